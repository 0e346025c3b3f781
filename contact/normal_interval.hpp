// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The normal force of one contact over an interval dt at whose start it is closed, of its penetrations p0 >= 0, p1 and their rates v0, v1 at both
/// ends, <p> = max(p, 0):
///     mean      F = K_N P + (C_N (p1 - p0) + K_N d (<p1>^2 - p0^2)/2)/dt,   P = (p0 + p1)/2 - (v1 - v0) dt/12
///     course    the parabola from N0 = K_N p0 + c(p0) v0 with the mean F and the bend of that law; the force ends where it does
///     growth    G = K_N (p1 - p0) + c' (v1 - v0) + K_N d (p1 v1 - p0 v0)
///     motion    p1 = p0 + v0 dt + a dt^2/2 - W dt^2 (F/2 - G/12),   v1 = v0 + (a - W F) dt
/// a: p'' without this force; W: mobility of the contact along its normal, 1/kg; c': growing_damping.
///
/// P is the mean of a motion that bends, G the growth of a linear force that moves the contact as far: of order 4 in x = (K_N W)^1/2 dt and C_N W dt
/// while the contact is closed. The frequency is that of K_N to -x^4/720, a damper alone decays as e^(-C_N W dt). Without damper the energy v^2/2W +
/// K_N p^2/2 stays the same to the last digit, a contact rests where K_N lets it rest, and neither depends on how the time is divided.
/// Above x = 1.7, where nothing is resolved, the terms of x^2/12 stay what they are there: stable at any dt.
#pragma once
#include "contact/normal_law.hpp"

namespace fretwork::contact {

/// C_N W dt up to which the damper does not take the force down within the interval: above, its mean stands for it.
constexpr double most_parabolic = 1.9;

/// A force over some time, a parabola of it by its ends and its mean, N.
struct ParabolicForce {
  double first = 0.0, last = 0.0, mean = 0.0;
  /// At a share of the time.
  [[nodiscard]] double at(double share) const { return first + share * (slope() - 6.0 * bow() * share); }
  /// d/d share at the start.
  [[nodiscard]] double slope() const { return last - first + 6.0 * bow(); }
  /// By how much the mean exceeds that of the straight line.
  [[nodiscard]] double bow() const { return mean - 0.5 * (first + last); }
  [[nodiscard]] double largest() const {
    const double b = bow(), s = slope();
    return 12.0 * b > s && s > 0.0 ? first + s * s / (24.0 * b) : std::max(first, last);
  }
  [[nodiscard]] double smallest() const {
    const double b = bow(), s = slope();
    return 12.0 * b < s && s < 0.0 ? first + s * s / (24.0 * b) : std::min(first, last);
  }
  /// Mean of the square, N2.
  [[nodiscard]] double square() const {
    const double b = bow();
    return (first * first + first * last + last * last) / 3.0 + b * (first + last + 1.2 * b);
  }
};

/// The penetration of a contact over an interval as it is without the contact's own normal force.
struct NormalPath {
  double start;        ///< m, >= 0
  double end;          ///< m, start + rate dt + acceleration dt^2/2
  double rate;         ///< m/s, at the start
  double acceleration; ///< m/s2
};

struct NormalInterval {
  double force = 0.0, growth = 0.0; ///< N, F and G
  double end = 0.0;                 ///< m, penetration
  double to = 0.0;                  ///< share of the interval up to which there is a force,
  ParabolicForce course;            ///< until then
  double damper_work = 0.0;         ///< J, by the damper, and what the positive part cuts off the spring
};

/// beta: of a speed that a damper takes down at the rate r, its mean over dt is speed/(1 + beta z), z = r dt: 1/2 of slow dampers, 1 of those that stop the
/// contact at once. With 1/2 throughout, the implicit midpoint, a stiff damper would turn the speed round.
[[nodiscard]] inline double implicit_share(double z) {
  constexpr double slow = 0.05; // z^5/30240 is round-off
  return z < slow ? 0.5 + z * (1.0 / 12.0 - z * z / 720.0) : 1.0 - 1.0 / z + 1.0 / std::expm1(z);
}
/// c' of a damper c, N s/m, z = c W dt: with it in G a speed that the damper alone takes down decays as e^-z; c of slow dampers, 6 c/z of fast ones.
[[nodiscard]] inline double growing_damping(double c, double z) {
  return z > 0.0 ? 12.0 * c * (implicit_share(z) - 0.5) / z : c;
}
/// x^2/12 of the longest interval that follows the frequency of its spring.
inline constexpr double most_bent = 0.25;

/// @param dt  s   @param mobility  W, 1/kg   @param growing  c', N s/m: it may be that of another mobility than W, a larger one
[[nodiscard]] NormalInterval normal_over_interval(const NormalLaw& law, double dt, double mobility,
                                                  double growing, const NormalPath& path);

} // namespace fretwork::contact
