// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a spring and a damper of a contact, closed for a part of a step, add to their force where the contact is accelerated otherwise than it was found for,
/// to first order. Acceleration and force are linear in time over the step, x = (mean, slope); in s = t/h the contact moves by h^2 U, h V:
///     U = (s^2/2, s^3/3 - s^2/2),  V = (s, s^2 - s);    f = -J (x + W f)
/// J: mean and slope of K h^2 U + C h V while it is closed, and of what a touch that comes earlier by U(from) adds: C h U(from), at once.
#pragma once

namespace fretwork::transient {

/// Linear in time over a step, from mean - slope to mean + slope.
struct LinearInTime {
  double mean = 0.0, slope = 0.0;
};

/// A spring and a damper, and what they move.
struct Element {
  double stiffness; ///< N/m, >= 0
  double damping;   ///< N s/m, >= 0
  double mobility;  ///< W, 1/kg
};

/// @param step  h, s   @param from, to  shares of the step between which the contact is closed   @param change  of the acceleration, m/s2
/// @return  N, positive along the acceleration
[[nodiscard]] LinearInTime answer_of(const Element& element, double step, double from, double to,
                                     const LinearInTime& change);

} // namespace fretwork::transient
