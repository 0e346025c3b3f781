// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/scene_statistics.hpp"
#include "app/judge_run.hpp"
#include "app/verification.hpp"

namespace fretwork::app {
namespace {

post::NodeStatistics node_statistics(const study::Study& study, const BuiltScene& built) {
  std::vector<Eigen::MatrixXd> rows, imposed;
  for (const post::ObservedNode& node : built.nodes) {
    rows.push_back(node.rows);
    imposed.push_back(node.imposed);
  }
  post::NodeStatistics out(rows, study.output.statistics_from);
  if (!study.support_motions.empty())
    out.add_imposed_motion(imposed, built.scene.motions, built.scene.duration);
  return out;
}

post::ForceStatistics force_statistics(const study::Study& study, const BuiltScene& built) {
  post::ForceStatistics out(built.forces, study.output.statistics_from);
  out.add_loads(built.forces, built.scene.loads, built.scene.duration);
  if (!study.support_motions.empty())
    out.add_imposed_motion(built.forces, built.scene.motions, built.scene.duration);
  return out;
}

} // namespace

SceneStatistics::SceneStatistics(const study::Study& study, const BuiltScene& built)
    : built_(built), contacts_(built.scene.contacts, study.output.statistics_from),
      sectors_(built.watched_wear.sectors, study.output.statistics_from,
               built.watched_wear.by_place ? std::span(built.scene.contacts)
                                           : std::span<const transient::ContactPoint>()),
      classes_(built.watched_wear.maxima, study.output.statistics_from),
      nodes_(node_statistics(study, built)), forces_(force_statistics(study, built)) {}

std::vector<transient::Observer*> SceneStatistics::observers() {
  std::vector<transient::Observer*> out;
  if (!built_.scene.contacts.empty())
    out.push_back(&contacts_);
  if (!built_.watched_wear.sectors.empty())
    out.push_back(&sectors_);
  if (built_.watched_wear.counts_forces())
    out.push_back(&classes_);
  if (!built_.nodes.empty())
    out.push_back(&nodes_);
  if (!built_.forces.empty())
    out.push_back(&forces_);
  return out;
}

SceneSummaries SceneStatistics::summaries(const transient::Run& run) {
  return {contacts_.summaries(), contacts_.errors_of_sums(), run.step_errors(),  sectors_.rates(),
          classes_.classes(),    nodes_.summaries(),         forces_.summaries()};
}

void resize_summaries(results::RunResults& out) {
  out.contact_summaries.resize(out.contacts.size());
  out.sector_rates.resize(out.contacts.size());
  out.force_speed_classes.resize(out.contacts.size());
  out.node_summaries.resize(out.node_names.size());
  out.force_summaries.resize(out.force_sites.size());
}

void merge_summaries(const BuiltScene& built, const SceneSummaries& scene, results::RunResults& out) {
  add_errors(out.errors_of_sums, scene.errors_of_sums);
  if (!scene.step_errors.empty())
    out.step_errors.resize(out.contact_summaries.size());
  std::size_t counted = 0;
  for (std::size_t c = 0; c < built.contacts.size(); ++c) {
    const std::size_t number = built.contacts[c];
    out.contact_summaries[number] = scene.contacts[c];
    if (!scene.step_errors.empty())
      out.step_errors[number] = without_round_off(scene.step_errors[c], scene.contacts[c]);
    if (c < scene.sector_rates.size())
      out.sector_rates[number] = scene.sector_rates[c];
    if (c < built.watched_wear.maxima.size() && built.watched_wear.maxima[c])
      out.force_speed_classes[number] = scene.classes[counted++];
  }
  for (std::size_t k = 0; k < built.node_numbers.size(); ++k)
    out.node_summaries[built.node_numbers[k]] = scene.nodes[k];
  for (std::size_t k = 0; k < built.force_numbers.size(); ++k)
    out.force_summaries[built.force_numbers[k]] = scene.forces[k];
}

} // namespace fretwork::app
