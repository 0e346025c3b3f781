// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/profile.hpp"
#include "core/error.hpp"
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string>

namespace profile_errors_test {

using namespace fretwork;
using contact::PolarPoint;
using contact::Profile;

namespace {

constexpr double pi = std::numbers::pi;

std::string message_of(const std::vector<PolarPoint>& points) {
  try {
    const Profile profile(points);
  } catch (const core::Error& error) {
    return error.what();
  }
  return "no error";
}
void expect_refused(const std::vector<PolarPoint>& points, std::initializer_list<const char*> parts) {
  const std::string message = message_of(points);
  for (const char* part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
}
constexpr double degree = pi / 180.0;

} // namespace

TEST(Profile, RefusesTooFewPoints) {
  expect_refused({}, {"0 points do not enclose a hole", "at least 3"});
  expect_refused({{0.0, 1.0}}, {"1 point does not enclose"});
  expect_refused({{0.0, 1.0}, {2.0, 1.0}}, {"2 points do not enclose"});
  expect_refused({{0.0, 1.0}, {pi, 1.0}, {2.0 * pi, 1.0}}, {"2 points do not enclose"});
}

TEST(Profile, RefusesMoreThanAMillionPoints) {
  expect_refused(std::vector<PolarPoint>(1000001, {0.0, 1.0}), {"1000001 points", "at most 1000000"});
}

TEST(Profile, RefusesValuesThatAreNoAngleOrRadius) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  expect_refused({{0.0, 1.0}, {2.0, nan}, {4.0, 1.0}},
                 {"point 2 (114.59", "not a finite number", "give an angle"});
  expect_refused({{0.0, 1.0}, {2.0, 1.0}, {inf, 1.0}}, {"point 3 (inf degrees, 1 m)", "not a finite number"});
  expect_refused({{0.0, 1.0}, {2.0, 0.0}, {4.0, 1.0}}, {"point 2", "0 m", "no positive radius", "> 0"});
  expect_refused({{0.0, -1e-3}, {2.0, 1.0}, {4.0, 1.0}},
                 {"point 1 (0 degrees, -0.001 m) has no positive radius"});
  expect_refused({{0.0, 1e-200}, {2.0, 1.0}, {4.0, 1.0}}, {"point 1", "no size of a hole", "metres"});
  expect_refused({{0.0, 1e200}, {2.0, 1.0}, {4.0, 1.0}}, {"point 1", "no size of a hole", "metres"});
}

TEST(Profile, RefusesAnglesOutOfOrder) {
  expect_refused({{0.0, 1.0}, {120 * degree, 1.0}, {90 * degree, 1.0}, {240 * degree, 1.0}},
                 {"point 3 (90 degrees, 1 m) comes after point 2 (120 degrees, 1 m)", "sort the points"});
  expect_refused({{0.0, 1.0}, {2.0, 1.0}, {2.0, 1.0}, {4.0, 1.0}},
                 {"point 2", "point 3", "are equal; leave one out"});
  expect_refused({{0.0, 1.0}, {2.0, 1.0}, {2.0, 1.5}, {4.0, 1.0}},
                 {"point 2", "point 3", "have the same angle"});
  expect_refused({{0.0, 1.0}, {2.0, 1.0}, {4.0, 1.0}, {4.0 + 1e-15, 1.0}},
                 {"point 3", "point 4", "equal to rounding"});
}

TEST(Profile, RefusesMoreThanATurn) {
  expect_refused(
      {{0.0, 1.0}, {120 * degree, 1.0}, {240 * degree, 1.0}, {370 * degree, 1.0}},
      {"point 4 (370 degrees, 1 m) is more than one turn after point 1 (0 degrees, 1 m)", "360 degrees"});
  expect_refused({{0.0, 1.0}, {120 * degree, 1.0}, {240 * degree, 1.0}, {360 * degree, 1.1}},
                 {"point 4 (360 degrees, 1.1 m) closes the turn but is not point 1", "leave the last out"});
}

TEST(Profile, RefusesAHoleWithoutItsOrigin) {
  expect_refused({{0.0, 1.0}, {60 * degree, 1.0}, {120 * degree, 1.0}},
                 {"point 3 (120 degrees, 1 m) and point 1 (0 degrees, 1 m)", "240 degrees", "not inside",
                  "move the origin"});
  expect_refused({{0.0, 1.0}, {180 * degree, 1.0}, {270 * degree, 1.0}},
                 {"point 1", "point 2", "180 degrees", "not inside"});
}

TEST(Profile, RefusesALastPointThatNearlyRepeatsTheFirst) {
  expect_refused({{0.0, 1.0}, {120 * degree, 1.0}, {240 * degree, 1.0}, {359.99999 * degree, 1.0 + 1e-7}},
                 {"point 4 (359.99999 degrees, 1 m) nearly repeats point 1 (0 degrees, 1 m)",
                  "does not close the hole", "repeat the first point exactly"});
  // a step in the radius or in the angle is a facet, however short
  EXPECT_EQ(
      message_of({{0.0, 1.0}, {120 * degree, 1.0}, {240 * degree, 1.0}, {359.99999 * degree, 1.0 + 1e-5}}),
      "no error");
  EXPECT_EQ(message_of({{0.0, 1.0}, {120 * degree, 1.0}, {240 * degree, 1.0}, {359.999 * degree, 1.0}}),
            "no error");
}

TEST(Profile, RefusesAPolygonThatCrossesItselfOrTurnsBack) {
  // a pentagram: its points in the order of its strokes
  expect_refused(
      {{0.0, 1.0}, {144 * degree, 1.0}, {288 * degree, 1.0}, {72 * degree, 1.0}, {216 * degree, 1.0}},
      {"point 4 (72 degrees, 1 m) comes after point 3 (288 degrees, 1 m)", "increasing angle"});
  // a hook, one of whose sides the origin does not see
  expect_refused(
      {{0.0, 1.0}, {60 * degree, 1.0}, {50 * degree, 2.0}, {120 * degree, 2.0}, {240 * degree, 1.0}},
      {"point 3 (50 degrees, 2 m) comes after point 2 (60 degrees, 1 m)", "increasing angle"});
  // clockwise
  expect_refused({{240 * degree, 1.0}, {120 * degree, 1.0}, {0.0, 1.0}},
                 {"point 2 (120 degrees, 1 m) comes after point 1 (240 degrees, 1 m)"});
}

TEST(Profile, RefusesAnIncompleteTurn) {
  expect_refused({{0.0, 1.0}, {60 * degree, 1.0}, {120 * degree, 1.0}, {180 * degree, 1.0}},
                 {"between point 4 (180 degrees, 1 m) and point 1 (0 degrees, 1 m) the angle is 180 degrees",
                  "leave less than 180"});
}

} // namespace profile_errors_test
