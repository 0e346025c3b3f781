// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/support_shapes.hpp"
#include "core/error.hpp"
#include "uniform.hpp"
#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace support_shapes_test {

using namespace fretwork;
using contact::BarSides;
using contact::BroachedHole;
using contact::Location;
using contact::PlaneAxis;
using contact::Profile;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double tube = 9.525e-3;   // m, of 3/4 inch
constexpr double round_off = 1e-17; // m: a few units in the last place of a radius
constexpr double direction_error =
    5e-3; // half the angle of the longest facet of a profile of default chord error

const BroachedHole narrow_trefoil{9.725e-3, 12e-3, 3, 0.35, 0.2};
const BroachedHole wide_trefoil{9.725e-3, 9.8e-3, 3, 0.35, -4.0};
const BroachedHole quatrefoil{9.7e-3, 11.5e-3, 4, 0.3, 1.0};
const BroachedHole two_lands{9.6e-3, 9.8e-3, 2, 0.8, 0.0};
const BroachedHole all[] = {narrow_trefoil, wide_trefoil, quatrefoil, two_lands};

/// Distance of a point to the plate round a broached hole, from the plate's arcs and walls themselves.
double to_plate(const BroachedHole& hole, double y, double z) {
  const double r = std::hypot(y, z), angle = std::atan2(z, y), half_land = 0.5 * hole.land_angle;
  double nearest = std::numeric_limits<double>::infinity();
  for (int land = 0; land < hole.lands; ++land) {
    const double pitch = 2.0 * pi / hole.lands;
    const double from_land = std::remainder(angle - hole.orientation - land * pitch, 2.0 * pi);
    const double from_lobe = std::remainder(angle - hole.orientation - (land + 0.5) * pitch, 2.0 * pi);
    if (std::abs(from_land) <= half_land)
      nearest = std::min(nearest, hole.land_radius - r);
    if (std::abs(from_lobe) <= 0.5 * pitch - half_land)
      nearest = std::min(nearest, hole.lobe_radius - r);
    for (const double side : {-half_land, half_land}) { // a wall from the land's corner outwards
      const double along = r * std::cos(from_land - side), across = r * std::sin(from_land - side);
      nearest = std::min(nearest,
                         std::hypot(along - std::clamp(along, hole.land_radius, hole.lobe_radius), across));
    }
  }
  return nearest;
}

std::string message_of(const std::function<void()>& build) {
  try {
    build();
  } catch (const core::Error& error) {
    return error.what();
  }
  return "no error";
}
void expect_refused(const std::function<void()>& build, std::initializer_list<const char*> parts) {
  const std::string message = message_of(build);
  for (const char* part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
}
void expect_refused(BroachedHole hole, std::initializer_list<const char*> parts, double error = 1e-8) {
  expect_refused([&] { (void)contact::broached_hole(tube, hole, error); }, parts);
}
BroachedHole changed(const std::function<void(BroachedHole&)>& change) {
  BroachedHole hole = narrow_trefoil;
  change(hole);
  return hole;
}

} // namespace

TEST(DrilledHole, IsACircleOfItsClearance) {
  EXPECT_NEAR(contact::drilled_hole(tube, 9.725e-3).gap, 2e-4, round_off);
  EXPECT_EQ(contact::drilled_hole(tube, tube).gap, 0.0);
}

TEST(FlatBars, ArePlanesAtTheirDistanceLessTheTube) {
  const auto one = contact::flat_bars(tube, 1e-2, PlaneAxis::z, BarSides::one);
  const auto two = contact::flat_bars(tube, 1e-2, PlaneAxis::z, BarSides::two);
  for (const double z : {-1e-3, 2e-4, 1e-3}) {
    EXPECT_NEAR(locate(one, 5e-3, z).gap, 1e-2 - tube - z, round_off);
    EXPECT_NEAR(locate(two, 5e-3, z).gap, 1e-2 - tube - std::abs(z), round_off);
  }
  EXPECT_EQ(locate(one, 0.0, 1e-3).nz, -1.0);
  EXPECT_EQ(locate(two, 0.0, -1e-3).nz, 1.0);
}

