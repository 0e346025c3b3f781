// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/broached_space.hpp"
#include "contact/obstacle.hpp"
#include "core/error.hpp"
#include "uniform.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace broached_space_test {

using namespace fretwork;
using contact::BroachedHole;
using contact::BroachedSpace;
using contact::Location;
using contact::PlanePoint;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double tube = 9.525e-3;   // m, of 3/4 inch
constexpr double round_off = 1e-17; // m: a few units in the last place of a radius

const BroachedHole narrow_trefoil{9.725e-3, 12e-3, 3, 0.35, 0.2};
const BroachedHole wide_trefoil{9.725e-3, 9.8e-3, 3, 0.35, -4.0};
const BroachedHole quatrefoil{9.7e-3, 11.5e-3, 4, 0.3, 1.0};
const BroachedHole two_lands{9.6e-3, 9.8e-3, 2, 0.8, 0.0};
const BroachedHole all[] = {narrow_trefoil, wide_trefoil, quatrefoil, two_lands};
const BroachedHole worn[] = {{9.725e-3, 12e-3, 3, 0.35, 0.2, {3e-4, 0.0, 1e-4}},
                             {9.6e-3, 12e-3, 4, 0.3, 1.0, {0.0, 5e-4, 4e-4, 1e-5}},
                             {9.6e-3, 10.4e-3, 2, 0.8, 0.0, {6e-5, 2e-4}},
                             {9.725e-3, 9.85e-3, 3, 0.35, 0.0, {0.0, 0.0, 8e-5}}};

double land_radius(const BroachedHole& hole, int land) {
  return hole.land_radius +
         (hole.land_growth.empty() ? 0.0 : hole.land_growth[static_cast<std::size_t>(land)]);
}

/// Distance of a point to the plate round a broached hole, from the plate's arcs and walls themselves.
double to_plate(const BroachedHole& hole, double y, double z) {
  const double r = std::hypot(y, z), angle = std::atan2(z, y), half_land = 0.5 * hole.land_angle;
  double nearest = std::numeric_limits<double>::infinity();
  for (int land = 0; land < hole.lands; ++land) {
    const double pitch = 2.0 * pi / hole.lands;
    const double from_land = std::remainder(angle - hole.orientation - land * pitch, 2.0 * pi);
    const double from_lobe = std::remainder(angle - hole.orientation - (land + 0.5) * pitch, 2.0 * pi);
    if (std::abs(from_land) <= half_land)
      nearest = std::min(nearest, land_radius(hole, land) - r);
    if (std::abs(from_lobe) <= 0.5 * pitch - half_land)
      nearest = std::min(nearest, hole.lobe_radius - r);
    for (const double side : {-half_land, half_land}) { // a wall from the land's corner outwards
      const double along = r * std::cos(from_land - side), across = r * std::sin(from_land - side);
      nearest = std::min(
          nearest, std::hypot(along - std::clamp(along, land_radius(hole, land), hole.lobe_radius), across));
    }
  }
  return nearest;
}

std::string message_of(const BroachedHole& hole, double radius) {
  try {
    (void)BroachedSpace(radius, hole);
  } catch (const core::Error& error) {
    return error.what();
  }
  return "no error";
}
void expect_refused(const BroachedHole& hole, std::initializer_list<const char*> parts,
                    double radius = tube) {
  const std::string message = message_of(hole, radius);
  for (const char* part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
}
BroachedHole changed(const std::function<void(BroachedHole&)>& change) {
  BroachedHole hole = narrow_trefoil;
  change(hole);
  return hole;
}

PlanePoint polar(double r, double angle) { return {r * std::cos(angle), r * std::sin(angle)}; }

} // namespace

namespace {

void expect_the_room(const BroachedHole& hole, tests::Uniform& uniform) {
  const BroachedSpace space(tube, hole);
  int inside = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto [y, z] = polar(uniform(0.0, 6e-4), uniform(0.0, 2.0 * pi));
    const double room = to_plate(hole, y, z) - tube;
    if (room < 0.0)
      continue;
    ASSERT_NEAR(space.locate(y, z).gap, room, round_off) << y << " " << z;
    ++inside;
  }
  EXPECT_GT(inside, 1000);
}

} // namespace

TEST(BroachedSpace, GapIsTheRoomBetweenTubeAndPlate) {
  tests::Uniform uniform(22);
  for (const BroachedHole& hole : all)
    expect_the_room(hole, uniform);
}

