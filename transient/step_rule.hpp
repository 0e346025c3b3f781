// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The time step and its reason.
///
///     h = min{ c/w_c, s t_s, r/r_t, m/w_max },  the shares at an accuracy of 0.01; others grow and fall with its square root
///
///                          c      s      r     m
///     splitting            0.45   0.25   3     2.5
///     collocation          0.5    0.5    2     -
///     energy_conserving    0.3    0.3    2     2.5
///     euler, devogelaere   0.3    0.3    0.5   0.5
/// over the terms that exist, with:
///     w_c    contact frequency: w_c^2 = largest eigenvalue of K_N^1/2 W K_N^1/2, W = B B^T over all normal
///            directions of all contacts; with residual flexibility R (Scene) of (K_N^-1 + R)^-1 in place of K_N
///     t_s    time in which sticking contacts move: 1/w_t, w_t as w_c with K_T over the tangent directions; with splitting
///            (1/w_t^2 + (C_T/K_T)^2)^1/2, the smallest C_T/K_T of all contacts with friction, and never w_t h above 0.5
///     r_t    rate of the tangential dampers, largest eigenvalue of C_T^1/2 W C_T^1/2
///     w_max  highest mode
/// No accuracy makes a step longer than that of 0.04, nor w_c h and w_t h than 1 (devogelaere: 0.75), above which impacts are wrong however
/// stable the run (doc/schemes.md, Stability map), nor r_t h than 4 where dampers are implicit. w_max h stays below 2.5: splitting resonates
/// with modes at w h = k pi. The limits of explicit Euler are r_t h < 1 and w_max h < 2; it also takes the other dampers explicitly and
/// resolves them by 0.5/r_e (its limit: r_e h < 2):
///     r_e    the largest of the rates of the structure's damping and of the normal dampers (c(p) at t = 0 in place of C_T)
/// Hunt and Crossley's damper c(p) = K_N d p grows with a penetration that is not known beforehand, but w_c bounds its rate: an impact
/// at the speed v has p <= min(1, sqrt(2/x)) v/w_c with x = d v (spring alone; damper alone), so that h c W <= eps min(x, sqrt(2 x)).
/// Euler's limit 2 is met up to x = 8 (which leaves less than 1/8 of the speed); the splitting takes the damper implicitly.
/// devogelaere has Euler's terms, r_e also the largest K_T/C_T of a sliding spring, with eps <= 0.5 for all dampers (its limit: 0.59).
/// runge_kutta_54 chooses its steps by its tolerance: `step` is the longest, from the terms of the loads and duration/200.
/// Never above 1/30 of the shortest period of the excitation times 2 eps (without contacts 1/200, and b = 0.6: statistics must
/// see the modes), nor the shortest interval of a table, nor duration/20000 (so many steps take milliseconds).
///
/// Without a scheme given, collocation is taken where its predicted time (steps times the cost of one) is below that of splitting.
#pragma once
#include "transient/scheme.hpp"
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

struct StepChoice {
  SchemeKind scheme = SchemeKind::splitting;
  double step = 0.0;              ///< s; of an adaptive scheme the longest
  int order = 2;                  ///< of statistics: order_of_statistics
  std::int64_t steps = 0;         ///< that cover the duration; 0: adaptive
  double tolerance = 1e-6;        ///< of an adaptive scheme
  double contact_frequency = 0.0; ///< w_c, rad/s
  double stick_frequency = 0.0;   ///< w_t, rad/s
  double stick_relaxation = 0.0;  ///< s, smallest C_T/K_T of the contacts with friction
  double damper_rate = 0.0;       ///< r_t, 1/s
  double explicit_rate = 0.0; ///< r_e, 1/s: of the dampers that only Euler has to resolve; 0 with splitting
  double highest_mode = 0.0;  ///< rad/s
  double excitation = 0.0;    ///< Hz
  std::string reason;         ///< one line for the user
  std::string scheme_reason;  ///< why this scheme; empty where it was given
  std::vector<std::string> warnings; ///< what a fixed step does not resolve
};

/// @throws core::Error where there would be absurdly many steps, or where the scheme cannot take the scene
[[nodiscard]] StepChoice choose_step(const Scene& scene, const StepOptions& options);

/// The same run at half the step, or, adaptive, at half the tolerance.
[[nodiscard]] StepChoice halved(StepChoice choice);

/// p of the statistics of a run with contacts: their error falls by 2^p from a choice to the halved one. 1 for euler, for the adaptive
/// scheme, whose error goes as its tolerance, and with the memory `reference`, whose spring jumps once a step; else 2, also of the schemes of order 4: forces have a kink where a contact opens or closes
/// inside a step, which costs them the order on all but single smooth paths (doc/schemes.md).
[[nodiscard]] int order_of_statistics(const Scene& scene, SchemeKind scheme);

} // namespace fretwork::transient
