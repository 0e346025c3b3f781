// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/obstacle.hpp"
#include "uniform.hpp"
#include <gtest/gtest.h>

namespace obstacle_test {

using namespace fretwork;
using contact::Circle;
using contact::locate;
using contact::Obstacle;
using contact::PlaneAxis;
using contact::PlanePair;
using contact::Stop;

namespace {

constexpr double gap = 0.3;
constexpr double round_off = 1e-15;

const Obstacle all[] = {Circle{gap}, PlanePair{gap, PlaneAxis::y}, PlanePair{gap, PlaneAxis::z},
                        Stop{gap, PlaneAxis::y}, Stop{gap, PlaneAxis::z}};

} // namespace

TEST(Obstacle, GapIsPositiveInsideAndNegativeBeyond) {
  for (const Obstacle& obstacle : all) {
    EXPECT_NEAR(locate(obstacle, 0.0, 0.0).gap, gap, round_off);
    EXPECT_NEAR(locate(obstacle, 0.2, 0.2).gap, obstacle.index() == 0 ? gap - std::sqrt(0.08) : gap - 0.2,
                round_off);
    EXPECT_LT(locate(obstacle, 0.5, 0.5).gap, 0.0);
  }
}

TEST(Obstacle, PlanesActOnBothSidesAndStopsOnOne) {
  EXPECT_NEAR(locate(PlanePair{gap, PlaneAxis::y}, -0.5, 9.0).gap, gap - 0.5, round_off);
  EXPECT_NEAR(locate(PlanePair{gap, PlaneAxis::z}, 9.0, -0.5).gap, gap - 0.5, round_off);
  EXPECT_NEAR(locate(Stop{gap, PlaneAxis::y}, -0.5, 9.0).gap, gap + 0.5, round_off);
  EXPECT_NEAR(locate(Stop{gap, PlaneAxis::z}, 9.0, -0.5).gap, gap + 0.5, round_off);
}

TEST(Obstacle, NormalIsAUnitVectorAtTheVeryCentre) {
  for (const Obstacle& obstacle : all) {
    const auto at = locate(obstacle, 0.0, 0.0);
    EXPECT_EQ(at.ny * at.ny + at.nz * at.nz, 1.0);
  }
}

TEST(Obstacle, BoundIsBelowTheGapAndItsRate) {
  tests::Uniform uniform(5);
  for (const Obstacle& obstacle : all) {
    const contact::GapBound bound = contact::properties_of(obstacle).gap_bound;
    for (int i = 0; i < 1000; ++i) {
      const double y = uniform(-1, 1), z = uniform(-1, 1), vy = uniform(-1, 1), vz = uniform(-1, 1);
      const auto at = locate(obstacle, y, z);
      EXPECT_GE(at.gap, bound.limit - std::sqrt(bound.wy * y * y + bound.wz * z * z) - round_off);
      EXPECT_GE(at.ny * vy + at.nz * vz, -std::sqrt(bound.wy * vy * vy + bound.wz * vz * vz) - round_off);
    }
    // the bound is sharp where the obstacle is approached head on
    EXPECT_NEAR(locate(obstacle, 0.4 * bound.wy, 0.4 * bound.wz * (1 - bound.wy)).gap, bound.limit - 0.4,
                round_off);
  }
}

TEST(Obstacle, NormalTakesEveryDirectionOfACircleAndOneOfAPlane) {
  using Directions = std::array<bool, 2>;
  EXPECT_EQ(contact::normal_directions(all[0]), (Directions{true, true}));
  EXPECT_EQ(contact::normal_directions(all[1]), (Directions{true, false}));
  EXPECT_EQ(contact::normal_directions(all[2]), (Directions{false, true}));
  EXPECT_EQ(contact::normal_directions(all[3]), (Directions{true, false}));
  EXPECT_EQ(contact::normal_directions(all[4]), (Directions{false, true}));
}

TEST(Obstacle, HasOppositeSidesWhereFreeSpaceLiesBetweenWalls) {
  for (const Obstacle& obstacle : all)
    EXPECT_EQ(contact::properties_of(obstacle).has_opposite_sides, !std::holds_alternative<Stop>(obstacle));
  EXPECT_TRUE(contact::properties_of(contact::Ellipse{1.0 + gap, 1.0 + 1.1 * gap, 1.0}).has_opposite_sides);
  EXPECT_FALSE(contact::properties_of(contact::RoundPair{gap}).has_opposite_sides);
  EXPECT_FALSE(contact::properties_of(contact::FacingPlanes{gap, PlaneAxis::y, 1.0}).has_opposite_sides);
}

TEST(Obstacle, IsRolledRoundByANodeWhosePathMissesTheFreeSpace) {
  constexpr double dt = 0.1, fast = 1.1 * gap / dt, slow = 0.9 * gap / dt;
  for (const Obstacle& hole : {Obstacle(Circle{gap}), Obstacle(contact::Ellipse{1.0 + gap, 1.0 + gap, 1.0})})
    for (const contact::PlanePoint& along : {contact::PlanePoint{0.6, 0.8}, {0.0, -1.0}}) {
      const auto rolls = [&](double past_centre, double speed) {
        return contact::rolls_round(hole, {along.z * past_centre, -along.y * past_centre},
                                    {along.y * speed, along.z * speed}, dt);
      };
      EXPECT_TRUE(rolls(1.01 * gap, fast));
      EXPECT_TRUE(rolls(-1.01 * gap, fast));
      EXPECT_FALSE(rolls(0.99 * gap, fast)) << "crosses the free space";
      EXPECT_FALSE(rolls(1.01 * gap, slow)) << "the interval resolves the clearance";
    }
  const contact::Ellipse oval{1.0 + gap, 1.0 + 1.1 * gap, 1.0};
  EXPECT_TRUE(contact::rolls_round(oval, {1.05 * gap, 0.0}, {0.0, 1.2 * fast}, dt));
  EXPECT_FALSE(contact::rolls_round(oval, {0.0, 1.05 * gap}, {1.2 * fast, 0.0}, dt));
  for (const Obstacle& flat : {Obstacle(PlanePair{gap, PlaneAxis::y}), Obstacle(Stop{gap, PlaneAxis::y})})
    EXPECT_FALSE(contact::rolls_round(flat, {1.01 * gap, 0.0}, {0.0, fast}, dt));
}

} // namespace obstacle_test
