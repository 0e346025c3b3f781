// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/step_rule.hpp"
#include "core/error.hpp"
#include "transient/modes/mass_scaling.hpp"
#include "transient/scene/scheme_limits.hpp"
#include "transient/scheme_scope.hpp"
#include "transient/splitting/macro_steps.hpp"
#include "transient/step_terms.hpp"
#include "transient/step_warnings.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::transient {
namespace {

/// Of a run: with the most of them single impacts come out to 1e-4, with the fewest its statistics see the motion.
constexpr double fewest_steps = 2000, most_least_steps = 20000;
/// Cost of a step, in modes, up to which the most of them take milliseconds. A contact costs as much as so many modes (instructions).
constexpr double cheap_step = 100.0, cost_of_contact = 40.0;
/// More steps than this are a mistake in a value rather than a wish: days of computing.
constexpr double most_steps = 1e12;
/// Whole numbers of the time loop end far above.
constexpr double countable_steps = 1e18;
constexpr double day = 86400.0; // s
/// A run of an adaptive scheme has at least so many steps.
constexpr double least_adaptive_steps = 200;
/// Length of a replay: w_c times it; in steps, at least; of the duration, at most.
constexpr double contact_times = 15.0, least_replay = 8.0, longest_replay = 0.01;
/// Of w_c: a slower w_t does not make replays longer.
constexpr double slowest_followed = 0.1;
/// Steps of a macro-step. More gain little: its end, with displacements and velocities, costs as much as one step.
constexpr double most_macro_steps = 12.0;
/// w_max times a macro-step, at an accuracy of 0.01: a dozen points a period of the highest mode, which statistics are to see.
constexpr double macro_step_mode = 0.5;
constexpr double two_pi = 2.0 * std::numbers::pi;
/// Steps of splitting that one of collocation takes the time of: measured 0.5 to 0.8 with 1 to 20 supports of 1e5 to 3e7 N/m, 0.8 to 2.1 with stiffer ones.
constexpr double collocation_cost = 0.7;
/// Likewise of steps in more than two intervals, where contacts limit them.
constexpr double collocation_cost_in_intervals = 0.5;
/// Of the time of splitting: below it collocation is taken, which does not measure its error (replays.hpp).
constexpr double worth_changing = 0.4;
/// Beside Hunt and Crossley's dampers, of whose strong impacts collocation has largest forces up to a quarter too high.
constexpr double worth_changing_hunt_crossley = 0.2;

/// At most as many as can be counted.
std::int64_t count_steps(double duration, const StepChoice& c) {
  return static_cast<std::int64_t>(std::min(std::ceil(duration / c.step * (1.0 - 1e-12)), countable_steps));
}

/// @throws core::Error where there would be absurdly many
void check_steps(double duration, const StepChoice& c) {
  if (static_cast<double>(c.steps) <= most_steps)
    return;
  const std::string steps =
      fmt::format("{:.3g} steps of {:.3g} s, more than {:g}", duration / c.step, c.step, most_steps);
  const std::string step = fmt::format("what the step follows from ({})", c.reason);
  throw core::Error(
      duration > day
          ? fmt::format("transient.duration = {:g} s ({:.3g} days) would take {}; shorten it, or check {}",
                        duration, duration / day, steps, step)
          : fmt::format("the transient of {:g} s would take {}; check {}, or the duration", duration, steps,
                        step));
}

/// A limit of the step and where it comes from.
struct Limit {
  double step; ///< s
  std::string reason;
  const char* cure = "";
};

/// @param fineness  1 at an accuracy of 0.01, as its square root
Limit limit_of(const StepTerm& term, double fineness) {
  return {std::max(term.bound.at(fineness) / term.rate, term.shortest.at(fineness)),
          fmt::format("{} {:.4g} {}", term.name, term.rate, term.unit), term.cure};
}

std::vector<Limit> load_limits(const StepChoice& c, bool contacts, double fineness) {
  std::vector<Limit> out;
  const auto points = [&](double wanted) { return std::max(wanted / fineness, fewest_points); };
  const auto resolve = [&](double wanted, double frequency) {
    if (frequency > 0.0)
      out.push_back(
          {1.0 / points(wanted) / frequency, fmt::format("{} ({:.4g} Hz)", name_of_excitation, frequency)});
  };
  const double by_lines = contacts ? points_of_lines : points_without_contacts;
  resolve(contacts ? limits_of(c.scheme).points_per_period : by_lines, c.excitation);
  resolve(by_lines, c.sampled_excitation);
  // its steps follow its tolerance and end at the points of tables: it only must not step over what other loads do
  if (c.scheme == SchemeKind::runge_kutta_54)
    return out;
  if (c.table_interval > 0.0)
    out.push_back(
        {longest_for_tables(c), fmt::format("{} ({:.4g} s)", name_of_table_interval, c.table_interval)});
  if (c.record_rate > 0.0)
    out.push_back(
        {c.scheme == SchemeKind::splitting
             ? (contacts ? record_share : record_share_without_contacts) * std::sqrt(fineness) / c.record_rate
             : std::max(c.record_interval, two_pi / (points(by_lines) * c.record_rate)),
         fmt::format("{} ({:.4g} Hz)", name_of_record_band, c.record_rate / two_pi)});
  return out;
}

/// What limits the step, but for the modes of splitting with contacts.
std::vector<Limit> step_limits(const StepChoice& c, bool contacts, double fineness) {
  std::vector<Limit> out = load_limits(c, contacts, fineness);
  const auto add = [&](const auto& terms) {
    for (const StepTerm& term : terms)
      if (term.rate > 0.0)
        out.push_back(limit_of(term, fineness));
  };
  add(contact_terms(c));
  add(damper_terms(c));
  if (c.scheme != SchemeKind::splitting || !contacts)
    add(std::array{mode_term(c, contacts)});
  return out;
}

/// Makes modes heavier that the step does not follow: those above `fastest`.
void scale_modes(StepChoice& c, const Scene& scene, double fastest) {
  const auto scaled = (scaled_masses(scene, fastest).array() > 1.0).count();
  if (scaled == 0)
    return;
  c.fastest = fastest;
  c.scaled = static_cast<int>(scaled);
  c.reason +=
      fmt::format("; {} of {} modes, those above {:.4g} Hz, are made heavier and move as modes of that "
                  "frequency (mass scaling)",
                  scaled, scene.system.size(), fastest / two_pi);
}

double fineness_of(double accuracy) {
  return std::sqrt(std::min(accuracy, coarsest_accuracy) / accuracy_of_shares);
}

/// Intervals in which splitting moves contacts within a step.
int intervals_of_step(const StepChoice& c, double fineness) {
  const SchemeLimits& limits = limits_of(c.scheme);
  if (limits.intervals == 1)
    return 1;
  const double rate =
      std::max({std::max(c.contact_frequency, c.stick_frequency) / contact_interval.at(fineness),
                c.damper_rate / limits.tangential_damper.at(fineness),
                c.normal_damper_rate / limits.normal_damper.at(fineness)});
  const double needed = rate * c.step;
  return static_cast<int>(
      std::clamp(std::ceil(needed * (1.0 - time_round_off)), 1.0, 1.0 * limits.intervals));
}

/// Length of replays: two or three periods of closed contacts, sticking ones included where they are not far slower: the two motions would part by chaos.
double replay_length(const StepChoice& c, const Scene& scene) {
  if (c.scheme != SchemeKind::splitting || !(c.contact_frequency > 0.0))
    return 0.0;
  const double sticking = std::max(c.stick_frequency, slowest_followed * c.contact_frequency),
               slowest =
                   c.stick_frequency > 0.0 ? std::min(c.contact_frequency, sticking) : c.contact_frequency;
  return std::min(std::max(contact_times / slowest, least_replay * c.step), longest_replay * scene.duration);
}

/// Steps that splitting may make at once where no contact can meet its obstacle: the flow is exact, but loads are linear over them and
/// statistics are to see the modes. Tables may change inside.
int longest_macro_step(const StepChoice& c, const Scene& scene, double fineness) {
  if (c.scheme != SchemeKind::splitting || c.scaled > 0 || !allows_macro_steps(scene))
    return 1;
  for (const vibration::Load& load : scene.loads)
    if (std::holds_alternative<signals::Table>(load.function) ||
        std::holds_alternative<signals::Integral>(load.function))
      return 1;
  double longest = most_macro_steps * c.step;
  if (c.excitation > 0.0)
    longest = std::min(longest, fineness / (points_of_lines * c.excitation));
  if (c.highest_mode > 0.0)
    longest = std::min(longest, macro_step_mode * fineness / c.highest_mode);
  return std::max(1, static_cast<int>(longest / c.step * (1.0 + time_round_off)));
}

/// Steps of a run in which nothing asks for more; fewer of expensive ones, since motions with many contacts are rarely followed impact by impact.
double least_steps(const Scene& scene) {
  const double cost =
      static_cast<double>(scene.system.size()) + cost_of_contact * static_cast<double>(scene.contacts.size());
  const double share = std::min(1.0, cheap_step / cost);
  return std::max(fewest_steps, std::floor(most_least_steps * share * share));
}

/// The step of splitting with modes made heavier. Beside Hunt and Crossley's dampers none is, at no step. A normal damper is a cause where modes would be made
/// heavier without it.
/// @param all  the longest step in which all modes are followed
Limit limit_of_scaled_modes(const StepChoice& c, const Limit& all, double fineness) {
  if (c.hunt_crossley)
    return {0.0, ""};
  const bool sticks = c.stick_frequency > c.contact_frequency;
  const double frequency = sticks ? c.stick_frequency : c.contact_frequency;
  const Limit slower{limits_of(c.scheme).highest_mode.at(fineness) / (scaled_above * frequency),
                     fmt::format("modes up to {:g} times the {} {:.4g} rad/s", scaled_above,
                                 sticks ? "frequency of sticking contacts" : "contact frequency", frequency)};
  const Limit damped{(1.0 - time_round_off) * scaled_up_to_damper / c.normal_damper_rate,
                     "modes that are made heavier beside normal dampers",
                     "; a smaller normal_damping makes the step longer"};
  if (damped.step >= slower.step || slower.step < least_gain_of_scaling * all.step)
    return slower;
  return damped.step > all.step ? damped : Limit{all.step, all.reason, damped.cure};
}

/// The longest step that the terms allow, but for whole steps that cover the duration.
void choose_automatic(StepChoice& c, const Scene& scene, double asked) {
  const double accuracy = std::min(asked, coarsest_accuracy), fineness = fineness_of(asked);
  const bool adaptive = c.scheme == SchemeKind::runge_kutta_54, contacts = !scene.contacts.empty();
  const double least = adaptive ? least_adaptive_steps : least_steps(scene);
  c.step = scene.duration / least;
  c.reason = fmt::format("a run has at least {} steps", least);
  bool by_least = true;
  const auto limit = [&](const Limit& one) {
    if (one.step < c.step) {
      by_least = false;
      c.step = one.step;
      c.reason = fmt::format("{} resolved for an accuracy of {}{}", one.reason, accuracy, one.cure);
    }
  };
  for (const Limit& one : step_limits(c, contacts, fineness))
    limit(one);
  double followed = 0.0; // w h of the fastest mode of splitting; 0: all are followed
  if (c.scheme == SchemeKind::splitting && contacts && c.highest_mode > 0.0) {
    const double most = limits_of(c.scheme).highest_mode.largest;
    const Limit modes = limit_of(mode_term(c, contacts), fineness), all{most / c.highest_mode, modes.reason},
                scaled = limit_of_scaled_modes(c, all, fineness);
    if (scaled.step < c.step)
      limit(scaled.step > modes.step ? scaled : Limit{modes.step, modes.reason, scaled.cure});
    if (all.step < c.step && c.step < least_gain_of_scaling * all.step)
      limit({all.step, all.reason, scaled.cure});
    if (modes.step < c.step && may_scale(scene, most / c.step, accuracy))
      followed = most;
    else
      limit(modes);
  }
  if (by_least && accuracy < accuracy_of_shares)
    c.reason += fmt::format("; an accuracy of {} asks for no shorter ones", accuracy);
  if (accuracy < asked)
    c.reason += fmt::format(" (no step is longer than that of {})", accuracy);
  if (adaptive)
    return;
  c.steps = count_steps(scene.duration, c);
  c.step = scene.duration / static_cast<double>(c.steps);
  if (followed > 0.0)
    scale_modes(c, scene, followed / c.step);
  c.macro_steps = longest_macro_step(c, scene, fineness);
  if (c.macro_steps > 1)
    c.reason +=
        fmt::format("; up to {} of them at once while no contact can meet its obstacle", c.macro_steps);
}

StepChoice choice_of(const Scene& scene, const SceneRates& rates, const StepOptions& options,
                     SchemeKind scheme) {
  StepChoice c;
  static_cast<SceneRates&>(c) = rates;
  c.scheme = scheme;
  if (scheme == SchemeKind::euler || scheme == SchemeKind::devogelaere)
    c.explicit_rate = explicit_damper_rate(scene);
  if (scheme == SchemeKind::devogelaere)
    c.explicit_rate = std::max(c.explicit_rate, relaxation_rate(scene));
  c.tolerance = options.tolerance;
  c.accuracy = options.accuracy;
  if (options.step)
    c.step = *options.step;
  else
    choose_automatic(c, scene, options.accuracy);
  c.parts = intervals_of_step(c, fineness_of(options.accuracy));
  c.replay = replay_length(c, scene);
  if (!options.step)
    return c;
  c.reason = "given in the study";
  if (c.scheme != SchemeKind::runge_kutta_54)
    c.steps = count_steps(scene.duration, c);
  return c;
}

/// splitting, or collocation where it takes less time: where modes far above the contacts limit the step of splitting.
StepChoice cheapest(const Scene& scene, const SceneRates& rates, const StepOptions& options) {
  StepChoice splitting = choice_of(scene, rates, options, SchemeKind::splitting);
  if (options.step || scene.contacts.empty())
    return splitting;
  if (const std::string why = out_of_scope(scene, SchemeKind::collocation); !why.empty()) {
    splitting.scheme_reason = "splitting, because collocation " + why;
    return splitting;
  }
  StepChoice collocation = choice_of(scene, rates, options, SchemeKind::collocation);
  const double time = (splitting.parts > 2 ? collocation_cost_in_intervals : collocation_cost) *
                      static_cast<double>(collocation.steps) /
                      static_cast<double>(splitting.steps); // of that of splitting
  if (time < (rates.hunt_crossley ? worth_changing_hunt_crossley : worth_changing)) {
    collocation.scheme_reason =
        fmt::format("collocation, which takes about {:.2g} of the time of splitting", time);
    return collocation;
  }
  splitting.scheme_reason = fmt::format("splitting; collocation would take about {:.2g} times as long", time);
  return splitting;
}

} // namespace

StepChoice choose_step(const Scene& scene, const StepOptions& options) {
  const SchemeKind scheme = options.scheme.value_or(SchemeKind::splitting);
  check_scope(scene, scheme);
  const SceneRates rates = rates_of(scene);
  StepChoice choice =
      options.scheme ? choice_of(scene, rates, options, scheme) : cheapest(scene, rates, options);
  check_steps(scene.duration, choice);
  if (choice.steps > 0)
    choice.warnings = options.step ? warnings_of_given_step(choice) : warnings_of_automatic_step(choice);
  return choice;
}

StepChoice halved(StepChoice choice) {
  if (choice.steps == 0) {
    choice.tolerance *= 0.5;
    return choice;
  }
  choice.step *= 0.5;
  choice.fastest *= 2.0;
  choice.steps *= 2;
  return choice;
}

} // namespace fretwork::transient
