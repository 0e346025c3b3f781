// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/step_rule.hpp"
#include "core/error.hpp"
#include "transient/modes/mass_scaling.hpp"
#include "transient/scheme_scope.hpp"
#include "transient/splitting/macro_steps.hpp"
#include "transient/step_limits.hpp"
#include <algorithm>
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
/// w_c dt and w_t dt of the intervals of splitting at an accuracy of 0.01: two a step, which take the time of one, since they turn less and are found
/// at once. Contacts whose error replays (replays.hpp) find above it move in up to 16 times as many.
constexpr double interval_share = 0.625;
/// Length of a replay: w_c times it; in steps, at least; of the duration, at most.
constexpr double contact_times = 15.0, least_replay = 8.0, longest_replay = 0.01;
/// The step of an accuracy of 0.02 is the longest: no statistics are worth having above it.
constexpr double coarsest_accuracy = 0.02;
/// Steps of a macro-step. More gain little: its end, with displacements and velocities, costs as much as one step.
constexpr double most_macro_steps = 12.0;
/// Steps of splitting that one of collocation takes the time of: measured 0.5 to 0.8 with 1 to 20 supports of 1e5 to 3e7 N/m, 0.8 to 2.1 with stiffer ones.
constexpr double collocation_cost = 0.7;
/// Of the time of splitting: below it collocation is taken, which does not measure its error (replays.hpp).
constexpr double worth_changing = 0.7;

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

/// What becomes of normal dampers that the step does not resolve.
void warn_of_normal_dampers(StepChoice& c, const char* cure) {
  const double rate = c.normal_damper_rate * c.step, most = most_normally_damped(c.scheme);
  if (!moves_exactly(c.scheme) || !(rate > most * (1.0 + 1e-9)))
    return;
  const char* what = c.scheme == SchemeKind::splitting ? "largest and rms forces that can be trusted"
                     : c.scheme == SchemeKind::energy_conserving ? "largest forces that can be trusted "
                                                                   "(rebounds are right at any step)"
                                                                 : "rebounds that can be trusted";
  c.warnings.push_back(fmt::format(
      "the step {:.3g} s does not resolve the normal dampers: r_n h = {:.3g}, at most {:g} for {}; {}",
      c.step, rate, most, what, cure));
}

/// Largest w_r h of a record without a warning: polygons then lose 0.7 % of it, lines between values 2 (w h)^2/8 = 9 % of its power.
double most_of_record(SchemeKind scheme) { return scheme == SchemeKind::splitting ? 1.5 : 0.6; }

void warn(StepChoice& c) {
  const auto add = [&](double value, double limit, const char* name, const char* what) {
    if (value > limit)
      c.warnings.push_back(fmt::format(
          "the step {:.3g} s does not resolve {}: {} = {:.3g}, at most {} for results that can be "
          "trusted; take a smaller step or leave it out",
          c.step, what, name, value, limit));
  };
  const bool exact = moves_exactly(c.scheme);
  const bool collocation = c.scheme == SchemeKind::collocation;
  const double resolved = most_resolved(c.scheme);
  add(c.contact_frequency * c.step, resolved, "w_c h", "the contact frequency");
  add(c.stick_frequency * c.step, resolved, "w_t h", "the frequency of sticking contacts");
  const double damped = c.scheme == SchemeKind::devogelaere ? most_damped : 1.0;
  add(c.damper_rate * c.step / c.parts, exact ? most_implicit(c.scheme) : damped,
      c.scheme == SchemeKind::splitting ? "r_t dt" : "r_t h", "the tangential dampers");
  add(c.explicit_rate * c.step, damped, "r_e h", "the dampers");
  warn_of_normal_dampers(c, "take a smaller step or leave it out");
  if (!collocation) {
    const double followed = followed_modes(c, c.step);
    add(c.highest_mode * c.step,
        c.scheme == SchemeKind::splitting ? 1.1 * followed
        : exact                           ? 3.0
                                          : 1.8,
        "w_max h",
        followed < before_resonance ? "the highest mode, with tangential dampers" : "the highest mode");
  }
  if (c.table_interval > 0.0)
    add(c.step / c.table_interval * (1.0 - 1e-9), 1.0,
        "h/interval", // of equal ones round-off leaves a shorter
        "the shortest interval of a table");
  if (c.step > c.record_interval * (1.0 + 1e-9))
    add(c.record_rate * c.step, most_of_record(c.scheme), "w h",
        "the band of a record below the highest mode");
  add(c.excitation * c.step * 20.0, 2.0, "20 f h", "the excitation");
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
                  scaled, scene.system.size(), fastest / (2.0 * std::numbers::pi));
}

double fineness_of(double accuracy) { return std::sqrt(std::min(accuracy, coarsest_accuracy) / 0.01); }

