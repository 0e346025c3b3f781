// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/ended_slide.hpp"
#include <gtest/gtest.h>

namespace fretwork::contact {
namespace {

constexpr double h = 2e-3;

/// Path of a contact until its spring and damper bear the friction, m, and of its slider.
EndedSlide integrated(Vec2 speed, Vec2 held, double spread, Vec2 loss) {
  constexpr int parts = 200000;
  EndedSlide out({}, {}, 0.0, {}, h);
  for (int i = 0; i < parts; ++i) {
    const Vec2 v = speed - ((i + 0.5) / parts) * loss;
    if (norm(v - held) < spread)
      break;
    out.path += h / parts * norm(v);
    out.slider += h / parts * (norm(v - held) - spread);
  }
  return out;
}

} // namespace

TEST(EndedSlide, IsThePathUpToTheSpeedThatTheDamperHolds) {
  constexpr Vec2 held{0.0, -0.02}, loss{0.0, 0.3};
  constexpr double spread = 0.07;
  for (const double speed : {0.06, 0.1, 0.2, 0.34})
    for (const double sign : {1.0, -1.0}) {
      const EndedSlide slide({0.0, sign * speed}, sign * held, spread, sign * loss, h),
          fine = integrated({0.0, sign * speed}, sign * held, spread, sign * loss);
      EXPECT_TRUE(slide.ends);
      EXPECT_NEAR(slide.path, fine.path, 1e-9) << speed;
      EXPECT_NEAR(slide.slider, fine.slider, 1e-9) << speed;
    }
}

TEST(EndedSlide, FollowsVelocitiesThatTurn) {
  constexpr Vec2 held{0.01, -0.02}, loss{0.1, 0.28};
  constexpr double spread = 0.07;
  for (const Vec2 speed : {Vec2{0.12, 0.1}, Vec2{0.03, 0.2}, Vec2{0.05, 0.25}}) {
    const EndedSlide slide(speed, held, spread, loss, h), fine = integrated(speed, held, spread, loss);
    EXPECT_TRUE(slide.ends);
    EXPECT_NEAR(slide.path / fine.path, 1.0, 5e-3);
    EXPECT_NEAR(slide.slider / fine.slider, 1.0, 2e-2);
  }
  EXPECT_FALSE(EndedSlide({0.15, 0.1}, held, spread, {0.0, 0.28}, h).ends); // it slides on to the side
}

TEST(EndedSlide, IsNoneWhereTheContactGoesOnOrSticksFromTheStart) {
  constexpr double hold = 0.05, loss = 0.3;
  for (const double speed : {0.0, hold, 1.001 * (hold + loss), 1.0}) {
    const EndedSlide slide({0.0, speed}, {}, hold, {0.0, loss}, h);
    EXPECT_FALSE(slide.ends);
    EXPECT_EQ(slide.path, 0.0);
  }
  EXPECT_FALSE(
      EndedSlide({0.0, 0.1}, {}, 0.0, {0.0, -1.0}, h).ends); // the flow gives more than friction takes
}

// Steps that slide as a whole where the mean speed is above the damper's, and else not at all: h d/24 less, whatever the damper.
TEST(EndedSlide, AddsWhatWholeStepsMissInTheMean) {
  constexpr int phases = 20000;
  constexpr double loss = 0.3;
  for (const double hold : {0.01, 0.05, loss}) {
    double missed = 0.0;
    for (int i = 0; i < phases; ++i) {
      const double speed = hold + (i + 0.5) / phases * loss, mean = speed - 0.5 * loss;
      const EndedSlide slide({0.0, speed}, {}, hold, {0.0, loss}, h);
      missed += (slide.path - (mean > hold ? h * mean : 0.0)) / phases;
    }
    EXPECT_NEAR(missed, h * loss / 24.0, 1e-3 * h * loss) << hold;
  }
}

} // namespace fretwork::contact