TEST(FlatBars, AtUnequalDistancesAreAPairShiftedToTheirMiddle) {
  const auto [planes, offset] = contact::flat_bars_between(tube, 9.6e-3, 9.9e-3, PlaneAxis::y);
  EXPECT_NEAR(locate(planes, 9.9e-3 - tube - offset, 0.0).gap, 0.0, round_off);
  EXPECT_NEAR(locate(planes, tube - 9.6e-3 - offset, 0.0).gap, 0.0, round_off);
  const auto beyond =
      contact::flat_bars_between(tube, -1e-3, 2.1e-2, PlaneAxis::y); // the tube starts in a bar
  EXPECT_NEAR(locate(beyond.planes, -beyond.offset, 0.0).gap, -1e-3 - tube, round_off);
}

TEST(EggCrate, IsTwoPairsOfPlanes) {
  const double gap_y = 3e-4, gap_z = 2e-4;
  const Profile crate = contact::egg_crate(tube, tube + gap_y, tube + gap_z);
  EXPECT_EQ(crate.vertices().size(), 4u);
  EXPECT_NEAR(crate.inscribed(), gap_z, round_off);
  tests::Uniform uniform(21);
  for (int i = 0; i < 3000; ++i) {
    const double y = uniform(-5e-4, 5e-4), z = uniform(-5e-4, 5e-4);
    const Location at = crate.locate(y, z);
    const Location by_y = locate(contact::PlanePair{gap_y, PlaneAxis::y}, y, z),
                   by_z = locate(contact::PlanePair{gap_z, PlaneAxis::z}, y, z);
    if (by_y.gap < 0.0 && by_z.gap < 0.0) { // beyond a corner
      EXPECT_NEAR(at.gap, -std::hypot(by_y.gap, by_z.gap), round_off);
      continue;
    }
    const Location& nearest = by_y.gap < by_z.gap ? by_y : by_z;
    EXPECT_NEAR(at.gap, nearest.gap, round_off);
    EXPECT_NEAR(at.ny, nearest.ny, 1e-12);
    EXPECT_NEAR(at.nz, nearest.nz, 1e-12);
  }
}

TEST(BroachedHole, GapIsTheRoomBetweenTubeAndPlate) {
  tests::Uniform uniform(22);
  for (const BroachedHole& hole : all)
    for (const double error : {1e-6, contact::default_chord_error, 1e-10}) {
      const Profile profile = contact::broached_hole(tube, hole, error);
      int inside = 0;
      for (int i = 0; i < 3000; ++i) {
        const double angle = uniform(0.0, 2.0 * pi), r = uniform(0.0, 6e-4);
        const double y = r * std::cos(angle), z = r * std::sin(angle), room = to_plate(hole, y, z) - tube;
        const double gap = profile.locate(y, z).gap;
        if (room < error)
          continue;
        ASSERT_NEAR(gap, room, error) << y << " " << z;
        ++inside;
      }
      EXPECT_GT(inside, 300);
    }
}

TEST(BroachedHole, CornersOfTheProfileTouchThePlateExactly) {
  for (const BroachedHole& hole : all) {
    const Profile profile = contact::broached_hole(tube, hole);
    for (const contact::PlanePoint& v : profile.vertices())
      ASSERT_NEAR(to_plate(hole, v.y, v.z), tube, round_off);
  }
}

TEST(BroachedHole, TouchesItsLandsFirst) {
  for (const BroachedHole& hole : all) {
    const Profile profile = contact::broached_hole(tube, hole);
    const double clearance = hole.land_radius - tube;
    EXPECT_NEAR(profile.inscribed(), clearance, contact::default_chord_error);
    for (int land = 0; land < hole.lands; ++land) {
      const double at_land = hole.orientation + 2.0 * pi * land / hole.lands,
                   at_lobe = at_land + pi / hole.lands;
      const double r = 1.05 * clearance;
      const Location location = profile.locate(r * std::cos(at_land), r * std::sin(at_land));
      EXPECT_NEAR(location.gap, clearance - r, contact::default_chord_error);
      EXPECT_NEAR(location.ny, -std::cos(at_land), direction_error);
      EXPECT_NEAR(location.nz, -std::sin(at_land), direction_error);
      EXPECT_GT(profile.locate(r * std::cos(at_lobe), r * std::sin(at_lobe)).gap, 0.0);
    }
  }
}

