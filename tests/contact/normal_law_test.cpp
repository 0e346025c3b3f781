// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/normal_law.hpp"
#include "uniform.hpp"
#include <gtest/gtest.h>

namespace normal_law_test {

using namespace fretwork;
using contact::mean_penetration;
using contact::normal_force;
using contact::NormalLaw;

namespace {

constexpr double round_off = 1e-14; // a handful of operations, relative
const NormalLaw law{1e6, 300.0};

} // namespace

TEST(NormalForce, IsThatOfSpringAndDamper) {
  EXPECT_DOUBLE_EQ(normal_force(law, 1e-4, 0.2), 1e6 * 1e-4 + 300.0 * 0.2);
  EXPECT_DOUBLE_EQ(normal_force(law, 1e-4, -0.2), 1e6 * 1e-4 - 300.0 * 0.2);
  EXPECT_DOUBLE_EQ(normal_force({1e6}, 1e-4, 99.0), 100.0);
}

TEST(NormalForce, IsZeroWhereOpenHoweverFastTheApproach) { EXPECT_EQ(normal_force(law, -1e-300, 1e6), 0.0); }

TEST(MeanPenetration, IsTheMeanOfItsPositivePart) {
  constexpr int points = 20000;
  constexpr double quadrature =
      2e-9; // midpoint rule across the kink: 1 / (8 points^2) of a slope of at most 4
  tests::Uniform uniform(7);
  for (int i = 0; i < 50; ++i) {
    const double p1 = uniform(-2, 2), p2 = uniform(-2, 2);
    double sum = 0.0;
    for (int k = 0; k < points; ++k)
      sum += std::max(0.0, p1 + (p2 - p1) * (k + 0.5) / points);
    EXPECT_NEAR(mean_penetration(p1, p2), sum / points, quadrature);
    EXPECT_EQ(mean_penetration(p1, p2), mean_penetration(p2, p1));
  }
}

TEST(MeanPenetration, HasItsLimitsWithoutASpeedAndAtTheEdge) {
  EXPECT_EQ(mean_penetration(0.0, 0.0), 0.0);
  EXPECT_EQ(mean_penetration(-1.0, -2.0), 0.0);
  EXPECT_EQ(mean_penetration(-1.0, 0.0), 0.0);
  EXPECT_EQ(mean_penetration(0.3, 0.3), 0.3);
  EXPECT_EQ(contact::closed_share(0.3, 0.3), 1.0);
  EXPECT_NEAR(contact::closed_share(-0.1, 0.3), 0.75, round_off);
  EXPECT_EQ(contact::closed_share(0.3, -0.1), contact::closed_share(-0.1, 0.3));
  EXPECT_EQ(contact::closed_share(0.0, 0.0), 0.0);
  EXPECT_EQ(mean_penetration(0.0, 0.5), 0.25);
  EXPECT_NEAR(mean_penetration(1e-20, 0.5), 0.25, round_off); // continuous across p1 = 0
  EXPECT_NEAR(mean_penetration(-1e-20, 0.5), 0.25, round_off);
}

} // namespace normal_law_test
