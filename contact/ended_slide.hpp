// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A slide that ends inside a step whose friction force is one for the whole step.
///
/// Under the friction mu_d F_N a contact loses the speed d over a step h; it sticks from the speed s on at which its spring and damper
/// bear the friction, T - C_T v = mu_d F_N. One that slides with the speed u when the step begins, s < u < s + d, so slides over the share
/// y = (u - s)/d of it:
///     path = h y (s + y d/2), of which the slider takes h d y^2/2 and the damper, stretched at the speed s, the rest.
/// A step that slides as a whole or sticks as a whole puts the end of a slide to the nearest action: with u anywhere in (s, s + d) its
/// paths are h d/24 too short in the mean. Where dampers bring contacts to rest in a few steps, impacts of few steps above all, work
/// rates were 0.5 to 2 % low at w_c h = 0.7 (doc/benchmarks.md).
#pragma once

namespace fretwork::contact {

struct EndedSlide {
  /// @param speed  u   @param hold  s >= 0   @param loss  d, m/s   @param step  h, s
  EndedSlide(double speed, double hold, double loss, double step) {
    if (!(speed > hold && speed < hold + loss))
      return;
    const double share = (speed - hold) / loss;
    ends = true;
    slider = 0.5 * step * loss * share * share;
    path = slider + step * hold * share;
  }

  bool ends = false;   ///< in this step
  double path = 0.0;   ///< m, while the friction is at its bound
  double slider = 0.0; ///< m
};

} // namespace fretwork::contact