TEST(BroachedHole, NormalAtACornerPointsFromItToTheTubesCentre) {
  const Profile profile = contact::broached_hole(tube, narrow_trefoil);
  const double corner = narrow_trefoil.orientation + 0.5 * narrow_trefoil.land_angle,
               a = narrow_trefoil.land_radius;
  for (const double x : {0.005, 0.01, 0.02}) { // about the corner, from its direction
    const double distance = tube - 1e-6;       // overlapping it by 1e-6
    const double along = a - distance * std::cos(x), across = distance * std::sin(x);
    const Location at = profile.locate(along * std::cos(corner) - across * std::sin(corner),
                                       along * std::sin(corner) + across * std::cos(corner));
    EXPECT_NEAR(at.gap, -1e-6, contact::default_chord_error);
    EXPECT_NEAR(at.ny, -std::cos(corner - x), direction_error);
    EXPECT_NEAR(at.nz, -std::sin(corner - x), direction_error);
  }
}

TEST(BroachedHole, OfAnySizeHasAFewThousandFacets) {
  for (const double size : {1.0, 10.0, 1e3, 1e6}) { // of a hole of 10 mm: given in mm, by mistake, too
    const Profile profile = contact::broached_hole(9.5e-3 * size, {9.7e-3 * size, 11e-3 * size, 4, pi / 9.0});
    EXPECT_LT(profile.vertices().size(), 5000U) << size;
    EXPECT_NEAR(profile.inscribed(), 2e-4 * size,
                std::max(contact::default_chord_error, contact::default_chord_share * 2e-4 * size));
  }
}

TEST(BroachedHole, IsTheSameFromLandToLandAndTurnsWithItsOrientation) {
  tests::Uniform uniform(23);
  const Profile profile = contact::broached_hole(tube, quatrefoil);
  BroachedHole other = quatrefoil;
  other.orientation += 0.37;
  const Profile turned = contact::broached_hole(tube, other);
  for (int i = 0; i < 1000; ++i) {
    const double angle = uniform(0.0, 2.0 * pi), r = uniform(0.0, 1e-3);
    const auto gap = [&](const Profile& p, double by) {
      return p.locate(r * std::cos(angle + by), r * std::sin(angle + by)).gap;
    };
    ASSERT_NEAR(gap(profile, 0.5 * pi), gap(profile, 0.0), round_off);
    ASSERT_NEAR(gap(turned, 0.37), gap(profile, 0.0), round_off);
  }
}

TEST(BroachedHole, TakesPointsInInverseProportionToTheRootOfTheChordError) {
  const auto number = [](double error) {
    const Profile profile = contact::broached_hole(tube, narrow_trefoil, error);
    return static_cast<double>(profile.vertices().size());
  };
  EXPECT_NEAR(number(1e-12) / number(1e-10), 10.0, 0.5);
}

TEST(EllipticHole, IsTheDistanceFromTheEllipseLessTheTube) {
  tests::Uniform uniform(71);
  for (const auto& [y_axis, z_axis] : {std::pair{9.9e-3, 9.8e-3}, {9.6e-3, 10.1e-3}, {9.8e-3, 9.8e-3}}) {
    const contact::Ellipse hole = contact::elliptic_hole(tube, y_axis, z_axis);
    const contact::PlanePoint axes{y_axis, z_axis};
    for (int i = 0; i < 200; ++i) {
      const double y = uniform(-8e-4, 8e-4), z = uniform(-8e-4, 8e-4);
      const auto at = contact::locate(hole, y, z);
      double least = 1.0; // of 20 000 places: off by their distance squared by the radius of curvature
      for (int k = 0; k < 20000; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 20000.0;
        least = std::min(least, std::hypot(axes.y * std::cos(angle) - y, axes.z * std::sin(angle) - z));
      }
      EXPECT_NEAR(at.gap, least - tube, 1e-9);
      const double foot_y = y - (at.gap + tube) * at.ny,
                   foot_z = z - (at.gap + tube) * at.nz; // on the ellipse
      EXPECT_NEAR(std::hypot(foot_y / axes.y, foot_z / axes.z), 1.0, 1e-13);
    }
  }
}

