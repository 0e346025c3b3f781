// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a step does not resolve: one message with each rate times the step, its bound (step_terms.hpp; loads: steps in a period), and the step that would
/// resolve them all. The step of an adaptive scheme (`steps` = 0) follows its tolerance: nothing is said of it.
#pragma once
#include "transient/step_choice.hpp"
#include <string>
#include <vector>

namespace fretwork::transient {

/// @return one message, or none
[[nodiscard]] std::vector<std::string> warnings_of_given_step(const StepChoice& c);
/// Of normal dampers that even the automatic step does not resolve.
/// @return one message, or none
[[nodiscard]] std::vector<std::string> warnings_of_automatic_step(const StepChoice& c);

} // namespace fretwork::transient
