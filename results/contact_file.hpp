// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A contact as it was set up: the attributes of /contacts/<name> in results.h5 (doc/results.md).
#pragma once
#include "results/hdf5.hpp"
#include "results/run_results.hpp"

namespace fretwork::results {

/// @param nodes  of the model, m
void write_facts(const h5::Group& group, const ContactFacts& c, const std::vector<core::Vec3>& nodes);
/// @throws h5::Failure if something is missing or does not fit together
[[nodiscard]] ContactFacts read_facts(const h5::Group& group);

} // namespace fretwork::results
