// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/normal_interval.hpp"

namespace fretwork::contact {
namespace {

/// Newton's method on pieces of parabolas: three to four iterations are usual.
constexpr int most_iterations = 20;
constexpr double tolerance = 1e-13; ///< of the force

/// F = mean(F), below 0 where the contact opens early, by Newton's method: mean gives the mean force that F leads to, and its derivative.
template <class Mean> double solve(const Mean& mean) {
  double force = 0.0, first = 0.0;
  for (int i = 0; i < most_iterations; ++i) {
    const auto [value, slope] = mean(force);
    const double next = force + (value - force) / (1.0 - slope);
    const double change = std::abs(next - force);
    force = next;
    first = i == 0 ? change : first;
    if (change <= tolerance * std::max(std::abs(force), first))
      break;
  }
  return force;
}
struct MeanForce {
  double value, slope;
};

} // namespace

NormalInterval normal_over_interval(const NormalLaw& law, double dt, double mobility, double growing,
                                    const NormalPath& path) {
  const double p0 = path.start, v0 = path.rate, k = law.stiffness;
  NormalInterval out;
  out.end = path.end;
  if (path.end <= 0.0 && p0 == 0.0 && v0 <= 0.0)
    return out;
  const double bent = std::min(most_bent, k * mobility * dt * dt / 12.0), straight = 1.0 - bent;
  const double lag = mobility > 0.0 ? bent / mobility : k * dt * dt / 12.0; // K_N dt^2/12, kg
  const double growing_share = growing * mobility * dt / 12.0;              // beta - 1/2
  const double by_force = (0.5 + growing_share) * mobility * dt * dt, c = law.damping / dt;
  const double free_end = path.end + growing_share * dt * dt * path.acceleration;
  const double n0 = std::max(0.0, k * p0 + law.damping_at(p0) * v0);
  double p1 = 0.0, v1 = 0.0, growth = 0.0;
  bool stiff = law.damping * mobility * dt > most_parabolic;
  const double free = k * p0 - lag * path.acceleration, gradient = 0.5 * k + c;
  if (law.dissipation == 0.0) { // linear
    out.force = (straight * free + gradient * (free_end - p0)) / (straight * straight + gradient * by_force);
    p1 = p0 + (free_end - p0 - by_force * out.force) / straight;
    v1 = v0 + dt * (path.acceleration - mobility * out.force);
  } else {
    // p1 by the growth of the force of d, as far as it is resolved
    const double d = k * law.dissipation,
                 fastest = std::max(std::abs(v0), std::abs(v0 + dt * path.acceleration));
    double bend = mobility * dt * dt * d / 12.0;
    if (bend * fastest > most_bent) {
      bend = 0.0;
      stiff = true;
    }
    const auto move = [&](double force) {
      v1 = v0 + dt * (path.acceleration - mobility * force);
      const double bends = std::min(bend * v1, most_bent);
      p1 = (straight * p0 + free_end - p0 - by_force * force - bend * p0 * v0) / (straight - bends);
      return -(by_force + bend * p1 * mobility * dt) / (straight - bends); // dp1/dF
    };
    out.force = solve([&](double force) -> MeanForce {
      const double by = move(force),
                   least = -0.25 * dt / law.dissipation; // m: the mean force falls with p1 above twice of it
      const double end = std::max(p1, least), falling = p1 > least ? d / dt * end : 0.0;
      return {(free + gradient * (p1 - p0) + 0.5 * d / dt * (end * end - p0 * p0)) / straight,
              (gradient + falling) * by / straight};
    });
    (void)move(out.force);
    growth = bend > 0.0 ? d * (p1 * v1 - p0 * v0) : 0.0;
  }
  growth += 12.0 * lag / (dt * dt) * (p1 - p0) + growing * (v1 - v0);
  // The bend of the law's course alone: a gap that is no straight function of the position changes how the force grows.
  const double bow = law.damping_at(0.5 * (p0 + p1)) * mobility * dt * growth / 12.0 -
                     k * (v1 - v0) * (dt + 3.0 * law.dissipation * (p1 - p0)) / 12.0;
  out.course = {n0, 2.0 * (out.force - bow) - n0, out.force};
  out.to = 1.0;
  if (stiff)
    out.course = {out.force, out.force, out.force};
  if (out.course.smallest() < 0.0) { // opens: the positive part of the parabola
    const double slope = out.course.slope(), curve = -6.0 * out.course.bow();
    const double root = std::sqrt(std::max(0.0, slope * slope - 4.0 * curve * n0));
    const double at = slope > 0.0    ? (slope + root) / (-2.0 * curve)
                      : root > slope ? 2.0 * n0 / (root - slope)
                                     : 0.0;
    const double to = out.to = std::clamp(at, 0.0, 1.0);
    out.force = to * (n0 + to * (slope / 2.0 + to * curve / 3.0));
    const double moment = to * to * (n0 / 2.0 + to * (slope / 3.0 + to * curve / 4.0)); // about the start
    growth = 12.0 * moment - 6.0 * out.force;
    out.course = {n0, 0.0, to > 0.0 ? out.force / to : 0.0};
    p1 = path.end - mobility * dt * dt * (0.5 * out.force - growth / 12.0);
    v1 = v0 + dt * (path.acceleration - mobility * out.force);
  }
  out.end = p1;
  if (!(out.force > 0.0)) {
    out.force = out.to = 0.0;
    out.course = {};
    out.end = path.end;
    out.damper_work = law.spring_energy(p0) - law.spring_energy(out.end);
    return out;
  }
  out.growth = growth;
  out.damper_work =
      out.force * (p1 - p0) + growth * dt / 12.0 * (v1 - v0) + law.spring_energy(p0) - law.spring_energy(p1);
  return out;
}

} // namespace fretwork::contact
