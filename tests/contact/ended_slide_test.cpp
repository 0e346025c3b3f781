// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/ended_slide.hpp"
#include <gtest/gtest.h>

namespace fretwork::contact {
namespace {

constexpr double h = 2e-3, loss = 0.3, hold = 0.05;

/// Path of a contact until it has slowed down to `hold`, m, and of its slider, whose spring and damper stretch at that speed.
EndedSlide integrated(double speed) {
  constexpr int parts = 200000;
  EndedSlide out(0.0, 0.0, 0.0, h);
  for (int i = 0; i < parts; ++i) {
    const double v = speed - (i + 0.5) / parts * loss;
    if (v < hold)
      break;
    out.path += h / parts * v;
    out.slider += h / parts * (v - hold);
  }
  return out;
}

} // namespace

TEST(EndedSlide, IsThePathUpToTheSpeedThatTheDamperHolds) {
  for (const double speed : {0.06, 0.1, 0.2, 0.34}) {
    const EndedSlide slide(speed, hold, loss, h), fine = integrated(speed);
    EXPECT_TRUE(slide.ends);
    EXPECT_NEAR(slide.path, fine.path, 1e-9) << speed;
    EXPECT_NEAR(slide.slider, fine.slider, 1e-9) << speed;
  }
}

TEST(EndedSlide, IsNoneWhereTheContactGoesOnOrSticksFromTheStart) {
  for (const double speed : {0.0, hold, hold + loss, 1.0}) {
    const EndedSlide slide(speed, hold, loss, h);
    EXPECT_FALSE(slide.ends);
    EXPECT_EQ(slide.path, 0.0);
  }
  EXPECT_FALSE(EndedSlide(0.1, 0.0, -1.0, h).ends); // the flow gives more than friction takes
}

// Steps that slide as a whole where the mean speed is above the damper's, and else not at all: h d/24 less, whatever the damper.
TEST(EndedSlide, AddsWhatWholeStepsMissInTheMean) {
  constexpr int phases = 20000;
  for (const double held : {0.0, hold, loss}) {
    double missed = 0.0;
    for (int i = 0; i < phases; ++i) {
      const double speed = held + (i + 0.5) / phases * loss, mean = speed - 0.5 * loss;
      missed += (EndedSlide(speed, held, loss, h).path - (mean > held ? h * mean : 0.0)) / phases;
    }
    EXPECT_NEAR(missed, h * loss / 24.0, 1e-3 * h * loss) << held;
  }
}

} // namespace fretwork::contact
