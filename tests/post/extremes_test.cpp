// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/extremes.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace extremes_test {

using fretwork::post::Extremes;

constexpr double h = 0.1;

/// Of one signal with equal steps.
Extremes of(const std::vector<double>& samples) {
  Extremes out(1);
  for (const double value : samples)
    out.watch(&value, h);
  return out;
}

TEST(Extremes, AreThoseOfSamplesWhereTheseGoOneWay) {
  const Extremes up = of({-1.0, 2.0, 7.0, 7.5});
  EXPECT_EQ(up.least(0), -1.0);
  EXPECT_EQ(up.most(0), 7.5);
  EXPECT_EQ(Extremes(1).most(0), 0.0) << "before the first sample";
}

TEST(Extremes, FindTheCrestsOfAParabola) {
  std::vector<double> samples;
  for (const double t : {-2.0, -1.0, 0.0, 1.0, 2.0})
    samples.push_back(5.0 - 3.0 * (t - 0.3) * (t - 0.3));
  EXPECT_DOUBLE_EQ(of(samples).most(0), 5.0);
  EXPECT_DOUBLE_EQ(of(samples).least(0), samples.front());
  for (double& value : samples)
    value = -value;
  EXPECT_DOUBLE_EQ(of(samples).least(0), -5.0);
}

TEST(Extremes, OfTwoEqualSamplesAreBetweenThem) {
  EXPECT_DOUBLE_EQ(of({0.0, 1.0, 1.0, 0.0}).most(0), 1.125);
  EXPECT_DOUBLE_EQ(of({1.0, 1.0, 1.0}).most(0), 1.0);
}

TEST(Extremes, OfASineOfTenSamplesAPeriodAreWithinHalfAPerCent) {
  for (int k = 0; k < 20; ++k) {
    std::vector<double> samples;
    for (int i = 0; i < 10; ++i)
      samples.push_back(std::sin(2.0 * std::numbers::pi * (i / 10.0 + k / 200.0)));
    samples.push_back(samples[0]);
    samples.push_back(samples[1]);
    EXPECT_NEAR(of(samples).most(0), 1.0, 4e-3) << k;
    EXPECT_NEAR(of(samples).least(0), -1.0, 4e-3) << k;
  }
}

TEST(Extremes, OfWhatAlternatesOrBouncesExceedNoSampleByMuch) {
  EXPECT_DOUBLE_EQ(of({-1.0, 1.0, -1.0, 1.0}).most(0), 1.0);
  EXPECT_LE(of({0.2, 0.9, 0.4, -0.1}).most(0), 0.9 + (0.4 - 0.2) / 8.0) << "off a stop";
}

TEST(Extremes, AreThoseOfSamplesWhereStepsDiffer) {
  Extremes uneven(1);
  for (const auto& [value, step] : {std::pair{0.0, h}, {1.0, 0.5 * h}, {1.0, h}, {0.5, h}})
    uneven.watch(&value, step);
  EXPECT_EQ(uneven.most(0), 1.0);
}

TEST(Extremes, OfSeveralSignalsAreThoseOfEach) {
  constexpr std::size_t signals = 11; // more than a vector has numbers, no multiple of it
  Extremes all(signals);
  std::vector<Extremes> each(signals, Extremes(1));
  for (int i = 0; i < 40; ++i) {
    std::vector<double> values;
    for (std::size_t k = 0; k < signals; ++k)
      values.push_back(std::sin(0.5 * i + static_cast<double>(k)) +
                       0.3 * std::sin(1.1 * i * (1.0 + static_cast<double>(k))));
    all.watch(values.data(), h);
    for (std::size_t k = 0; k < signals; ++k)
      each[k].watch(&values[k], h);
  }
  for (std::size_t k = 0; k < signals; ++k) {
    EXPECT_EQ(all.least(k), each[k].least(0)) << k;
    EXPECT_EQ(all.most(k), each[k].most(0)) << k;
  }
}

} // namespace extremes_test
