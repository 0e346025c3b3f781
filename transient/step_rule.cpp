// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/step_rule.hpp"
#include "core/error.hpp"
#include "transient/modes/mass_scaling.hpp"
#include "transient/scheme_scope.hpp"
#include "transient/splitting/flights.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace fretwork::transient {
namespace {

/// Per run: they take milliseconds, single impacts come out to 1e-4, and statistics see the motion.
constexpr double least_steps = 20000;
/// More steps than this are a mistake in a value rather than a wish: days of computing.
constexpr double most_steps = 1e12;
constexpr double points_per_period =
    30.0; ///< of the excitation at accuracy 0.01, with contacts: loads linear between steps lose (2 pi/30)^2/12 = 0.4 % of it
/// Without contacts little else limits the step: linear interpolation then errs by (2 pi/200)^2/12 = 8e-5.
constexpr double linear_points_per_period = 200.0;
/// A run of an adaptive scheme has at least so many steps.
constexpr double least_adaptive_steps = 200;
/// w_t h at an accuracy of 0.01, whatever the damping: where forces stand at instants a stuck contact gives way by (w_t h)^2/4 too much, 13 %.
constexpr double most_stuck = 0.71;
/// Of r_t h where dampers are implicit: above it sticking contacts ring.
double most_implicit(SchemeKind scheme) { return scheme == SchemeKind::splitting ? 6.3 : 4.0; }
/// Of r_n h of schemes that take normal dampers implicitly, at an accuracy of 0.01 and for a fixed step: above 2 the mean rate alone turns the speed of a mass round
/// (splitting); with collocation a tenth of it is left at 4, where 0.02 is right.
constexpr double normally_damped = 2.0;
double most_normally_damped(SchemeKind scheme) { return scheme == SchemeKind::splitting ? 2.0 : 4.0; }
/// w_c h that normal dampers never make the step shorter than: a damper that is faster leaves no rebound (e < 0.001), and resolving it costs
/// without end.
constexpr double finest_for_dampers = 0.03;
/// w_c dt and w_t dt of the intervals of splitting at an accuracy of 0.01, and how many a step has at most. Of contacts that mostly stick figures are
/// up to 20 % off then, until replays (replays.hpp) have shown it: they move in up to 16 times as many intervals.
constexpr double interval_share = 0.35, most_intervals = 64.0;
/// Length of a replay: w_c times it; in steps, at least; of the duration, at most.
constexpr double contact_times = 30.0, least_replay = 8.0, longest_replay = 0.01;
/// Of a damper's rate times the step of devogelaere, whose limit is 0.59.
constexpr double most_damped = 0.5;
/// The step of an accuracy of 0.02 is the longest: no statistics are worth having above it.
constexpr double coarsest_accuracy = 0.02;
/// w_c h of splitting at an accuracy of 0.01 where modes are made heavier: impulses on modes of w h near 2.5 cost energy that grows with h^2
/// (damping of the modes 12 % too high at w_c h = 0.7, 4 % here), and the modes that are left as they are reach further above w_c.
constexpr double contact_share_with_scaling = 0.45;
/// Steps of a flight. More gain little: its end, with displacements and velocities, costs as much as one step.
constexpr double most_flight = 12.0;
/// Steps of splitting that one of collocation takes the time of: measured 0.9 to 1.1 with 1 and 3 supports, 0.6 to 0.8 with 8 to 30; the same where a
/// damping matrix couples the modes (0.4 to 0.9), and with friction in the plane.
double collocation_cost(const Scene& scene) { return scene.contacts.size() > 3 ? 0.7 : 1.0; }
/// Of the time of splitting: below it collocation is taken, which does not measure its error (replays.hpp).
constexpr double worth_changing = 0.7;
/// Contacts move in intervals within steps: not with residual flexibility, whose forces stand at instants.
bool has_intervals(const StepChoice& c, const Scene& scene) {
  return c.scheme == SchemeKind::splitting && scene.residual.size() == 0;
}
/// w_c h, w_t h and r_t h at an accuracy of 0.01. Measured on rattling tubes (bench_statistics), work rates: with splitting within 1 % at
/// w_c h = 1, with modes near w_c at 0.8 (up to 1.6 % high at 0.9), r_t h = 6.3; with residual flexibility, where contacts stick without much damping (stick_time), 3 % low at w_t h = 0.5, 0.9 % at 0.25, for they
/// start to slide inside steps, which only intervals follow; with collocation these are off by 2.8 % at 1, 1.4 % at 0.5.
/// Of r_t h, where dampers are implicit: above 2 a step turns the speed of a sticking contact round, 0.52 of it at 6.3.
struct Shares {
  double contact, stick, damper;
};
/// w_c h of the longest automatic step, whatever the accuracy.
constexpr double longest_contact_share = 1.0;
/// Up to this share of w_c modes move little while a contact is closed: splitting takes the rest of an impact as that of a mass.
constexpr double slow_modes = 0.6;
Shares shares(const StepChoice& c, const Scene& scene) {
  switch (c.scheme) {
  case SchemeKind::splitting:
    return {c.highest_mode <= slow_modes * c.contact_frequency ? 1.0 : 0.8,
            has_intervals(c, scene) ? 1.0 : 0.25, 6.3};
  case SchemeKind::collocation:
    return {0.5, 0.5, 2.0};
  default:
    return {0.3, 0.3, 2.0};
  }
}
/// Largest w_c h and w_t h without a warning: above it an impact changes the energy by more than 1 % or the statistics are wrong, however
/// stable the run (doc/schemes.md, Stability map).
double most_resolved(SchemeKind scheme) {
  switch (scheme) {
  case SchemeKind::splitting:
    return 1.05; // in intervals of a quarter of it
  case SchemeKind::devogelaere:
    return 0.75;
  case SchemeKind::energy_conserving:
    return 0.5; // its largest forces are 4 % low there, 14 % at 1
  default:
    return 1.0;
  }
}

/// The modes move exactly between the actions of the contacts.
bool moves_exactly(SchemeKind scheme) {
  return scheme == SchemeKind::splitting || scheme == SchemeKind::collocation ||
         scheme == SchemeKind::energy_conserving;
}

/// Shortest time in which the dampers of sticking contacts give way to their springs, C_T/K_T, s; 0 without friction.
double shortest_relaxation(const Scene& scene) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const ContactPoint& point : scene.contacts)
    if (const auto& law = point.support.friction; law.active())
      shortest = std::min(shortest, law.damping / law.stiffness);
  return std::isfinite(shortest) ? shortest : 0.0;
}

