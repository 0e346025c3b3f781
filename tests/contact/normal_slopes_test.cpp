// SPDX-License-Identifier: GPL-3.0-or-later
// The normal law over both dampers: regimes of Hunt and Crossley's, derivatives, scales.
#include "contact/normal_law.hpp"
#include "uniform.hpp"
#include <array>
#include <gtest/gtest.h>

namespace normal_slopes_test {

using namespace fretwork;
using namespace fretwork::contact;

namespace {

constexpr double round_off = 1e-14; // a handful of operations, relative
constexpr double relative_step = 1e-6;
constexpr double difference_error = 1e-8; // relative: eps/step, and step^2 times curvatures of order 1
constexpr double rescaled = 1e-12;        // rounding of scales that are no powers of two

constexpr double k = 1e6, p_max = 1e-4, v_max = 1.0;
const std::array laws = {NormalLaw{k}, NormalLaw{k, 150.0}, NormalLaw{k, 0.0, 2.0}, NormalLaw{k, 80.0, 0.7}};

/// (f(x + h) - f(x - h))/(2 h).
template <class F> double difference(F f, double x, double h) { return (f(x + h) - f(x - h)) / (2.0 * h); }

} // namespace

TEST(HuntCrossley, StartsAndEndsWithoutForceAndDoesNotPull) {
  const NormalLaw& law = laws[2];
  EXPECT_EQ(normal_force(law, 0.0, 0.3), 0.0);
  EXPECT_DOUBLE_EQ(normal_force(law, 1e-4, 0.3), 1e6 * 1e-4 * (1.0 + 2.0 * 0.3));
  EXPECT_DOUBLE_EQ(normal_force(law, 1e-4, -0.3), 1e6 * 1e-4 * (1.0 - 2.0 * 0.3));
  EXPECT_EQ(normal_force(law, 1e-4, -0.6), 0.0);
  EXPECT_FALSE(laws[0].damps());
  EXPECT_TRUE(law.damps());
}

TEST(NormalLaw, NeverPullsAndNeverGivesEnergyByItsDampers) {
  tests::Uniform uniform(51);
  for (const NormalLaw& law : laws)
    for (int i = 0; i < 2000; ++i) {
      const double p = uniform(-p_max, p_max), rate = uniform(-v_max, v_max);
      const double force = normal_force(law, p, rate);
      EXPECT_GE(force, 0.0);
      if (p > 0.0) {
        EXPECT_GE((force - k * p) * rate, -round_off * force); // what is not the spring takes energy
      } else {
        EXPECT_EQ(force, 0.0);
      }
      EXPECT_EQ(force, normal_force(law, p, rate));
    }
}

TEST(NormalSlopes, AreThoseOfTheForceInEveryRegime) {
  tests::Uniform uniform(52);
  for (const NormalLaw& law : laws) {
    int open = 0, closed = 0, clipped = 0;
    for (int i = 0; i < 2000; ++i) {
      const double p = uniform(-p_max, p_max), rate = uniform(-v_max, v_max);
      const double hp = relative_step * p_max, hv = relative_step * v_max;
      const NormalSlopes s = normal_slopes(law, p, rate);
      EXPECT_EQ(s.force, normal_force(law, p, rate));
      const bool kink =
          std::abs(p) < hp || std::abs(k * p + law.damping_at(p) * rate) < 2.0 * k * hp * (1.0 + 2.0);
      if (kink)
        continue;
      (p < 0.0 ? open : s.force > 0.0 ? closed : clipped) += 1;
      EXPECT_NEAR(s.by_penetration, difference([&](double x) { return normal_force(law, x, rate); }, p, hp),
                  difference_error * k);
      EXPECT_NEAR(s.by_rate, difference([&](double x) { return normal_force(law, p, x); }, rate, hv),
                  difference_error * k * p_max);
    }
    EXPECT_GT(open, 500);
    EXPECT_GT(closed, 300);
    EXPECT_EQ(clipped > 50, law.damps());
  }
}

TEST(MeanSlopes, AreThoseOfTheMeanPenetrationInEveryRegime) {
  tests::Uniform uniform(53);
  int regimes[4] = {};
  for (int i = 0; i < 4000; ++i) {
    const double p1 = uniform(-1, 1), p2 = uniform(-1, 1), h = relative_step;
    if (std::min(std::abs(p1), std::abs(p2)) < 0.01 || std::abs(p1 - p2) < 0.01)
      continue; // third derivatives grow there
    ++regimes[2 * (p1 > 0.0) + (p2 > 0.0)];
    const MeanSlopes s = mean_slopes(p1, p2);
    EXPECT_NEAR(s.by_p1, difference([&](double p) { return mean_penetration(p, p2); }, p1, h),
                difference_error);
    EXPECT_NEAR(s.by_p2, difference([&](double p) { return mean_penetration(p1, p); }, p2, h),
                difference_error);
    EXPECT_EQ(s.by_p1, mean_slopes(p2, p1).by_p2);
  }
  for (const int met : regimes)
    EXPECT_GT(met, 500);
}

TEST(MeanSlopes, AreContinuousWhereAnEndOpens) {
  const double tiny = 1e-16;
  EXPECT_NEAR(mean_slopes(tiny, 1.0).by_p2, mean_slopes(-tiny, 1.0).by_p2, round_off);
  EXPECT_NEAR(mean_slopes(tiny, 1.0).by_p1, mean_slopes(-tiny, 1.0).by_p1, round_off);
  EXPECT_EQ(mean_slopes(0.3, 0.3).by_p1, 0.5);
  EXPECT_EQ(mean_slopes(0.0, 0.0).by_p1, 0.0);
}

TEST(NormalLaw, HidesNoUnit) {
  tests::Uniform uniform(55);
  struct Units {
    double mass, length, time, tolerance; // relative; 0: the same bytes
  };
  for (const Units u : {Units{0x1p9, 0x1p-11, 0x1p4, 0.0}, Units{1e-3, 1e3, 1.0, rescaled}}) {
    const double force = u.mass * u.length / (u.time * u.time), speed = u.length / u.time;
    for (const NormalLaw& law : laws) {
      const NormalLaw scaled{law.stiffness * force / u.length, law.damping * force / speed,
                             law.dissipation / speed};
      for (int i = 0; i < 500; ++i) {
        const double p = uniform(-p_max, p_max), q = uniform(-p_max, p_max), rate = uniform(-v_max, v_max),
                     scale = k * p_max;
        EXPECT_NEAR(mean_penetration(p, q) * u.length, mean_penetration(p * u.length, q * u.length),
                    u.tolerance * p_max * u.length);
        EXPECT_NEAR(normal_force(law, p, rate) * force, normal_force(scaled, p * u.length, rate * speed),
                    u.tolerance * scale * force);
      }
    }
  }
}

} // namespace normal_slopes_test
