// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The normal force of one contact over an interval dt at whose start it is closed, of its penetrations p0 >= 0, p1 and their rates v0, v1 at both
/// ends, <p> = max(p, 0):
///     mean      F = K_N (p0 + A (p1 - p0)) + K_N' (L - Y (F - 5 K_N' (p1 - p0)/8) - (v1 - v0) dt/12) + (C_N (p1 - p0) + K_N d (<p1>^2 - p0^2)/2)/dt
///     course    the parabola from K_N p0 + c(p0) v0 to K_N p1 + c(p1) v1 with the mean F; the force ends where it does
///     growth    G = K_N' (p1 - p0) + c' (v1 - v0) + K_N d (p1 v1 - p0 v0)
///     motion    p1 = p0 + v0 dt + a dt^2/2 - W dt^2 (F/2 - G/12) - Y G,   v1 = v0 + (a - W F) dt
/// a: p'' without this force; W: mobility of the contact along its normal, 1/kg. Y, compliance, m/N: of a structure that holds forces back within the
/// interval; L, lift: what the mean of the penetration without this force exceeds that of the parabola through its ends by. K_N', c', A: linear_terms.
///
/// In short intervals these are K_N, C_N and 1/2: (p0 + p1)/2 - (v1 - v0) dt/12 is the mean of a motion that bends, G the growth of a linear force that moves the
/// contact as far. With them the end is that of an oscillator with a damper in time, to 1e-3 and better (linear_terms). Without damper, L and Y the energy v^2/2W + K_N p^2/2 stays the same
/// to the last digit. A contact rests where K_N lets it rest, where L = Y F. Neither depends on how the time is divided. Above x = (K_N W)^1/2 dt = 1.68, where nothing
/// is resolved, the terms of x^2/12 stay what they are there: stable at any dt.
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
  double end;          ///< m
  double rate;         ///< m/s, at the start
  double acceleration; ///< m/s2
  double lift = 0.0;   ///< m, L: 0 of the parabola from the start through the end
};

struct NormalInterval {
  double force = 0.0, growth = 0.0; ///< N, F and G
  double end = 0.0;                 ///< m, penetration
  double to = 0.0;                  ///< share of the interval up to which there is a force,
  ParabolicForce course;            ///< until then
  double damper_work = 0.0;         ///< J, by the damper, and what the positive part cuts off the spring
};

/// c' of a damper c, N s/m, z = c W dt: with it in G a speed that the damper alone takes down decays as e^-z; c of slow dampers, 6 c/z of fast ones. The mean of that
/// speed over dt is its start over 1 + beta z, beta = 1/2 + z c'/(12 c): 1/2 of slow dampers, 1 of those that stop the contact at once. With c throughout, the implicit
/// midpoint, a stiff damper would turn the speed round.
[[nodiscard]] inline double growing_damping(double c, double z) {
  constexpr double series = 0.8; // up to z^14 it leaves out 3e-15
  if (z < series) {
    const double s = z * z;
    return c * (1.0 - s * (1.0 / 60.0 -
                           s * (1.0 / 2520.0 -
                                s * (1.0 / 100800.0 -
                                     s * (1.0 / 3991680.0 - s * (691.0 / 108972864000.0 -
                                                                 s * (1.0 / 6227020800.0 -
                                                                      s * (3617.0 / 889218570240000.0))))))));
  }
  const double beta = 1.0 - 1.0 / z + 1.0 / std::expm1(z);
  return 12.0 * c * (beta - 0.5) / z;
}
/// K' W dt^2/12 of the longest interval that follows the frequency of its spring: x = 1.68.
inline constexpr double most_bent = 0.25;

/// What stands for a spring K and a damper C in the terms of an interval.
struct LinearTerms {
  double stiffness; ///< N/m, K'
  double damping;   ///< N s/m, c'
  double end;       ///< A, the part of the end in the mean of the motion
};
/// Fitted to the exact solution of an oscillator: K' without C to 2e-5, 12 (1 - (x/2) cot(x/2))/(W dt^2), with z = C W dt up to 4 to 1e-3, while x is below 1.68.
/// @param mobility  W, 1/kg, may be round-off below 0   @param twelfth  dt^2/12   @param growing  growing_damping: c' without the spring
[[nodiscard]] inline LinearTerms linear_terms(double stiffness, double mobility, double twelfth, double z,
                                              double growing) {
  const double y = stiffness * mobility * twelfth;
  LinearTerms out{stiffness * (1.0 + y * (0.2 + y * (2.0 / 35.0 + y * (3.0 / 175.0)))), growing, 0.5};
  if (z > 0.0) {
    const double resolved = std::min(y, most_bent), square = z * z;
    out.stiffness /= 1.0 + square * (1.0 + resolved * (2.0 / 3.0)) / (60.0 + square / 3.0);
    out.damping *= 1.0 + resolved * (0.4 + 0.2 * resolved) / (1.0 + square / 30.0);
    out.end += z * resolved / (60.0 + square);
  }
  if (out.stiffness * mobility * twelfth > most_bent)
    out.stiffness = most_bent / (mobility * twelfth);
  return out;
}

/// @param dt  s   @param mobility  W, 1/kg   @param compliance  Y, m/N   @param growing  c', N s/m: it may be that of another mobility than W, a larger one
[[nodiscard]] NormalInterval normal_over_interval(const NormalLaw& law, double dt, double mobility,
                                                  double compliance, double growing, const NormalPath& path);

} // namespace fretwork::contact
