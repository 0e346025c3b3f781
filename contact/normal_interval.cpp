// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/normal_interval.hpp"

namespace fretwork::contact {
namespace {

/// x^2/12 of the longest interval that follows the contact's own frequency.
constexpr double most_bent = 0.25;
/// beta up to which the force of a contact that is closed at the start is taken for linear in the interval.
constexpr double most_linear = 0.6;
/// Newton's method on pieces of parabolas: three to four iterations are usual.
constexpr int most_iterations = 20;
constexpr double tolerance = 1e-13; ///< of the force

/// The law with all that does not change while F is sought.
struct MeanLaw {
  double k, lag, c, d; ///< N/m, m, N/m, N/m2
  double p0, n0;       ///< m, N: at the start
  bool stiff;          ///< the damper takes the force down within the interval: it is not linear

  /// Mean of the force, and its slope by p1.
  struct Mean {
    double force, slope;
    double last; ///< N: where it is linear from n0 to the end of the interval, whatever its sign
  };
  [[nodiscard]] Mean at(double p1) const {
    const double closed1 = std::max(p1, 0.0), damped = d * closed1;
    const double by_end = c + 2.0 * damped;
    if (p0 < 0.0) {
      const double force = k * mean_penetration(p0, p1) + c * closed1 + damped * closed1;
      return {force, p1 > 0.0 ? k * mean_slopes(p0, p1).by_p2 + by_end : 0.0, force};
    }
    const double s = closed_share(p0, p1);
    const double linear =
        k * (0.5 * (p0 + p1) - s * s * lag) + c * (p1 - p0) + damped * closed1 - d * p0 * p0;
    const double last = stiff ? linear : 2.0 * linear - n0;
    if (last >= 0.0 || stiff)
      return {linear, 0.5 * k + by_end, last};
    const double share = n0 / (n0 - last); // of the interval with a force
    return {0.5 * n0 * share, share * share * (0.5 * k + by_end), last};
  }
};

/// F = law(end - b F), F >= 0.
double solve(const MeanLaw& law, double end, double b) {
  double force = 0.0;
  for (int i = 0; i < most_iterations; ++i) {
    const MeanLaw::Mean mean = law.at(end - b * force);
    const double next = std::max(0.0, force + (mean.force - force) / (1.0 + b * mean.slope));
    const double change = std::abs(next - force);
    force = next;
    if (change <= tolerance * force)
      break;
  }
  return force;
}

} // namespace

NormalInterval normal_over_interval(const NormalLaw& law, double dt, double usual, double mobility,
                                    double share, const NormalPath& path) {
  NormalInterval out;
  out.end = path.end;
  const double p0 = path.start;
  if (p0 <= 0.0 && path.end <= 0.0)
    return out;
  const double bent = std::min(most_bent, law.stiffness * mobility * usual * usual / 12.0);
  const double k = law.stiffness / (1.0 - bent);
  const double lag = mobility > 0.0 ? bent * path.acceleration / (law.stiffness * mobility) : 0.0;
  // that of the mean law: with K_h and a
  const double n0 = p0 >= 0.0 ? std::max(0.0, k * (p0 - lag) + law.damping_at(p0) * path.rate) : 0.0;
  const MeanLaw mean_law{k,  lag, law.damping / dt,   0.5 * law.stiffness * law.dissipation / dt,
                         p0, n0,  share > most_linear};
  const double b = share * mobility * dt * dt;
  if (p0 >= 0.0 && law.dissipation == 0.0) { // closed to the end, as in most intervals: linear
    const double c = mean_law.c;
    const double force =
        std::max(0.0, (k * (0.5 * (p0 + path.end) - lag) + c * (path.end - p0)) / (1.0 + b * (0.5 * k + c)));
    const double p1 = path.end - b * force, last = mean_law.stiff ? force : 2.0 * force - n0;
    if (p1 > 0.0 && last >= 0.0)
      return {force,
              p1,
              0.0,
              1.0,
              mean_law.stiff ? force : n0,
              last,
              (force + k * lag) * (p1 - p0) - 0.5 * k * (p1 * p1 - p0 * p0)};
  }
  out.force = solve(mean_law, path.end, b);
  const double p1 = out.end = path.end - b * out.force;
  const double closed0 = std::max(p0, 0.0), closed1 = std::max(p1, 0.0), s = closed_share(p0, p1);
  if (!(out.force > 0.0)) {
    out.damper_work = law.spring_energy(p0) - law.spring_energy(p1);
    return out;
  }
  const double spring = p0 >= 0.0 ? out.force + k * s * s * lag : out.force;
  out.damper_work = spring * (p1 - p0) - 0.5 * k * (closed1 * closed1 - closed0 * closed0);
  if (p0 >= 0.0) {
    const double last = mean_law.at(p1).last;
    out.first = mean_law.stiff ? out.force : n0;
    out.last = std::max(0.0, last);
    out.to = last >= 0.0 ? 1.0 : n0 / (n0 - last);
    return out;
  }
  out.from = p0 / (p0 - p1);
  out.to = 1.0;
  const double mean = out.force / (1.0 - out.from);
  out.first = std::min(2.0 * mean, law.damping * std::max(0.0, path.rate));
  out.last = 2.0 * mean - out.first;
  return out;
}

} // namespace fretwork::contact
