// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/student.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace student_test {

using fretwork::wear::student_factor;

TEST(StudentFactor, IsThatOfPrintedTables) {
  // M. Abramowitz, I. Stegun, Handbook of Mathematical Functions, table 26.10, three decimals
  constexpr double printed = 5.1e-4;
  EXPECT_NEAR(student_factor(1.0, 0.95), 12.706, printed);
  EXPECT_NEAR(student_factor(7.0, 0.95), 2.365, printed);
  EXPECT_NEAR(student_factor(7.0, 0.99), 3.499, printed);
  EXPECT_NEAR(student_factor(30.0, 0.95), 2.042, printed);
  EXPECT_NEAR(student_factor(120.0, 0.9), 1.658, printed);
}

TEST(StudentFactor, HasClosedFormsForOneTwoAndManyDegrees) {
  constexpr double tolerance = 1e-9;
  for (const double confidence : {0.1, 0.5, 0.6827, 0.95, 0.999}) {
    const double one = std::tan(0.5 * std::numbers::pi * confidence),
                 two = confidence * std::sqrt(2.0 / (1.0 - confidence * confidence));
    EXPECT_NEAR(student_factor(1.0, confidence) / one, 1.0, tolerance) << confidence;
    EXPECT_NEAR(student_factor(2.0, confidence) / two, 1.0, tolerance) << confidence;
    // normal: the share within +- z standard deviations
    constexpr double of_many = 1e-5;
    EXPECT_NEAR(std::erf(student_factor(1e6, confidence) / std::numbers::sqrt2), confidence, of_many);
  }
}

TEST(StudentFactor, FallsWithTheDegreesOfFreedom) {
  for (double degrees = 1.0; degrees < 100.0; degrees += 0.5)
    EXPECT_GT(student_factor(degrees, 0.95), student_factor(degrees + 0.5, 0.95)) << degrees;
}

} // namespace student_test
