// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/moments.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>

namespace moments_test {

using namespace fretwork::post;

TEST(Accumulator, GivesMeanAndDeviation) {
  Accumulator a;
  for (const double x : {1.0, 2.0, 4.0, 5.0})
    a.add(x, 0.1);
  EXPECT_DOUBLE_EQ(a.mean(), 3.0);
  EXPECT_DOUBLE_EQ(a.std(), std::sqrt(2.5));
}

TEST(Accumulator, WeighsASampleAsIfItHadComeInParts) {
  Accumulator whole, parts;
  for (const auto& [x, weight] : {std::pair{1.0, 0.5}, {4.0, 0.25}, {-2.0, 1.0}}) {
    whole.add(x, weight);
    for (int i = 0; i < 2; ++i)
      parts.add(x, 0.5 * weight);
  }
  EXPECT_DOUBLE_EQ(whole.mean(), (0.5 + 1.0 - 2.0) / 1.75);
  EXPECT_DOUBLE_EQ(whole.std(), std::sqrt((0.5 + 4.0 + 4.0) / 1.75 - whole.mean() * whole.mean()));
  EXPECT_EQ(parts.mean(), whole.mean()); // powers of two: no rounding
  EXPECT_EQ(parts.std(), whole.std());
}

TEST(Accumulator, OfNothingIsZero) {
  EXPECT_EQ(Accumulator().mean(), 0.0);
  EXPECT_EQ(Accumulator().std(), 0.0);
}

TEST(Accumulator, OfOneSampleIsTheSample) {
  Accumulator a;
  a.add(-3.5, 0.1);
  EXPECT_EQ(a.mean(), -3.5);
  EXPECT_EQ(a.std(), 0.0);
}

TEST(Accumulator, KeepsASmallMotionAboutALargeMean) {
  constexpr int n = 100000;
  constexpr double mean = 1e6, amplitude = 1e-3;
  Accumulator a;
  for (int i = 0; i < n; ++i)
    a.add(mean + amplitude * std::sin(2.0 * std::numbers::pi * 10.0 * i / n), 0.1);
  constexpr double last_digit =
      1e-6; // 1e-10 of the mean's own resolution against 1e-3: squares of it would keep nothing
  EXPECT_NEAR(a.std() / (amplitude / std::numbers::sqrt2), 1.0, last_digit);
  EXPECT_NEAR(a.mean(), mean, 1e-9);
}

} // namespace moments_test
