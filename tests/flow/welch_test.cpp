// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/welch.hpp"
#include "turbulent_zone.hpp"
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace welch_test {

using namespace fretwork;
using namespace fretwork::flow;

namespace {

std::vector<double> white_noise(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> noise;
  std::vector<double> out(count);
  for (double& value : out)
    value = noise(generator);
  return out;
}

} // namespace

TEST(Welch, GivesASineItsVariance) {
  std::vector<double> series;
  for (int j = 0; j < 20000; ++j)
    series.push_back(7.0 + 3.0 * std::sin(2.0 * pi * 12.5 * 1e-3 * j));
  const PowerSpectrum p = welch(series, 1e-3, 0.5);
  EXPECT_DOUBLE_EQ(p.frequency[1], 0.5);
  EXPECT_DOUBLE_EQ(p.frequency.back(), 500.0);
  EXPECT_EQ(p.segments, 19u);
  const double variance = std::accumulate(p.density.begin(), p.density.end(), 0.0) * 0.5;
  constexpr double round_off = 1e-10;
  EXPECT_NEAR(variance, 4.5, round_off);
  EXPECT_NEAR(p.density[25] * 0.5 * 1.5, 4.5,
              round_off); // a line has two thirds of it in the middle: width 1.5 of the Hann window
  EXPECT_NEAR(p.density[0], 0.0, round_off); // the mean is taken away
}

TEST(Welch, GivesWhiteNoiseItsDensityWithinTheBand) {
  constexpr double step = 0.01; // variance 1 up to 50 Hz: 0.02/Hz
  const PowerSpectrum p = welch(white_noise(400000, 3), step, 0.25);
  double mean = 0.0, within = 0.0;
  const auto lines = static_cast<double>(p.density.size() - 4);
  for (std::size_t k = 2; k + 2 < p.density.size(); ++k) {
    mean += p.density[k] / lines;
    within += (p.lower * p.density[k] < 0.02 && 0.02 < p.upper * p.density[k]) / lines;
  }
  constexpr double of_the_mean = 0.008; // three standard deviations of 4000 s
  EXPECT_NEAR(mean / 0.02, 1.0, of_the_mean);
  constexpr double of_the_share = 0.06; // 196 lines, neighbours correlated
  EXPECT_NEAR(within, 0.95, of_the_share);
  EXPECT_LT(p.lower, 1.0);
  EXPECT_GT(p.upper, 1.0);
}

TEST(Welch, FindsTheSpectrumOfTwoSignalsAndTheirDelay) {
  const std::vector<double> x = white_noise(200000, 5), noise = white_noise(200000, 6);
  WelchEstimate estimate(2, 0.01, 400);
  for (std::size_t j = 3; j < x.size(); ++j)
    estimate.add(
        std::vector<double>{x[j], x[j - 3] + 0.5 * noise[j]}); // y is x delayed by 0.03 s, with noise
  const CrossPowerSpectrum c = estimate.cross(0, 1), reverse = estimate.cross(1, 0);
  constexpr double tolerance = 0.08; // 1000 segments: 3 % a line, three standard deviations
  for (std::size_t k = 5; k < 200; k += 13) {
    EXPECT_NEAR(c.coherence(k), 0.8, tolerance);
    EXPECT_NEAR(std::abs(c.xy[k] / 0.02 - std::polar(1.0, 2.0 * pi * c.frequency[k] * 0.03)), 0.0,
                tolerance * 1.5);
    EXPECT_EQ(reverse.xy[k], std::conj(c.xy[k]));
  }
}

TEST(Welch, KnowsTheQuantilesOfChiSquare) {
  constexpr double printed = 5e-4; // tables of four digits
  EXPECT_NEAR(chi_square_quantile(2.0, 0.95), 5.9915, printed);
  EXPECT_NEAR(chi_square_quantile(10.0, 0.025), 3.2470, printed);
  EXPECT_NEAR(chi_square_quantile(10.0, 0.975), 20.4832, printed);
  EXPECT_NEAR(chi_square_quantile(100.0, 0.975), 129.5612, printed);
  EXPECT_NEAR(chi_square_quantile(2.0, 0.5), 2.0 * std::log(2.0), 1e-12);
  EXPECT_NEAR(chi_square_quantile(1e5, 0.975),
              1e5 + 1.959964 * std::sqrt(2e5) + 2.0 * (1.959964 * 1.959964 - 1.0) / 3.0, 0.05);
}

TEST(Welch, RefusesWrongInput) {
  const std::vector<double> brief(20, 1.0);
  EXPECT_EQ(message_of([] { WelchEstimate(0, 0.1, 8); }), "power spectra of no signal; give one at least");
  EXPECT_EQ(message_of([] { WelchEstimate(1, 0.0, 8); }),
            "a step of 0 s between samples makes no sense; give one > 0");
  EXPECT_EQ(message_of([] { WelchEstimate(1, 0.1, 9); }),
            "segments of 9 samples make no power spectrum; give an even number from 8 to 2^30");
  EXPECT_EQ(message_of([&] { (void)welch(brief, 0.1, 0.1); }),
            "a power spectrum by segments of 100 samples of 0.1 s needs one at least, the signal has 20; ask "
            "for a wider resolution "
            "or a longer run");
  EXPECT_EQ(
      message_of([&] { (void)welch(brief, 0.1, 5.0); }),
      "a resolution of 5 Hz makes no power spectrum of samples of 0.1 s; give one > 0 and at most 1.25 Hz");
  EXPECT_EQ(message_of([] { (void)chi_square_quantile(10.0, 1.0); }),
            "no quantile 1 of a chi-square variable of 10 degrees of freedom; give a probability between 0 "
            "and 1, and up to 1e6 "
            "degrees of freedom");
}

} // namespace welch_test
