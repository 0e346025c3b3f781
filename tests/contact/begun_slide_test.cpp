// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/begun_slide.hpp"
#include <gtest/gtest.h>

namespace fretwork::contact {
namespace {

struct Slide {
  double time = 0.0, path = 0.0, pressed_path = 0.0, slider_work = 0.0;
};

/// The same by small steps of a mass under mu N t until its damper bears all of it.
Slide by_steps(double speed, double growth, double friction, double damping, double mobility) {
  const double step = BegunSlide(speed, growth, friction, damping, mobility).time / 4e4;
  Slide out;
  double v = speed;
  for (int i = 0;; ++i) {
    const double t = (i + 0.5) * step, force = growth * t;
    const double middle = v - 0.5 * step * mobility * friction * growth * (t - 0.25 * step),
                 slider = middle - friction * force / damping;
    if (!(slider > 0.0))
      return out;
    out.path += step * middle;
    out.pressed_path += step * force * middle;
    out.slider_work += step * friction * force * slider;
    v -= step * mobility * friction * force;
    out.time += step;
  }
}

} // namespace

TEST(BegunSlide, IsThatOfAMassUnderAForceThatGrows) {
  constexpr double growth = 5e7, friction = 0.3, damping = 2e4;
  for (const double mobility : {0.0, 0.1, 3.0})
    for (const double speed : {1e-4, 1e-2, 0.5}) {
      const BegunSlide slide(speed, growth, friction, damping, mobility);
      const Slide seen = by_steps(speed, growth, friction, damping, mobility);
      EXPECT_NEAR(seen.time / slide.time, 1.0, 1e-4);
      EXPECT_NEAR(seen.path / slide.path, 1.0, 1e-4);
      EXPECT_NEAR(seen.pressed_path / slide.pressed_path, 1.0, 1e-4);
      EXPECT_NEAR(seen.slider_work / slide.slider_work, 1.0, 1e-4);
    }
}

} // namespace fretwork::contact