// Lands of their own radii: gap, gap bound, and normals as differences of the gap.
TEST(BroachedSpace, HasLandsOfUnequalRadii) {
  tests::Uniform uniform(23);
  for (const BroachedHole& hole : worn) {
    expect_the_room(hole, uniform);
    const BroachedSpace space(tube, hole);
    EXPECT_EQ(space.clearance(), space.locate(0.0, 0.0).gap);
    for (int i = 0; i < 1000; ++i) {
      const double r = uniform(0.0, 6e-4);
      const auto [y, z] = polar(r, uniform(0.0, 2.0 * pi));
      EXPECT_GE(space.locate(y, z).gap, space.clearance() - r - round_off);
    }
    for (std::size_t land = 0; land < hole.land_growth.size(); ++land) {
      const double angle = hole.orientation + 2.0 * pi * static_cast<double>(land) / hole.lands;
      const double clear = land_radius(hole, static_cast<int>(land)) - tube;
      const auto [y, z] = polar(clear, angle);
      EXPECT_NEAR(space.locate(y, z).gap, 0.0, round_off);
      EXPECT_NEAR(space.locate(y, z).ny, -std::cos(angle), 1e-12);
    }
  }
  expect_refused(changed([](BroachedHole& hole) { hole.land_growth = {1e-4}; }), {"growth of 1 lands of 3"});
  expect_refused(changed([](BroachedHole& hole) { hole.land_growth = {0.0, 0.0, 5e-3}; }), {"lobe radius"});
}

TEST(BroachedSpace, OutlineIsWhereTheTubeTouchesThePlate) {
  for (const BroachedHole& hole : all)
    for (const PlanePoint& v : BroachedSpace(tube, hole).outline(7))
      ASSERT_NEAR(to_plate(hole, v.y, v.z), tube, round_off);
  for (const BroachedHole& hole : {worn[0], worn[1]}) // their lobes have arcs left
    for (const PlanePoint& v : BroachedSpace(tube, hole).outline(7))
      ASSERT_NEAR(to_plate(hole, v.y, v.z), tube, round_off);
}

TEST(BroachedSpace, PenetrationIsTheDistanceToTheOutline) {
  tests::Uniform uniform(24);
  for (const BroachedHole& hole : all) {
    const BroachedSpace space(tube, hole);
    const auto outline = space.outline(4000);
    for (int i = 0; i < 300; ++i) {
      // somewhat deep, and as deep as the plate's corners and beyond
      const auto [y, z] =
          polar(i % 2 == 0 ? uniform(2e-4, 1.5e-3) : uniform(1e-3, 2e-2), uniform(0.0, 2.0 * pi));
      const Location at = space.locate(y, z);
      if (at.gap >= 0.0)
        continue;
      double least = 1.0, across = 0.0;
      for (std::size_t k = 0; k < outline.size(); ++k) {
        const PlanePoint &p = outline[k], &next = outline[(k + 1) % outline.size()];
        if (const double d = std::hypot(p.y - y, p.z - z); d < least)
          least = d, across = std::hypot(next.y - p.y, next.z - p.z);
      }
      ASSERT_LE(-at.gap, least + round_off) << y << " " << z;
      ASSERT_GT(-at.gap, std::sqrt(std::max(0.0, least * least - across * across)) - 1e-9) << y << " " << z;
      // the normal leads to the nearest place of the end
      ASSERT_NEAR(space.locate(y - (1.0 + 1e-9) * at.gap * at.ny, z - (1.0 + 1e-9) * at.gap * at.nz).gap, 0.0,
                  1e-9 * least);
    }
  }
}

TEST(BroachedSpace, NormalDoesNotJumpFromLandToCorner) {
  const BroachedSpace space(tube, narrow_trefoil);
  const double corner = narrow_trefoil.orientation + 0.5 * narrow_trefoil.land_angle, r = 2.1e-4;
  const double turn = 1e-9;
  const auto at = [&](double angle) {
    const auto [y, z] = polar(r, angle);
    return space.locate(y, z);
  };
  const Location land = at(corner - turn), beside = at(corner + turn);
  EXPECT_NEAR(land.ny, beside.ny, 3.0 * turn);
  EXPECT_NEAR(land.nz, beside.nz, 3.0 * turn);
  EXPECT_NEAR(land.gap, beside.gap, round_off);
  const auto kappa = [&](double angle) {
    const auto [y, z] = polar(r, angle);
    return space.curvature(y, z);
  };
  EXPECT_NEAR(kappa(corner - turn), -1.0 / r, 1e-9 / r);
  EXPECT_NEAR(kappa(corner + turn), 1.0 / (narrow_trefoil.land_radius - r), 1e-6);
}

