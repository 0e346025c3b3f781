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

void broadcast(MPI_Comm comm, int root, const BuiltScene& built, SceneSummaries& of) {
  MPI_Bcast(&of.errors_of_sums, static_cast<int>(sizeof of.errors_of_sums), MPI_BYTE, root, comm);
  broadcast_plain(comm, root, of.contacts);
  broadcast_plain(comm, root, of.step_errors);
  of.sector_rates.resize(built.watched_wear.sectors.size());
  for (std::vector<double>& rates : of.sector_rates)
    broadcast_plain(comm, root, rates);
  for (const auto& maxima : built.watched_wear.maxima)
    if (maxima && core::rank(comm) != root)
      of.classes.emplace_back(maxima->force, maxima->speed);
  static_assert(std::is_trivially_copyable_v<wear::KwuClasses>);
  MPI_Bcast(of.classes.data(), static_cast<int>(of.classes.size() * sizeof(wear::KwuClasses)), MPI_BYTE, root,
            comm);
  broadcast_plain(comm, root, of.nodes);
  broadcast_plain(comm, root, of.forces);
}

} // namespace

double output_interval(const study::Study& study) {
  return study.output.every.value_or(study.transient->duration / default_outputs);
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
  broadcast(comm, root, built, job.summaries);
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
  broadcast(comm, root, built, job.series);
}

Job::Job(const study::Study& study, const BuiltScene& built, const transient::StepChoice& choice,
         ProgressObserver* progress)
    : statistics_(study, built),
      impacts_(with_impacts(study) ? built.scene.contacts.size() : 0, study.output.statistics_from,
               study.output.rest_time, static_cast<std::size_t>(impact_rows(study, choice))),
      largest_(built.scene.contacts.size(), study.output.statistics_from),
      powers_(study.output.statistics_from), grid_(grid_of(study)),
      recorder_(built.scene, built.nodes, grid_, transient::scaled_masses(built.scene, choice.fastest)),
      observers_(watching(study, built, progress)), run_(built.scene, choice, observers_, &recorder_, grid_) {
  recorder_.add_reactions(built.forces);
}

JobResult Job::result() && {
  JobResult out;
  out.report = run_.finish();
  out.summaries = statistics_.summaries(run_);
  out.impacts = std::move(impacts_).impacts();
  out.largest_impacts = largest_.histories();
  out.power = powers_.balance();
  out.series = std::move(recorder_).series();
  return out;
}

/// Only what has something to see.
std::vector<transient::Observer*> Job::watching(const study::Study& study, const BuiltScene& built,
                                                ProgressObserver* progress) {
  std::vector<transient::Observer*> observers = statistics_.observers();
  if (!built.scene.contacts.empty())
    observers.push_back(&largest_);
  if (with_impacts(study) && !built.scene.contacts.empty())
    observers.push_back(&impacts_);
  if (!built.scene.system.motion.empty())
    observers.push_back(&powers_);
  if (progress)
    observers.push_back(progress);
  return observers;
}

} // namespace fretwork::app
