// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/jobs.hpp"
#include "app/resumed_run.hpp"
#include "app/verification.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/share_out.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <type_traits>

namespace fretwork::app {
namespace {

/// Output instants of a run for which the study names no interval.
constexpr double default_outputs = 5000.0;
/// Above this residual of the energy the results are not to be trusted, whatever they look like.
constexpr double residual_warning = 0.05;

/// Dampers of contacts that give back this share of the energy put in are no round-off.
constexpr double given_by_dampers = 0.01;

/// Series and tables are held in memory until they are written; a study that asks for more than this has a slip in
/// output.every or output.impacts.
constexpr double most_series_bytes = 4294967296.0;

void check_size_of_series(const study::Study& study, const std::vector<BuiltScene>& scenes) {
  const double duration = study.transient->duration,
               every = study.output.every.value_or(duration / default_outputs);
  double columns = 1.0; // values at an output: modal and of contacts and nodes, as in results.h5
  for (const BuiltScene& built : scenes)
    columns += 2.0 * static_cast<double>(built.modes) + 10.0 * static_cast<double>(built.contacts.size()) +
               9.0 * static_cast<double>(built.nodes.size());
  const double bytes = duration / every * columns * static_cast<double>(sizeof(double));
  if (bytes > most_series_bytes)
    throw core::Error(fmt::format("output.every = {}: {:.3g} outputs of {} values would take {:.3g} GB, at "
                                  "most {:.3g} are held; sample less often "
                                  "(statistics see every step)",
                                  every, duration / every, columns, bytes * 1e-9, most_series_bytes * 1e-9));
}

/// Rows of the table of impacts of a contact: an impact takes a step, and an open one parts it from the next.
std::int64_t impact_rows(const study::Study& study, const transient::StepChoice& choice) {
  const bool adaptive = choice.steps == 0;
  return adaptive ? study.output.impacts : std::min(study.output.impacts, choice.steps / 2 + 1);
}

void check_size_of_impacts(const study::Study& study, const std::vector<BuiltScene>& scenes,
                           const std::vector<transient::StepChoice>& choices) {
  double rows = 0.0;
  for (std::size_t s = 0; s < scenes.size(); ++s)
    rows +=
        static_cast<double>(scenes[s].contacts.size()) * static_cast<double>(impact_rows(study, choices[s]));
  const double bytes = rows * static_cast<double>(sizeof(post::Impact));
  if (bytes > most_series_bytes)
    throw core::Error(fmt::format(
        "output.impacts = {}: {:.3g} rows of all contacts would take {:.3g} GB, at most {:.3g} are "
        "held; keep fewer rows (statistics count every impact)",
        study.output.impacts, rows, bytes * 1e-9, most_series_bytes * 1e-9));
}

/// What one run gives.
struct JobResult {
  transient::Report report{};
  std::vector<post::ContactSummary> contacts;
  post::StandardErrors errors_of_sums;       ///< of all contacts of the run
  std::vector<post::ContactImpacts> impacts; ///< empty without tables
  std::vector<post::NodeSummary> nodes;
  post::TimeSeries series;
};

/// A run and all that watches it.
class Job {
public:
  Job(const study::Study& study, const BuiltScene& built, const transient::StepChoice& choice,
      ProgressObserver* progress)
      : contacts_(built.scene.contacts.size(), study.output.statistics_from),
        impacts_(with_impacts(study) ? built.scene.contacts.size() : 0, study.output.statistics_from,
                 study.output.rest_time, static_cast<std::size_t>(impact_rows(study, choice))),
        nodes_(rows_of(built.nodes), study.output.statistics_from), grid_(grid_of(study)),
        recorder_(built.scene, built.nodes, grid_), observers_(watching(study, built, progress)),
        run_(built.scene, choice, observers_, &recorder_, grid_) {
    if (study.support_motions.empty())
      return;
    std::vector<Eigen::MatrixXd> carried;
    for (const auto& node : built.nodes)
      carried.push_back(node.carried);
    nodes_.carry(carried, built.scene.motions, built.scene.duration);
  }

  [[nodiscard]] transient::Run& run() { return run_; }

