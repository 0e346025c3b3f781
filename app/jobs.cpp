// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/jobs.hpp"
#include "app/expected_time.hpp"
#include "app/job.hpp"
#include "app/judge_run.hpp"
#include "app/resumed_run.hpp"
#include "app/verification.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/share_out.hpp"
#include "results/figures.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace fretwork::app {
namespace {

/// Series and tables are held in memory until they are written; a study that asks for more than this has a slip in
/// output.every or output.impacts.
constexpr double most_series_bytes = 4294967296.0;
/// On the clock: what `check` spends on the pilot runs of all scenes.
constexpr std::chrono::duration<double> longest_pilots{1.5};

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

/// Series of the reactions of a job.
void merge_reactions(const BuiltScene& built, JobResult& job, results::RunResults& out) {
  const std::size_t sections = out.force_sites.size() - out.series.reactions.size();
  std::size_t reaction = 0;
  for (const std::size_t number : built.force_numbers)
    if (number >= sections)
      out.series.reactions[number - sections] = std::move(job.series.reactions[reaction++]);
}

/// Puts the result of a job at its places among those of the study.
void merge(const BuiltScene& built, JobResult&& job, const transient::StepChoice& choice,
           results::RunResults& out) {
  out.transients.push_back({choice, job.report, built.structures, job.power});
  merge_summaries(built, job.summaries, out);
  for (std::size_t c = 0; c < built.contacts.size(); ++c) {
    out.series.contacts[built.contacts[c]] = std::move(job.series.contacts[c]);
    out.largest_impacts[built.contacts[c]] = std::move(job.largest_impacts[c]);
    if (!job.impacts.empty())
      out.impacts[built.contacts[c]] = std::move(job.impacts[c]);
  }
  for (std::size_t k = 0; k < built.node_numbers.size(); ++k)
    out.series.nodes[built.node_numbers[k]] = std::move(job.series.nodes[k]);
  merge_reactions(built, job, out);
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

transient::StepOptions step_options(const study::Transient& transient) {
  transient::StepOptions options;
  options.step = transient.step;
  options.accuracy = transient.accuracy;
  options.scheme = scheme_of(transient.scheme);
  options.tolerance = transient.tolerance;
  return options;
}

/// The rank of every scene: a step costs as much as it has modes.
std::vector<int> owners(const std::vector<BuiltScene>& scenes,
                        const std::vector<transient::StepChoice>& choices, int ranks) {
  std::vector<double> costs;
  for (std::size_t s = 0; s < scenes.size(); ++s)
    costs.push_back(static_cast<double>(choices[s].steps) *
                    static_cast<double>(scenes[s].scene.system.size()));
  return core::share_out(costs, ranks);
}

/// Runs one after the other, each with its share of the steps of all.
class SharedProgress {
public:
  SharedProgress(const ProgressCallback& callback, std::int64_t all_steps, double duration)
      : callback_(callback), all_(all_steps), duration_(duration) {}
  /// Of the next run, which takes `steps`; of adaptive steps, whose number is not known, the share is 0.
  [[nodiscard]] ProgressObserver next(std::int64_t steps) {
    const double begin = share(done_);
    done_ += steps;
    return {callback_, begin, share(steps), duration_};
  }

private:
  [[nodiscard]] double share(std::int64_t steps) const {
    return all_ > 0 ? static_cast<double>(steps) / static_cast<double>(all_) : 0.0;
  }
  const ProgressCallback& callback_;
  std::int64_t all_, done_ = 0;
  double duration_;
};

/// What the runs of all scenes give; of those of other ranks nothing, before the broadcast.
struct Outcomes {
  std::vector<JobResult> jobs;
  std::vector<HalfRun> halves; ///< empty without verification
};

/// Of all scenes; their numbers on this rank.
struct PlannedRuns {
  const std::vector<BuiltScene>& scenes;
  std::vector<transient::StepChoice> choices;
  std::vector<std::size_t> mine;
  bool verified; ///< each again at half the step
};

/// Collective: runs the scenes of this rank.
Outcomes run_own(MPI_Comm comm, const study::Study& study, const PlannedRuns& planned,
                 const AroundRuns& around) {
  const std::size_t count = planned.scenes.size();
  Outcomes out{std::vector<JobResult>(count), std::vector<HalfRun>(planned.verified ? count : 0)};
  const auto half_steps = [&planned](std::size_t s) {
    return planned.verified ? transient::halved(planned.choices[s]).steps : std::int64_t{0};
  };
  std::int64_t all_steps = 0;
  for (const std::size_t s : planned.mine)
    all_steps += planned.choices[s].steps + half_steps(s);
  const ProgressCallback& progress = around.progress;
  SharedProgress shared(progress, all_steps, study.transient->duration);
  core::agree(comm, [&] {
    for (const std::size_t s : planned.mine) {
      const BuiltScene& built = planned.scenes[s];
      const transient::StepChoice& choice = planned.choices[s];
      ProgressObserver observer = shared.next(choice.steps);
      const auto make = [&] {
        return std::make_unique<Job>(study, built, choice, progress ? &observer : nullptr);
      };
      const bool others = s != planned.mine.back() || around.others_follow;
      const OwnCheckpoint of_run{around.checkpoints, around.first_checkpoint + s, others || planned.verified};
      out.jobs[s] = std::move(*resumed_run(make, of_run)).result();
      if (planned.verified) {
        ProgressObserver at_half = shared.next(half_steps(s));
        out.halves[s] =
            run_at_half(built.scene, choice, study.output.statistics_from, progress ? &at_half : nullptr,
                        {around.checkpoints, count + of_run.number, others});
      }
    }
  });
  return out;
}

void resize_results(const study::Study& study, results::RunResults& out) {
  const std::size_t contacts = out.contacts.size();
  resize_summaries(out);
  out.accuracy = study.transient->accuracy;
  out.series.contacts.resize(contacts);
  out.impacts.resize(study.output.impacts > 0 ? contacts : 0);
  out.largest_impacts.resize(contacts);
  out.rest_time = study.output.rest_time;
  out.series.nodes.resize(out.node_names.size());
  out.series.reactions.resize(static_cast<std::size_t>(
      std::count_if(out.force_sites.begin(), out.force_sites.end(),
                    [](const results::ForceSite& site) { return !site.is_section(); })));
}

/// Of a fixed step that is far below the automatic one; else empty.
std::string short_step_warning(const transient::Scene& scene, const transient::StepChoice& fixed,
                               transient::StepOptions options) {
  constexpr double far_below = 100.0;
  if (!options.step || fixed.steps == 0) // adaptive
    return {};
  options.step.reset();
  options.scheme = fixed.scheme;
  double automatic = 0.0; // s
  try {
    automatic = transient::choose_step(scene, options).step;
  } catch (const core::Error&) { // of absurdly many steps, which a fixed one may avoid
    return {};
  }
  if (!(automatic > far_below * fixed.step))
    return {};
  constexpr int digits = 2;
  return fmt::format(
      "transient.step = {:.3g} s is {} times shorter than the automatic step, {:.3g} s, and the "
      "run takes as many times longer; leave step out",
      fixed.step, results::without_exponent(automatic / fixed.step, digits), automatic);
}

} // namespace

void check_size_of_series(const study::Study& study, const std::vector<BuiltScene>& scenes) {
  const double duration = study.transient->duration, every = output_interval(study);
  double columns = 1.0; // values at an output: modal and of contacts and nodes, as in results.h5
  for (const BuiltScene& built : scenes)
    columns += 2.0 * static_cast<double>(built.modes) + 10.0 * static_cast<double>(built.contacts.size()) +
               9.0 * static_cast<double>(built.nodes.size());
  const double bytes = duration / every * columns * static_cast<double>(sizeof(double));
  if (bytes > most_series_bytes)
    throw core::Error(fmt::format(
        "output.every = {} over transient.duration = {} s: {:.3g} outputs of {} values would take {:.3g} GB, "
        "at "
        "most {:.3g} are held; sample less often (statistics see every step), or shorten the duration",
        every, duration, duration / every, columns, bytes * 1e-9, most_series_bytes * 1e-9));
}

std::vector<transient::StepChoice> choose_steps(MPI_Comm comm, const study::Study& study,
                                                const std::vector<BuiltScene>& scenes) {
  const transient::StepOptions options = step_options(*study.transient);
  std::vector<transient::StepChoice> choices;
  core::agree(comm, [&] {
    for (const BuiltScene& built : scenes) {
      choices.push_back(transient::choose_step(built.scene, options));
      if (std::string wasteful = short_step_warning(built.scene, choices.back(), options); !wasteful.empty())
        choices.back().warnings.push_back(std::move(wasteful));
    }
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
  return choices;
}

Forecast check_jobs(MPI_Comm comm, const study::Study& study, const std::vector<BuiltScene>& scenes) {
  check_size_of_series(study, scenes);
  Forecast out;
  out.outputs = study.transient->duration / output_interval(study);
  const std::vector<transient::StepChoice> choices = choose_steps(comm, study, scenes);
  const double with_verification = study.transient->verify && !study.contacts.empty() ? 3.0 : 1.0;
  const auto shortest = std::min_element(choices.begin(), choices.end(),
                                         [](const auto& a, const auto& b) { return a.step < b.step; });
  if (shortest != choices.end())
    out.step_reason = shortest->reason;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const transient::StepChoice& choice = choices[s];
    out.steps += static_cast<double>(choice.steps);
    out.impact_rows.push_back(static_cast<double>(impact_rows(study, choice)));
    out.warnings.insert(out.warnings.end(), choice.warnings.begin(), choice.warnings.end());
    const PilotTime time =
        pilot_time(scenes[s].scene, choice, longest_pilots / static_cast<double>(scenes.size()));
    check_expected_time(time.seconds, study.transient->max_hours);
    out.time.seconds += with_verification * time.seconds;
    out.time.contacts_open = out.time.contacts_open || time.contacts_open;
  }
  return out;
}

void run_jobs(MPI_Comm comm, const study::Study& study, const std::vector<BuiltScene>& scenes,
              const AroundRuns& around, results::RunResults& out) {
  check_size_of_series(study, scenes);
  // statistics of contacts are what is compared
  PlannedRuns planned{
      scenes, choose_steps(comm, study, scenes), {}, study.transient->verify && !out.contacts.empty()};
  const int ranks = core::size(comm);
  const std::vector<int> owner = owners(scenes, planned.choices, ranks);
  for (std::size_t s = 0; s < scenes.size(); ++s)
    if (owner[s] == core::rank(comm))
      planned.mine.push_back(s);
  Outcomes outcomes = run_own(comm, study, planned, around);
  resize_results(study, out);
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (ranks > 1)
      broadcast(comm, owner[s], scenes[s], outcomes.jobs[s]);
    if (ranks > 1 && planned.verified)
      broadcast(comm, owner[s], scenes[s].scene.contacts.size(), outcomes.halves[s]);
    judge_run(study, scenes[s], planned.choices[s], outcomes.jobs[s].report, out);
    merge(scenes[s], std::move(outcomes.jobs[s]), planned.choices[s], out);
  }
  if (planned.verified)
    compare_with_half(scenes, outcomes.halves, out);
  judge_step_errors(out);
  tell_impacts_left_out(study.output.impacts, out);
}

} // namespace fretwork::app
