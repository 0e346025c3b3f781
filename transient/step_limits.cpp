// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/step_limits.hpp"
#include "transient/modes/mass_scaling.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::transient {
namespace {

/// Without contacts little else limits the step: linear interpolation then errs by (2 pi/200)^2/12 = 8e-5.
constexpr double linear_points_per_period = 200.0;
/// Of r_n h of collocation and energy_conserving, at an accuracy of 0.01.
constexpr double normally_damped = 2.0;
/// w_c h that normal dampers never make the step shorter than: a damper that is faster leaves no rebound (e < 0.001), and resolving it costs
/// without end.
constexpr double finest_for_dampers = 0.03;
/// w_c h and w_t h of the longest automatic step, whatever the accuracy: that of splitting, the only scheme that comes to it.
constexpr double longest_contact_share = 1.25;
/// w_c h and w_t h at an accuracy of 0.01. With collocation work rates of rattling tubes are 2.8 % off at w_t h = 1, 1.4 % at 0.5: contacts start to
/// slide inside steps, which only intervals follow.
double contact_share(SchemeKind scheme) {
  switch (scheme) {
  case SchemeKind::splitting:
    return longest_contact_share;
  case SchemeKind::collocation:
    return 0.5;
  default:
    return 0.3;
  }
}
/// Of a damper's rate times the step of schemes that take it explicitly.
double explicit_share(SchemeKind scheme, double fineness) {
  return scheme == SchemeKind::devogelaere ? std::min(0.5 * fineness, most_damped) : 0.5 * fineness;
}
/// r_t h up to which tangential dampers do not stop contacts within the step, and w h of modes that are followed above it.
constexpr double slow_dampers = 3.0, beside_dampers = 1.5;
/// With contacts: collocation needs none of it, splitting can take modes as heavier ones.
bool may_go_past_modes(SchemeKind scheme) {
  return scheme == SchemeKind::collocation || scheme == SchemeKind::splitting;
}

/// Of single steps of splitting: the polygon nearest to a record loses (w h)^4/720 of what moves with w, 0.14 % at an accuracy of 0.01, 0.01 %
/// without contacts. Other schemes have lines between values, and none where their steps are no longer than its intervals.
double record_step(const StepChoice& c, bool contacts, double fineness) {
  if (c.scheme == SchemeKind::splitting)
    return (contacts ? 1.0 : 0.5) * std::sqrt(fineness) / c.record_rate;
  const double points = contacts ? points_per_period : linear_points_per_period;
  return std::max(c.record_interval,
                  2.0 * std::numbers::pi /
                      (std::max(points / fineness, fewest_points_per_period) * c.record_rate));
}

} // namespace

double most_resolved(SchemeKind scheme) {
  switch (scheme) {
  case SchemeKind::splitting:
    return 1.3;
  case SchemeKind::devogelaere:
    return 0.75;
  case SchemeKind::energy_conserving:
    return 0.5; // its largest forces are 4 % low there, 14 % at 1
  default:
    return 1.0;
  }
}

bool moves_exactly(SchemeKind scheme) {
  return scheme == SchemeKind::splitting || scheme == SchemeKind::collocation ||
         scheme == SchemeKind::energy_conserving;
}

double most_implicit(SchemeKind scheme) { return scheme == SchemeKind::splitting ? 6.3 : 4.0; }

double most_normally_damped(SchemeKind scheme) {
  return scheme == SchemeKind::splitting ? most_intervals * normal_damper_share : 4.0;
}

double damper_share(SchemeKind scheme, double fineness) {
  if (!moves_exactly(scheme))
    return explicit_share(scheme, fineness);
  return std::min((scheme == SchemeKind::splitting ? most_implicit(scheme) : 2.0) * fineness,
                  most_implicit(scheme));
}

double followed_modes(const StepChoice& c, double step) {
  return c.scheme == SchemeKind::splitting && c.damper_rate * step > slow_dampers ? beside_dampers
                                                                                  : before_resonance;
}

