// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One run of a study with all that watches it, and what it gives.
#pragma once
#include "app/build_scene.hpp"
#include "app/progress_observer.hpp"
#include "post/contact_statistics.hpp"
#include "post/force_speed_classes.hpp"
#include "post/force_statistics.hpp"
#include "post/impact_table.hpp"
#include "post/largest_impact.hpp"
#include "post/node_statistics.hpp"
#include "post/power_balance.hpp"
#include "post/recorder.hpp"
#include "post/sector_work.hpp"
#include "study/study.hpp"
#include "transient/run.hpp"
#include <mpi.h>

namespace fretwork::app {

/// s, between outputs: the study's, or a share of the duration.
[[nodiscard]] double output_interval(const study::Study& study);

/// Rows of the table of impacts of a contact: an impact takes a step, and an open one parts it from the next.
[[nodiscard]] std::int64_t impact_rows(const study::Study& study, const transient::StepChoice& choice);

/// Of the observed nodes and the forces of a scene, over the window of the study.
[[nodiscard]] post::NodeStatistics node_statistics(const study::Study& study, const BuiltScene& built);
[[nodiscard]] post::ForceStatistics force_statistics(const study::Study& study, const BuiltScene& built);

/// What one run gives.
struct JobResult {
  transient::Report report{};
  std::vector<post::ContactSummary> contacts;
  post::StandardErrors errors_of_sums;                        ///< of all contacts of the run
  std::vector<transient::StepError> step_errors;              ///< by contact; empty: not measured
  std::vector<post::ContactImpacts> impacts;                  ///< empty without tables
  std::vector<std::vector<post::ForcePoint>> largest_impacts; ///< by contact
  std::vector<std::vector<double>> sector_rates;              ///< W, by contact; empty where nothing wears
  std::vector<wear::KwuClasses> classes;                      ///< of the contacts under the law kwu_epri
  std::vector<post::NodeSummary> nodes;
  std::vector<post::ForceSummary> forces;
  post::PowerBalance power; ///< under a fluidelastic law, else 0
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

  post::ContactStatistics contacts_;
  post::ImpactTable impacts_;
  post::LargestImpact largest_;
  post::SectorStatistics sectors_;
  post::ForceSpeedClasses classes_;
  post::NodeStatistics nodes_;
  post::ForceStatistics forces_;
  post::PowerStatistics powers_;
  transient::OutputGrid grid_;
  post::Recorder recorder_;
  std::vector<transient::Observer*> observers_;
  transient::Run run_;
};

} // namespace fretwork::app
