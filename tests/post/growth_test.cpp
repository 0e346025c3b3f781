// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/growth.hpp"
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

namespace growth_test {

using namespace fretwork;

namespace {

constexpr double step = 1e-3;

/// Energies of a narrow-band random vibration whose amplitude forgets in `memory` steps and grows by a rate, 1/s.
std::vector<double> random_vibration(std::mt19937_64& generator, std::size_t count, double memory,
                                     double rate) {
  std::normal_distribution<double> normal;
  const auto draw = [&] {
    const double real = normal(generator);
    return std::complex<double>(real, normal(generator));
  };
  const double kept = std::exp(-1.0 / memory), added = std::sqrt(1.0 - kept * kept);
  std::complex<double> amplitude = draw();
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) {
    out.push_back(std::norm(amplitude) * std::exp(2.0 * rate * step * static_cast<double>(i)));
    amplitude = kept * amplitude + added * draw();
  }
  return out;
}

double share_that_grows(std::size_t count, double memory, double rate) {
  std::mt19937_64 generator(1);
  constexpr int runs = 1000;
  int growing = 0;
  for (int i = 0; i < runs; ++i)
    growing += post::amplitude_growth(random_vibration(generator, count, memory, rate), step)->significant;
  return static_cast<double>(growing) / runs;
}

} // namespace

TEST(AmplitudeGrowth, OfAnExponentialHasNoScatter) {
  constexpr double rate = 1.7, digits = 1e-9;
  for (const std::size_t count : {128u, 1000u, 1023u}) {
    std::vector<double> energies;
    for (std::size_t i = 0; i < count; ++i)
      energies.push_back(3.0 * std::exp(2.0 * rate * step * static_cast<double>(i)));
    const auto growth = post::amplitude_growth(energies, step);
    ASSERT_TRUE(growth);
    EXPECT_NEAR(growth->rate, rate, digits);
    EXPECT_NEAR(growth->error, 0.0, digits);
    EXPECT_NEAR(growth->rms_ratio, std::exp(0.5 * rate * step * static_cast<double>(count)), digits);
    EXPECT_TRUE(growth->significant);
    for (double& energy : energies)
      energy = 1.0 / energy;
    EXPECT_NEAR(post::amplitude_growth(energies, step)->rate, -rate, digits);
    EXPECT_FALSE(post::amplitude_growth(energies, step)->significant) << "it decays";
  }
}

TEST(AmplitudeGrowth, OfLessThanTwoPerCentIsNone) {
  const auto grows = [](double ratio) {
    std::vector<double> energies;
    for (int i = 0; i < 320; ++i)
      energies.push_back(std::pow(ratio, 2.0 * i / 160.0));
    return post::amplitude_growth(energies, step)->significant;
  };
  EXPECT_FALSE(grows(1.01));
  EXPECT_TRUE(grows(1.03));
}

/// The probability is that of the warning: 1 % of stationary motions, whatever they remember.
TEST(AmplitudeGrowth, IsSeldomFoundInAStationaryMotion) {
  for (const double memory : {2.0, 20.0, 200.0, 1000.0})
    EXPECT_LT(share_that_grows(2000, memory, 0.0), 0.035) << memory << " steps";
  EXPECT_GT(share_that_grows(2000, 20.0, 0.5), 0.75); // 1.65 times the rms from half to half, in 100 memories
}

TEST(AmplitudeGrowth, OfFewEnergiesOrARestIsNotKnown) {
  EXPECT_FALSE(post::amplitude_growth(std::vector<double>(127, 1.0), step));
  EXPECT_TRUE(post::amplitude_growth(std::vector<double>(128, 1.0), step));
  EXPECT_FALSE(post::amplitude_growth(std::vector<double>(128, 1.0), step)->significant);
  EXPECT_FALSE(post::amplitude_growth(std::vector<double>(128, 0.0), step));
  std::vector<double> diverged(128, 1.0);
  diverged.back() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(post::amplitude_growth(diverged, step));
}

} // namespace growth_test
