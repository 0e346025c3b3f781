// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/turning_slip.hpp"
#include <gtest/gtest.h>

namespace turning_slip_test {

using namespace fretwork::contact;

namespace {

Vec2 at_angle(double a) { return {std::cos(a), std::sin(a)}; }
double between(Vec2 a, Vec2 b) { return norm(a - b); }

constexpr double round_off = 1e-13; // near the opposite direction half of the angle has a tangent of 14
const Vec2 towards = at_angle(0.4);

} // namespace

TEST(TurningSlip, FollowsItsDifferentialEquation) {
  constexpr int steps = 4000; // of the midpoint rule
  constexpr double by_step = 1e-6;
  for (const double angle : {-2.9, -1.2, 1e-3, 0.7, 2.5})
    for (const double length : {1e-3, 0.3, 4.0}) {
      const TurningSlip turning(at_angle(0.4 + angle), towards);
      const double h = length / steps;
      const auto slope = [](Vec2 e) { return towards - dot(towards, e) * e; };
      Vec2 e = at_angle(0.4 + angle), sum{};
      for (int i = 0; i < steps; ++i) {
        const Vec2 middle = e + (0.5 * h) * slope(e);
        sum = sum + (1.0 / steps) * middle;
        e = e + h * slope(middle);
      }
      EXPECT_LT(between(turning.after(length), e), by_step) << angle << ", " << length;
      EXPECT_LT(between(turning.mean(length), sum), by_step) << angle << ", " << length;
    }
}

TEST(TurningSlip, GoesOnAsFromWhereItIs) {
  for (const double angle : {-2.0, 0.3, 3.0}) {
    const TurningSlip whole(at_angle(0.4 + angle), towards), rest(whole.after(0.7), towards);
    EXPECT_LT(between(whole.after(2.0), rest.after(1.3)), round_off);
    EXPECT_LT(between(2.0 * whole.mean(2.0), 0.7 * whole.mean(0.7) + 1.3 * rest.mean(1.3)), round_off);
    EXPECT_NEAR(norm(whole.after(2.0)), 1.0, round_off);
  }
}

TEST(TurningSlip, IsAtItsEndFromTheStartOrAfterALongWay) {
  const TurningSlip there(towards, towards), far(at_angle(2.0), towards);
  EXPECT_LT(between(there.after(3.0), towards), round_off);
  EXPECT_LT(between(there.mean(3.0), towards), round_off);
  EXPECT_LT(between(far.after(800.0), towards), round_off);
  EXPECT_LT(between(far.mean(0.0), at_angle(2.0)), round_off); // no way at all
}

} // namespace turning_slip_test
