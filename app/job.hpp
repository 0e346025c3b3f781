// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One run of a study with all that watches it, and what it gives.
#pragma once
#include "app/build_scene.hpp"
#include "app/progress_observer.hpp"
#include "app/scene_statistics.hpp"
#include "post/impact_table.hpp"
#include "post/largest_impact.hpp"
#include "post/power_balance.hpp"
#include "post/recorder.hpp"
#include "study/study.hpp"
#include "transient/run.hpp"
#include <mpi.h>

namespace fretwork::app {

/// s, between outputs: the study's, or a share of the duration.
[[nodiscard]] double output_interval(const study::Study& study);

/// Rows of the table of impacts of a contact: an impact takes a step, and an open one parts it from the next.
[[nodiscard]] std::int64_t impact_rows(const study::Study& study, const transient::StepChoice& choice);

/// What one run gives.
struct JobResult {
  transient::Report report{};
  SceneSummaries summaries;
  std::vector<post::ContactImpacts> impacts;                  ///< empty without tables
  std::vector<std::vector<post::ForcePoint>> largest_impacts; ///< by contact
  post::PowerBalance power;                                   ///< under a fluidelastic law, else 0
  post::TimeSeries series;
};

/// Collective: the result of a job from its rank to all. Names are known everywhere.
void broadcast(MPI_Comm comm, int root, const BuiltScene& built, JobResult& job);

/// A run and all that watches it.
class Job {
public:
  /// @param progress  nullptr: nobody watches
  Job(const study::Study& study, const BuiltScene& built, const transient::StepChoice& choice,
      ProgressObserver* progress);
  [[nodiscard]] transient::Run& run() { return run_; }
  /// After the last step.
  [[nodiscard]] JobResult result() &&;

private:
  std::vector<transient::Observer*> watching(const study::Study& study, const BuiltScene& built,
                                             ProgressObserver* progress);

  SceneStatistics statistics_;
  post::ImpactTable impacts_;
  post::LargestImpact largest_;
  post::PowerStatistics powers_;
  transient::OutputGrid grid_;
  post::Recorder recorder_;
  std::vector<transient::Observer*> observers_;
  transient::Run run_;
};

} // namespace fretwork::app
