// SPDX-License-Identifier: GPL-3.0-or-later
// Obstacles whose sides have moved away by wear.
#include "app/opened_contacts.hpp"
#include "contact/support_shapes.hpp"
#include "core/error.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace fretwork::app {
namespace {

constexpr double growth = 1e-4, radius = 9.525e-3; // m
constexpr double round_off = 1e-15;                // m

double gap_at(const contact::Obstacle& obstacle, double y, double z) {
  return contact::locate(obstacle, y, z).gap;
}

void expect_wider(const contact::Obstacle& obstacle, double y, double z) {
  EXPECT_NEAR(gap_at(opened_obstacle(obstacle, growth), y, z), gap_at(obstacle, y, z) + growth, round_off)
      << y << ", " << z;
}

} // namespace

TEST(OpenedContacts, MoveEverySideAway) {
  using contact::PlaneAxis;
  for (const auto& [y, z] : {std::pair(1e-4, 5e-5), std::pair(-2e-4, 0.0)}) {
    expect_wider(contact::Circle{3e-4}, y, z);
    expect_wider(contact::PlanePair{3e-4, PlaneAxis::y}, y, z);
    expect_wider(contact::Stop{3e-4, PlaneAxis::y}, y, z);
    expect_wider(contact::FacingPlanes{0.02, PlaneAxis::y, -1.0}, y - 0.02, z);
    expect_wider(contact::RoundPair{0.02}, y, z + 0.03);
  }
  const contact::Obstacle ellipse = contact::elliptic_hole(radius, radius + 2e-4, radius + 3e-4);
  expect_wider(ellipse, 1e-5, 0.0); // along an axis of the hole
}

// Each face of two bars or of an egg crate moves by the wear of its own side.
TEST(OpenedContacts, MoveEachFaceByItsOwnSide) {
  const SideGrowth growth_of{3e-4, 2e-4, 1e-4, 0.0};
  const auto gaps = [](const PlacedContact& placed, double y, double z) {
    return gap_at(placed.obstacle, placed.rest.y() + y, placed.rest.z() + z);
  };
  constexpr double out = 4e-4; // m, nearest to the face on that side
  PlacedContact bars, crate;
  bars.rest = crate.rest = {0.0, 5e-5, 0.0}; // a tube beside the middle
  bars.obstacle = contact::PlanePair{5e-4, contact::PlaneAxis::y};
  crate.obstacle = contact::egg_crate(radius, radius + 5e-4, radius + 5e-4);
  for (PlacedContact* placed : {&bars, &crate}) {
    const double plus = gaps(*placed, out, 0.0), minus = gaps(*placed, -out, 0.0);
    open_sides(growth_of, *placed);
    EXPECT_NEAR(gaps(*placed, out, 0.0), plus + growth_of[0], round_off);
    EXPECT_NEAR(gaps(*placed, -out, 0.0), minus + growth_of[2], round_off);
  }
  EXPECT_NEAR(gaps(crate, 0.0, out), 1e-4 + growth_of[1], round_off);
  EXPECT_NEAR(gaps(crate, 0.0, -out), 1e-4 + growth_of[3], round_off);
}

TEST(OpenedContacts, MoveTheFacesOfAnEggCrate) {
  const contact::Profile crate = contact::egg_crate(radius, radius + 2e-4, radius + 5e-4);
  for (const auto& [y, z] : {std::pair(1e-4, 0.0), std::pair(0.0, -3e-4), std::pair(-3e-4, 1e-4)})
    expect_wider(crate, y, z);
}

TEST(OpenedContacts, WidenTheLandsOfABroachedHole) {
  const contact::Obstacle hole = contact::BroachedSpace(radius, {radius + 2e-4, radius + 3e-3, 4, 0.3});
  expect_wider(hole, 1e-4, 0.0);
  EXPECT_THROW((void)opened_obstacle(hole, 5e-3), core::Error); // no lobe is left
}

// At the middle of each land the tube has the clearance of its own scar more, also after a second stage.
TEST(OpenedContacts, MoveEachLandByItsOwnScar) {
  const SideGrowth growth_of{1e-4, 0.0, 4e-5, 9e-5};
  for (const int lands : {3, 4}) {
    PlacedContact placed{};
    placed.rest = {0.0, 5e-5, -2e-5};
    placed.obstacle = contact::BroachedSpace(radius, {radius + 2e-4, radius + 3e-3, lands, 0.3, 0.7});
    for (int stage = 1; stage <= 2; ++stage) {
      open_sides(growth_of, placed);
      for (int k = 0; k < lands; ++k) {
        const double angle = 0.7 + 2.0 * std::numbers::pi * k / lands;
        const double r = 2e-4 + stage * growth_of[static_cast<std::size_t>(k)];
        EXPECT_NEAR(gap_at(placed.obstacle, r * std::cos(angle), r * std::sin(angle)), 0.0, 1e-17)
            << lands << " lands, " << k << ", stage " << stage;
      }
    }
    EXPECT_EQ(placed.rest.y(), 5e-5);
    const contact::Obstacle wider = opened_obstacle(placed.obstacle, growth); // of worn lands, all alike
    const double r = 3e-4 + 2.0 * growth_of[0];
    EXPECT_NEAR(gap_at(wider, r * std::cos(0.7), r * std::sin(0.7)), 0.0, 1e-17);
  }
}