/// Intervals in which splitting moves contacts within a step.
int intervals_of_step(const StepChoice& c, double fineness) {
  if (c.scheme != SchemeKind::splitting)
    return 1;
  const double rate = std::max(
      {std::max(c.contact_frequency, c.stick_frequency) / (interval_share * fineness),
       c.damper_rate / damper_share(c.scheme, fineness), c.normal_damper_rate / normal_damper_share});
  const double needed = rate * c.step;
  return static_cast<int>(std::clamp(std::ceil(needed * (1.0 - 1e-9)), 1.0, most_intervals));
}

/// Length of replays: two or three periods of closed contacts, sticking ones included.
double replay_length(const StepChoice& c, const Scene& scene) {
  if (c.scheme != SchemeKind::splitting || !(c.contact_frequency > 0.0))
    return 0.0;
  const double slowest =
      c.stick_frequency > 0.0 ? std::min(c.contact_frequency, c.stick_frequency) : c.contact_frequency;
  return std::min(std::max(contact_times / slowest, least_replay * c.step), longest_replay * scene.duration);
}

/// Steps that splitting may make at once where no contact can meet its obstacle: the flow is exact, but loads are linear over them and
/// statistics are to see the modes (a dozen points a period of the highest). Tables may change inside.
int longest_macro_step(const StepChoice& c, const Scene& scene, double fineness) {
  if (c.scheme != SchemeKind::splitting || c.scaled > 0 || !allows_macro_steps(scene))
    return 1;
  for (const vibration::Load& load : scene.loads)
    if (std::holds_alternative<signals::Table>(load.function) ||
        std::holds_alternative<signals::Integral>(load.function))
      return 1;
  double longest = most_macro_steps * c.step;
  if (c.excitation > 0.0)
    longest = std::min(longest, fineness / (points_per_period * c.excitation));
  if (c.highest_mode > 0.0)
    longest = std::min(longest, 0.5 * fineness / c.highest_mode);
  return std::max(1, static_cast<int>(longest / c.step * (1.0 + 1e-9)));
}

/// Steps of a run in which nothing asks for more; fewer of expensive ones, since motions with many contacts are rarely followed impact by impact.
double least_steps(const Scene& scene) {
  const double cost =
      static_cast<double>(scene.system.size()) + cost_of_contact * static_cast<double>(scene.contacts.size());
  const double share = std::min(1.0, cheap_step / cost);
  return std::max(fewest_steps, std::floor(most_least_steps * share * share));
}

/// The longest step that the terms allow, but for whole steps that cover the duration.
void choose_automatic(StepChoice& c, const Scene& scene, double asked) {
  const double accuracy = std::min(asked, coarsest_accuracy), fineness = fineness_of(asked);
  const bool adaptive = c.scheme == SchemeKind::runge_kutta_54;
  const double least = adaptive ? least_adaptive_steps : least_steps(scene);
  c.step = scene.duration / least;
  c.reason = fmt::format("a run has at least {} steps", least);
  const auto limit = [&](const StepLimit& term) {
    if (term.limit < c.step) {
      c.step = term.limit;
      c.reason = fmt::format("{} resolved for an accuracy of {}{}", term.reason, accuracy, term.cure);
    }
  };
  for (const StepLimit& term : step_limits(c, scene, fineness))
    limit(term);
  double followed = 0.0; // w h of the fastest mode of splitting; 0: all are followed
  if (c.scheme == SchemeKind::splitting && !scene.contacts.empty() && c.highest_mode > 0.0) {
    const StepLimit modes = mode_limit(c, true, fineness);
    if (followed_modes(c, c.step) < before_resonance && modes.limit < c.step) // scaled ones stay at 2 w_c
      limit({std::max(modes.limit, 0.5 * followed_modes(c, c.step) * fineness /
                                       std::max(c.contact_frequency, c.stick_frequency)),
             "modes up to twice the contact frequency, with tangential dampers", modes.cure});
    const double most = followed_modes(c, c.step);
    if (modes.limit < c.step && may_scale(scene, most / c.step, accuracy))
      followed = most;
    else
      limit(modes);
  }
  if (accuracy < asked)
    c.reason += fmt::format(" (no step is longer than that of {})", accuracy);
  if (adaptive)
    return;
  c.steps = count_steps(scene.duration, c);
  c.step = scene.duration / static_cast<double>(c.steps);
  warn_of_normal_dampers(c, c.scheme == SchemeKind::collocation
                                ? "take scheme = \"energy_conserving\", or a smaller damper"
                                : "give a smaller damper where these matter");
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
  if (c.scheme != SchemeKind::runge_kutta_54) {
    c.steps = count_steps(scene.duration, c);
    warn(c);
  }
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
  const double time = collocation_cost * static_cast<double>(collocation.steps) /
                      static_cast<double>(splitting.steps); // of that of splitting
  if (time < worth_changing) {
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