/// Time in which sticking contacts move, s: that of their vibration, or where it is longer that in which their dampers give way.
double stick_time(const StepChoice& c, const Scene& scene) {
  const double vibration = 1.0 / c.stick_frequency;
  return c.scheme == SchemeKind::splitting && !has_intervals(c, scene)
             ? std::hypot(vibration, shortest_relaxation(scene))
             : vibration;
}

/// With contacts: collocation needs none of it, splitting can take modes as heavier ones.
bool may_go_past_modes(SchemeKind scheme) {
  return scheme == SchemeKind::collocation || scheme == SchemeKind::splitting;
}

struct Term {
  double limit; ///< s
  std::string reason;
};

/// What the highest mode asks of the step.
Term mode_term(const StepChoice& c, bool contacts, double fineness) {
  const bool exact = moves_exactly(c.scheme);
  const double eps = 0.5 * fineness;
  // without contacts the flow of the splitting scheme is exact: only the statistics need to see the modes, in about 20 points a period
  const double mode = exact ? (contacts ? 5.0 : 0.6) : 1.0;
  return {(exact && contacts ? std::min(eps * mode, before_resonance) : eps * mode) / c.highest_mode,
          fmt::format("the highest mode {:.4g} rad/s", c.highest_mode)};
}

/// What limits the step, the highest mode where contacts meet exact flows apart. `fineness` scales with the square root of the accuracy,
/// 1 for 0.01.
std::vector<Term> terms(const StepChoice& c, const Scene& scene, double fineness) {
  const bool exact = moves_exactly(c.scheme), contacts = !scene.contacts.empty();
  const double eps = 0.5 * fineness;
  std::vector<Term> out;
  const auto add = [&](double factor, double rate, const std::string& reason) {
    if (rate > 0.0)
      out.push_back({factor / rate, reason});
  };
  const double points = (contacts ? points_per_period : linear_points_per_period) / fineness;
  add(1.0 / points, c.excitation, fmt::format("the excitation ({:.4g} Hz)", c.excitation));
  // its steps follow its tolerance and end at the points of tables: it only must not step over what other loads do
  if (c.scheme == SchemeKind::runge_kutta_54)
    return out;
  if (c.table_interval > 0.0)
    out.push_back(
        {c.table_interval, fmt::format("the shortest interval of a table ({:.4g} s)", c.table_interval)});
  const bool devogelaere = c.scheme == SchemeKind::devogelaere;
  const double damped = devogelaere ? std::min(eps, most_damped) : eps;
  const Shares share = shares(c, scene);
  const double resolved = most_resolved(c.scheme);
  add(std::min({share.contact * fineness, longest_contact_share, resolved}), c.contact_frequency,
      fmt::format("the contact frequency {:.4g} rad/s", c.contact_frequency));
  if (c.stick_frequency > 0.0) {
    const double most = std::min((has_intervals(c, scene) ? share.stick : most_stuck) * fineness, resolved) /
                        c.stick_frequency;
    out.push_back({std::min(share.stick * fineness * stick_time(c, scene), most),
                   fmt::format("the frequency of sticking contacts {:.4g} rad/s", c.stick_frequency)});
  }
  add(exact ? std::min(share.damper * fineness, most_implicit(c.scheme)) : damped, c.damper_rate,
      fmt::format("the tangential dampers' rate {:.4g} 1/s", c.damper_rate));
  if (exact && c.normal_damper_rate > 0.0)
    out.push_back(
        {std::max(std::min(normally_damped * fineness, most_normally_damped(c.scheme)) / c.normal_damper_rate,
                  finest_for_dampers * fineness / c.contact_frequency),
         fmt::format("the normal dampers' rate {:.4g} 1/s", c.normal_damper_rate)});
  add(damped, c.explicit_rate, fmt::format("the dampers' rate {:.4g} 1/s", c.explicit_rate));
  if (c.highest_mode > 0.0 && !(contacts && may_go_past_modes(c.scheme)))
    out.push_back(mode_term(c, contacts, fineness));
  return out;
}

