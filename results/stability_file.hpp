// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Stability diagrams in results.h5: /stability/<number>, with attributes assessment and tubes; datasets factor, of the modes the number of their
/// tube and their own number there (from 0), and by factors and modes frequency (Hz), damping and growth (1/s).
#pragma once
#include "results/hdf5.hpp"
#include "results/run_results.hpp"

namespace fretwork::results {

/// Nothing where no assessment has a diagram. @throws h5::Failure
void write_stability(const h5::Group& root, const std::vector<StabilityAssessment>& assessments);

} // namespace fretwork::results
