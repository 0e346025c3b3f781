// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the user is to know of runs that have ended: failures, and doubts about their results.
#pragma once
#include "app/build_scene.hpp"
#include "results/run_results.hpp"
#include "transient/run.hpp"

namespace fretwork::app {

/// Adds the warnings of a run to `out`.
/// @throws core::ComputationError where the run diverged or stopped
void judge_run(const study::Study& study, const BuiltScene& built, const transient::StepChoice& choice,
               const transient::Report& report, results::RunResults& out);

/// Adds a warning where the step changes statistics by more than the accuracy.
void judge_step_errors(results::RunResults& out);
/// Without the work of a contact that does not slide in its statistics.
[[nodiscard]] transient::StepError without_round_off(transient::StepError error,
                                                     const post::ContactSummary& of);

/// A table that ends early never does so silently: a note where impacts have no row.
/// @param kept  output.impacts
void tell_impacts_left_out(std::int64_t kept, results::RunResults& out);

} // namespace fretwork::app