/// @throws core::Error where there would be absurdly many
std::int64_t count_steps(double duration, const StepChoice& c) {
  const double steps = std::ceil(duration / c.step * (1.0 - 1e-12));
  if (!(steps <= most_steps))
    throw core::Error(fmt::format(
        "the transient would take {:.3g} steps of {:.3g} s ({}); check the value that asks for them, "
        "or the duration",
        steps, c.step, c.reason));
  return static_cast<std::int64_t>(steps);
}

/// What becomes of normal dampers that the step does not resolve.
void warn_of_normal_dampers(StepChoice& c, const char* cure) {
  const double rate = c.normal_damper_rate * c.step, most = most_normally_damped(c.scheme);
  if (!moves_exactly(c.scheme) || !(rate > most))
    return;
  const bool keeps = c.scheme == SchemeKind::energy_conserving;
  c.warnings.push_back(fmt::format(
      "the step {:.3g} s does not resolve the normal dampers: r_n h = {:.3g}, at most {} for {}; {}", c.step,
      rate, most,
      keeps ? "largest forces that can be trusted (rebounds are right at any step)"
            : "rebounds that can be trusted",
      cure));
}

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
  add(c.damper_rate * c.step, exact ? most_implicit(c.scheme) : damped, "r_t h", "the tangential dampers");
  add(c.explicit_rate * c.step, damped, "r_e h", "the dampers");
  warn_of_normal_dampers(c, "take a smaller step or leave it out");
  if (!collocation)
    add(c.highest_mode * c.step,
        c.scheme == SchemeKind::splitting ? 2.75
        : exact                           ? 3.0
                                          : 1.8,
        "w_max h", "the highest mode");
  if (c.table_interval > 0.0)
    add(c.step / c.table_interval * (1.0 - 1e-9), 1.0,
        "h/interval", // of equal ones round-off leaves a shorter
        "the shortest interval of a table");
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
int intervals_of_step(const StepChoice& c, const Scene& scene, double fineness) {
  if (!has_intervals(c, scene))
    return 1;
  const double needed =
      std::max(c.contact_frequency, c.stick_frequency) * c.step / (interval_share * fineness);
  return static_cast<int>(std::clamp(std::ceil(needed * (1.0 - 1e-9)), 1.0, most_intervals));
}

/// Length of replays: some five periods of closed contacts, sticking ones included.
double replay_length(const StepChoice& c, const Scene& scene) {
  if (!has_intervals(c, scene) || !(c.contact_frequency > 0.0))
    return 0.0;
  const double slowest =
      c.stick_frequency > 0.0 ? std::min(c.contact_frequency, c.stick_frequency) : c.contact_frequency;
  return std::min(std::max(contact_times / slowest, least_replay * c.step), longest_replay * scene.duration);
}

