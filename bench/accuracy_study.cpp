// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/accuracy_study.hpp"
#include "bench/reference_solution.hpp"
#include "bench/thread_time.hpp"
#include "core/error.hpp"
#include "post/contact_statistics.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace fretwork::bench {
namespace {

constexpr int fewest_members = 8, most_members = 16;
constexpr double pilot_periods = 40.0, fewest_periods = 60.0;
constexpr double skipped_share = 0.1; ///< of the duration, before the window
constexpr double disturbance = 0.02;  ///< of the gap, from member to member
constexpr double negligible = 1e-3;
constexpr double flow_seconds = 40e-9, mode_seconds = 4e-9,
                 force_seconds = 60e-9; ///< of the reference solution, about

using Values = std::array<double, figure_count>;

struct Scales {
  double tangential = 0.0, slider = 0.0, impacts = 0.0, closed = 0.0, sliding = 0.0; ///< means of a member
};

transient::Scene member_of(const RandomScene& random, double duration, int member) {
  transient::Scene scene = random.scene;
  scene.duration = duration;
  double shape = 0.0;
  for (const transient::ContactPoint& point : scene.contacts)
    shape = std::max(shape, point.b.col(0).norm());
  double moved = disturbance * random.gap * member / shape;
  for (const Eigen::Index first : random.first_modes) {
    scene.q0.segment(first, 3).array() += moved;
    moved = -moved; // so that contacts between two are disturbed too
  }
  for (vibration::Load& load : scene.loads)
    if (auto* noise = std::get_if<signals::Random>(&load.function))
      noise->seed += 7919U * static_cast<std::uint64_t>(member);
  return scene;
}

/// Sums over contacts.
Values values_of(const std::vector<ReferenceFigures>& contacts) {
  Values out{};
  for (const ReferenceFigures& c : contacts) {
    const Values one = {c.work_rate,          c.friction_power, c.normal_rms, c.normal_mean,
                        c.contact_time_ratio, c.impact_rate,    c.normal_max};
    for (std::size_t k = 0; k < figure_count; ++k)
      out[k] += one[k];
  }
  return out;
}

Values values_of(const post::ContactStatistics& statistics) {
  Values out{};
  for (const post::ContactSummary& c : statistics.summaries()) {
    const Values one = {c.work_rate,          c.friction_power, c.normal_rms, c.normal_mean,
                        c.contact_time_ratio, c.impact_rate,    c.normal_max};
    for (std::size_t k = 0; k < figure_count; ++k)
      out[k] += one[k];
  }
  return out;
}

/// How long a member is: so that the fewest members take half of the budget.
double duration_of(const RandomScene& random, const StudyOptions& options) {
  const double pilot = pilot_periods * random.period;
  const transient::Scene scene = member_of(random, pilot, 0);
  ReferenceSolution reference(scene, options.resolution);
  reference.run(0.0);
  const double flow = flow_seconds + mode_seconds * static_cast<double>(scene.system.size());
  const double seconds =
      flow * static_cast<double>(reference.flows()) + force_seconds * static_cast<double>(reference.forces());
  const double periods = pilot_periods * 0.5 * options.budget / (fewest_members * seconds);
  return random.period * std::clamp(periods, fewest_periods, most_periods);
}

struct Ensemble {
  std::vector<Values> ours, reference;
  Scales scales;

  [[nodiscard]] FigureError error(Figure k) const {
    const double n = static_cast<double>(ours.size());
    double a = 0.0, b = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      a += ours[i][k] / n;
      b += reference[i][k] / n;
    }
    for (std::size_t i = 0; i < ours.size(); ++i)
      squares += std::pow(ours[i][k] - reference[i][k] - (a - b), 2);
    return {k, a, b, std::sqrt(squares / (n * (n - 1.0))), false, false};
  }
};

bool counts(const FigureError& e, const Scales& scales, std::size_t contacts) {
  if (!(scales.closed > 0.0) || !(e.reference > 0.0))
    return false;
  switch (e.figure) {
  case work_rate:
    return e.reference > negligible * scales.tangential;
  case friction_power:
    return e.reference > negligible * scales.slider;
  case impact_rate:
    return scales.impacts >= 5.0 && scales.closed < 0.999 * static_cast<double>(contacts);
  default:
    return e.figure < judged_figures;
  }
}

