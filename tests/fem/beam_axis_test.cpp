// SPDX-License-Identifier: GPL-3.0-or-later
#include "expect_error.hpp"
#include "fem/beam_axis.hpp"
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace beam_axis_test {

using namespace fretwork;
using fem::BeamAxis;
using fem::Vec3;
using fretwork::tests::expect_error;
using std::numbers::pi;

namespace {

constexpr double round_off = 1e-13; // of sines and a square root, relative to the radius

/// A circle in an oblique plane.
const Vec3 centre(0.3, -0.2, 0.5), u = Vec3(1.0, 2.0, -0.5).normalized(),
                                   v = u.cross(Vec3(0.2, 0.3, 1.0)).normalized();
constexpr double radius = 0.7;

Vec3 on_circle(double t) { return centre + radius * (std::cos(t) * u + std::sin(t) * v); }
Vec3 along_circle(double t) { return -std::sin(t) * u + std::cos(t) * v; }

} // namespace

TEST(BeamAxis, FollowsTheCircleThroughThreePoints) {
  for (const double angle : {0.1, 1.0, pi / 2, pi, 4.5})
    for (const double share : {0.5, 0.1, 0.8}) { // the middle need not be half way
      const BeamAxis axis(on_circle(0.4), on_circle(0.4 + angle), on_circle(0.4 + share * angle));
      EXPECT_NEAR(axis.angle(), angle, 10 * round_off) << share;
      EXPECT_NEAR(axis.length(), radius * angle, 10 * round_off) << share;
      for (const double s : {0.0, 0.3, 1.0}) {
        const double t = 0.4 + s * angle;
        EXPECT_LT((axis.point(s * axis.length()) - on_circle(t)).norm(), 10 * round_off) << angle << " " << s;
        EXPECT_LT((axis.tangent(s * axis.length()) - along_circle(t)).norm(), 10 * round_off);
      }
    }
}

TEST(BeamAxis, KeepsTheDigitsOfFlatArcs) {
  const Vec3 a = Vec3::Zero(), b = Vec3::UnitX();
  for (const double angle : {1e-2, 1e-4, 1e-6}) {
    const double sagitta = 0.5 * std::tan(angle / 4);
    const BeamAxis axis(a, b, Vec3(0.5, sagitta, 0.0));
    EXPECT_NEAR(axis.angle() / angle, 1.0, round_off);
    EXPECT_NEAR(axis.point(0.5 * axis.length()).y() / sagitta, 1.0, 1e-10); // half the turn, from the ends
    EXPECT_LT((axis.point(axis.length()) - b).norm(), round_off);
  }
}

TEST(BeamAxis, IsStraightWithoutMiddleAndWithOneOnTheChord) {
  const Vec3 a(0.1, 0.2, 0.3), b(1.1, -0.2, 0.5);
  for (const std::optional<Vec3>& middle :
       {std::optional<Vec3>(), std::optional<Vec3>(0.5 * (a + b)), std::optional<Vec3>(a + 0.3 * (b - a))}) {
    const BeamAxis axis(a, b, middle);
    EXPECT_TRUE(axis.is_straight());
    EXPECT_NEAR(axis.length(), (b - a).norm(), round_off);
    EXPECT_LT((axis.point(0.25 * axis.length()) - (a + 0.25 * (b - a))).norm(), round_off);
    EXPECT_LT((axis.tangent(0.0) - (b - a).normalized()).norm(), round_off);
  }
}

TEST(BeamAxis, RefusesAMiddleThatIsNotBetweenTheEnds) {
  const Vec3 a = Vec3::Zero(), b = Vec3::UnitX();
  for (const Vec3& middle : {Vec3(1.5, 0, 0), Vec3(-2, 0, 0), a, b})
    expect_error([&] { (void)BeamAxis(a, b, middle); },
                 {"beam from (0, 0, 0) to (1, 0, 0)", "not between its ends", "on the arc"});
}

} // namespace beam_axis_test
