// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far modes reach where the study gives modes.accuracy, or says nothing of their number (modal/impact_modes.hpp).
#pragma once
#include "app/build_contacts.hpp"
#include "app/turbulent_loads.hpp"
#include "modal/basis.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// Of a study that says nothing of the number of its modes.
constexpr double default_modes_accuracy = 0.01;

/// Of each structure, that a study takes which says nothing of their number.
constexpr int most_default_modes = 1000;

/// What the contact that asks for most needs, or the loads where that is more: twice the highest frequency of loads and motions, the end of the
/// band of turbulence, above which a thousandth of its forces lies. The contact's: its
/// stiffness (of the whole support) on the beams at its nodes, bent in the softer plane; the span that its node is on. A beam that ends at
/// the node without another is taken as free there.
/// Sets modes.up_to_hz (and modes.accuracy) of the study. Empty, and nothing is set, where the study gives count or up_to_hz, and where it
/// gives nothing, no contact is at a beam with mass and there is no turbulence: the default count holds.
/// @throws core::Error where the study gives modes.accuracy and no contact is at a beam with mass
[[nodiscard]] std::optional<results::ModesLimit>
take_modes_limit(study::Study& study, const fem::Model& model, const std::vector<PlacedContact>& placed,
                 const std::vector<TurbulentLoad>& turbulence);

/// Lowers the limit of a study that says nothing of the number of its modes to that of most_default_modes of one structure, by the waves along
/// its beams; the accuracy of the limit is then not a number.
/// @return a warning with the error that remains; empty where nothing was lowered
[[nodiscard]] std::string cap_default_modes(study::Study& study, const fem::Model& model,
                                            const std::vector<PlacedContact>& placed,
                                            results::ModesLimit& limit);

/// A note what was chosen and why.
void report_modes_limit(const study::Study& study, const results::ModesLimit& limit,
                        results::RunResults& out);

/// What is right in statics may be wrong in impacts: of the contact whose structure has modes that end farthest below what forces within
/// 10 % need with static modes, and below half its frequency. Empty where there is none, without these, and with
/// modes.accuracy.
[[nodiscard]] std::string few_modes_warning(const study::Study& study, const fem::Model& model,
                                            const std::vector<PlacedContact>& placed,
                                            const std::vector<modal::Basis>& bases);

} // namespace fretwork::app
