// SPDX-License-Identifier: GPL-3.0-or-later
#include "refusal.hpp"
#include "wear/obstacle_geometry.hpp"
#include <numbers>

namespace obstacle_geometry_test {

using namespace fretwork;
using namespace fretwork::wear;

namespace {

constexpr TubeInSupport tube{9.525e-3, 30e-3, 0.01};
constexpr double round_off = 1e-17; ///< m

} // namespace

TEST(ObstacleGeometry, OfACircleIsAHoleOrARing) {
  const Geometry hole = geometry_of(contact::Circle{2e-4}, tube);
  ASSERT_TRUE(std::holds_alternative<DrilledHole>(hole));
  EXPECT_EQ(std::get<DrilledHole>(hole).clearance, 2e-4);
  EXPECT_EQ(std::get<DrilledHole>(hole).radius, tube.radius);
  EXPECT_EQ(std::get<DrilledHole>(hole).length, tube.length);
  EXPECT_EQ(std::get<DrilledHole>(hole).inclination, tube.inclination);
  const Geometry from_shape = geometry_of(contact::drilled_hole(9.525e-3, 9.725e-3), tube);
  EXPECT_NEAR(std::get<DrilledHole>(from_shape).clearance, 2e-4, round_off);
  EXPECT_TRUE(std::holds_alternative<Ring>(geometry_of(contact::Circle{0.0}, tube)));
}

TEST(ObstacleGeometry, OfPlanesIsAFlatBar) {
  for (const contact::Obstacle& planes : {contact::Obstacle(contact::PlanePair{1e-4, contact::PlaneAxis::y}),
                                          contact::Obstacle(contact::Stop{1e-4, contact::PlaneAxis::z})}) {
    const Geometry bar = geometry_of(planes, tube);
    ASSERT_TRUE(std::holds_alternative<FlatBar>(bar));
    EXPECT_EQ(std::get<FlatBar>(bar).inclination, tube.inclination);
  }
}

TEST(ObstacleGeometry, OfARoundPairIsTubeOnTube) {
  const Geometry pair = geometry_of(contact::RoundPair{0.02}, tube);
  ASSERT_TRUE(std::holds_alternative<TubeOnTube>(pair));
  EXPECT_EQ(std::get<TubeOnTube>(pair).crossing, tube.inclination);
  expect_refused([] { (void)geometry_of(contact::RoundPair{0.02}, {9.525e-3, 30e-3}); }, {"parallel tubes"});
}

TEST(ObstacleGeometry, OfABroachedHoleIsItsLands) {
  const contact::BroachedSpace space(9.525e-3, {9.725e-3, 12e-3, 4, 0.35});
  const Lands lands = std::get<Lands>(geometry_of(space, tube));
  EXPECT_NEAR(lands.clearance, 2e-4, round_off);
  EXPECT_EQ(lands.half_angle, 0.175);
  EXPECT_EQ(lands.lands, 4);
  EXPECT_EQ(lands.inclination, tube.inclination);
  EXPECT_EQ(lands.middles, std::vector<double>{0.0});
  expect_refused(
      [&] {
        (void)geometry_of(contact::BroachedSpace(8.5e-3, {9e-3, 12e-3, 4, 0.35}), tube);
      },
      {"lands of radius 0.009 m do not hold a tube of radius 0.009525 m", "land_radius"});
}

TEST(ObstacleGeometry, ThatDoesNotExistIsRefused) {
  expect_refused(
      [] {
        (void)geometry_of(contact::FacingPlanes{1e-3, contact::PlaneAxis::y, 1.0}, tube);
      },
      {"facing planes have no geometry of wear", "neither body is a tube", "flat_bar"});
  expect_refused(
      [] { (void)geometry_of(contact::egg_crate(9.525e-3, 9.7e-3, 9.7e-3), tube); },
      {"a profile of 4 points has no geometry of wear of its own", "lands", "flat_bar (egg crate)"});
  expect_refused(
      [] {
        (void)geometry_of(contact::Circle{1e-4}, {0.0, 30e-3});
      },
      {"drilled hole", "tube radius"});
}

} // namespace obstacle_geometry_test
