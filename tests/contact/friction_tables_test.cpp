// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/friction_tables.hpp"
#include "contact/normal_interval.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace friction_tables_test {

using namespace fretwork::contact;

namespace {

constexpr double stiffness = 2.0, length = 0.5;
FrictionLaw law_of(double r) { return {stiffness, r > 0.0 ? stiffness * length / r : 0.0, 0.5, 0.5}; }

} // namespace

TEST(FrictionTables, HaveTheSpringOfAnyForceThatIsAParabola) {
  // T1 = integral of r/tau e^(-r (tau - t)/tau) F over the piece: of 1, t, t^2 by share and spread
  constexpr int places = 20000;
  for (const double r : {1e-4, 9.9e-3, 1.01e-2, 0.3, 4.0, 40.0}) {
    const SlipTable t = slip_table(law_of(r), length);
    double moments[3] = {};
    for (int i = 0; i < places; ++i) {
      const double x = (i + 0.5) / places, weight = r * std::exp(-r * (1.0 - x)) / places;
      for (int k = 0; k < 3; ++k)
        moments[k] += weight * std::pow(x, k);
    }
    EXPECT_NEAR(t.relaxed / moments[0], 1.0, 1e-5) << r;
    EXPECT_NEAR(t.share / (moments[1] / moments[0]), 1.0, 1e-5) << r;
    EXPECT_NEAR(t.spread, moments[2] / moments[0] - std::pow(moments[1] / moments[0], 2), 1e-5) << r;
    EXPECT_NEAR(mean_decay(t), (1.0 - std::exp(-r * t.share)) / (r * t.share), 1e-9) << r;
  }
}

TEST(FrictionTables, OfNoDamperAreThoseOfAVeryFastOne) {
  const SlipTable none = slip_table(law_of(0.0), length), fast = slip_table(law_of(1e7), length);
  EXPECT_EQ(none.relaxed, 1.0);
  EXPECT_EQ(none.share, 1.0);
  EXPECT_NEAR(fast.share, none.share, 1e-6);
  EXPECT_NEAR(fast.spread, none.spread, 1e-6);
  EXPECT_NEAR(fast.gradient, none.gradient, 1e-6 * none.gradient);
}

TEST(FrictionTables, HaveTheTermsOfTheMobilityThatIsAskedFor) {
  // a table of another one lends its c', within a hundredth only: what that changes, 3e-4, cannot be round-off
  const FrictionLaw law{2.0, 3.0, 0.5, 0.5};
  const StickTable t = stick_table(law, 1.0, length);
  for (const double mobility : {0.2, 0.995, 3.0}) {
    const StickTerms<double> of = stick_terms(law, t, 1.0, mobility),
                             own = stick_terms(law, stick_table(law, mobility, length), mobility, mobility);
    const double own_growing = growing_damping(law.damping, law.damping * mobility * length);
    const double lent = std::abs(mobility - 1.0) < 0.01 ? t.growing / own_growing : 1.0;
    EXPECT_NEAR(of.damping / own.damping, lent, 1e-14) << mobility;
    EXPECT_NEAR(of.stiffness, own.stiffness, 1e-15) << mobility;
  }
  EXPECT_GT(std::abs(t.growing / growing_damping(law.damping, law.damping * 0.995 * length) - 1.0), 1e-4);
}

TEST(FrictionTables, HaveTermsInAPlaneAlongTheAxesOfItsMobility) {
  const FrictionLaw law{2.0, 3.0, 0.5, 0.5};
  const StickTable t = stick_table(law, 1.0, length);
  const StickTerms<double> low = stick_terms(law, t, 1.0, 0.5), high = stick_terms(law, t, 1.0, 1.5);
  const StickTerms<Sym2> along = stick_terms(law, t, 1.0, Sym2{0.5, 0.0, 1.5}),
                         turned = stick_terms(law, t, 1.0, Sym2{1.0, 0.5, 1.0}); // by 45 degrees
  EXPECT_NEAR(along.damping.xx, low.damping, 1e-14);
  EXPECT_NEAR(along.damping.tt, high.damping, 1e-14);
  EXPECT_EQ(along.damping.xt, 0.0);
  EXPECT_NEAR(turned.stiffness.xx, 0.5 * (low.stiffness + high.stiffness), 1e-14);
  EXPECT_NEAR(turned.stiffness.xt, 0.5 * (high.stiffness - low.stiffness), 1e-14);
}

} // namespace friction_tables_test
