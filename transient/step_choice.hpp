// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Scheme and step of a run, as step_rule.hpp chooses them.
#pragma once
#include "transient/scene/scheme.hpp"
#include "transient/scene_rates.hpp"
#include <cstdint>
#include <string>
#include <vector>

namespace fretwork::transient {

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

} // namespace fretwork::transient
