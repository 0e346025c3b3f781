// SPDX-License-Identifier: GPL-3.0-or-later
// Contact constants from a restitution or from a tube's wall, against impacts integrated step by step.
#include "contact/normal_law.hpp"
#include "contact/restitution.hpp"
#include "core/error.hpp"
#include "restitution_of_ratio.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <string>

namespace restitution_test {

using namespace fretwork;
using namespace fretwork::contact;
using tests::restitution_of_ratio;

namespace {

constexpr double round_trip = 1e-12; // some ulps of exponents up to 700
constexpr double round_off = 1e-15;
constexpr double integrated = 1e-9; // fourth order at 20000 steps: 1e-12, but for the kink at release

template <class F> std::string message(F f) {
  try {
    f();
  } catch (const core::Error& error) {
    return error.what();
  }
  return "no error";
}

/// Speed after / speed before of a free mass on a law: Runge and Kutta's method of order 4 until the force
/// ends.
double simulated(const NormalLaw& law, double mass, double speed) {
  const double h = 2e-4 * std::sqrt(mass / law.stiffness);
  const auto slope = [&](double p, double v) {
    return -std::max(0.0, law.stiffness * p + law.damping_at(p) * v) / mass;
  };
  double p = 0.0, v = speed;
  while (v > 0.0 || slope(p, v) < 0.0) {
    const double a1 = slope(p, v), v2 = v + 0.5 * h * a1, a2 = slope(p + 0.5 * h * v, v2),
                 v3 = v + 0.5 * h * a2, a3 = slope(p + 0.5 * h * v2, v3), v4 = v + h * a3,
                 a4 = slope(p + h * v3, v4);
    p += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    if (p < 0.0)
      break; // Hunt and Crossley: the force ends with the penetration
  }
  return -v / speed;
}

/// -de/dxi of the reference's law, by central differences.
double slope_of_restitution(double xi) {
  const double step = 1e-4 * xi;
  return (restitution_of_ratio(xi - step) - restitution_of_ratio(xi + step)) / (2.0 * step);
}

} // namespace

TEST(Restitution, OfTheReferencesLawHasItsKnownValues) {
  constexpr double printed = 5e-9; // half the last digit of the source
  EXPECT_EQ(ratio_of_restitution(1.0), 0.0);
  EXPECT_NEAR(restitution_of_ratio(0.1), 0.74407940, printed);
  EXPECT_NEAR(ratio_of_restitution(0.74407940), 0.1, printed / slope_of_restitution(0.1));
  EXPECT_NEAR(ratio_of_restitution(std::exp(-2.0)), 1.0, round_off);
  EXPECT_NEAR(ratio_of_restitution(0.25e-16) / 1e8, 1.0, 1e-13); // 1/(2 xi)^2 far above 1: an exponent of 38
}

TEST(Restitution, IsSmoothAcrossCriticalDamping) {
  // -ln e = 2 + (4/3) d - (2/5) d^2 + (16/105) d^3 ... at xi = 1 + d
  for (const double d : {1e-1, 1e-3, 1e-6, 1e-9, 1e-12, -1e-12, -1e-9, -1e-6, -1e-3, -1e-1})
    EXPECT_NEAR(ratio_of_restitution(std::exp(-2.0 - 4.0 / 3.0 * d + 0.4 * d * d)), 1.0 + d,
                0.2 * std::abs(d * d * d) + round_off);
}

TEST(Restitution, OfTheReferencesLawIsWhatAnImpactLeaves) {
  for (const double xi : {0.01, 0.1, 0.5, 0.9, 1.0, 1.2, 3.0}) {
    const double m = 2.0, k = 5e5;
    EXPECT_NEAR(ratio_of_restitution(simulated({k, 2.0 * xi * std::sqrt(k * m)}, m, 1.5)), xi,
                integrated / slope_of_restitution(xi));
  }
}

TEST(Restitution, OfTheReferencesLawIsInvertedExactly) {
  for (const double e :
       {1e-300, 1e-20, 1e-3, 0.1, 0.13, std::exp(-2.0), 0.14, 0.3, 0.7, 0.99, 1.0 - 1e-9, 1.0})
    EXPECT_NEAR(restitution_of_ratio(ratio_of_restitution(e)) / e, 1.0, round_trip) << e;
  for (const double xi : {1e-15, 1e-6, 0.2, 0.999, 1.0, 1.001, 7.0, 1e6}) // small xi: e itself rounds
    EXPECT_NEAR(ratio_of_restitution(restitution_of_ratio(xi)), xi, round_trip * xi + round_off) << xi;
  EXPECT_EQ(ratio_of_restitution(1.0), 0.0);
  EXPECT_NEAR(ratio_of_restitution(1.0 - 0x1p-40) * std::numbers::pi, 0x1p-40, 0x1p-79); // e = 1 - pi xi ...
}

TEST(Restitution, GivesTheDamperOfAMassOnAStiffness) {
  const double e = restitution_of_ratio(0.25);
  EXPECT_NEAR(damping_of_restitution(e, 5e5, 2.0), 2.0 * 0.25 * 1e3, 1e3 * round_trip);
  EXPECT_EQ(damping_of_restitution(1.0, 5e5, 2.0), 0.0);
}

TEST(Restitution, OfHuntAndCrossleysLawIsWhatAnImpactLeaves) {
  for (const double x : {0.01, 0.2, 1.0, 5.0}) {
    const double m = 0.3, k = 1e6, v = 0.4;
    EXPECT_NEAR(simulated({k, 0.0, x / v}, m, v), restitution_of_dissipation(x), integrated);
    EXPECT_NEAR(simulated({100.0 * k, 0.0, x / v}, 7.0 * m, v), restitution_of_dissipation(x), integrated);
  }
}

TEST(Restitution, OfHuntAndCrossleysLawHasItsLimits) {
  EXPECT_EQ(restitution_of_dissipation(0.0), 1.0);
  for (const double x : {1e-3, 1e-6, 1e-9}) // e = 1 - 2x/3 + (4/9) x^2 ...
    EXPECT_NEAR(restitution_of_dissipation(x), 1.0 - 2.0 * x / 3.0, 0.5 * x * x + round_off);
  EXPECT_DOUBLE_EQ(restitution_of_dissipation(1e3) * 1e3, 1.0); // it leaves at the speed 1/d
  EXPECT_DOUBLE_EQ(restitution_of_dissipation(1e200) * 1e200, 1.0);
}

TEST(Restitution, OfHuntAndCrossleysLawIsInvertedExactly) {
  for (const double e : {1e-200, 1e-6, 0.01, 0.3, 0.7, 0.99, 1.0 - 1e-6, 1.0 - 1e-12, 1.0})
    EXPECT_NEAR(restitution_of_dissipation(dissipation_of_restitution(e, 0.25) * 0.25) / e, 1.0, round_trip);
  for (const double x : {1e-8, 1e-3, 0.1, 2.0, 20.0}) // x near 0 as exactly as e can tell
    EXPECT_NEAR(dissipation_of_restitution(restitution_of_dissipation(x), 1.0), x,
                round_trip * x + 2 * round_off);
  EXPECT_EQ(dissipation_of_restitution(1.0, 1.0), 0.0);
}

TEST(WallStiffness, IsThatOfOvalisation) {
  // a tube of 19.05 x 1.09 mm, E = 2e11 Pa, by hand: 1.9 * 2e11 * 1.09e-3^2/19.05e-3 * sqrt(0.0572178)
  EXPECT_NEAR(wall_stiffness(2e11, 19.05e-3, 1.09e-3), 5.6690e6, 50.0);
}

TEST(Restitution, RefusesWhatCannotBe) {
  const std::string outside =
      " is not the share of its speed that a body keeps in an impact; give a number > 0 "
      "(0 would ask for an infinite damper) and at most 1";
  EXPECT_EQ(message([] { (void)ratio_of_restitution(0.0); }), "restitution = 0" + outside);
  EXPECT_EQ(message([] { (void)ratio_of_restitution(1.5); }), "restitution = 1.5" + outside);
  EXPECT_EQ(message([] { (void)ratio_of_restitution(std::nan("")); }), "restitution = nan" + outside);
  EXPECT_EQ(message([] { (void)dissipation_of_restitution(-1.0, 1.0); }), "restitution = -1" + outside);
  EXPECT_EQ(message([] { (void)dissipation_of_restitution(0.5, 0.0); }),
            "speed of impact = 0 m/s makes no sense; give a number > 0");
  EXPECT_EQ(message([] { (void)damping_of_restitution(0.5, -1.0, 1.0); }),
            "stiffness = -1 N/m makes no sense; give a number > 0");
  EXPECT_EQ(message([] { (void)damping_of_restitution(0.5, 1.0, 0.0); }),
            "mass = 0 kg makes no sense; give a number > 0");
}

TEST(WallStiffness, RefusesWhatIsNoTube) {
  EXPECT_EQ(message([] { (void)wall_stiffness(0.0, 0.02, 0.001); }),
            "Young's modulus = 0 Pa makes no sense; give a number > 0");
  EXPECT_EQ(message([] { (void)wall_stiffness(2e11, -0.02, 0.001); }),
            "outer diameter = -0.02 m makes no sense; give a number > 0");
  EXPECT_EQ(message([] { (void)wall_stiffness(2e11, 0.02, INFINITY); }),
            "wall thickness = inf m makes no sense; give a number > 0");
  EXPECT_EQ(
      message([] { (void)wall_stiffness(2e11, 0.02, 0.01); }),
      "wall thickness = 0.01 m leaves no tube of outer diameter 0.02 m; give less than half the diameter");
}

} // namespace restitution_test
