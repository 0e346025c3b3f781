// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A slide that ends inside a step whose friction force is one for the whole step.
///
/// Under a friction mu_d F_N against its slip and all other forces a contact loses the velocity d over a step h, v = u - d t/h. Its spring
/// and damper bear T - C_T v: it sticks once this is within mu_d F_N, where r = v - T/C_T has come down to R = mu_d F_N/C_T. One that slides
/// when the step begins, |r| > R, so slides over the share y of it, the first root of |r| = R, if that is below 1:
///     path = int |v| dt,   of which the slider takes int (|r| - R) dt and the damper, stretched with the speed R + T/C_T, the rest,
/// both by Simpson's rule, exact on a line.
/// A step that slides as a whole or sticks as a whole puts the end of a slide to the nearest action: on a line, with u anywhere in
/// (R, R + d), its paths are h d/24 too short in the mean. Where dampers bring contacts to rest in a few steps, impacts of few steps above
/// all, work rates were 0.5 to 2 % low at w_c h = 0.7 (doc/benchmarks.md).
#pragma once
#include "contact/vec2.hpp"

namespace fretwork::contact {

struct EndedSlide {
  /// @param speed  u   @param held  T/C_T   @param spread  R >= 0   @param loss  d, m/s   @param step  h, s
  EndedSlide(Vec2 speed, Vec2 held, double spread, Vec2 loss, double step) {
    const Vec2 excess = speed - held;
    const double a = dot(loss, loss), b = dot(excess, loss), c = dot(excess, excess) - spread * spread,
                 square = b * b - a * c;
    if (!(c > 0.0 && b > 0.0 && square > 0.0))
      return;
    const double share = c / (b + std::sqrt(square));
    if (!(share < 1.0))
      return;
    ends = true;
    const Vec2 half = (0.5 * share) * loss;
    const double sixth = step * share / 6.0;
    path = sixth * (norm(speed) + 4.0 * norm(speed - half) + norm(speed - 2.0 * half));
    slider = sixth * (norm(excess) + 4.0 * norm(excess - half) - 5.0 * spread);
  }

  bool ends = false;   ///< in this step
  double path = 0.0;   ///< m, while the friction is at its bound
  double slider = 0.0; ///< m
};

} // namespace fretwork::contact
