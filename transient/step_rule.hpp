// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The time step and its reason. Names of bounds are those of the table in scene/scheme_limits.hpp, a row for each scheme, with their values and sources.
///
///     h = min{ contact/w_c, contact/w_t, intervals tangential_damper/r_t, tangential_damper/r_e, highest_mode/w_max,
///              max(intervals normal_damper/r_n, f finest_for_normal_dampers/w_c),
///              max(structure_at_contacts/w_s, contact_beside_structure/max(w_c, w_t)) },
///     each bound min(f share, largest), f = (min(accuracy, coarsest_accuracy)/accuracy_of_shares)^1/2
/// over the terms that exist (step_terms.hpp), with:
///     w_c, w_t, w_s, r_t, r_n, w_max   scene_rates.hpp
///     r_e                         explicit_damper_rate; of devogelaere also the largest K_T/C_T of a sliding spring
/// Dampers of contacts are resolved by the intervals of splitting, the least number that keeps them, and contact_interval for w_c and w_t, in the step. A normal damper
/// that even finest_for_normal_dampers does not resolve is warned about, also with the automatic step (step_warnings.hpp).
///
/// With contacts splitting follows modes to highest_mode/h. In a step of highest_mode/(scaled_above max(w_c, w_t)) faster ones are made heavier
/// (mass_scaling.hpp), but none in a step below least_gain_of_scaling times highest_mode/w_max, the longest in which all are followed; where they may not be, or r_n h is above scaled_up_to_damper, the step is shorter. Without contacts exact flows have mode_without_contacts/w_max.
///
/// Hunt and Crossley's damper c(p) = K_N d p grows with a penetration that is not known beforehand. In an impact at the speed v w_c bounds its rate:
/// p <= min(1, sqrt(2/x)) v/w_c with x = d v (spring alone; damper alone), so that h c W <= 0.5 min(x, sqrt(2 x)).
/// Euler's limit 2 is met up to x = 8 (which leaves less than 1/8 of the speed). Where loads press the contact nothing bounds it: splitting
/// makes no mode heavier beside such dampers, at any step, and its intervals resolve them at the penetration that is ahead.
/// runge_kutta_54 chooses its steps by its tolerance: `step` is the longest, from the excitation and duration/200.
///
/// Loads: max(points/f, fewest_points) steps in the shortest period of the excitation, points_per_period of the table (points_of_lines for sampled
/// forces, points_without_contacts); never above the shortest interval of a table (longest_for_tables; whose points runge_kutta_54 ends its steps at); records by
/// record_share, with others than splitting by points. Nor is a step above duration/20000, where
/// steps are expensive, s = modes + 40 contacts above 100, duration/max(2000, 2e8/s^2): so many steps take milliseconds to some hundredths of a second.
///
/// Without a scheme given, collocation is taken where its predicted time (steps times the cost of one) is below 0.4 of that of splitting.
#pragma once
#include "transient/step_choice.hpp"
#include <optional>

namespace fretwork::transient {

struct StepOptions {
  std::optional<SchemeKind> scheme; ///< none: chosen
  std::optional<double> step;       ///< s: fixed
  double accuracy = 0.01;           ///< target relative error of statistics
  double tolerance = 1e-6;          ///< of a step's error in the energy norm: adaptive schemes
};

/// @throws core::Error where there would be absurdly many steps, or where the scheme cannot take the scene
[[nodiscard]] StepChoice choose_step(const Scene& scene, const StepOptions& options);

/// The same run at half the step, or, adaptive, at half the tolerance.
[[nodiscard]] StepChoice halved(StepChoice choice);

} // namespace fretwork::transient