TEST(BroachedSpace, TouchesItsLandsFirst) {
  for (const BroachedHole& hole : all) {
    const BroachedSpace space(tube, hole);
    const double clearance = hole.land_radius - tube;
    EXPECT_EQ(space.locate(0.0, 0.0).gap, space.clearance());
    EXPECT_NEAR(space.clearance(), clearance, round_off);
    for (int land = 0; land < hole.lands; ++land) {
      const double at_land = hole.orientation + 2.0 * pi * land / hole.lands,
                   at_lobe = at_land + pi / hole.lands;
      const double r = 1.05 * clearance;
      const auto [y, z] = polar(r, at_land);
      const Location location = space.locate(y, z);
      EXPECT_NEAR(location.gap, clearance - r, round_off);
      EXPECT_NEAR(location.ny, -std::cos(at_land), 1e-14);
      EXPECT_NEAR(location.nz, -std::sin(at_land), 1e-14);
      const auto [lobe_y, lobe_z] = polar(r, at_lobe);
      EXPECT_GT(space.locate(lobe_y, lobe_z).gap, 0.0);
    }
  }
}

TEST(BroachedSpace, NormalAtACornerPointsFromItToTheTubesCentre) {
  const BroachedSpace space(tube, narrow_trefoil);
  const double corner = narrow_trefoil.orientation + 0.5 * narrow_trefoil.land_angle,
               a = narrow_trefoil.land_radius;
  for (const double x : {0.005, 0.01, 0.02}) // about the corner, from its direction
    for (const double side : {-1.0, 1.0}) {
      const double at_corner = side < 0.0 ? 2.0 * narrow_trefoil.orientation - corner : corner;
      const double distance = tube - 1e-6; // overlapping it by 1e-6
      const double along = a - distance * std::cos(x), across = side * distance * std::sin(x);
      const Location at = space.locate(along * std::cos(at_corner) - across * std::sin(at_corner),
                                       along * std::sin(at_corner) + across * std::cos(at_corner));
      EXPECT_NEAR(at.gap, -1e-6, round_off);
      EXPECT_NEAR(at.ny, -std::cos(at_corner - side * x), 1e-14);
      EXPECT_NEAR(at.nz, -std::sin(at_corner - side * x), 1e-14);
    }
}

TEST(BroachedSpace, IsTheSameFromLandToLandAndTurnsWithItsOrientation) {
  tests::Uniform uniform(23);
  const BroachedSpace space(tube, quatrefoil);
  BroachedHole other = quatrefoil;
  other.orientation += 0.37;
  const BroachedSpace turned(tube, other);
  for (int i = 0; i < 1000; ++i) {
    const double angle = uniform(0.0, 2.0 * pi), r = uniform(0.0, 1e-3);
    const auto gap = [&](const BroachedSpace& s, double by) {
      const auto [y, z] = polar(r, angle + by);
      return s.locate(y, z).gap;
    };
    ASSERT_NEAR(gap(space, 0.5 * pi), gap(space, 0.0), round_off);
    ASSERT_NEAR(gap(turned, 0.37), gap(space, 0.0), round_off);
  }
}

TEST(BroachedSpace, HasANormalWhereverANodeIs) {
  const BroachedSpace space(tube, wide_trefoil);
  const double corner = wide_trefoil.orientation + 0.5 * wide_trefoil.land_angle;
  std::vector<PlanePoint> places = space.outline(3);
  places.push_back({0.0, 0.0});
  places.push_back(polar(wide_trefoil.land_radius, corner));
  places.push_back(polar(1e3, 1.0));
  for (const auto& [y, z] : places) {
    const Location at = space.locate(y, z);
    EXPECT_NEAR(std::hypot(at.ny, at.nz), 1.0, 1e-14) << y << " " << z;
    EXPECT_TRUE(std::isfinite(at.gap) && std::isfinite(space.curvature(y, z))) << y << " " << z;
  }
}

TEST(BroachedSpace, RefusesLandsThatMakeNoBroachedHole) {
  expect_refused(changed([](auto& h) { h.lobe_radius = h.land_radius; }),
                 {"lobe radius", "not larger than the land"});
  expect_refused(changed([](auto& h) { h.lands = 1; }), {"lands = 1", "at least 2"});
  expect_refused(changed([](auto& h) { h.land_angle = 0.0; }), {"land angle = 0 rad"});
  expect_refused(changed([](auto& h) { h.land_angle = 2.1; }),
                 {"land angle = 2.1 rad", "no lobe", "2.0944 rad"});
  expect_refused(changed([](auto& h) { h.orientation = INFINITY; }), {"orientation = inf rad"});
  expect_refused(BroachedHole{9.725e-3, 12e-3, 2, 0.1, 0.0},
                 {"passes behind the corner", "smaller lobe radius"});
  expect_refused(changed([](auto& h) { h.lobe_radius = std::numeric_limits<double>::quiet_NaN(); }),
                 {"broached hole: lobe radius = nan m"});
  expect_refused(changed([](auto& h) { h.land_radius = 9e-3; }), {"land radius = 0.009 m is less"});
  expect_refused(changed([](auto& h) { h.land_radius = tube; }),
                 {"land radius = 0.009525 m", "leaves no room"});
}

} // namespace broached_space_test
