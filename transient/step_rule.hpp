// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The time step and its reason.
///
///     h = min{ c/w_c, s/w_t, r/r_t, max(n/r_n, 0.03/w_c), m/w_max },  the shares at an accuracy of 0.01; others grow and fall with its square root
///
///                          c      s      r     n     m
///     splitting            1.25   1.25   403   115   2.5 (down to 1.5 where r_t h is above 3) where modes cannot be made heavier (mass_scaling.hpp)
///     collocation          0.5    0.5    2     2     -
///     energy_conserving    0.3    0.3    2     2     2.5
///     euler, devogelaere   0.3    0.3    0.5   -     0.5
/// over the terms that exist, with:
///     w_c, w_t, r_t, r_n, w_max   scene_rates.hpp
/// r_n counts for splitting, collocation and energy_conserving, which take normal dampers implicitly. splitting resolves them, as tangential ones, in its
/// intervals, of which a step has up to 64: r_t dt = 6.3, r_n dt = 1.8 whatever the accuracy. With collocation a damper of r_n h = 2 stops a mass in
/// one step. A damper that even 0.03/w_c does not resolve is warned about, also with the automatic step: of energy_conserving the rebounds are right
/// (conserving_normal.hpp), the largest force at first touch is not.
/// No accuracy makes a step longer than that of 0.02, nor w_c h than 1.25 with splitting and 1 with collocation (devogelaere: 0.75,
/// energy_conserving: 0.5), above which impacts are wrong however stable the run (doc/schemes.md, Stability map), nor r_t h than 4 where dampers are
/// implicit, r_t dt than 6.3 in the intervals of splitting. With contacts
/// splitting resonates with modes at w h = k pi: those above w h = m are made heavier (mass_scaling.hpp), or where they may not be, and
/// with energy_conserving, the step stays below 2.5/w_max. The limits of explicit Euler are r_t h < 1 and w_max h < 2; it also takes the other dampers explicitly and
/// resolves them by 0.5/r_e (its limit: r_e h < 2):
///     r_e    explicit_damper_rate
/// Hunt and Crossley's damper c(p) = K_N d p grows with a penetration that is not known beforehand, but w_c bounds its rate: an impact
/// at the speed v has p <= min(1, sqrt(2/x)) v/w_c with x = d v (spring alone; damper alone), so that h c W <= 0.5 min(x, sqrt(2 x)).
/// Euler's limit 2 is met up to x = 8 (which leaves less than 1/8 of the speed); the splitting takes the damper implicitly.
/// devogelaere has Euler's terms, r_e also the largest K_T/C_T of a sliding spring, and never more than 0.5 for all dampers (its limit: 0.59).
/// runge_kutta_54 chooses its steps by its tolerance: `step` is the longest, from the terms of the loads and duration/200.
/// Never above 1/30 of the shortest period of the excitation at an accuracy of 0.01 (without contacts 1/200, and m = 0.3: statistics must
/// see the modes), nor the shortest interval of a table (whose points runge_kutta_54 ends its steps at), nor duration/20000, where
/// steps are expensive, s = modes + 40 contacts above 100, duration/max(2000, 2e8/s^2): so many steps take milliseconds to some hundredths of a second.
///
/// Without a scheme given, collocation is taken where its predicted time (steps times the cost of one) is below 0.7 of that of splitting.
#pragma once
#include "transient/scene/scheme.hpp"
#include "transient/scene_rates.hpp"
#include <optional>
#include <string>
#include <vector>

namespace fretwork::transient {

struct StepOptions {
  std::optional<SchemeKind> scheme; ///< none: chosen
  std::optional<double> step;       ///< s: fixed
  double accuracy = 0.01;           ///< target relative error of statistics
  double tolerance = 1e-6;          ///< of a step's error in the energy norm: adaptive schemes
};

struct StepChoice : SceneRates {
  SchemeKind scheme = SchemeKind::splitting;
  double step = 0.0;       ///< s; of an adaptive scheme the longest
  std::int64_t steps = 0;  ///< that cover the duration; 0: adaptive
  double tolerance = 1e-6; ///< of an adaptive scheme
  double fastest =
      0.0; ///< rad/s: of the automatic step of splitting: faster modes are made heavier (mass_scaling.hpp); 0: none
  int scaled = 0; ///< how many modes that are
  int parts = 1;  ///< intervals in which splitting moves contacts within a step
  double replay =
      0.0; ///< s, length of the replays that measure the error of the step and refine `parts` (replays.hpp); 0: none
  double accuracy = 0.01; ///< asked for
  int macro_steps = 1;    ///< steps that splitting makes at once while no contact can meet its obstacle
  double explicit_rate =
      0.0; ///< r_e, 1/s: of the dampers that only Euler and devogelaere have to resolve; 0 with others
  std::string reason;        ///< one line for the user
  std::string scheme_reason; ///< why this scheme; empty where it was given
  std::vector<std::string>
      warnings; ///< what a fixed step does not resolve, and normal dampers that no automatic one does
};

/// @throws core::Error where there would be absurdly many steps, or where the scheme cannot take the scene
[[nodiscard]] StepChoice choose_step(const Scene& scene, const StepOptions& options);

/// The same run at half the step, or, adaptive, at half the tolerance.
[[nodiscard]] StepChoice halved(StepChoice choice);

} // namespace fretwork::transient
