// SPDX-License-Identifier: GPL-3.0-or-later
// Worn areas against textbook forms, limits and the chord by which they grow.
#include "wear/cross_section.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cross_section_test {

using namespace fretwork::wear;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double radius = 9.525e-3, clearance = 2e-4;

constexpr double round_off = 1e-14;
constexpr double lost_to_clearance = 1e-12; ///< round-off over c/R = 0.02, twice
constexpr double textbook = 1e-10;          ///< its terms are 1e4 times the area at the depths tested
constexpr double differenced = 1e-7;        ///< central differences with a relative step of 1e-4: its square

double textbook_segment(double p) {
  return radius * radius * std::acos(1.0 - p / radius) - (radius - p) * std::sqrt(2.0 * radius * p - p * p);
}

double textbook_crescent(double c, double p) {
  const double hole = radius + c, e = c + p;
  const double h_t = (hole * hole - radius * radius - e * e) / (2.0 * e), h_s = h_t + e;
  const double x = std::sqrt(radius * radius - h_t * h_t);
  return radius * radius * std::acos(h_t / radius) - hole * hole * std::acos(h_s / hole) + x * e;
}

} // namespace

TEST(SegmentArea, IsTheTextbookForm) {
  for (const double p : {1e-4, 4e-4, 1e-3, 5e-3, 9e-3})
    EXPECT_NEAR(segment_area(radius, p) / textbook_segment(p), 1.0, textbook) << p;
  EXPECT_NEAR(segment_area(radius, radius) / (0.5 * pi * radius * radius), 1.0, round_off);
  EXPECT_EQ(segment_area(radius, 0.0), 0.0);
}

TEST(SegmentArea, KeepsItsDigitsAtSmallDepths) {
  // A_s = (4/3) sqrt(2 R) p^1.5 (1 - 3 p/(20 R) - 3 p^2/(224 R^2) - ...)
  for (const double p : {1e-15, 1e-12, 1e-9, 1e-8}) {
    const double r = p / radius;
    EXPECT_NEAR(segment_area(radius, p) / (4.0 / 3.0 * std::sqrt(2.0 * radius) * std::pow(p, 1.5)),
                1.0 - 0.15 * r - 3.0 / 224.0 * r * r, round_off)
        << p;
  }
}

TEST(SegmentArea, GrowsByItsChord) {
  for (double p = 1e-9; p < 0.9 * radius; p *= 1.3) {
    const double d = 1e-4 * p;
    const double slope = (segment_area(radius, p + d) - segment_area(radius, p - d)) / (2.0 * d);
    EXPECT_NEAR(slope / (2.0 * std::sqrt(p * (2.0 * radius - p))), 1.0, differenced) << p;
  }
}

TEST(CrescentArea, IsTheTextbookForm) {
  for (const double c : {5e-5, 2e-4, 1e-3})
    for (const double p : {2e-5, 1e-4, 1e-3, 5e-3, 9e-3})
      EXPECT_NEAR(crescent_area(radius, c, p) / textbook_crescent(c, p), 1.0, textbook) << c << " " << p;
}

TEST(CrescentArea, HasItsLimitAtSmallDepths) {
  // (4/3) sqrt(2 R R_h/c) p^1.5, from which the next term takes a share of the order p/c
  const double hole = radius + clearance;
  for (const double share : {1e-12, 1e-9, 1e-6}) {
    const double p = share * clearance;
    const double limit = 4.0 / 3.0 * std::sqrt(2.0 * radius * hole / clearance) * std::pow(p, 1.5);
    EXPECT_NEAR(crescent_area(radius, clearance, p) / limit, 1.0, share + lost_to_clearance) << p;
  }
}

TEST(CrescentArea, HasItsLimitAtNoClearance) {
  for (const double p : {1e-7, 1e-5, 1e-3}) {
    const double equal_circles = 2.0 * radius * radius * std::asin(0.5 * p / radius) +
                                 0.5 * p * std::sqrt(4.0 * radius * radius - p * p);
    EXPECT_NEAR(crescent_area(radius, 0.0, p) / equal_circles, 1.0, round_off) << p;
    constexpr double small = 1e-6; // of p: the area changes by some c/p
    EXPECT_NEAR(crescent_area(radius, small * p, p) / equal_circles, 1.0, 3.0 * small) << p;
  }
}

TEST(CrescentArea, HasTheSegmentAsItsLimitInAWideHole) {
  constexpr double wide = 1e4; // radii: the face is flat to 1/wide
  for (const double p : {1e-6, 1e-4, 1e-3})
    EXPECT_NEAR(crescent_area(radius, wide * radius, p) / segment_area(radius, p), 1.0, 1.0 / wide) << p;
}

TEST(CrescentArea, IsContinuousWhereItsFormsMeet) {
  const double p = clearance * clearance / radius;
  const double below = crescent_area(radius, clearance, p * (1.0 - 1e-9)),
               above = crescent_area(radius, clearance, p * (1.0 + 1e-9));
  EXPECT_NEAR(above / below, 1.0 + 1.5 * 2e-9, 4e-11); // A goes with p^1.5, less p/c = 2 % of its slope
}

TEST(CrescentArea, GrowsByItsChord) {
  const double hole = radius + clearance;
  for (double p = 1e-8; p < 0.9 * radius; p *= 1.5) {
    const double d = 1e-4 * p;
    const double slope =
        (crescent_area(radius, clearance, p + d) - crescent_area(radius, clearance, p - d)) / (2.0 * d);
    const double chord = 2.0 * hole * std::sin(crescent_half_angle(radius, clearance, p));
    EXPECT_NEAR(slope / chord, 1.0, differenced) << p;
  }
}

TEST(LandArea, EqualsTheCrescentWhereItIsWiderThanTheScar) {
  for (const double c : {1e-6, 2e-4, 2e-3})
    for (double p = 1e-9; p < 0.9 * radius; p *= 3.0)
      EXPECT_NEAR(land_area(radius, c, p, -pi, pi) / crescent_area(radius, c, p), 1.0,
                  round_off * radius / std::max(c, p) * 10.0 + lost_to_clearance)
          << c << " " << p; // round-off of the crescent's difference
}

TEST(CrescentArea, HasTheHalfAngleOfItsDepth) {
  for (const double c : {1e-5, 2e-4, 2e-3})
    for (const double angle : {0.05, -0.2, 0.5, 0.9})
      EXPECT_NEAR(crescent_half_angle(radius, c, depth_of_half_angle(radius, c, angle)), std::abs(angle),
                  1e-9); // digits of p/R, of a difference of radii
  EXPECT_GT(depth_of_half_angle(radius, clearance, 0.5 * pi), radius);
  EXPECT_GT(depth_of_half_angle(radius, clearance, 3.0), radius);
}

TEST(LandArea, AddsUpAndIsSymmetric) {
  const double p = 1e-4, edge = crescent_half_angle(radius, clearance, p);
  EXPECT_NEAR(land_area(radius, clearance, p, -edge, 0.1) + land_area(radius, clearance, p, 0.1, edge),
              crescent_area(radius, clearance, p), lost_to_clearance * crescent_area(radius, clearance, p));
  EXPECT_NEAR(land_area(radius, clearance, p, 0.1, 0.4) / land_area(radius, clearance, p, -0.4, -0.1), 1.0,
              round_off);
  EXPECT_EQ(land_area(radius, clearance, p, edge + 1e-6, 2.0), 0.0); // beyond the scar
  EXPECT_EQ(land_area(radius, clearance, 0.0, -1.0, 1.0), 0.0);
}

} // namespace cross_section_test