void judge(SceneResult& result, const Ensemble& ensemble, const StudyOptions& options) {
  result.figures.clear();
  for (std::size_t k = 0; k < figure_count; ++k) {
    FigureError e = ensemble.error(static_cast<Figure>(k));
    Scales scales = ensemble.scales;
    for (double* s : {&scales.tangential, &scales.slider, &scales.impacts, &scales.closed})
      *s /= result.members;
    e.judged = counts(e, scales, result.scene.scene.contacts.size());
    e.fails = e.judged &&
              !(std::abs(e.ours - e.reference) <= options.tolerance() * e.reference + 2.0 * e.standard_error);
    if (const transient::StepError& of = result.step_error; k < judged_figures && of.sums[k] > 0.0) {
      const double per = transient::statistic_share(k) / of.sums[k];
      e.measured = per * of.errors[k];
      e.measured_spread = per * std::sqrt(of.spreads[k]);
    }
    result.figures.push_back(e);
  }
}

bool resolved(const SceneResult& result, const StudyOptions& options) {
  return std::all_of(result.figures.begin(), result.figures.end(), [&](const FigureError& e) {
    return !e.judged || e.standard_error <= 0.25 * options.tolerance() * e.reference;
  });
}

Values run_of(const transient::Scene& scene, const StudyOptions& options, double from, SceneResult& result) {
  transient::StepChoice choice = transient::choose_step(scene, options.step);
  if (choice.steps > 0) {
    choice.step *= options.step_factor;
    choice.steps = static_cast<std::int64_t>(std::ceil(scene.duration / choice.step * (1 - 1e-12)));
  }
  post::ContactStatistics statistics(scene.contacts, from);
  transient::Observer* const observers[] = {&statistics};
  const double begin = thread_seconds();
  transient::Run run(scene, choice, observers, nullptr, {});
  run.advance(std::numeric_limits<std::int64_t>::max());
  const transient::Report report = run.finish();
  result.seconds += thread_seconds() - begin;
  for (const transient::StepError& of : run.step_errors()) {
    result.step_error.parts = std::max(result.step_error.parts, of.parts);
    for (std::size_t k = 0; k < transient::replayed_figures; ++k) {
      result.step_error.sums[k] += of.sums[k];
      result.step_error.errors[k] += of.errors[k];
      result.step_error.spreads[k] += of.spreads[k] * of.spreads[k];
    }
  }
  result.step = choice.step;
  result.resolution = choice.contact_frequency * choice.step;
  result.scheme = transient::name_of(choice.scheme);
  if (report.outcome != transient::Outcome::done)
    result.failure = report.outcome == transient::Outcome::diverged ? "the run diverged" : "the run failed";
  return values_of(statistics);
}

Values solution_of(const transient::Scene& scene, double resolution, double from, SceneResult& result,
                   Scales* scales) {
  ReferenceSolution reference(scene, resolution);
  const double begin = thread_seconds();
  reference.run(from);
  (scales ? result.reference_seconds : result.seconds) += thread_seconds() - begin;
  result.unresolved += reference.unconverged() + reference.missed();
  const auto contacts = reference.figures();
  for (std::size_t c = 0; scales && c < contacts.size(); ++c) {
    scales->tangential += contacts[c].tangential_rate;
    scales->slider += scene.contacts[c].support.friction.mu_dynamic * contacts[c].tangential_rate;
    scales->impacts += static_cast<double>(contacts[c].impacts);
    scales->closed += contacts[c].contact_time_ratio;
    scales->sliding += contacts[c].sliding_time_ratio;
  }
  if (!scales)
    result.step = reference.step();
  return values_of(contacts);
}

} // namespace

SceneResult study(RandomScene scene, const StudyOptions& options) {
  SceneResult result;
  result.scene = std::move(scene);
  result.duration = duration_of(result.scene, options);
  const double from = skipped_share * result.duration;
  Ensemble ensemble;
  for (int member = 0; member < most_members && result.failure.empty(); ++member) {
    const transient::Scene one = member_of(result.scene, result.duration, member);
    const double fine = options.halved ? 0.5 * options.resolution : options.resolution;
    ensemble.ours.push_back(options.halved ? solution_of(one, options.resolution, from, result, nullptr)
                                           : run_of(one, options, from, result));
    ensemble.reference.push_back(solution_of(one, fine, from, result, &ensemble.scales));
    if (options.against) {
      StudyOptions other = options;
      other.step.scheme = *options.against;
      ensemble.reference.back() = run_of(one, other, from, result);
    }
    ++result.members;
    if (result.members < fewest_members)
      continue;
    judge(result, ensemble, options);
    if (resolved(result, options))
      break;
  }
  if (!result.failure.empty())
    result.figures.clear();
  result.closed =
      ensemble.scales.closed / (result.members * static_cast<double>(result.scene.scene.contacts.size()));
  result.sliding = ensemble.scales.closed > 0.0 ? ensemble.scales.sliding / ensemble.scales.closed : 0.0;
  return result;
}

} // namespace fretwork::bench
