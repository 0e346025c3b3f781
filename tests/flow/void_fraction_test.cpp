// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "flow/void_fraction.hpp"
#include <cmath>
#include <limits>

namespace fretwork::flow::void_fraction_test {
namespace {

constexpr double printed = 0.5e-6; ///< six decimals
constexpr double solved = 1e-13;   ///< a root to the last digits
const Phases phases{740.0, 36.5, 9.1e-5 / 740.0, 5.2e-7, 0.0176};
const CrossFlow flow{400.0, 0.01905, 1.44 * 0.01905};

TEST(VoidFraction, HasTheReferenceValues) {
  struct Row {
    double x, homogeneous, alpha, velocity_ratio;
  };
  for (const Row& row : {Row{0.05, 0.516219, 0.374401, 1.782975}, Row{0.15, 0.781553, 0.636890, 2.039787},
                         Row{0.30, 0.896789, 0.789189, 2.320995}}) {
    EXPECT_NEAR(homogeneous_void_fraction(row.x, 740.0, 36.5), row.homogeneous, printed);
    const VoidFraction found = feenstra_void_fraction(row.x, phases, flow);
    EXPECT_NEAR(found.alpha, row.alpha, printed) << row.x;
    EXPECT_NEAR(found.velocity_ratio, row.velocity_ratio, printed) << row.x;
  }
}

TEST(VoidFraction, OfFeenstraSolvesItsEquation) {
  for (const double x : {1e-6, 1e-3, 0.05, 0.5, 0.95, 0.9999}) {
    const auto [alpha, s] = feenstra_void_fraction(x, phases, flow);
    EXPECT_NEAR(alpha, 1.0 / (1.0 + s * 36.5 / 740.0 * (1.0 - x) / x), solved) << x;
    const double richardson =
                     std::pow(740.0 - 36.5, 2) * 9.81 * (flow.pitch - flow.diameter) / (400.0 * 400.0),
                 capillary = 9.1e-5 * x * 400.0 / (alpha * 36.5 * 0.0176);
    EXPECT_NEAR(s, 1.0 + 25.7 * std::sqrt(richardson * capillary) / 1.44, 1e-10 * s) << x;
    EXPECT_GT(alpha, 0.0) << "the spurious root";
  }
}

TEST(VoidFraction, IsHomogeneousAtHighMassFlux) {
  // S - 1 falls as G_p^(-1/2)
  constexpr double fast = 1e10;
  EXPECT_NEAR(feenstra_void_fraction(0.15, phases, {fast, flow.diameter, flow.pitch}).alpha,
              homogeneous_void_fraction(0.15, 740.0, 36.5), 1e-4);
}

TEST(VoidFraction, HasTheLimitsOfOnePhase) {
  for (const double x : {0.0, 1.0}) {
    EXPECT_EQ(homogeneous_void_fraction(x, 740.0, 36.5), x);
    EXPECT_EQ(feenstra_void_fraction(x, phases, flow).alpha, x);
  }
  EXPECT_EQ(mixture_density(0.0, phases), 740.0);
  EXPECT_EQ(mixture_density(1.0, phases), 36.5);
  EXPECT_EQ(mixture_density(0.5, phases), 388.25);
  EXPECT_DOUBLE_EQ(mixture_viscosity(0.0, phases), phases.liquid_viscosity);
  EXPECT_DOUBLE_EQ(mixture_viscosity(1.0, phases), phases.gas_viscosity);
}

TEST(VoidFraction, RefusesDataWithoutSense) {
  tests::expect_error([] { (void)homogeneous_void_fraction(1.2, 740.0, 36.5); },
                      {"steam quality = 1.2", "from 0 to 1"});
  tests::expect_error([] { (void)homogeneous_void_fraction(-0.1, 740.0, 36.5); }, {"steam quality = -0.1"});
  tests::expect_error([] { (void)homogeneous_void_fraction(0.1, 0.0, 36.5); },
                      {"liquid density = 0 kg/m3", "> 0"});
  tests::expect_error([] { (void)homogeneous_void_fraction(0.1, 740.0, -1.0); }, {"gas density = -1 kg/m3"});
  Phases bad = phases;
  bad.surface_tension = 0.0;
  tests::expect_error([&] { (void)feenstra_void_fraction(0.1, bad, flow); }, {"surface tension = 0 N/m"});
  bad = phases;
  bad.liquid_viscosity = std::nan("");
  tests::expect_error([&] { (void)feenstra_void_fraction(0.1, bad, flow); }, {"liquid viscosity = nan m2/s"});
  tests::expect_error(
      [] {
        (void)feenstra_void_fraction(0.1, phases, {0.0, 0.02, 0.03});
      },
      {"pitch mass flux = 0"});
  tests::expect_error(
      [] {
        (void)feenstra_void_fraction(0.1, phases, {400.0, 0.03, 0.03});
      },
      {"pitch less outer diameter = 0 m"});
}

TEST(VoidFraction, SaysWhereThereIsNoRoot) {
  // a velocity ratio above 1e9 leaves no root in the bracket
  Phases heavy = phases;
  heavy.surface_tension = 1e-30;
  EXPECT_THROW((void)feenstra_void_fraction(0.1, heavy, {1e-9, 0.02, 0.03}), core::ComputationError);
}

} // namespace
} // namespace fretwork::flow::void_fraction_test