  [[nodiscard]] JobResult result() && {
    JobResult out;
    out.report = run_.finish();
    out.contacts = contacts_.summaries();
    out.errors_of_sums = contacts_.errors_of_sums();
    out.impacts = std::move(impacts_).impacts();
    out.nodes = nodes_.summaries();
    out.series = std::move(recorder_).series();
    return out;
  }

private:
  static bool with_impacts(const study::Study& study) { return study.output.impacts > 0; }
  static std::vector<Eigen::MatrixXd> rows_of(const std::vector<post::ObservedNode>& nodes) {
    std::vector<Eigen::MatrixXd> rows;
    for (const auto& node : nodes)
      rows.push_back(node.rows);
    return rows;
  }
  static transient::OutputGrid grid_of(const study::Study& study) {
    const double duration = study.transient->duration;
    return transient::output_grid(duration, study.output.every.value_or(duration / default_outputs));
  }
  /// Only what has something to see.
  std::vector<transient::Observer*> watching(const study::Study& study, const BuiltScene& built,
                                             ProgressObserver* progress) {
    std::vector<transient::Observer*> observers;
    if (!built.scene.contacts.empty())
      observers.push_back(&contacts_);
    if (with_impacts(study) && !built.scene.contacts.empty())
      observers.push_back(&impacts_);
    if (!built.nodes.empty())
      observers.push_back(&nodes_);
    if (progress)
      observers.push_back(progress);
    return observers;
  }

