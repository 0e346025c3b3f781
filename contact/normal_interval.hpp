// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The mean normal force of one contact over an interval dt, from its penetrations p0 and p1 at both ends, <p> = max(p, 0):
///     closed at the start   F = mean of the positive part of a force that goes linearly from N0 to N1,
///                           (N0 + N1)/2 = K_h ((p0 + p1)/2 - s^2 a dt^2/12) + (C_N (p1 - p0) + K_N d (<p1>^2 - p0^2)/2)/dt
///     open at the start     F = <K_h M + (C_N <p1> + K_N d <p1>^2/2)/dt>+
///     p1 = end - beta W dt^2 F,   1/K_h = (1/K_N)(1 - x^2/12),   x^2 = K_N W dt_u^2
///     N0    force at the start, K_h (p0 - a dt^2/12) + c(p0) p'; M: mean of <p> along the straight line from p0 to p1, s: share of it that is closed
///     a     p'' without this force; end: p1 without it
///     W     mobility of the contact along its normal, 1/kg
/// Spring: its work is -(V1 - V0), V = K_h <p>^2/2, so that an impact without losses keeps its energy wherever in an interval it begins and ends.
/// K_h and a give the mean force of a motion that bends, p'' = a - W F: a closed contact has the frequency of K_N to -x^2/24 (measured: -0.06 % at
/// x = 0.12), and rests where K_N lets it rest. Damper: the impulse of C_N p' over the time in which there is a force, which may begin with a jump.
/// beta = 1/2, and up to 1 where the damper stops the contact within the interval: implicit_share.
/// Order 2. Above x = 1.7, where nothing is resolved, K_h stays 4/3 K_N.
#pragma once
#include "contact/normal_law.hpp"

namespace fretwork::contact {

/// The penetration of a contact over an interval as it is without the contact's own normal force.
struct NormalPath {
  double start;        ///< m
  double end;          ///< m, start + rate dt + beta acceleration dt^2
  double rate;         ///< m/s, at the start
  double acceleration; ///< m/s2
};

struct NormalInterval {
  double force = 0.0;             ///< N, mean over the interval
  double end = 0.0;               ///< m, penetration
  double from = 0.0, to = 0.0;    ///< shares of the interval between which there is a force,
  double first = 0.0, last = 0.0; ///< N, then, linear between
  double damper_work = 0.0;       ///< J, by the damper, and what the positive part cuts off the spring
  /// N2, mean over the interval.
  [[nodiscard]] double square() const {
    return (to - from) * (first * first + first * last + last * last) / 3.0;
  }
};

/// beta: of a speed that a damper takes down at the rate r, its mean over dt is speed (1 - beta z), z = r dt: 1 - 1/z + 1/(e^z - 1), by a formula
/// that is right to 0.01 and in both limits, 1/2 of slow dampers and 1 of those that stop the contact at once. With 1/2 throughout, the
/// implicit midpoint, a stiff damper would turn the speed round.
[[nodiscard]] inline double implicit_share(double z) { return 0.5 + 0.5 * z / std::sqrt(36.0 + z * z); }

/// @param dt  s   @param usual  s: that of most intervals of the contact, >= dt   @param mobility  W, 1/kg   @param share  beta
[[nodiscard]] NormalInterval normal_over_interval(const NormalLaw& law, double dt, double usual,
                                                  double mobility, double share, const NormalPath& path);

} // namespace fretwork::contact
