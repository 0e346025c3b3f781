// SPDX-License-Identifier: GPL-3.0-or-later
// Sides of a tube at which flat faces meet it.
#include "contact/sides.hpp"
#include "contact/support_shapes.hpp"
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace fretwork::contact::sides_test {
namespace {

using Sides = std::vector<std::size_t>;

/// The name of the side of a contact point at an angle.
std::string side_at(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return side_names[side_of({-std::cos(angle), -std::sin(angle)})];
}

} // namespace

TEST(Sides, AreOppositeToTheNormal) {
  for (const double off : {-40.0, 0.0, 40.0}) {
    EXPECT_EQ(side_at(off), "+y");
    EXPECT_EQ(side_at(90.0 + off), "+z");
    EXPECT_EQ(side_at(180.0 + off), "-y");
    EXPECT_EQ(side_at(270.0 + off), "-z");
  }
}

TEST(Sides, AreThoseOfPlanesAndEggCrates) {
  EXPECT_EQ(flat_sides(PlanePair{1e-4, PlaneAxis::y}), (Sides{0, 2}));
  EXPECT_EQ(flat_sides(PlanePair{0.0, PlaneAxis::z}), (Sides{1, 3}));
  EXPECT_EQ(flat_sides(egg_crate(9e-3, 9.2e-3, 9.5e-3)), (Sides{0, 1, 2, 3}));
}

TEST(Sides, AreNotThoseOfRoundObstaclesAndOfOneFace) {
  EXPECT_TRUE(flat_sides(Circle{1e-4}).empty());
  EXPECT_TRUE(flat_sides(Stop{1e-4, PlaneAxis::y}).empty());
  EXPECT_TRUE(flat_sides(FacingPlanes{1e-3, PlaneAxis::y, 1.0}).empty());
  const double turn = std::numbers::pi / 2.0; // a square on its corner, and three facets
  EXPECT_TRUE(
      flat_sides(Profile(std::vector<PolarPoint>{{0.0, 1.0}, {turn, 1.0}, {2 * turn, 1.0}, {3 * turn, 1.0}}))
          .empty());
  EXPECT_TRUE(
      flat_sides(Profile(std::vector<PolarPoint>{{0.0, 1.0}, {1.5 * turn, 1.0}, {2.5 * turn, 1.0}})).empty());
}

} // namespace fretwork::contact::sides_test
