// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A slide that begins when a contact closes and that its damper ends while the normal force still grows from nothing.
///
/// A contact that touches at the tangential speed u slides at once, for nothing presses it yet. With F_N = N t (N = K_N times the speed of
/// approach) and the friction mu_d F_N against it, on a mass 1/W,
///     v = u - W mu_d N t^2/2,
/// until its damper bears all of the friction, C_T v = mu_d N t. With b = mu_d N/C_T and r = C_T W this is at
///     t = 2 u/(b + sqrt(b^2 + 2 b r u)),
/// before which the path, the pressed path and the slider's work are
///     t (u - r b t^2/6),    int F_N v dt = N t^2 (u/2 - r b t^2/8),    mu_d (int F_N v dt - N b t^3/3).
/// The spring is slower and left out (K_T t << C_T), as is the turn of F_N towards its crest. An impact that is almost normal ends its slide
/// in a small part of a step: told by steps alone, slides of tangential speeds below a tenth of the normal one were missed by 30 to 100 % at
/// w_c h = 0.8, and work rates of tubes that bounce to and fro were 2 to 6 % low (doc/benchmarks.md).
#pragma once
#include <cmath>

namespace fretwork::contact {

struct BegunSlide {
  /// @param speed  u, > 0   @param growth  N, N/s, > 0   @param friction  mu_d, > 0   @param damping  C_T, N s/m, > 0
  /// @param mobility  W along the slide, 1/kg
  BegunSlide(double speed, double growth, double friction, double damping, double mobility) {
    const double b = friction * growth / damping, r = damping * mobility;
    time = 2.0 * speed / (b + std::sqrt(b * (b + 2.0 * r * speed)));
    const double time2 = time * time;
    path = time * (speed - r * b * time2 / 6.0);
    pressed_path = growth * time2 * (0.5 * speed - 0.125 * r * b * time2);
    slider_work = friction * (pressed_path - growth * b * time2 * time / 3.0);
  }

  double time;         ///< s, from the touch to the end
  double path;         ///< m
  double pressed_path; ///< J, integral of F_N |v|
  double slider_work;  ///< J
};

} // namespace fretwork::contact
