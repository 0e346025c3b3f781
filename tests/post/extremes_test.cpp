// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/extremes.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace extremes_test {

using fretwork::core::StateArchive;
using fretwork::post::Extremes;

constexpr double h = 0.1;

/// Of one signal, equally spaced.
Extremes of(const std::vector<double>& samples) {
  Extremes out(1);
  for (std::size_t i = 0; i < samples.size(); ++i)
    out.watch(&samples[i], h * static_cast<double>(i));
  return out;
}

TEST(Extremes, AreThoseOfSamplesWhereTheseGoOneWay) {
  const Extremes up = of({-1.0, 2.0, 7.0, 7.5});
  EXPECT_EQ(up.min(0), -1.0);
  EXPECT_EQ(up.max(0), 7.5);
  EXPECT_EQ(Extremes(1).max(0), 0.0) << "before the first sample";
}

TEST(Extremes, FindTheCrestsOfAParabola) {
  std::vector<double> samples;
  for (const double t : {-2.0, -1.0, 0.0, 1.0, 2.0})
    samples.push_back(5.0 - 3.0 * (t - 0.3) * (t - 0.3));
  EXPECT_DOUBLE_EQ(of(samples).max(0), 5.0);
  EXPECT_DOUBLE_EQ(of(samples).min(0), samples.front());
  for (double& value : samples)
    value = -value;
  EXPECT_DOUBLE_EQ(of(samples).min(0), -5.0);
}

TEST(Extremes, OfTwoEqualSamplesAreBetweenThem) {
  EXPECT_DOUBLE_EQ(of({0.0, 1.0, 1.0, 0.0}).max(0), 1.125);
  EXPECT_DOUBLE_EQ(of({1.0, 1.0, 1.0}).max(0), 1.0);
}

TEST(Extremes, OfASineOfTenSamplesAPeriodAreNearItsCrests) {
  constexpr double bound = 3.6e-3; // halfway between a sample and the middle of two: 3.5e-3
  for (int k = 0; k < 20; ++k) {
    std::vector<double> samples;
    for (int i = 0; i < 10; ++i)
      samples.push_back(std::sin(2.0 * std::numbers::pi * (i / 10.0 + k / 200.0)));
    samples.push_back(samples[0]);
    samples.push_back(samples[1]);
    EXPECT_NEAR(of(samples).max(0), 1.0, bound) << k;
    EXPECT_NEAR(of(samples).min(0), -1.0, bound) << k;
  }
}

TEST(Extremes, OfWhatAlternatesOrBouncesExceedNoSampleByMuch) {
  EXPECT_DOUBLE_EQ(of({-1.0, 1.0, -1.0, 1.0}).max(0), 1.0);
  EXPECT_DOUBLE_EQ(of({0.2, 0.9, 0.4, -0.1}).max(0), 0.9 + 0.2 * 0.2 / (8.0 * 1.2)) << "off a stop";
}

TEST(Extremes, AreThoseOfSamplesWhereSpacingsDiffer) {
  Extremes uneven(1);
  for (const auto& [value, time] : {std::pair{0.0, 0.0}, {1.0, h}, {1.0, 1.5 * h}, {0.5, 2.5 * h}})
    uneven.watch(&value, time);
  EXPECT_EQ(uneven.max(0), 1.0);
}

TEST(Extremes, GoOnFromACheckpointBeforeACrest) {
  const std::vector<double> samples = {0.0, 0.8, 1.0, 0.4, 0.0};
  for (std::size_t cut = 1; cut < samples.size(); ++cut) {
    Extremes before(1), after(1);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (i == cut) {
        StateArchive saved;
        before.visit(saved);
        StateArchive restored(std::move(saved).bytes());
        after.visit(restored);
        restored.end();
      }
      (i < cut ? before : after).watch(&samples[i], h * static_cast<double>(i));
    }
    EXPECT_EQ(after.max(0), of(samples).max(0)) << cut;
  }
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
    all.watch(values.data(), h * i);
    for (std::size_t k = 0; k < signals; ++k)
      each[k].watch(&values[k], h * i);
  }
  for (std::size_t k = 0; k < signals; ++k) {
    EXPECT_EQ(all.min(k), each[k].min(0)) << k;
    EXPECT_EQ(all.max(k), each[k].max(0)) << k;
  }
}

} // namespace extremes_test
