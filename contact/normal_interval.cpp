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

NormalInterval normal_over_interval(const NormalLaw& law, double dt, double mobility, double compliance,
                                    double growing, const NormalPath& path) {
  const double p0 = path.start, v0 = path.rate, k = law.stiffness;
  NormalInterval out;
  out.end = path.end;
  if (path.end <= 0.0 && p0 == 0.0 && v0 <= 0.0)
    return out;
  const double twelfth = dt * dt / 12.0;
  const auto [stiffness, damping, end_share] =
      linear_terms(k, mobility, twelfth, law.damping * mobility * dt, growing);
  const double lag = stiffness * twelfth;                   // kg
  const double by_growth = mobility * twelfth - compliance; // m/N
  const double straight = 1.0 - stiffness * by_growth;
  const double growing_share = damping * by_growth / dt; // beta - 1/2
  const double by_force = (0.5 + growing_share) * mobility * dt * dt, c = law.damping / dt;
  const double free_end = path.end + growing_share * dt * dt * path.acceleration;
  const double n0 = std::max(0.0, k * p0 + law.damping_at(p0) * v0);
  double p1 = 0.0, v1 = 0.0, growth = 0.0;
  bool stiff = law.damping * mobility * dt > most_parabolic;
  const double free = k * p0 + stiffness * path.lift - lag * path.acceleration,
               gradient = end_share * k + c + 0.625 * stiffness * stiffness * compliance;
  if (law.dissipation == 0.0) { // linear
    out.force = (straight * free + gradient * (free_end - p0)) / (straight * straight + gradient * by_force);
    p1 = p0 + (free_end - p0 - by_force * out.force) / straight;
    v1 = v0 + dt * (path.acceleration - mobility * out.force);
  } else {
    // p1 by the growth of the force of d, as far as it is resolved
    const double d = k * law.dissipation,
                 fastest = std::max(std::abs(v0), std::abs(v0 + dt * path.acceleration));
    double bend = by_growth * d;
    if (std::abs(bend) * fastest > most_bent) {
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
    growth = bend != 0.0 ? d * (p1 * v1 - p0 * v0) : 0.0;
  }
  growth += stiffness * (p1 - p0) + damping * (v1 - v0);
  out.course = {n0, k * p1 + law.damping_at(p1) * v1, out.force};
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
    p1 = path.end - 0.5 * mobility * dt * dt * out.force + by_growth * growth;
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
  // first moment of the rate, about the middle
  const double moment = dt / 12.0 * (v1 - v0) - path.lift + compliance * (out.force - 0.625 * growth);
  out.damper_work = out.force * (p1 - p0) + growth * moment + law.spring_energy(p0) - law.spring_energy(p1);
  return out;
}

} // namespace fretwork::contact
