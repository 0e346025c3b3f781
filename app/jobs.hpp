// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The transients of a study: one independent run for each connected structure, shared out over ranks.
#pragma once
#include "app/build_scene.hpp"
#include "app/checkpoints.hpp"
#include "app/expected_time.hpp"
#include "app/progress_observer.hpp"
#include "results/run_results.hpp"
#include <mpi.h>

namespace fretwork::app {

/// Collective: the step of every scene.
/// @throws core::Error where there would be absurdly many, or hardly any in the window of statistics
[[nodiscard]] std::vector<transient::StepChoice> choose_steps(MPI_Comm comm, const study::Study& study,
                                                              const std::vector<BuiltScene>& scenes);

/// @throws core::Error where the series of a run would not fit in memory
void check_size_of_series(const study::Study& study, const std::vector<BuiltScene>& scenes);

/// What watches and keeps the runs.
struct AroundRuns {
  const ProgressCallback& progress;
  Checkpoints& checkpoints;
  /// Of a study that is run several times: the numbers of its checkpoints start here; whether this time is not the last.
  std::size_t first_checkpoint = 0;
  bool others_follow = false;
};

/// Collective. Runs every scene and fills contact_summaries, node_summaries, transients and series of `out`,
/// complete on rank 0. Each goes on from its checkpoint, if there is one.
/// @param out  its contacts, node_names and force_sites are those of the scenes
/// @throws core::Error where the series would not fit in memory, core::ComputationError where a run diverged
void run_jobs(MPI_Comm comm, const study::Study& study, const std::vector<BuiltScene>& scenes,
              const AroundRuns& around, results::RunResults& out);

/// What a run of the scenes would be.
struct Forecast {
  double steps = 0.0, outputs = 0.0; ///< of all scenes; instants
  PilotTime time;                    ///< of all scenes one after the other
  std::string step_reason;           ///< of the shortest step
  std::vector<double> impact_rows;   ///< of one contact of each scene, at most
  std::vector<std::string> warnings; ///< of the choice of steps
};
/// Collective. Refuses what run_jobs refuses before its first step.
/// @throws core::Error
[[nodiscard]] Forecast check_jobs(MPI_Comm comm, const study::Study& study,
                                  const std::vector<BuiltScene>& scenes);

} // namespace fretwork::app
