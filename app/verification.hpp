// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// `verify = true`: every run again at half the step (half the tolerance), its statistics beside those of the run.
#pragma once
#include "app/build_scene.hpp"
#include "app/progress_observer.hpp"
#include "app/resumed_run.hpp"
#include "results/run_results.hpp"
#include <mpi.h>

namespace fretwork::app {

/// What is kept of a run at half the step.
struct HalfRun {
  transient::Report report{};
  std::vector<post::ContactSummary> contacts;
  post::StandardErrors errors_of_sums;
};

/// @param choice  of the run itself   @param from  s, start of the window of the statistics
/// @param progress  tells how far it is, or null
/// @param own  it goes on from a checkpoint of its own
[[nodiscard]] HalfRun run_at_half(const transient::Scene& scene, const transient::StepChoice& choice,
                                  double from, ProgressObserver* progress, const OwnCheckpoint& own);

/// Collective.
void broadcast(MPI_Comm comm, int root, std::size_t contacts, HalfRun& half);

/// Errors of sums over the contacts of structures that nothing joins: independent, squares add up.
void add_errors(post::StandardErrors& sum, const post::StandardErrors& of);

/// Fills out.verification from the statistics in `out`, and warns where they differ.
/// @param halves  as `scenes`
void compare_with_half(const std::vector<BuiltScene>& scenes, const std::vector<HalfRun>& halves,
                       results::RunResults& out);

} // namespace fretwork::app
