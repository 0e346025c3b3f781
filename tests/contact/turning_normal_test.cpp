// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/obstacle.hpp"
#include "contact/turning_normal.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace turning_normal_test {

using namespace fretwork::contact;

namespace {

constexpr double gap = 1e-3, orbit = 0.8e-3, rate = 300.0; // m, m, rad/s
constexpr PlanePoint centre{0.15e-3, -0.25e-3};            // m, of the orbit, from that of the hole

/// The n-th derivative of an orbit in a hole, at a time.
PlanePoint derivative(int n, double time) {
  const double angle = 0.7 + rate * time + 0.5 * n * std::acos(-1.0), size = orbit * std::pow(rate, n);
  return {size * std::cos(angle) + (n == 0 ? centre.y : 0.0),
          size * std::sin(angle) + (n == 0 ? centre.z : 0.0)};
}

struct Errors {
  double penetration, rate;
};

/// Of the kinematics over an interval, from the Taylor series of the orbit about its middle, up to dt^3, at its start.
Errors errors(double dt) {
  const auto series = [](double from_position, double from_velocity, double from_acceleration,
                         double from_jerk) {
    const PlanePoint u = derivative(0, 0.0), v = derivative(1, 0.0), a = derivative(2, 0.0),
                     j = derivative(3, 0.0);
    return PlanePoint{from_position * u.y + from_velocity * v.y + from_acceleration * a.y + from_jerk * j.y,
                      from_position * u.z + from_velocity * v.z + from_acceleration * a.z + from_jerk * j.z};
  };
  const Obstacle hole = Circle{gap};
  const PlanePoint mean = series(1.0, 0.0, dt * dt / 24.0, 0.0);
  const Location at = locate(hole, mean.y, mean.z);
  const auto along = [axes = at.axes()](PlanePoint p) {
    return AlongAxes{axes.normal(p.y, p.z), axes.tangent(p.y, p.z)};
  };
  const NormalKinematics p =
      normal_kinematics(dt, at.gap, curvature(hole, mean.y, mean.z),
                        {along(series(0.0, 1.0, -0.5 * dt, dt * dt / 8.0)), along(series(0.0, 1.0, 0.0, 0.0)),
                         along(series(0.0, 0.0, 1.0, 0.0)), along(series(0.0, 0.0, 0.0, dt))});
  const PlanePoint u = derivative(0, -0.5 * dt), v = derivative(1, -0.5 * dt);
  const Location start = locate(hole, u.y, u.z);
  return {std::abs(p.penetration + start.gap), std::abs(p.rate + start.axes().normal(v.y, v.z))};
}

} // namespace

// On an orbit beside the centre of a hole.
TEST(NormalKinematics, HaveThePenetrationToOrderFourAndItsRateToOrderThree) {
  for (const double dt : {0.2 / rate, 0.1 / rate, 0.05 / rate}) {
    const Errors coarse = errors(dt), fine = errors(0.5 * dt);
    EXPECT_NEAR(std::log2(coarse.penetration / fine.penetration), 4.0, 0.3) << rate * dt;
    EXPECT_NEAR(std::log2(coarse.rate / fine.rate), 3.0, 0.3) << rate * dt;
  }
  EXPECT_LT(errors(0.1 / rate).penetration, 1e-5 * gap);
  EXPECT_LT(errors(0.1 / rate).rate, 1e-3 * orbit * rate);
}

TEST(NormalKinematics, OfAPlaneAreThoseOfTheCubic) {
  constexpr double dt = 1e-3, p0 = 2e-5, v0 = -0.3, a = 40.0, j = 7e4;
  const double mean = p0 + dt * (0.5 * v0 + dt * (a / 6.0 + dt * j / 24.0));
  const NormalKinematics p = normal_kinematics(
      dt, -mean, 0.0,
      {{-v0, 1.0}, {-v0 - 0.5 * dt * (a + 0.25 * dt * j), 1.0}, {-a - 0.5 * dt * j, 2.0}, {-dt * j, 3.0}});
  EXPECT_FALSE(p.turn.turns);
  EXPECT_NEAR(p.penetration, p0, 1e-12 * p0);
  EXPECT_EQ(p.rate, v0);
  EXPECT_DOUBLE_EQ(p.acceleration, a + 0.5 * dt * j);
  EXPECT_EQ(p.jerk_by_turning, 0.0);
}

// Near the centre of a hole the curvature has no bound: the normal turns by no more than most_turned.
TEST(NormalKinematics, TurnByABoundedAngle) {
  constexpr double dt = 1e-3;
  const NormalKinematics p = normal_kinematics(dt, gap, -1e12, {{0.0, 2.0}, {0.0, 2.0}, {}, {}});
  EXPECT_NEAR(p.turn.omega * dt, -most_turned, 1e-12);
}

} // namespace turning_normal_test
