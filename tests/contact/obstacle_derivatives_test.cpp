// SPDX-License-Identifier: GPL-3.0-or-later
// Every obstacle at random places: derivatives of gap and normal, scales, mirrors, places without a direction.
#include "contact/obstacle.hpp"
#include "uniform.hpp"
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace obstacle_derivatives_test {

using namespace fretwork;
using namespace fretwork::contact;

namespace {

constexpr double step = 1e-6;
constexpr double difference_error = 1e-9; // central differences: step^2 times third derivatives, eps/step
constexpr double turn_error = 1e-6;       // the same of the normal, at least 0.02 from where it turns at once
constexpr double round_off = 1e-15;
constexpr double rescaled = 1e-12;        // rounding of scales that are no powers of two
constexpr double rounded_corners = 1e-13; // of sines and cosines of mirrored angles
constexpr double gap = 0.3;

/// A star of eight corners, every second one protruding, symmetric about both axes.
Profile star(double size = 1.0) {
  std::vector<PolarPoint> points;
  for (int k = 0; k < 8; ++k)
    points.push_back({k * std::numbers::pi / 4.0, (k % 2 == 0 ? 1.0 : 0.5) * size});
  return Profile(points);
}

struct Named {
  std::string name;
  Obstacle obstacle;
};

/// Of all kinds and axes, lengths multiplied by `size`.
std::vector<Named> every(double size = 1.0) {
  using enum PlaneAxis;
  const double g = gap * size;
  return {{"circle", Circle{g}},
          {"plane pair y", PlanePair{g, y}},
          {"plane pair z", PlanePair{g, z}},
          {"stop y", Stop{g, y}},
          {"stop z", Stop{g, z}},
          {"round pair", RoundPair{g}},
          {"facing planes +y", FacingPlanes{g, y, 1.0}},
          {"facing planes -y", FacingPlanes{g, y, -1.0}},
          {"facing planes +z", FacingPlanes{g, z, 1.0}},
          {"facing planes -z", FacingPlanes{g, z, -1.0}},
          {"ellipse", Ellipse{1.7 * size, 1.4 * size, 0.8 * size}},
          {"ellipse, higher than wide", Ellipse{1.1 * size, 1.2 * size, 0.9 * size}},
          {"ellipse, pointed for the body", Ellipse{1.8 * size, 1.2 * size, 1.0 * size}},
          {"circle as an ellipse", Ellipse{1.5 * size, 1.5 * size, 1.2 * size}},
          {"trefoil", BroachedSpace(2.0 * size, {2.3 * size, 2.8 * size, 3, 0.35, 0.4})},
          {"quatrefoil", BroachedSpace(2.0 * size, {2.3 * size, 2.5 * size, 4, 0.5, -0.4})},
          {"profile", star(size)}};
}

Vec2 normal(const Obstacle& o, double y, double z) {
  const Location at = locate(o, y, z);
  return {at.ny, at.nz};
}

/// A coordinate away from the axes, on which gaps have ridges.
double off_axis(tests::Uniform& uniform) { return std::copysign(uniform(0.02, 1.5), uniform(-1, 1)); }

/// Whether the gap is smooth within reach of differences: the same piece of it all round.
bool smooth(const Obstacle& o, double y, double z) {
  const Vec2 n = normal(o, y, z);
  const double kappa = curvature(o, y, z);
  if (std::abs(kappa) > 50.0) // within 0.02 of a corner
    return false;
  for (const Vec2 d : {Vec2{0.01, 0.0}, Vec2{-0.01, 0.0}, Vec2{0.0, 0.01}, Vec2{0.0, -0.01}})
    if (norm(normal(o, y + d.x, z + d.t) - n) > 0.7 ||
        (curvature(o, y + d.x, z + d.t) == 0.0) != (kappa == 0.0))
      return false;
  return true;
}

} // namespace

TEST(ObstacleDerivatives, NormalIsTheGradientOfTheGap) {
  tests::Uniform uniform(41);
  for (const auto& [name, o] : every())
    for (int i = 0; i < 500; ++i) {
      const double y = off_axis(uniform), z = off_axis(uniform), h = step;
      if (!smooth(o, y, z))
        continue;
      const Vec2 n = normal(o, y, z);
      EXPECT_NEAR(n.x, (locate(o, y + h, z).gap - locate(o, y - h, z).gap) / (2 * h), difference_error)
          << name;
      EXPECT_NEAR(n.t, (locate(o, y, z + h).gap - locate(o, y, z - h).gap) / (2 * h), difference_error)
          << name;
      EXPECT_NEAR(norm(n), 1.0, round_off) << name;
    }
}

TEST(ObstacleDerivatives, CurvatureTurnsTheNormal) {
  tests::Uniform uniform(42);
  for (const auto& [name, o] : every()) {
    int facets = 0, inside = 0, outside = 0;
    for (int i = 0; i < 2000; ++i) {
      const double y = off_axis(uniform), z = off_axis(uniform), h = step;
      if (!smooth(o, y, z))
        continue;
      const double kappa = curvature(o, y, z);
      (kappa == 0.0 ? facets : kappa > 0.0 ? inside : outside) += 1;
      const Vec2 n = normal(o, y, z), t{n.t, -n.x};
      const Vec2 by_y = (0.5 / h) * (normal(o, y + h, z) - normal(o, y - h, z));
      const Vec2 by_z = (0.5 / h) * (normal(o, y, z + h) - normal(o, y, z - h));
      EXPECT_LT(norm(by_y - (kappa * t.x) * t), turn_error) << name;
      EXPECT_LT(norm(by_z - (kappa * t.t) * t), turn_error) << name;
    }
    if (name == "profile") { // facet, protruding corner, corner of the hole
      EXPECT_GT(facets, 100);
      EXPECT_GT(inside, 20);
      EXPECT_GT(outside, 100);
    }
  }
  EXPECT_EQ(curvature(Circle{gap}, 0.3, 0.4), -2.0);
  EXPECT_EQ(curvature(RoundPair{gap}, 0.3, 0.4), 2.0);
}

TEST(ObstacleDerivatives, CurvatureOfAProfileIsThatOfItsNearestPiece) {
  const Obstacle o = star(); // corner 0 at (1, 0), facets at 45 - atan(...) to it
  EXPECT_DOUBLE_EQ(curvature(o, 1.25, 0.0), -4.0);
  const double c = 0.5 * std::numbers::sqrt2;
  EXPECT_NEAR(curvature(o, 0.3 * c, 0.3 * c), 5.0, 1e-13);
  EXPECT_EQ(curvature(o, 0.75, 0.15), 0.0);
  EXPECT_EQ(curvature(o, 1.0, 0.0), 0.0); // on the corner itself
}

TEST(ObstacleDerivatives, PlacesWithoutADirectionGiveFiniteResults) {
  for (const auto& [name, o] : every())
    for (const double y : {0.0, -0.0, 5e-324, 1e-200})
      for (const double z : {0.0, -0.0, -5e-324, 1e-170}) {
        const Location at = locate(o, y, z);
        EXPECT_TRUE(std::isfinite(at.gap)) << name;
        EXPECT_NEAR(at.ny * at.ny + at.nz * at.nz, 1.0, round_off) << name << ' ' << y << ' ' << z;
        EXPECT_TRUE(std::isfinite(curvature(o, y, z)) || y * y + z * z > 0.0) << name;
      }
  EXPECT_EQ(curvature(Circle{gap}, 0.0, 0.0), 0.0);
  EXPECT_EQ(curvature(RoundPair{gap}, 0.0, 0.0), 0.0);
}

TEST(ObstacleDerivatives, GivesTheSameBytesForLengthsScaledByPowersOfTwo) {
  tests::Uniform uniform(43);
  for (const double size : {0x1p-13, 0x1p10}) {
    const auto plain = every(), scaled = every(size);
    for (std::size_t k = 0; k < plain.size(); ++k)
      for (int i = 0; i < 1000; ++i) {
        const double y = uniform(-1.5, 1.5), z = uniform(-1.5, 1.5);
        const Location a = locate(plain[k].obstacle, y, z),
                       b = locate(scaled[k].obstacle, size * y, size * z);
        EXPECT_EQ(size * a.gap, b.gap) << plain[k].name;
        EXPECT_EQ(a.ny, b.ny) << plain[k].name;
        EXPECT_EQ(a.nz, b.nz) << plain[k].name;
        EXPECT_EQ(curvature(plain[k].obstacle, y, z),
                  size * curvature(scaled[k].obstacle, size * y, size * z));
      }
  }
}

TEST(ObstacleDerivatives, HidesNoUnit) {
  tests::Uniform uniform(44);
  const double size = 1e-3 / 3.0; // metres to something else
  const auto plain = every(), scaled = every(size);
  for (std::size_t k = 0; k < plain.size(); ++k)
    for (int i = 0; i < 1000; ++i) {
      const double y = off_axis(uniform), z = off_axis(uniform);
      if (!smooth(plain[k].obstacle, y, z))
        continue;
      const Location a = locate(plain[k].obstacle, y, z), b = locate(scaled[k].obstacle, size * y, size * z);
      EXPECT_NEAR(a.gap, b.gap / size, rescaled) << plain[k].name;
      EXPECT_NEAR(a.ny, b.ny, rescaled) << plain[k].name;
      EXPECT_NEAR(a.nz, b.nz, rescaled) << plain[k].name;
    }
}

TEST(ObstacleDerivatives, MirrorsWithItsObstacle) {
  tests::Uniform uniform(45);
  const auto obstacles = every();
  const auto mirrored = [](Obstacle o, PlaneAxis axis) { // one-sided bodies change sides
    if (auto* planes = std::get_if<FacingPlanes>(&o); planes && planes->axis == axis)
      planes->side = -planes->side;
    if (const auto* space = std::get_if<BroachedSpace>(&o)) {
      BroachedHole hole = space->hole();
      hole.orientation = (axis == PlaneAxis::y ? std::numbers::pi : 0.0) - hole.orientation;
      return Obstacle(BroachedSpace(space->tube_radius(), hole));
    }
    return o;
  };
  for (const auto& [name, o] : obstacles)
    for (int i = 0; i < 500; ++i) {
      const double y = off_axis(uniform), z = off_axis(uniform);
      if (!smooth(o, y, z))
        continue;
      const Location at = locate(o, y, z);
      const auto* stop = std::get_if<Stop>(&o); // has no other side
      if (!stop || stop->axis == PlaneAxis::z) {
        const Location image = locate(mirrored(o, PlaneAxis::y), -y, z);
        EXPECT_NEAR(image.gap, at.gap, rounded_corners) << name;
        EXPECT_NEAR(image.ny, -at.ny, rounded_corners) << name;
        EXPECT_NEAR(image.nz, at.nz, rounded_corners) << name;
      }
      if (!stop || stop->axis == PlaneAxis::y) {
        const Location image = locate(mirrored(o, PlaneAxis::z), y, -z);
        EXPECT_NEAR(image.gap, at.gap, rounded_corners) << name;
        EXPECT_NEAR(image.ny, at.ny, rounded_corners) << name;
        EXPECT_NEAR(image.nz, -at.nz, rounded_corners) << name;
      }
    }
}

TEST(TwoNodes, RoundBodiesPushEachOtherApart) {
  const RoundPair pair{0.5};
  EXPECT_EQ(locate(pair, 0.6, 0.8).gap, 0.5);
  EXPECT_EQ(locate(pair, 0.0, -0.3).gap, -0.2);
  EXPECT_EQ(locate(pair, 0.0, -0.3).nz, -1.0); // the first is pushed on, away from the second
}

TEST(TwoNodes, FlatBodiesKeepTheirSidesEvenWhereTheyHavePassed) {
  const FacingPlanes right{0.2, PlaneAxis::y, 1.0}, below{0.2, PlaneAxis::z, -1.0};
  EXPECT_DOUBLE_EQ(locate(right, 0.5, 9.0).gap, 0.3);
  EXPECT_DOUBLE_EQ(locate(right, 0.1, 9.0).gap, -0.1);
  const Location passed = locate(right, -0.4, 9.0);
  EXPECT_DOUBLE_EQ(passed.gap, -0.6);
  EXPECT_EQ(passed.ny, 1.0); // pushed back to its side
  EXPECT_DOUBLE_EQ(locate(below, 9.0, -0.5).gap, 0.3);
  EXPECT_EQ(locate(below, 9.0, 0.5).nz, -1.0);
}

TEST(TwoNodes, BoundIsBelowTheGap) {
  tests::Uniform uniform(46);
  for (const auto& [name, o] : every()) {
    const GapBound r = properties_of(o).gap_bound;
    double least = 1.0;
    for (int i = 0; i < 1000; ++i) {
      const double y = uniform(-1, 1), z = uniform(-1, 1);
      const double bound =
          r.limit - (r.radial * std::sqrt(r.wy * y * y + r.wz * z * z) + r.ly * y + r.lz * z);
      const double above = locate(o, y, z).gap - bound;
      EXPECT_GE(above, -2.0 * round_off) << name;
      least = std::min(least, above);
    }
    EXPECT_LT(least, 0.01) << name; // and is met
  }
}

} // namespace obstacle_derivatives_test