/// Steps that splitting may make at once where no contact can meet its obstacle: the flow is exact, but loads are linear over them and
/// statistics are to see the modes (a dozen points a period of the highest). Tables may change inside.
int flight_steps(const StepChoice& c, const Scene& scene, double fineness) {
  if (c.scheme != SchemeKind::splitting || c.scaled > 0 || !may_fly(scene))
    return 1;
  for (const Load& load : scene.loads)
    if (std::holds_alternative<Table>(load.function) || std::holds_alternative<Integral>(load.function))
      return 1;
  double longest = most_flight * c.step;
  if (c.excitation > 0.0)
    longest = std::min(longest, fineness / (points_per_period * c.excitation));
  if (c.highest_mode > 0.0)
    longest = std::min(longest, 0.5 * fineness / c.highest_mode);
  return std::max(1, static_cast<int>(longest / c.step * (1.0 + 1e-9)));
}

/// The longest step that the terms allow, but for whole steps that cover the duration.
void choose_automatic(StepChoice& c, const Scene& scene, double asked) {
  const double accuracy = std::min(asked, coarsest_accuracy), fineness = fineness_of(asked);
  const bool adaptive = c.scheme == SchemeKind::runge_kutta_54;
  const double least = adaptive ? least_adaptive_steps : least_steps;
  c.step = scene.duration / least;
  c.reason = fmt::format("a run has at least {} steps", least);
  const auto limit = [&](const Term& term) {
    if (term.limit < c.step) {
      c.step = term.limit;
      c.reason = fmt::format("{} resolved for an accuracy of {}", term.reason, accuracy);
    }
  };
  for (const Term& term : terms(c, scene, fineness))
    limit(term);
  double followed = 0.0; // w h of the fastest mode of splitting; 0: all are followed
  if (c.scheme == SchemeKind::splitting && !scene.contacts.empty() && c.highest_mode > 0.0) {
    const Term modes = mode_term(c, true, fineness);
    const double most = modes.limit * c.highest_mode;
    if (modes.limit < c.step) {
      const Term scaled{
          std::max(modes.limit, contact_share_with_scaling * fineness / c.contact_frequency),
          fmt::format("the contact frequency {:.4g} rad/s, with modes far above it,", c.contact_frequency)};
      const double step = std::min(c.step, scaled.limit);
      if (step > modes.limit && may_scale(scene, most / step, accuracy)) {
        limit(scaled);
        followed = most;
      }
    }
    if (followed == 0.0)
      limit(modes);
  }
  if (accuracy < asked)
    c.reason += fmt::format(" (no step is longer than that of {})", accuracy);
  if (adaptive)
    return;
  c.steps = count_steps(scene.duration, c);
  c.step = scene.duration / static_cast<double>(c.steps);
  warn_of_normal_dampers(c, c.scheme == SchemeKind::energy_conserving
                                ? "give a smaller damper where these matter"
                                : "take scheme = \"energy_conserving\", or a smaller damper");
  if (followed > 0.0)
    scale_modes(c, scene, followed / c.step);
  c.flight = flight_steps(c, scene, fineness);
  if (c.flight > 1)
    c.reason += fmt::format("; up to {} of them at once while no contact can meet its obstacle", c.flight);
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
  c.parts = intervals_of_step(c, scene, fineness_of(options.accuracy));
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
  const double share = static_cast<double>(collocation.steps) / static_cast<double>(splitting.steps),
               step_cost = collocation_cost(scene), cost = step_cost * share;
  StepChoice& chosen = cost < worth_changing ? collocation : splitting;
  chosen.scheme_reason = fmt::format(
      "{}: collocation would need {:.2g} of the steps of splitting, each of about {:.2g} times the time",
      name_of(chosen.scheme), share, step_cost);
  return std::move(chosen);
}

} // namespace

StepChoice choose_step(const Scene& scene, const StepOptions& options) {
  const SchemeKind scheme = options.scheme.value_or(SchemeKind::splitting);
  check_scope(scene, scheme);
  const SceneRates rates = rates_of(scene);
  return options.scheme ? choice_of(scene, rates, options, scheme) : cheapest(scene, rates, options);
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
