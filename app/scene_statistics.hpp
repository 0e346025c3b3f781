// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The statistics of one scene over the window of the study, and their places among those of all scenes: of single runs and of the cases of
/// sweeps alike.
#pragma once
#include "app/build_scene.hpp"
#include "post/contact_statistics.hpp"
#include "post/force_speed_classes.hpp"
#include "post/force_statistics.hpp"
#include "post/node_statistics.hpp"
#include "post/sector_work.hpp"
#include "results/run_results.hpp"
#include "study/study.hpp"
#include "transient/run.hpp"

namespace fretwork::app {

/// By contact, observed node and force of the scene.
struct SceneSummaries {
  std::vector<post::ContactSummary> contacts;
  post::StandardErrors errors_of_sums;           ///< of all contacts of the scene
  std::vector<transient::StepError> step_errors; ///< by contact; empty: not measured
  std::vector<std::vector<double>> sector_rates; ///< W, by contact; empty where nothing wears
  std::vector<wear::KwuClasses> classes;         ///< of the contacts under the law kwu_epri
  std::vector<post::NodeSummary> nodes;
  std::vector<post::ForceSummary> forces;
};

/// What observes a run for them.
class SceneStatistics {
public:
  /// @param built  must live longer
  SceneStatistics(const study::Study& study, const BuiltScene& built);
  SceneStatistics(const SceneStatistics&) = delete;
  SceneStatistics& operator=(const SceneStatistics&) = delete;

  /// Those that have something to observe.
  [[nodiscard]] std::vector<transient::Observer*> observers();
  /// After the last step of the run.
  [[nodiscard]] SceneSummaries summaries(const transient::Run& run);

private:
  const BuiltScene& built_;
  post::ContactStatistics contacts_;
  post::SectorStatistics sectors_;
  post::ForceSpeedClasses classes_;
  post::NodeStatistics nodes_;
  post::ForceStatistics forces_;
};

/// Makes room in `out` for the summaries of its `contacts`, `node_names` and `force_sites`.
void resize_summaries(results::RunResults& out);

/// Puts the summaries of a scene at their places in `out`; errors of sums add up.
void merge_summaries(const BuiltScene& built, const SceneSummaries& scene, results::RunResults& out);

} // namespace fretwork::app
