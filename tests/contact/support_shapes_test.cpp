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
using contact::Location;
using contact::PlaneAxis;
using contact::Profile;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double tube = 9.525e-3;   // m, of 3/4 inch
constexpr double round_off = 1e-17; // m: a few units in the last place of a radius

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
}

TEST(SupportShapes, RefuseATubeThatDoesNotFit) {
  expect_refused([] { (void)contact::drilled_hole(1.0, 0.9); },
                 {"hole radius = 0.9 m is less than the tube radius, 1 m", "give at least"});
  expect_refused(
      [] { (void)contact::flat_bars(1.0, 0.9, PlaneAxis::y, BarSides::two); },
      {"distance = 0.9 m is less", "Bars that press on the tube are two contacts of one bar each"});
  expect_refused([] { (void)contact::flat_bars_between(1.0, 0.9, 1.0, PlaneAxis::y); },
                 {"half the distance between the bars = 0.95 m is less", "negative offset"});
  expect_refused([] { (void)contact::flat_bars_between(1.0, -1.1, 1.1, PlaneAxis::y); },
                 {"flat bars: -1.1 m", "leave nothing between the bars; give two distances > 0"});
  expect_refused([] { (void)contact::egg_crate(1.0, 0.9, 2.0); }, {"half width along y = 0.9 m is less"});
  expect_refused([] { (void)contact::egg_crate(1.0, 2.0, 1.0); },
                 {"half width along z = 1 m", "leaves no room"});
}

} // namespace support_shapes_test
