// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals/record.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace record_test {

using namespace fretwork::signals;

namespace {

template <class Value> Table record(double interval, int points, Value value) {
  Table out;
  for (int k = 0; k < points; ++k) {
    out.time.push_back(interval * k);
    out.value.push_back(value(interval * k));
  }
  return out;
}

Table sine(double interval, double duration, double w) {
  return record(interval, static_cast<int>(duration / interval) + 1,
                [&](double t) { return std::sin(w * t); });
}

/// The mean of value times sin(w t), twice, of a polygon with corners a step apart.
double amplitude(const std::vector<double>& corners, double step, double w) {
  double sum = 0.0;
  constexpr int parts = 20;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k)
    for (int i = 0; i < parts; ++i) {
      const double s = (i + 0.5) / parts;
      sum +=
          2.0 * std::lerp(corners[k], corners[k + 1], s) * std::sin(w * step * (static_cast<double>(k) + s));
    }
  return sum / (parts * static_cast<double>(corners.size() - 1));
}

} // namespace

TEST(Record, IsATableOfManyPointsAtNearlyEqualIntervals) {
  EXPECT_TRUE(is_record(sine(1e-3, 1.0, 10.0)));
  EXPECT_FALSE(is_record(sine(1e-3, 0.05, 10.0))) << "few points";
  Table jump = sine(1e-3, 1.0, 10.0);
  jump.time[500] = jump.time[499];
  EXPECT_FALSE(is_record(jump));
  Table pulse = sine(1e-3, 1.0, 10.0);
  pulse.time[500] = pulse.time[499] + 2e-4;
  EXPECT_FALSE(is_record(pulse));
}

TEST(Record, ChangesAsFastAsItsSines) {
  constexpr double highest = 1e4;
  for (const double w : {10.0, 300.0, 3000.0})
    EXPECT_NEAR(rate_of_record(sine(2e-5, 2.0, w), highest, 10.0), w, 0.02 * w);
  EXPECT_EQ(rate_of_record(sine(2e-5, 2.0, 3e4), highest, 10.0), highest) << "faster than the modes";
  EXPECT_EQ(rate_of_record(record(1e-3, 100, [](double) { return 3.0; }), highest, 10.0), 0.0);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  EXPECT_EQ(rate_of_record(record(1e-5, 100000, [&](double) { return normal(random); }), highest, 10.0),
            highest);
  // rows before the run and after it do not count
  Table early = record(
      1e-3, 20000, [](double t) { return 5.0 + std::sin(10.0 * t) + (t < 9.0 ? std::sin(900.0 * t) : 0.0); });
  for (double& time : early.time)
    time -= 10.0;
  EXPECT_NEAR(rate_of_record(early, highest, 10.0), 10.0, 0.5);
  EXPECT_NEAR(rate_of_record(early, highest, 5.0), 10.0, 0.5);
  // a small fast part on a large slow one counts by its velocity
  const double both = rate_of_record(
      record(2e-5, 100000, [](double t) { return 100.0 * std::sin(3.0 * t) + std::sin(3000.0 * t); }),
      highest, 10.0);
  EXPECT_GT(both, 2900.0);
}

TEST(Record, IsItsOwnPolygonWhereItIsOne) {
  const auto value = [](double t) { return 2.0 - 3.0 * t; };
  const Table line = record(1e-3, 1001, value);
  const auto corners = nearest_polygon(line, 7e-3, 140);
  for (std::size_t k = 0; k < corners.size(); ++k)
    EXPECT_NEAR(corners[k], value(7e-3 * static_cast<double>(k)), 1e-12);
  Table coarse{{0.5, 1.0}, {1.0, 2.0}}; // held outside, its corners on those of the polygon
  const auto held = nearest_polygon(coarse, 0.25, 7);
  const std::vector<double> expected{1.0, 1.0, 1.0, 1.5, 2.0, 2.0, 2.0};
  for (std::size_t k = 0; k < held.size(); ++k)
    EXPECT_NEAR(held[k], expected[k], 1e-12) << k;
}

TEST(Record, KeepsItsAmplitudesInThePolygon) {
  constexpr double h = 1e-3;
  for (const double w : {200.0, 500.0, 1000.0, 1500.0}) {
    const double x = w * h, wave = std::pow(std::sin(0.5 * x) / (0.5 * x), 4) / ((2.0 + std::cos(x)) / 3.0);
    const double kept = amplitude(nearest_polygon(sine(1e-5, 2.0, w), h, 2001), h, w);
    EXPECT_NEAR(kept, wave, 2e-3) << w; // the sine does not fill the window
    EXPECT_NEAR(kept, 1.0 - std::pow(x, 4) / 720.0, x > 1.2 ? 6e-3 : 3e-3) << w;
  }
  // what is too fast does not come back as its alias, 2 pi/h - w
  const double fast = 2.0 * std::numbers::pi / h - 300.0;
  const auto corners = nearest_polygon(sine(1e-5, 2.0, fast), h, 2001);
  EXPECT_LT(std::abs(amplitude(corners, h, 300.0)), 5e-3);
}

TEST(Record, KeepsItsImpulseInThePolygon) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const Table noise = record(1e-4, 5001, [&](double) { return normal(random); });
  double impulse = 0.0, of_polygon = 0.0;
  for (std::size_t k = 1; k < noise.time.size(); ++k)
    impulse += 0.5 * (noise.value[k - 1] + noise.value[k]) * (noise.time[k] - noise.time[k - 1]);
  const auto corners = nearest_polygon(noise, 1e-3, 501);
  for (std::size_t k = 1; k < corners.size(); ++k)
    of_polygon += 0.5e-3 * (corners[k - 1] + corners[k]);
  EXPECT_NEAR(of_polygon, impulse, 1e-12);
}

} // namespace record_test
