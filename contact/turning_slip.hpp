// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A force of friction at its bound that turns while the contact slips, in closed form.
///
/// The direction e of the force turns towards g, against the motion, as in perfect plasticity: e' = g - (g . e) e over the length a, the
/// integral of K_T |v|/|P| (friction_interval.hpp). The angle between both falls with tan(angle/2) = tan(angle_0/2) e^-a.
#pragma once
#include "contact/plane.hpp"
#include <cassert>
#include <cmath>

namespace fretwork::contact {

class TurningSlip {
public:
  /// @param direction, towards  e at the start and g, of length 1, not opposite to each other
  TurningSlip(Vec2 direction, Vec2 towards)
      : towards_(towards), across_{-towards.t, towards.x},
        tangent_(dot(direction, across_) / (1.0 + dot(direction, towards))) {
    assert(dot(direction, towards) > -1.0);
  }
  [[nodiscard]] Vec2 after(double a) const {
    const double t = tangent_ * std::exp(-a);
    return (1.0 / (1.0 + t * t)) * ((1.0 - t * t) * towards_ + 2.0 * t * across_);
  }
  /// Of e over the length a; shorter than 1 where it turns.
  [[nodiscard]] Vec2 mean(double a) const {
    if (!(a > 0.0))
      return after(0.0);
    const double fall = tangent_ * std::expm1(-a), end = tangent_ + fall,
                 turned = 2.0 * std::atan(-fall / (1.0 + tangent_ * end)),
                 along = 1.0 + std::log1p(fall * (end + tangent_) / (1.0 + tangent_ * tangent_)) / a;
    return along * towards_ + (turned / a) * across_;
  }

private:
  Vec2 towards_, across_;
  double tangent_; ///< of half of the angle
};

} // namespace fretwork::contact
