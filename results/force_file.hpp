// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Forces of sections and restraints in results.h5: /sections/<group>, statistics of one section a row, and /reactions/<name>, series.
#pragma once
#include "results/hdf5.hpp"
#include "results/run_results.hpp"

namespace fretwork::results {

/// @throws h5::Failure
void write_forces(const h5::Group& root, const RunResults& results);
/// Of restraints the series only: their statistics are in summary.json.
/// @throws h5::Failure
void read_forces(const h5::Group& root, RunResults& results);

} // namespace fretwork::results
