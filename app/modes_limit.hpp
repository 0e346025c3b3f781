// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far modes reach where the study gives modes.accuracy instead of their number (modal/impact_modes.hpp).
#pragma once
#include "app/build_contacts.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// Of the contact that asks for most: its stiffness (of the whole support) on the beams at its nodes, bent in the softer plane; the span
/// that its node is on. A beam that ends at the node without another is taken as free there.
/// @param study  with modes.accuracy
/// @throws core::Error where no contact is at a beam with mass
[[nodiscard]] results::ModesLimit modes_limit(const study::Study& study, const fem::Model& model,
                                              const std::vector<PlacedContact>& placed);

/// A note what was chosen and why; a warning where something shakes the structure faster than that.
void report_modes_limit(const study::Study& study, const results::ModesLimit& limit,
                        results::RunResults& out);

} // namespace fretwork::app
