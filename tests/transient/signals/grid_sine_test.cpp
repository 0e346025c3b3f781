// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/signals/grid_sine.hpp"
#include <cstring>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace grid_sine_test {

using namespace fretwork::transient;

namespace {

constexpr Harmonic wave{3.0, 21.7, 0.4};
double sine(double time) {
  return wave.amplitude * std::sin(2.0 * std::numbers::pi * wave.frequency * time + wave.phase);
}
/// Of the angles at the point, at the begin of its block and between, and of four operations.
double round_off(double time) {
  return wave.amplitude * 1.2e-16 * (4.0 + 3.0 * 2.0 * std::numbers::pi * wave.frequency * time);
}

} // namespace

TEST(GridSine, IsTheSineOnItsGridAndElsewhere) {
  const double d = 3.1e-5;
  GridSine at(wave, d);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> any(0.0, 10.0);
  for (int i = 0; i < 1000; ++i) {
    const double time = any(generator), point = std::floor(time / d) * d;
    EXPECT_NEAR(at(point), sine(point), round_off(point)) << point;
    EXPECT_EQ(at(time), sine(time)) << time;
  }
  for (std::int64_t k = 0; k < 1000; ++k)
    EXPECT_NEAR(at(static_cast<double>(k) * d), sine(static_cast<double>(k) * d), round_off(1000 * d)) << k;
  EXPECT_EQ(at(0.0), sine(0.0));
}

// Runs that begin again at a checkpoint, and instants that somebody asks for between steps, must not change a byte.
TEST(GridSine, DoesNotRememberWhatItGave) {
  const double d = 1e-4;
  GridSine in_order(wave, d), back(wave, d);
  std::vector<double> values;
  for (int k = 0; k < 1000; ++k)
    values.push_back(in_order(k * d));
  for (int k = 999; k >= 0; --k)
    EXPECT_EQ(back(k * d), values[static_cast<std::size_t>(k)]) << k;
}

} // namespace grid_sine_test
