// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "flow/added_mass.hpp"
#include "flow/damping_terms.hpp"
#include "flow/void_fraction.hpp"
#include <cmath>
#include <limits>
#include <numbers>

namespace fretwork::flow::damping_terms_test {
namespace {

constexpr double printed = 0.5e-6;  ///< six decimals, per cent
constexpr double round_off = 1e-14; ///< of numbers of order 1
constexpr double percent = 100.0;
constexpr double diameter = 0.01905, mass = 0.8, frequency = 40.0; ///< m, kg/m, Hz
const SpanLayout layout{9, 1.0};
const double support = support_factor(layout, 0.03);
const double confinement =
    viscous_confinement(confinement_ratio({Arrangement::square, 1.44 * diameter}, diameter));
const Phases phases{740.0, 36.5, 1.23e-7, 5.2e-7};

double mass_ratio(double density) { return density * diameter * diameter / mass; }

void expect_terms(double alpha, double viscous, double squeeze_film, double two_phase) {
  const double density = mixture_density(alpha, phases), nu = mixture_viscosity(alpha, phases);
  EXPECT_NEAR(percent *
                  viscous_damping(mass_ratio(density), stokes_number(frequency, diameter, nu), confinement),
              viscous, printed);
  EXPECT_NEAR(percent * squeeze_film_damping(support, frequency, mass_ratio(density)), squeeze_film, printed);
  EXPECT_NEAR(percent * two_phase_damping(mass_ratio(740.0), alpha, confinement), two_phase, printed);
}

TEST(DampingTerms, HaveTheReferenceValues) {
  expect_terms(0.0, 0.122160, 1.886395, 0.0);
  expect_terms(0.5, 0.081511, 0.989720, 1.894152);
  expect_terms(0.85, 0.039570, 0.362048, 0.947076);
  EXPECT_NEAR(percent * liquid_friction_damping * support, 0.076980, printed);
  EXPECT_NEAR(percent * gas_support_damping * support, 0.769800, printed);
}

TEST(DampingTerms, ViscousIsThatOfStokesOutsideABundle) {
  EXPECT_EQ(viscous_confinement(std::numeric_limits<double>::infinity()), 1.0);
  // xi = (100 pi/sqrt 8)(rho D^2/m) sqrt(2 nu/(pi f D^2)), per cent
  const double expected = 100.0 * std::numbers::pi / std::sqrt(8.0) * mass_ratio(740.0) *
                          std::sqrt(2.0 * 1.23e-7 / (std::numbers::pi * frequency * diameter * diameter));
  EXPECT_NEAR(percent * viscous_damping(mass_ratio(740.0), stokes_number(frequency, diameter, 1.23e-7), 1.0),
              expected, round_off);
}

TEST(DampingTerms, VoidShapeRisesHoldsAndFalls) {
  for (const auto& [alpha, h] :
       {std::pair{0.0, 0.0}, {0.2, 0.5}, {0.4, 1.0}, {0.55, 1.0}, {0.7, 1.0}, {0.85, 0.5}, {1.0, 0.0}})
    EXPECT_NEAR(void_shape(alpha), h, round_off) << alpha;
}

TEST(DampingTerms, SpansLieBetweenSupportsAndEnds) {
  const SpanLayout four = span_layout({2.0, 0.5, 3.0}, 4.5); // 0.5, 1.5, 1, 1.5
  EXPECT_EQ(four.spans, 4);
  EXPECT_NEAR(four.mean_span, (1.5 + 1.5 + 1.0) / 3.0, round_off);
  const SpanLayout two = span_layout({1.0}, 4.0);
  EXPECT_EQ(two.spans, 2);
  EXPECT_NEAR(two.mean_span, 2.0, round_off) << "of all where there are fewer than three";
  const SpanLayout one = span_layout({}, 4.0);
  EXPECT_EQ(one.spans, 1);
  EXPECT_EQ(support_factor(one, 0.03), 0.0) << "no support, no damping of supports";
  tests::expect_error(
      [] {
        (void)span_layout({1.0, 4.2}, 4.0);
      },
      {"support at s = 4.2 m is not on the tube", "4 m"});
}

} // namespace
} // namespace fretwork::flow::damping_terms_test
