// SPDX-License-Identifier: GPL-3.0-or-later
// The band of turbulent forces and the blocks of their draws: closed forms of cor_3, and independence of modes.
#include "flow/cross_spectrum.hpp"
#include "flow/load_band.hpp"
#include "turbulent_zone.hpp"
#include <gtest/gtest.h>

namespace fretwork::flow::load_band_test {
namespace {

constexpr double of_sums = 5e-3; ///< trapezia of 12 points an octave across a corner

/// int of Phi of cor_3 from 0 to x = f_r.
double cor_3_up_to(double x) {
  const double low = 2.0 * 5e-3 * std::sqrt(std::min(x, 0.2));
  return x <= 0.2 ? low : low + 4e-5 / 2.5 * (std::pow(0.2, -2.5) - std::pow(x, -2.5));
}

TurbulentZone zone_of(const Spectrum& spectrum) {
  TurbulentZone zone = pinned_zone(1.0, 0.06, 100, 3);
  zone.spectrum = spectrum;
  return zone;
}

TEST(LoadBand, EndsWhereAThousandthOfTheForceIsAbove) {
  const LoadBand band = load_band({zone_of(Cor3{})});
  constexpr double per_hz = 0.01905 / 1.5, all = 5.366563e-3; // D/V; 2 5e-3 sqrt(0.2) + 1.6e-5 0.2^-2.5
  EXPECT_NEAR(cor_3_up_to(1e9) / all, 1.0, 1e-6);
  EXPECT_EQ(band.low, 0.0);
  EXPECT_EQ(band.below, 0.0);
  EXPECT_EQ(band.above, lost_above_band);
  EXPECT_NEAR(band.high / (std::pow(1e-3 * all / 1.6e-5, -0.4) / per_hz), 1.0, of_sums);
  EXPECT_GE(band.high * band.block_period, 1024.0);
  EXPECT_LT(band.high * band.block_period, 2048.0);
  EXPECT_EQ(std::log2(band.block_period), std::floor(std::log2(band.block_period)));
}

TEST(LoadBand, SaysWhatAGivenOneLoses) {
  const LoadBand band = load_band({zone_of(Cor3{})}, 2.0, 50.0);
  constexpr double per_hz = 0.01905 / 1.5;
  const double all = cor_3_up_to(1e9);
  EXPECT_EQ(band.low, 2.0);
  EXPECT_EQ(band.high, 50.0);
  EXPECT_NEAR(band.below, cor_3_up_to(2.0 * per_hz) / all, of_sums);
  EXPECT_NEAR(band.above, 1.0 - cor_3_up_to(50.0 * per_hz) / all, of_sums);
}

TEST(LoadBand, DoesNotDependOnTheModesNorOnTheScaleOfVelocity) {
  const TurbulentZone zone = zone_of(Cor3{});
  TurbulentZone other = zone;
  other.axes[0].shapes = 7.0 * zone.axes[0].shapes.topRows(1);
  EXPECT_EQ(load_band({zone}).high, load_band({other}).high);
  TurbulentZone slow = zone;
  slow.velocity *= 0.125; // as many lines a block: cost and memory are those of the faster flow
  EXPECT_NEAR(load_band({slow}).high * 8.0 / load_band({zone}).high, 1.0, of_sums);
  EXPECT_EQ(load_band({slow}).block_period, 8.0 * load_band({zone}).block_period);
}

TEST(LoadBand, GivesTheMeanSquareOfModalForces) {
  const TurbulentZone zone = zone_of(white(2.0));
  const LoadBand band = load_band({zone}, 10.0, 60.0);
  const Eigen::VectorXd squares = modal_mean_squares({zone}, band);
  const Eigen::MatrixXd g = CrossSpectrum({zone})(20.0);
  for (Eigen::Index i = 0; i < squares.size(); ++i)
    EXPECT_NEAR(squares(i) / (50.0 * g(i, i)), 1.0, 1e-3) << i; // trapezia of f in ln f: (ln 2/12)^2/12
}

TEST(LoadBand, RefusesForcesThatAreNoneAndBandsThatAreNone) {
  TurbulentZone still = zone_of(Cor3{});
  still.velocity.setZero();
  EXPECT_NE(message_of([&] { (void)load_band({still}); }).find("velocity is 0"), std::string::npos);
  TurbulentZone zone = zone_of(Cor3{});
  EXPECT_NE(message_of([&] { (void)load_band({zone}, 5.0, 5.0); }).find("low < high"), std::string::npos);
  zone.axes[0].weight = 0.0;
  EXPECT_NE(message_of([&] { (void)load_band({zone}); }).find("no random force"), std::string::npos);
}

} // namespace
} // namespace fretwork::flow::load_band_test
