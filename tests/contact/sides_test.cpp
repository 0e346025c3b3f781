// SPDX-License-Identifier: GPL-3.0-or-later
// Sides of a tube at which flat faces or lands meet it.
#include "contact/sides.hpp"
#include "contact/support_shapes.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace fretwork::contact::sides_test {
namespace {

using Names = std::vector<std::string>;

Names names_of(const Obstacle& obstacle) {
  Names out;
  for (const Side& side : sides_of(obstacle)) {
    EXPECT_EQ(side_number(side.name), side.number);
    out.push_back(side.name);
  }
  return out;
}

/// The name of the side of a contact point at an angle.
std::string side_at(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return flat_side_names[flat_side_of({-std::cos(angle), -std::sin(angle)})];
}

/// Regular, the first corner at y_loc.
Profile polygon(int corners) {
  std::vector<PolarPoint> points;
  for (int k = 0; k < corners; ++k)
    points.push_back({2.0 * std::numbers::pi * k / corners, 1.0});
  return Profile(points);
}

BroachedSpace broached(int lands, double first) {
  return {9e-3, {9.2e-3, 9.3e-3, lands, 0.3, first * std::numbers::pi / 180.0}};
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

TEST(Sides, AreThoseOfPlanesStopsAndEggCrates) {
  EXPECT_EQ(names_of(PlanePair{1e-4, PlaneAxis::y}), (Names{"+y", "-y"}));
  EXPECT_EQ(names_of(PlanePair{0.0, PlaneAxis::z}), (Names{"+z", "-z"}));
  EXPECT_EQ(names_of(Stop{1e-4, PlaneAxis::z}), (Names{"+z"}));
  EXPECT_EQ(names_of(egg_crate(9e-3, 9.2e-3, 9.5e-3)), (Names{"+y", "+z", "-y", "-z"}));
}

TEST(Sides, AreNotThoseOfRoundObstacles) {
  EXPECT_TRUE(names_of(Circle{1e-4}).empty());
  EXPECT_TRUE(names_of(FacingPlanes{1e-3, PlaneAxis::y, 1.0}).empty());
  EXPECT_TRUE(names_of(polygon(9)).empty());
  const double turn = std::numbers::pi / 2.0; // a corner that protrudes, and one that is none
  for (const double middle : {0.3, std::numbers::sqrt2 / 2.0})
    EXPECT_TRUE(
        names_of(Profile(std::vector<PolarPoint>{
                     {0.0, 1.0}, {0.5 * turn, middle}, {turn, 1.0}, {2 * turn, 1.0}, {3 * turn, 1.0}}))
            .empty());
}

// A square on its corner and other convex polygons, by the normals of their facets, which are in the middle between two corners.
TEST(Sides, OfAConvexPolygonAreItsFacets) {
  EXPECT_EQ(names_of(polygon(3)), (Names{"facet 1", "facet 2", "facet 3"}));
  EXPECT_EQ(names_of(polygon(4)).size(), 4u);
  for (const int n : {3, 4, 6, 8}) {
    const SideFinder side_of(polygon(n));
    for (int k = 0; k < n; ++k)
      for (const double off : {-0.49, 0.0, 0.49}) {
        const double angle = (k + 0.5 + off) * 2.0 * std::numbers::pi / n;
        EXPECT_EQ(side_of({-std::cos(angle), -std::sin(angle)}), static_cast<std::size_t>(k))
            << n << ", " << off;
      }
  }
  EXPECT_TRUE(facet_normals(egg_crate(9e-3, 9.2e-3, 9.5e-3)).empty()); // of names of their own
  EXPECT_EQ(side_number("facet 8"), 7u);
}

// Every place of a turn belongs to the land within half a pitch of it.
TEST(Sides, OfABroachedHoleAreItsLands) {
  EXPECT_EQ(names_of(broached(3, 20.0)), (Names{"land 1", "land 2", "land 3"}));
  EXPECT_TRUE(names_of(broached(9, 0.0)).empty());
  for (const int lands : {2, 3, 4, 8})
    for (const double first : {0.0, 20.0, -170.0, 500.0}) {
      const SideFinder side_of(broached(lands, first));
      const double pitch = 360.0 / lands;
      for (int k = 0; k < lands; ++k)
        for (const double off : {-0.49, 0.0, 0.49}) {
          const double angle = (first + (k + off) * pitch) * std::numbers::pi / 180.0;
          EXPECT_EQ(side_of({-std::cos(angle), -std::sin(angle)}), static_cast<std::size_t>(k))
              << lands << " from " << first << ", " << k << " + " << off;
        }
    }
}

TEST(Sides, AreLeftAtTheCornersOfLands) {
  const double half = 0.15, turn = 2.0 * std::numbers::pi, first = 20.0 * std::numbers::pi / 180.0;
  const SideFinder side_of(broached(4, 20.0));
  for (int land = 0; land < 4; ++land)
    for (const double off : {-0.5, -0.16, -0.14, 0.0, 0.14, 0.16, 0.5}) {
      const double angle = first + land * turn / 4.0 + off;
      EXPECT_EQ(side_of.at_corner(2e-4 * std::cos(angle), 2e-4 * std::sin(angle)), std::abs(off) > half)
          << off;
    }
  EXPECT_FALSE(SideFinder(Circle{1e-4}).at_corner(1e-4, 1e-4));
  EXPECT_FALSE(SideFinder(broached(9, 0.0)).at_corner(1e-4, 1e-4)); // one surface
}

TEST(Sides, HaveNumbersByTheirNames) {
  EXPECT_EQ(side_number("land 8"), 7u);
  EXPECT_FALSE(side_number("land 9"));
  EXPECT_FALSE(side_number("y"));
}

} // namespace fretwork::contact::sides_test