// Where the tube touches a facet it has the clearance of its own scar more, also after a second stage.
TEST(OpenedContacts, MoveEachFacetByItsOwnScar) {
  const SideGrowth growth_of{1e-5, 0.0, 4e-5, 2e-5, 0.0, 3e-5};
  for (const int n : {3, 6}) {
    std::vector<contact::PolarPoint> points;
    for (int k = 0; k < n; ++k)
      points.push_back({0.2 + 2.0 * std::numbers::pi * k / n, 5e-4});
    PlacedContact placed{};
    placed.obstacle = contact::Profile(points);
    const double inscribed = 5e-4 * std::cos(std::numbers::pi / n);
    const auto expect_at_facet = [&](const contact::Obstacle& obstacle, int k, double r) {
      const double angle = 0.2 + 2.0 * std::numbers::pi * (k + 0.5) / n;
      EXPECT_NEAR(gap_at(obstacle, r * std::cos(angle), r * std::sin(angle)), 0.0, 1e-17) << n << ", " << k;
    };
    for (int stage = 1; stage <= 2; ++stage) {
      open_sides(growth_of, placed);
      for (int k = 0; k < n; ++k)
        expect_at_facet(placed.obstacle, k, inscribed + stage * growth_of[static_cast<std::size_t>(k)]);
    }
    for (int k = 0; k < n; ++k) // all alike
      expect_at_facet(opened_obstacle(placed.obstacle, growth), k,
                      inscribed + growth + 2.0 * growth_of[static_cast<std::size_t>(k)]);
    EXPECT_EQ(placed.rest.y(), 0.0);
  }
}

// The chamfer of a corner, 0.14 mm long, ends where its neighbours meet: when it has moved by half of that.
TEST(OpenedContacts, SayWhichFacetIsWornAway) {
  const std::vector<std::pair<double, double>> corners{
      {-1e-3, -1e-3}, {1e-3, -1e-3}, {1e-3, 0.9e-3}, {0.9e-3, 1e-3}, {-1e-3, 1e-3}};
  std::vector<contact::PolarPoint> points;
  for (const auto& [y, z] : corners)
    points.push_back({std::atan2(z, y), std::hypot(y, z)});
  PlacedContact placed{};
  placed.obstacle = contact::Profile(points);
  open_sides({0.0, 0.0, 6e-5, 0.0, 0.0}, placed);
  try {
    open_sides({0.0, 0.0, 2e-5, 0.0, 0.0}, placed);
    ADD_FAILURE() << "a facet of no length";
  } catch (const core::Error& error) {
    EXPECT_STREQ(error.what(), "facet 3 of the profile is worn away: its neighbours meet before it");
  }
}

TEST(OpenedContacts, MoveThePointsOfAProfileOutward) {
  std::vector<contact::PolarPoint> points;
  constexpr int n = 720;
  for (int k = 0; k < n; ++k)
    points.push_back({2.0 * std::numbers::pi * k / n - 2.5, 3e-4 + 1e-4 * std::cos(0.01745 * k)});
  const contact::Profile hole(points);
  const auto wider = std::get<contact::Profile>(opened_obstacle(hole, growth));
  ASSERT_EQ(wider.vertices().size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    EXPECT_NEAR(std::hypot(wider.vertices()[k].y, wider.vertices()[k].z),
                std::hypot(hole.vertices()[k].y, hole.vertices()[k].z) + growth, round_off);
}

TEST(OpenedContacts, OpenByAngleOnlyWhereTheyAreCirclesInSpace) {
  PlacedContact placed{};
  placed.obstacle = contact::Circle{1e-4};
  EXPECT_TRUE(opens_by_angle(placed));
  placed.other = 3;
  EXPECT_FALSE(opens_by_angle(placed));
  placed.other = -1;
  placed.obstacle = contact::Circle{0.0};
  EXPECT_FALSE(opens_by_angle(placed));
}

} // namespace fretwork::app
