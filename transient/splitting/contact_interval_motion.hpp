// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a contact does in an interval, in the order in which it is found: its motion without its own force, its normal force. For
/// contact_interval.cpp and contact_interval_friction.cpp alone.
#pragma once
#include "transient/splitting/contact_interval.hpp"

namespace fretwork::transient {

/// How a contact moves over an interval without its own force, along the normal at its mean position and across.
struct ContactIntervals::Motion {
  contact::ContactAxes axes;
  Components mean, half_way;       ///< m, position from the obstacle's centre; m/s, velocity half way
  Components velocity;             ///< m/s, at the start
  Components acceleration;         ///< m/s2, mean
  Components jerk;                 ///< m/s3
  Components by_normal;            ///< 1/kg, W n
  double mobility = 0.0;           ///< 1/kg, n W n
  Components compliance_by_normal; ///< m/N, Y n
  double compliance = 0.0;         ///< m/N, n Y n
  Components expected;             ///< N, of its force: what moves the mean position by Y
  Components lift;                 ///< m, of the mean position, with that
  /// The penetration is p + r t + a t^2/2 + bend x^2 (3 - 2 x), x = t/dt.
  double penetration = 0.0;          ///< p, m
  double rate = 0.0;                 ///< r, m/s
  double acceleration_inwards = 0.0; ///< a, m/s2: mean of its second derivative, under the friction expected
  double bend = 0.0;                 ///< m: by its jerk at the end, and by others' Y G
  double lift_inwards = 0.0;         ///< m, of the mean of the penetration, under the friction expected
  double per_interval = 0.0;         ///< 1/dt
  contact::AxesTurn turn;
  [[nodiscard]] double after(double time) const {
    const double x = per_interval * time;
    return penetration + time * (rate + 0.5 * time * acceleration_inwards) + bend * x * x * (3.0 - 2.0 * x);
  }
  [[nodiscard]] double rate_after(double time) const {
    const double x = per_interval * time;
    return rate + time * acceleration_inwards + 6.0 * per_interval * bend * x * (1.0 - x);
  }
  /// Of a part of the interval from a time on, as long: the mean acceleration, and what the jerk bends at its end.
  [[nodiscard]] double acceleration_over(double from, double length) const {
    return acceleration_inwards +
           6.0 * per_interval * per_interval * bend * (1.0 - per_interval * (2.0 * from + length));
  }
  [[nodiscard]] double bend_over(double length) const {
    const double share = per_interval * length;
    return share * share * share * bend;
  }
};

/// Its normal force over an interval.
struct ContactIntervals::NormalForce {
  double force = 0.0,
         growth = 0.0; ///< N, mean over the interval, and growth of a linear force with its first moment
  double from = 0.0, to = 0.0;            ///< s: it acts between,
  contact::ParabolicForce course;         ///< so
  bool opens = false;                     ///< it ends in the interval
  double approach = 0.0, departure = 0.0; ///< m/s, where it closes and opens
  double damper_work = 0.0;               ///< J
  double deepest = 0.0;                   ///< m, penetration beside a damper
};

} // namespace fretwork::transient
