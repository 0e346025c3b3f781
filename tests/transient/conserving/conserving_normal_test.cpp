// SPDX-License-Identifier: GPL-3.0-or-later
// Normal force of a step that keeps the energy: its limits, its work, its derivatives.
#include "transient/conserving/conserving_normal.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace conserving_normal_test {

using namespace fretwork;
using namespace fretwork::transient;

namespace {

constexpr double h = 1e-3; // s
constexpr double round_off = 1e-12;
const contact::NormalLaw law{2e4, 30.0, 0.5};
/// Penetrations at both ends, m, and the rate at the end, m/s: closed, closing, opening, turning.
struct Ends {
  double p0, p1, rate;
};
const Ends ends[] = {{2e-4, 3e-4, 0.05},  {2e-4, 1e-4, -0.2}, {-1e-4, 2e-4, 0.2},
                     {2e-4, -1e-4, -0.4}, {2e-4, 3e-4, -0.1}, {-1e-4, 2e-4, -0.1}};

} // namespace

TEST(ConservingNormal, TakesTheMeanRateAtShortStepsAndTheLastOneAtLongOnes) {
  EXPECT_EQ(end_rate_share(0.0, 1.0), 0.0);
  EXPECT_EQ(end_rate_share(5.0, -1.0), 0.0); // a mode that the force pushes back
  EXPECT_NEAR(end_rate_share(2.0, 1e-3), 2e-3 / 6.0, 1e-9);
  EXPECT_NEAR(end_rate_share(1.0, 0.02 - 1e-9), end_rate_share(1.0, 0.02 + 1e-9), 1e-9);
  EXPECT_NEAR(end_rate_share(1e6, 1.0), 1.0 - 2e-6, round_off);
  // v1 = v0 exp(-z) for a mass alone: its mean rate is (v0 + v1)/2
  for (const double z : {0.01, 0.3, 2.0, 20.0}) {
    const double b = end_rate_share(z, 1.0), v1 = std::exp(-z);
    EXPECT_NEAR(1.0 - z * ((1.0 - b) * 0.5 * (1.0 + v1) + b * v1), v1, 1e-11 * z) << z;
  }
}

TEST(ConservingNormal, DoesTheWorkOfTheSpringAndNeverGivesEnergy) {
  for (const auto& [p0, p1, rate] : ends)
    for (const double share : {0.0, 0.3, 0.9}) {
      const StepNormal f = step_normal_force(law, share, p0, p1, rate, h);
      const double v0 = std::max(0.0, p0), v1 = std::max(0.0, p1);
      EXPECT_NEAR(f.spring * (p1 - p0), 0.5 * law.stiffness * (v1 * v1 - v0 * v0), round_off);
      EXPECT_GE((std::max(0.0, f.force) - f.spring) * (p1 - p0), -round_off);
    }
}

TEST(ConservingNormal, OfASteadyRateIsTheLaw) {
  constexpr double rate = 0.1, p0 = 2e-4, p1 = p0 + h * rate;
  for (const double share : {0.0, 0.3, 0.9})
    EXPECT_NEAR(step_normal_force(law, share, p0, p1, rate, h).force,
                contact::normal_force(law, 0.5 * (p0 + p1), rate), round_off * 10.0);
}

TEST(ConservingNormal, HasTheDerivativesOfItsDifferences) {
  constexpr double small = 1e-9, of_differences = 1e-5; // m and m/s; relative
  for (const auto& [p0, p1, rate] : ends)
    for (const double share : {0.0, 0.3, 0.9}) {
      const auto force = [&, p0 = p0](double p, double r) {
        return step_normal_force(law, share, p0, p, r, h).force;
      };
      const StepNormal f = step_normal_force(law, share, p0, p1, rate, h);
      EXPECT_NEAR(f.by_end, (force(p1 + small, rate) - force(p1 - small, rate)) / (2.0 * small),
                  of_differences * (law.stiffness + law.damping / h));
      EXPECT_NEAR(f.by_rate, (force(p1, rate + small) - force(p1, rate - small)) / (2.0 * small),
                  of_differences * law.damping);
    }
}

} // namespace conserving_normal_test
