// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/job.hpp"
#include "core/mpi.hpp"
#include "transient/modes/mass_scaling.hpp"
#include <algorithm>
#include <type_traits>

namespace fretwork::app {
namespace {

/// Output instants of a run for which the study names no interval.
constexpr double default_outputs = 5000.0;

bool with_impacts(const study::Study& study) { return study.output.impacts > 0; }

std::vector<Eigen::MatrixXd> rows_of(const std::vector<post::ObservedNode>& nodes) {
  std::vector<Eigen::MatrixXd> rows;
  for (const auto& node : nodes)
    rows.push_back(node.rows);
  return rows;
}

transient::OutputGrid grid_of(const study::Study& study) {
  return transient::output_grid(study.transient->duration, output_interval(study));
}

template <class T> void broadcast_plain(MPI_Comm comm, int root, std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  constexpr std::size_t part = (std::size_t{1} << 30) / sizeof(T); // counts stay within an int
  auto count = static_cast<std::uint64_t>(values.size());
  MPI_Bcast(&count, 1, MPI_UINT64_T, root, comm);
  values.resize(count);
  for (std::size_t at = 0; at < count; at += part)
    MPI_Bcast(values.data() + at, static_cast<int>(std::min(part, count - at) * sizeof(T)), MPI_BYTE, root,
              comm);
}

void broadcast(MPI_Comm comm, int root, const BuiltScene& built, post::TimeSeries& all) {
  core::broadcast(comm, root, all.time);
  core::broadcast(comm, root, all.modal_displacement);
  core::broadcast(comm, root, all.modal_velocity);
  all.contacts.resize(built.scene.contacts.size());
  for (std::size_t c = 0; c < built.scene.contacts.size(); ++c) {
    auto& series = all.contacts[c];
    series.name = built.scene.contacts[c].name;
    core::broadcast(comm, root, series.displacement);
    core::broadcast(comm, root, series.velocity);
    core::broadcast(comm, root, series.gap);
    core::broadcast(comm, root, series.normal_force);
    core::broadcast(comm, root, series.tangential_force);
    core::broadcast(comm, root, series.normal);
    broadcast_plain(comm, root, series.state);
  }
  all.nodes.resize(built.nodes.size());
  for (std::size_t k = 0; k < built.nodes.size(); ++k) {
    auto& series = all.nodes[k];
    series.name = built.nodes[k].name;
    core::broadcast(comm, root, series.displacement);
    core::broadcast(comm, root, series.velocity);
    core::broadcast(comm, root, series.acceleration);
  }
  std::vector<std::string> reactions;
  for (const post::FollowedForce& force : built.forces)
    if (!force.section)
      reactions.push_back(force.name);
  all.reactions.resize(reactions.size());
  for (std::size_t k = 0; k < reactions.size(); ++k) {
    all.reactions[k].name = reactions[k];
    core::broadcast(comm, root, all.reactions[k].force);
  }
}

} // namespace

double output_interval(const study::Study& study) {
  return study.output.every.value_or(study.transient->duration / default_outputs);
}

post::NodeStatistics node_statistics(const study::Study& study, const BuiltScene& built) {
  post::NodeStatistics out(rows_of(built.nodes), study.output.statistics_from);
  if (study.support_motions.empty())
    return out;
  std::vector<Eigen::MatrixXd> imposed;
  for (const auto& node : built.nodes)
    imposed.push_back(node.imposed);
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

std::int64_t impact_rows(const study::Study& study, const transient::StepChoice& choice) {
  const bool adaptive = choice.steps == 0;
  return adaptive ? study.output.impacts : std::min(study.output.impacts, choice.steps / 2 + 1);
}

void broadcast(MPI_Comm comm, int root, const BuiltScene& built, JobResult& job) {
  static_assert(std::is_trivially_copyable_v<transient::Report>);
  MPI_Bcast(&job.report, static_cast<int>(sizeof job.report), MPI_BYTE, root, comm);
  static_assert(std::is_trivially_copyable_v<post::PowerBalance>);
  MPI_Bcast(&job.power, static_cast<int>(sizeof job.power), MPI_BYTE, root, comm);
  MPI_Bcast(&job.errors_of_sums, static_cast<int>(sizeof job.errors_of_sums), MPI_BYTE, root, comm);
  broadcast_plain(comm, root, job.contacts);
  broadcast_plain(comm, root, job.step_errors);
  std::uint64_t tables = job.impacts.size();
  MPI_Bcast(&tables, 1, MPI_UINT64_T, root, comm);
  job.impacts.resize(tables);
  for (post::ContactImpacts& table : job.impacts) {
    broadcast_plain(comm, root, table.rows);
    MPI_Bcast(&table.left_out, 1, MPI_INT64_T, root, comm);
  }
  job.largest_impacts.resize(built.scene.contacts.size());
  for (std::vector<post::ForcePoint>& history : job.largest_impacts)
    broadcast_plain(comm, root, history);
  job.sector_rates.resize(built.watched_wear.sectors.size());
  for (std::vector<double>& rates : job.sector_rates)
    broadcast_plain(comm, root, rates);
  for (const auto& maxima : built.watched_wear.maxima)
    if (maxima && core::rank(comm) != root)
      job.classes.emplace_back(maxima->force, maxima->speed);
  MPI_Bcast(job.classes.data(), static_cast<int>(job.classes.size() * sizeof(wear::KwuClasses)), MPI_BYTE,
            root, comm);
  broadcast_plain(comm, root, job.nodes);
  broadcast_plain(comm, root, job.forces);
  broadcast(comm, root, built, job.series);
}

Job::Job(const study::Study& study, const BuiltScene& built, const transient::StepChoice& choice,
         ProgressObserver* progress)
    : contacts_(built.scene.contacts, study.output.statistics_from),
      impacts_(with_impacts(study) ? built.scene.contacts.size() : 0, study.output.statistics_from,
               study.output.rest_time, static_cast<std::size_t>(impact_rows(study, choice))),
      largest_(built.scene.contacts.size(), study.output.statistics_from),
      sectors_(built.watched_wear.sectors, study.output.statistics_from,
               built.watched_wear.by_place ? std::span(built.scene.contacts)
                                           : std::span<const transient::ContactPoint>()),
      classes_(built.watched_wear.maxima, study.output.statistics_from),
      nodes_(node_statistics(study, built)), forces_(force_statistics(study, built)),
      powers_(study.output.statistics_from), grid_(grid_of(study)),
      recorder_(built.scene, built.nodes, grid_, transient::scaled_masses(built.scene, choice.fastest)),
      observers_(watching(study, built, progress)), run_(built.scene, choice, observers_, &recorder_, grid_) {
  recorder_.add_reactions(built.forces);
}

JobResult Job::result() && {
  JobResult out;
  out.report = run_.finish();
  out.contacts = contacts_.summaries();
  out.errors_of_sums = contacts_.errors_of_sums();
  out.step_errors = run_.step_errors();
  out.impacts = std::move(impacts_).impacts();
  out.largest_impacts = largest_.histories();
  out.sector_rates = sectors_.rates();
  out.classes = classes_.classes();
  out.nodes = nodes_.summaries();
  out.forces = forces_.summaries();
  out.power = powers_.balance();
  out.series = std::move(recorder_).series();
  return out;
}

/// Only what has something to see.
std::vector<transient::Observer*> Job::watching(const study::Study& study, const BuiltScene& built,
                                                ProgressObserver* progress) {
  std::vector<transient::Observer*> observers;
  if (!built.scene.contacts.empty()) {
    observers.push_back(&contacts_);
    observers.push_back(&largest_);
  }
  if (with_impacts(study) && !built.scene.contacts.empty())
    observers.push_back(&impacts_);
  if (!built.watched_wear.sectors.empty())
    observers.push_back(&sectors_);
  if (built.watched_wear.counts_forces())
    observers.push_back(&classes_);
  if (!built.nodes.empty())
    observers.push_back(&nodes_);
  if (!built.forces.empty())
    observers.push_back(&forces_);
  if (!built.scene.system.motion.empty())
    observers.push_back(&powers_);
  if (progress)
    observers.push_back(progress);
  return observers;
}

} // namespace fretwork::app