  post::ContactStatistics contacts_;
  post::ImpactTable impacts_;
  post::NodeStatistics nodes_;
  transient::OutputGrid grid_;
  post::Recorder recorder_;
  std::vector<transient::Observer*> observers_;
  transient::Run run_;
};

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

/// The result of a job from its rank to all. Names are known everywhere.
void broadcast(MPI_Comm comm, int root, const BuiltScene& built, JobResult& job) {
  static_assert(std::is_trivially_copyable_v<transient::Report>);
  MPI_Bcast(&job.report, static_cast<int>(sizeof job.report), MPI_BYTE, root, comm);
  MPI_Bcast(&job.errors_of_sums, static_cast<int>(sizeof job.errors_of_sums), MPI_BYTE, root, comm);
  broadcast_plain(comm, root, job.contacts);
  std::uint64_t tables = job.impacts.size();
  MPI_Bcast(&tables, 1, MPI_UINT64_T, root, comm);
  job.impacts.resize(tables);
  for (post::ContactImpacts& table : job.impacts) {
    broadcast_plain(comm, root, table.rows);
    MPI_Bcast(&table.left_out, 1, MPI_INT64_T, root, comm);
  }
  broadcast_plain(comm, root, job.nodes);
  core::broadcast(comm, root, job.series.time);
  core::broadcast(comm, root, job.series.modal_displacement);
  core::broadcast(comm, root, job.series.modal_velocity);
  job.series.contacts.resize(built.scene.contacts.size());
  for (std::size_t c = 0; c < built.scene.contacts.size(); ++c) {
    auto& series = job.series.contacts[c];
    series.name = built.scene.contacts[c].name;
    core::broadcast(comm, root, series.displacement);
    core::broadcast(comm, root, series.velocity);
    core::broadcast(comm, root, series.gap);
    core::broadcast(comm, root, series.normal_force);
    core::broadcast(comm, root, series.tangential_force);
    broadcast_plain(comm, root, series.state);
  }
  job.series.nodes.resize(built.nodes.size());
  for (std::size_t k = 0; k < built.nodes.size(); ++k) {
    auto& series = job.series.nodes[k];
    series.name = built.nodes[k].name;
    core::broadcast(comm, root, series.displacement);
    core::broadcast(comm, root, series.velocity);
    core::broadcast(comm, root, series.acceleration);
  }
}

/// Puts the result of a job at its places among those of the study.
void merge(const BuiltScene& built, JobResult&& job, const transient::StepChoice& choice,
           results::RunResults& out) {
  out.transients.push_back({choice, job.report});
  add_errors(out.errors_of_sums, job.errors_of_sums);
  for (std::size_t c = 0; c < built.contacts.size(); ++c) {
    out.contact_summaries[built.contacts[c]] = job.contacts[c];
    out.series.contacts[built.contacts[c]] = std::move(job.series.contacts[c]);
    if (!job.impacts.empty())
      out.impacts[built.contacts[c]] = std::move(job.impacts[c]);
  }
  for (std::size_t k = 0; k < built.node_numbers.size(); ++k) {
    out.node_summaries[built.node_numbers[k]] = job.nodes[k];
    out.series.nodes[built.node_numbers[k]] = std::move(job.series.nodes[k]);
  }
  // the modes of all structures are stacked in the order of the bases, whichever run they belong to
  Eigen::Index modes = 0;
  std::vector<Eigen::Index> first;
  for (const auto& basis : out.bases) {
    first.push_back(modes);
    modes += basis.size();
  }
  const Eigen::Index outputs = job.series.time.size();
  if (out.series.time.size() == 0 ||
      outputs < out.series.time.size()) { // the first; or one that was cut short: the common time
    out.series.time = job.series.time;
    out.series.modal_displacement.conservativeResize(modes, outputs);
    out.series.modal_velocity.conservativeResize(modes, outputs);
  }
  std::vector<Eigen::Index> rows; // of the modes of its structures, one after the other
  for (const std::size_t s : built.structures)
    for (Eigen::Index i = 0; i < out.bases[s].size(); ++i)
      rows.push_back(first[s] + i);
  const Eigen::Index common = out.series.time.size();
  const auto place = [&](const Eigen::MatrixXd& moving, Eigen::MatrixXd& all) {
    for (Eigen::Index j = 0; j < common; ++j) {
      for (const Eigen::Index row : rows)
        all(row, j) = 0.0;
      for (std::size_t k = 0; k < built.moving.size(); ++k)
        all(rows[static_cast<std::size_t>(built.moving[k])], j) = moving(static_cast<Eigen::Index>(k), j);
    }
  };
  place(job.series.modal_displacement, out.series.modal_displacement);
  place(job.series.modal_velocity, out.series.modal_velocity);
}

std::optional<transient::SchemeKind> scheme_of(study::Scheme scheme) {
  switch (scheme) {
  case study::Scheme::automatic:
    return {};
  case study::Scheme::splitting:
    return transient::SchemeKind::splitting;
  case study::Scheme::collocation:
    return transient::SchemeKind::collocation;
  case study::Scheme::euler:
    return transient::SchemeKind::euler;
  case study::Scheme::devogelaere:
    return transient::SchemeKind::devogelaere;
  case study::Scheme::runge_kutta_54:
    return transient::SchemeKind::runge_kutta_54;
  case study::Scheme::energy_conserving:
    return transient::SchemeKind::energy_conserving;
  }
  return {};
}

void judge(const transient::StepChoice& choice, const transient::Report& report, results::RunResults& out) {
  for (const std::string& warning : choice.warnings)
    out.warnings.push_back(warning);
  if (report.outcome == transient::Outcome::diverged)
    throw core::ComputationError(fmt::format(
        "the transient diverged at t = {:.6g} s (scheme {}, step {:.3g} s): its energy has left all that was "
        "put in; take a smaller step, or leave step out to have one chosen",
        report.end_time, transient::name_of(choice.scheme), choice.step));
  if (report.outcome == transient::Outcome::step_failed)
    throw core::ComputationError(fmt::format("the transient stopped at t = {:.6g} s (scheme {}): {}",
                                             report.end_time, transient::name_of(choice.scheme),
                                             transient::name_of(report.failure)));
  if (report.residual_relative > residual_warning)
    out.warnings.push_back(
        fmt::format("the energy balance is off by {:.2g} % of the energy put in; take a smaller step",
                    100.0 * report.residual_relative));
  if (report.counts.unconverged > report.counts.steps / 1000)
    out.warnings.push_back(fmt::format(
        "in {} of {} steps the coupled contact forces missed their tolerance; take a smaller step",
        report.counts.unconverged, report.counts.steps));
}

/// The spring of `reference` is set by every slip, and no work pays for it.
void judge_memory(const BuiltScene& built, const transient::Report& report, results::RunResults& out) {
  const auto jumps = [](const transient::ContactPoint& point) {
    const contact::FrictionLaw& law = point.support.friction;
    return law.active() && law.kind == contact::FrictionMemoryKind::reference;
  };
  const auto& points = built.scene.contacts;
  const double input = std::abs(report.energy.initial + report.energy.load_work);
  if (std::any_of(points.begin(), points.end(), jumps) &&
      report.energy.contact_damping < -given_by_dampers * input)
    out.warnings.push_back(fmt::format("friction_memory = \"reference\": the dampers of the contacts gave "
                                       "{:.2g} % of the energy put in instead "
                                       "of taking some, because that memory's springs jump in a slip; the "
                                       "energies of friction are not to be "
                                       "trusted; take friction_memory = \"return_map\"",
                                       -100.0 * report.energy.contact_damping / input));
}

/// A table that ends early never does so silently.
void tell_impacts_left_out(std::int64_t kept, results::RunResults& out) {
  std::int64_t left_out = 0, tables = 0;
  for (const post::ContactImpacts& impacts : out.impacts) {
    left_out += impacts.left_out;
    tables += impacts.left_out > 0 ? 1 : 0;
  }
  if (left_out > 0)
    out.notes.push_back(fmt::format("the table{} of impacts of {} contact{} end{} after output.impacts = {} "
                                    "rows: {} later impacts have no row (the statistics count them); raise "
                                    "output.impacts, or start output.statistics_from later",
                                    tables == 1 ? "" : "s", tables, tables == 1 ? "" : "s",
                                    tables == 1 ? "s" : "", kept, left_out));
}

} // namespace

void run_jobs(MPI_Comm comm, const study::Study& study, const std::vector<BuiltScene>& scenes,
              std::size_t contacts, std::size_t nodes, const ProgressCallback& progress,
              const CheckpointOptions& checkpoint_options, results::RunResults& out) {
  check_size_of_series(study, scenes);
  const int ranks = core::size(comm), here = core::rank(comm);
  transient::StepOptions options;
  options.step = study.transient->step;
  options.accuracy = study.transient->accuracy;
  options.scheme = scheme_of(study.transient->scheme);
  options.tolerance = study.transient->tolerance;
  std::vector<transient::StepChoice> choices;
  core::agree(comm, [&] {
    for (const BuiltScene& built : scenes)
      choices.push_back(transient::choose_step(built.scene, options));
  });
  core::agree(comm, [&] {
    for (const auto& choice : choices)
      if (study.output.statistics_from > study.transient->duration - 2.0 * choice.step)
        throw core::Error(fmt::format(
            "output.statistics_from = {} s leaves less than two steps of {:.3g} s before the end at {} s; "
            "start the statistics earlier",
            study.output.statistics_from, choice.step, study.transient->duration));
  });
  core::agree(comm, [&] { check_size_of_impacts(study, scenes, choices); });
  std::vector<JobResult> jobs(scenes.size());
  const bool verified =
      study.transient->verify && contacts > 0; // statistics of contacts are what is compared
  std::vector<HalfRun> halves(verified ? scenes.size() : 0);
  std::vector<double> costs; // a step costs as much as it has modes
  for (std::size_t s = 0; s < scenes.size(); ++s)
    costs.push_back(static_cast<double>(choices[s].steps) *
                    static_cast<double>(scenes[s].scene.system.size()));
  const std::vector<int> owner = core::share_out(costs, ranks);
  const auto half_steps = [&](std::size_t s) {
    return verified ? transient::halved(choices[s]).steps : std::int64_t{0};
  };
  std::int64_t all_steps = 0, done_steps = 0;
  for (std::size_t s = 0; s < scenes.size(); ++s)
    all_steps += owner[s] == here ? choices[s].steps + half_steps(s) : 0;
  Checkpoints checkpoints(checkpoint_options);
  core::agree(comm, [&] {
    auto left = std::count(owner.begin(), owner.end(), here);
    for (std::size_t s = 0; s < scenes.size(); ++s)
      if (owner[s] == here) {
        const auto part = [&](std::int64_t steps) {
          return all_steps > 0 ? static_cast<double>(steps) / static_cast<double>(all_steps)
                               : 0.0; // adaptive: not known
        };
        const auto next = [&](std::int64_t steps) {
          done_steps += steps;
          return ProgressObserver(progress, part(done_steps - steps), part(steps), study.transient->duration);
        };
        ProgressObserver observer = next(choices[s].steps);
        const auto make = [&] {
          return std::make_unique<Job>(study, scenes[s], choices[s], progress ? &observer : nullptr);
        };
        const bool others = --left > 0;
        jobs[s] = std::move(*resumed_run(make, s, checkpoints, others || verified)).result();
        if (verified) {
          ProgressObserver at_half = next(half_steps(s));
          halves[s] = run_at_half(scenes[s].scene, choices[s], study.output.statistics_from,
                                  progress ? &at_half : nullptr, scenes.size() + s, checkpoints, others);
        }
      }
  });
  out.accuracy = study.transient->accuracy;
  out.contact_summaries.resize(contacts);
  out.series.contacts.resize(contacts);
  out.impacts.resize(study.output.impacts > 0 ? contacts : 0);
  out.rest_time = study.output.rest_time;
  out.node_summaries.resize(nodes);
  out.series.nodes.resize(nodes);
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (ranks > 1)
      broadcast(comm, owner[s], scenes[s], jobs[s]);
    if (ranks > 1 && verified)
      broadcast(comm, owner[s], scenes[s].scene.contacts.size(), halves[s]);
    judge(choices[s], jobs[s].report, out);
    judge_memory(scenes[s], jobs[s].report, out);
    merge(scenes[s], std::move(jobs[s]), choices[s], out);
  }
  if (verified)
    compare_with_half(scenes, halves, out);
  tell_impacts_left_out(study.output.impacts, out);
}

} // namespace fretwork::app