StepLimit mode_limit(const StepChoice& c, bool contacts, double fineness) {
  const bool exact = moves_exactly(c.scheme);
  const double eps = 0.5 * fineness;
  // without contacts the flow of the splitting scheme is exact: only the statistics need to see the modes, in about 20 points a period
  const double mode = exact ? (contacts ? 5.0 : 0.6) : 1.0;
  // with dampers that stop contacts, or in a step in which they do not
  const double slow = c.damper_rate > 0.0 ? slow_dampers * c.highest_mode / c.damper_rate : before_resonance,
               followed = c.scheme == SchemeKind::splitting
                              ? std::clamp(slow, beside_dampers, before_resonance)
                              : before_resonance;
  const bool damped = exact && contacts && followed < before_resonance;
  return {(exact && contacts ? std::min(eps * mode, followed) : eps * mode) / c.highest_mode,
          fmt::format("the highest mode {:.4g} rad/s{}", c.highest_mode,
                      damped ? ", with tangential dampers" : ""),
          damped ? "; a smaller tangential_damping makes the step longer" : ""};
}

std::vector<StepLimit> step_limits(const StepChoice& c, const Scene& scene, double fineness) {
  const bool exact = moves_exactly(c.scheme), contacts = !scene.contacts.empty();
  std::vector<StepLimit> out;
  const auto add = [&](double factor, double rate, const std::string& reason) {
    if (rate > 0.0)
      out.push_back({factor / rate, reason});
  };
  const auto resolve = [&](double points, double frequency) {
    add(1.0 / std::max(points / fineness, fewest_points_per_period), frequency,
        fmt::format("the excitation ({:.4g} Hz)", frequency));
  };
  const double by_lines = contacts ? points_per_period : linear_points_per_period;
  if (contacts && c.scheme == SchemeKind::splitting) {
    resolve(corrected_points_per_period, c.excitation);
    resolve(by_lines, c.sampled_excitation);
  } else {
    resolve(by_lines, c.excitation);
  }
  // its steps follow its tolerance and end at the points of tables: it only must not step over what other loads do
  if (c.scheme == SchemeKind::runge_kutta_54)
    return out;
  if (c.table_interval > 0.0)
    out.push_back(
        {c.table_interval, fmt::format("the shortest interval of a table ({:.4g} s)", c.table_interval)});
  if (c.record_rate > 0.0)
    out.push_back({record_step(c, contacts, fineness),
                   fmt::format("the band of a record below the highest mode ({:.4g} Hz)",
                               c.record_rate / (2.0 * std::numbers::pi))});
  const double closed =
      std::min({contact_share(c.scheme) * fineness, longest_contact_share, most_resolved(c.scheme)});
  add(closed, c.contact_frequency, fmt::format("the contact frequency {:.4g} rad/s", c.contact_frequency));
  add(closed, c.stick_frequency,
      fmt::format("the frequency of sticking contacts {:.4g} rad/s", c.stick_frequency));
  if (c.damper_rate > 0.0) {
    const bool splitting = c.scheme == SchemeKind::splitting;
    const double intervals = splitting ? most_intervals : 1.0;
    out.push_back({intervals * damper_share(c.scheme, fineness) / c.damper_rate,
                   fmt::format("the tangential dampers' rate {:.4g} 1/s", c.damper_rate),
                   splitting ? "; a smaller tangential_damping makes the step longer"
                             : "; a smaller tangential_damping makes the step longer (scheme = \"splitting\" "
                               "resolves the dampers within a step)"});
  }
  if (exact && c.normal_damper_rate > 0.0) {
    const double most = most_normally_damped(c.scheme),
                 share =
                     c.scheme == SchemeKind::splitting ? most : std::min(normally_damped * fineness, most);
    out.push_back(
        {std::max(share / c.normal_damper_rate, finest_for_dampers * fineness / c.contact_frequency),
         fmt::format("the normal dampers' rate {:.4g} 1/s", c.normal_damper_rate)});
  }
  add(explicit_share(c.scheme, fineness), c.explicit_rate,
      fmt::format("the dampers' rate {:.4g} 1/s", c.explicit_rate));
  if (c.highest_mode > 0.0 && !(contacts && may_go_past_modes(c.scheme)))
    out.push_back(mode_limit(c, contacts, fineness));
  return out;
}

} // namespace fretwork::transient
