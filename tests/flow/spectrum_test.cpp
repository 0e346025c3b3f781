// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/spectrum.hpp"
#include "turbulent_zone.hpp"
#include <gtest/gtest.h>

namespace spectrum_test {

using namespace fretwork;
using namespace fretwork::flow;

namespace {

constexpr double seven_digits = 5e-7; ///< relative: the reference values have seven

constexpr double diameter = 0.01905, lambda = 3.4 * diameter;

/// rho 740 kg/m3, V 1.5 m/s, D 19.05 mm.
PointSpectrum at(const Spectrum& spectrum, double reynolds = 2e4, double void_fraction = 0.0,
                 double velocity = 1.5) {
  return PointSpectrum(spectrum,
                       {velocity, 740.0, void_fraction, velocity * diameter / reynolds, diameter, 740.0},
                       lambda, false, "zone 'a'");
}

void expect_near(double value, double reference) {
  EXPECT_NEAR(value, reference, seven_digits * std::abs(reference));
}

void expect_reduced(const PointSpectrum& spectrum, double at_005, double at_02, double at_1) {
  expect_near(spectrum.reduced(0.05), at_005);
  expect_near(spectrum.reduced(0.2), at_02);
  expect_near(spectrum.reduced(1.0), at_1);
}

} // namespace

TEST(Spectrum, HasTheReferenceValuesOfCor1) {
  expect_reduced(at(Cor1{}, 2e4), 3.242588e-4, 1.671959e-4, 2.610089e-6);
  expect_reduced(at(Cor1{}, 4e4), 1.218017e-3, 3.049800e-3, 1.876800e-6);
  expect_reduced(at(Cor1{}, 1e5), 5.180042e-3, 3.485399e-3, 8.200940e-6);
}

TEST(Spectrum, OfCor1IsContinuousInItsLevel) {
  constexpr double tolerance = 2e-3; // of polynomials of four digits
  const auto level = [](double re) { return at(Cor1{}, re).reduced(1e-9); };
  EXPECT_NEAR(level(1.5e4) / level(1.5e4 + 1.0), 1.0, tolerance);
  EXPECT_NEAR(level(5e4) / level(5e4 + 1.0), 1.0, tolerance);
}

TEST(Spectrum, HasTheReferenceValuesOfCor2AndCor3) {
  expect_reduced(at(Cor2{}), 1.299947e-3, 2.000528e-4, 2.986934e-6);
  expect_reduced(at(Cor3{}), 2.236068e-2, 1.118034e-2, 4e-5);
}

TEST(Spectrum, HasTheReferenceLevelsOfCor4) {
  expect_near(cor4_level(0.3), 4.875249e8);
  expect_near(cor4_level(0.5), 4.184408e8);
  expect_near(cor4_level(0.7), 1.686004e8);
  const PointSpectrum spectrum = at(Cor4{}, 2e4, 0.5); // phi0/(f_r^2 (rho V)^4)
  expect_near(spectrum.reduced(0.1), 4.184408e8 / 0.01 / std::pow(740.0 * 1.5, 4.0));
}

TEST(Spectrum, HasTheReferenceForcesPerLength) {
  expect_near(at(Cor3{})(40.0), 1.367411e-3);
  expect_near(at(Axisa{})(40.0), 7.540871e-4);
  expect_near(at(Interior{})(40.0), 1.256812e-2);
  expect_near(at(Inlet{})(40.0), 25.0 * 1.256812e-2);
  expect_near(2.0 * lambda * at(TwoPhaseSpectrum{740.0}, 2e4, 0.85, 3.0)(40.0), 2.000575e-2);
}

TEST(Spectrum, OfCor3IsThatOfAxisaForTwoLambdaOfFourDiameters) {
  constexpr double tolerance = 0.07; // 50/4 = 12.5 exactly at low f_r; 3e-6 . 12.5 = 3.75e-5 for 4e-5
  const FlowState state{1.5, 740.0, 0.0, 1e-7, diameter, 740.0};
  const PointSpectrum axisa(Axisa{}, state, 2.0 * diameter, false, "");
  const PointSpectrum cor3(Cor3{}, state, 2.0 * diameter, false, "");
  EXPECT_NEAR(axisa(4.0) / cor3(4.0), 1.0, 1e-12);
  EXPECT_NEAR(axisa(100.0) / cor3(100.0), 1.0, tolerance);
}

TEST(Spectrum, OfATwoSidedSourceIsTwiceAsLarge) {
  const FlowState state{1.5, 740.0, 0.5, 1e-7, diameter, 740.0};
  for (const Spectrum& s : {Spectrum{Cor1{}}, Spectrum{Cor2{}}, Spectrum{Cor3{}}, Spectrum{Cor4{}},
                            Spectrum{Axisa{}}, Spectrum{TwoPhaseSpectrum{740.0}}, white(3.0)}) {
    const PointSpectrum one(s, state, lambda, false, ""), two(s, state, lambda, true, "");
    EXPECT_DOUBLE_EQ(two(7.0), 2.0 * one(7.0)) << name_of(s);
  }
}

TEST(Spectrum, OutsideItsRangeIsHeldBelowAndContinuedAbove) {
  const PointSpectrum spectrum = at(Axisa{});
  EXPECT_EQ(spectrum.reduced(0.001), spectrum.reduced(0.01));
  expect_near(spectrum.reduced(30.0), 3e-6 * std::pow(30.0, -3.5));
  const double per_f = diameter / 1.5;
  expect_near(spectrum.lowest(), 0.01 / per_f);
  expect_near(spectrum.highest(), 3.0 / per_f);
  EXPECT_FALSE(spectrum.covers(0.99 * spectrum.lowest()));
  EXPECT_TRUE(spectrum.covers(0.5 * spectrum.highest()));
  EXPECT_FALSE(spectrum.covers(1.01 * spectrum.highest()));
  EXPECT_TRUE(at(Cor2{}).covers(1e6));
  EXPECT_EQ(spectrum(0.0), 0.0);
  EXPECT_EQ(at(Cor3{})(0.0), 0.0);
}

TEST(Spectrum, OfATableIsLinearInLogarithms) {
  const TableSpectrum rows{{0.1, 1.0, 10.0}, {1e-2, 1e-3, 1e-7}, false};
  const PointSpectrum spectrum = at(rows);
  constexpr double round_off = 1e-12;
  EXPECT_NEAR(spectrum.reduced(std::sqrt(0.1)), std::sqrt(1e-5), round_off);
  EXPECT_NEAR(spectrum.reduced(1.0) / 1e-3, 1.0, round_off);
  EXPECT_NEAR(spectrum.reduced(std::sqrt(10.0)) / 1e-5, 1.0, round_off);
  EXPECT_NEAR(spectrum.reduced(100.0) / 1e-11, 1.0, round_off); // last slope
  EXPECT_EQ(spectrum.reduced(0.01), 1e-2);
  const PointSpectrum absolute = at(TableSpectrum{{10.0, 100.0}, {4.0, 0.04}, true});
  EXPECT_NEAR(absolute(std::sqrt(1000.0)), 0.4, round_off);
  EXPECT_EQ(absolute(1.0), 4.0);
  EXPECT_EQ(absolute.highest(), 100.0);
}

TEST(Spectrum, RefusesWrongInput) {
  const auto message = [](const Spectrum& s, const FlowState& state) {
    return message_of([&] { (void)PointSpectrum(s, state, lambda, false, "zone 'a'"); });
  };
  const FlowState good{1.5, 740.0, 0.5, 1e-7, diameter, 740.0};
  FlowState state = good;
  state.velocity = 0.0;
  EXPECT_EQ(message(Cor2{}, state), "zone 'a': velocity = 0 m/s makes no sense; give a number > 0");
  state = good;
  state.viscosity = 0.0;
  EXPECT_EQ(message(Cor1{}, state),
            "zone 'a': kinematic viscosity = 0 m2/s makes no sense; give a number > 0");
  state = good;
  state.void_fraction = 1.0;
  EXPECT_EQ(message(Cor4{}, state),
            "zone 'a': the spectrum cor_4 is one of two-phase flow, void fraction = 1; give one "
            "between 0 and 1 or another spectrum");
  EXPECT_NE(message(TwoPhaseSpectrum{700.0}, state), "");
  EXPECT_EQ(message(Cor2{-1.0}, good), "zone 'a': phi0 of cor_2 = -1 makes no sense; give a number > 0");
  EXPECT_EQ(
      message(TableSpectrum{{1.0, 2.0}, {1.0}}, good),
      "zone 'a': the table of a spectrum has 2 abscissas and 1 values; give as many of both, at least one");
  EXPECT_EQ(message(TableSpectrum{{1.0, 1.0}, {1.0, 2.0}}, good),
            "zone 'a': abscissas of the spectrum's table are to ascend; 1 follows 1");
  EXPECT_EQ(message(TableSpectrum{{1.0}, {0.0}}, good),
            "zone 'a': value 1 of the spectrum's table = 0 makes no sense; give a number > 0");
}

} // namespace spectrum_test