TEST(EllipticHole, HasAnOutlineWithoutGap) {
  for (const auto& [y_axis, z_axis] : {std::pair{9.9e-3, 9.8e-3}, {10.1e-3, 9.6e-3}, {9.6e-3, 10.1e-3}}) {
    const contact::Obstacle hole = contact::elliptic_hole(tube, y_axis, z_axis);
    const auto outline = contact::outline_of(hole);
    ASSERT_GT(outline.size(), 100u);
    for (const auto& point : outline)
      EXPECT_NEAR(contact::locate(hole, point.y, point.z).gap, 0.0, 1e-15);
  }
}

TEST(SupportShapes, RefuseSizesThatAreNoLength) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused([] { (void)contact::drilled_hole(-1.0, 1.0); },
                 {"drilled hole: tube radius = -1 m", "length > 0"});
  expect_refused([&] { (void)contact::drilled_hole(1.0, nan); }, {"drilled hole: hole radius = nan m"});
  expect_refused([] { (void)contact::flat_bars(0.0, 1.0, PlaneAxis::y, BarSides::one); },
                 {"flat bars: tube radius = 0 m"});
  expect_refused([] { (void)contact::egg_crate(1.0, 2.0, 0.0); }, {"egg crate: half width along z = 0 m"});
  expect_refused(changed([&](auto& h) { h.lobe_radius = nan; }), {"broached hole: lobe radius = nan m"});
}

TEST(SupportShapes, RefuseATubeThatDoesNotFit) {
  expect_refused([] { (void)contact::drilled_hole(1.0, 0.9); },
                 {"hole radius = 0.9 m is less than the tube radius, 1 m", "give at least"});
  expect_refused([] { (void)contact::flat_bars(1.0, 0.9, PlaneAxis::y, BarSides::two); },
                 {"distance = 0.9 m is less"});
  expect_refused([] { (void)contact::flat_bars_between(1.0, 0.9, 1.0, PlaneAxis::y); },
                 {"half the distance between the bars = 0.95 m is less"});
  expect_refused([] { (void)contact::flat_bars_between(1.0, -1.1, 1.1, PlaneAxis::y); },
                 {"flat bars: -1.1 m", "leave nothing between the bars; give two distances > 0"});
  expect_refused([] { (void)contact::egg_crate(1.0, 0.9, 2.0); }, {"half width along y = 0.9 m is less"});
  expect_refused([] { (void)contact::egg_crate(1.0, 2.0, 1.0); },
                 {"half width along z = 1 m", "leaves no room"});
  expect_refused(changed([](auto& h) { h.land_radius = 9e-3; }), {"land radius = 0.009 m is less"});
  expect_refused(changed([](auto& h) { h.land_radius = tube; }),
                 {"land radius = 0.009525 m", "leaves no room"});
}

TEST(SupportShapes, RefuseLandsThatMakeNoBroachedHole) {
  expect_refused(changed([](auto& h) { h.lobe_radius = h.land_radius; }),
                 {"lobe radius", "not larger than the land"});
  expect_refused(changed([](auto& h) { h.lands = 1; }), {"lands = 1", "at least 2"});
  expect_refused(changed([](auto& h) { h.land_angle = 0.0; }), {"land angle = 0 rad"});
  expect_refused(changed([](auto& h) { h.land_angle = 2.1; }),
                 {"land angle = 2.1 rad", "no lobe", "2.0944 rad"});
  expect_refused(changed([](auto& h) { h.orientation = INFINITY; }), {"orientation = inf rad"});
  expect_refused(BroachedHole{9.725e-3, 12e-3, 2, 0.1, 0.0},
                 {"passes behind the corner", "smaller lobe radius"});
}

TEST(SupportShapes, RefuseChordErrorsTooLargeOrTooSmall) {
  expect_refused(narrow_trefoil, {"chord error = 0 m"}, 0.0);
  expect_refused(narrow_trefoil,
                 {"chord error = 0.001 m", "not less than the clearance at the lands, 0.0002 m"}, 1e-3);
  expect_refused(narrow_trefoil, {"chord error = 1e-18 m asks for", "points; give a larger one"}, 1e-18);
}

} // namespace support_shapes_test
