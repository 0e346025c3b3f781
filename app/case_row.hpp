// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The outputs of a case of a sweep: their names, the same for all cases, and the row of one.
#pragma once
#include "app/build_contacts.hpp"
#include "app/worn_places.hpp"
#include "results/run_results.hpp"
#include "sweep/table.hpp"

namespace fretwork::app {

/// By contact (work_rate, normal_rms, normal_max, tangential_max, impact_rate, contact_time_ratio), by support that wears (wear_depth, years, support_years where it
/// has a limit of its own),
/// by observed node (std_x, largest_x ...), by group of section forces (stress, stress_std, moment, shear_force), by restraint (force, moment), by assessment of
/// stability (velocity_ratio: V/Vc),
/// of all contacts together (total.work_rate, total.impact_rate, total.energy_residual), of the worst one (worst.work_rate, worst.normal_rms,
/// worst.normal_max, worst.wear_depth, worst.years, worst.velocity_ratio).
/// @param contacts  inactive ones included
/// @param facts  node_names, force_sites, and of stability the names of assessments and tubes
/// @throws core::Error where two have the same name, or there are none
[[nodiscard]] std::vector<sweep::Column> case_columns(const std::vector<PlacedContact>& contacts,
                                                      const std::vector<WornPlace>& worn,
                                                      const results::RunResults& facts);

/// What is not there in a case, such as a contact that is inactive, is not a number.
/// @param placed  as the contacts of `run`
/// @throws core::Error for an output that is no column
[[nodiscard]] std::vector<double> case_row(const std::vector<sweep::Column>& columns,
                                           const std::vector<PlacedContact>& placed,
                                           const results::RunResults& run);

} // namespace fretwork::app
