// SPDX-License-Identifier: GPL-3.0-or-later
#include "kwu_counts.hpp"
#include "refusal.hpp"
#include <random>

namespace kwu_epri_test {

using namespace fretwork::wear;

namespace {

constexpr double round_off = 1e-14;

} // namespace

TEST(KwuClasses, HoldTheirUpperLimit) {
  KwuClasses classes(10.0, 0.5); // widths 2 N, 0.1 m/s
  classes.add(2.0, 0.1);         // the limits of class 0
  classes.add(2.0 + 1e-6, 0.1);
  classes.add(2.0, 0.1 + 1e-6);
  classes.add(10.0, 0.5);
  EXPECT_EQ(classes.share(0, 0), 0.25);
  EXPECT_EQ(classes.share(0, 1), 0.25);
  EXPECT_EQ(classes.share(1, 0), 0.25);
  EXPECT_EQ(classes.share(4, 4), 0.25);
  EXPECT_EQ(classes.share_above(), 0.0);
}

TEST(KwuClasses, TakeLimitsToRoundOff) {
  KwuClasses classes(0.9, 0.7);
  for (int k = 1; k <= 5; ++k)
    classes.add(0.9 / 5.0 * k, 0.7 / 5.0 * k); // k times a width has other last digits than the limit
  for (int k = 0; k < 5; ++k)
    EXPECT_EQ(classes.share(k, k), 0.2) << k;
}

TEST(KwuClasses, CountWhatSticksInTheFirstClassAndNothingWithoutForce) {
  KwuClasses classes(10.0, 0.5);
  classes.add(1.0, 0.0);
  classes.add(0.0, 0.3);
  classes.add(-1.0, 0.3);
  EXPECT_EQ(classes.share(0, 0), 1.0);
}

TEST(KwuClasses, TellWhatIsAboveTheMaxima) {
  KwuClasses classes(10.0, 0.5);
  EXPECT_EQ(classes.share_above(), 0.0);
  EXPECT_EQ(classes.share(0, 0), 0.0);
  EXPECT_EQ(classes.indices({1.0, 1.0}).impact, 0.0);
  classes.add(1.0, 0.05, 3.0);
  classes.add(11.0, 0.05);
  classes.add(1.0, 0.6, 4.0);
  EXPECT_EQ(classes.share_above(), 5.0 / 8.0);
  EXPECT_EQ(classes.share(0, 0), 3.0 / 8.0);
}

TEST(KwuClasses, WeighSamplesByTheirTime) {
  KwuClasses one(10.0, 0.5), other(10.0, 0.5);
  for (int k = 0; k < 3; ++k)
    one.add(3.0, 0.25);
  one.add(9.0, 0.05);
  other.add(3.0, 0.25, 0.3);
  other.add(9.0, 0.05, 0.1);
  const ImpactSliding a = one.indices({4.0, 40.0}), b = other.indices({4.0, 40.0});
  EXPECT_NEAR(a.impact / b.impact, 1.0, round_off);
  EXPECT_NEAR(a.sliding / b.sliding, 1.0, round_off);
  // Si = (1/4) k1 k (0.9)^3; Sg = (3/4) k2 3 0.25^2
  EXPECT_NEAR(a.impact, 0.25 * 4.0 * 5.0 * 0.729, round_off);
  EXPECT_NEAR(a.sliding, 0.75 * 40.0 * 3.0 * 0.0625, 10.0 * round_off);
}

TEST(KwuClasses, OfTheirOwnMaximaHoldEverySampleInContact) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> uniform(-0.5, 1.0);
  std::vector<double> forces, speeds;
  for (int k = 0; k < 2000; ++k) {
    forces.push_back(50.0 * uniform(generator));
    speeds.push_back(0.1 * std::abs(uniform(generator)));
  }
  const KwuClasses classes = counted(forces, speeds);
  double sum = 0.0;
  for (int i = 0; i < kwu_classes; ++i)
    for (int j = 0; j < kwu_classes; ++j)
      sum += classes.share(i, j);
  EXPECT_NEAR(sum, 1.0, round_off);
  EXPECT_EQ(classes.share_above(), 0.0);
}

TEST(KwuClasses, ScaleWithTheUnits) {
  // Si goes with F^3/C^3, Sg with k2 F v^2: in kN and mm/s the same numbers
  const std::vector<double> forces{2.0, 9.0, 18.0, 50.0}, speeds{.002, .004, .03, .05};
  std::vector<double> kilo, milli;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    kilo.push_back(1e-3 * forces[k]);
    milli.push_back(1e3 * speeds[k]);
  }
  const ImpactSliding a = counted(forces, speeds).indices({4.0, 40.0});
  const ImpactSliding b = counted(kilo, milli).indices({4.0, 40.0 * 1e3 * 1e-6, 5.0, 1e-2});
  EXPECT_NEAR(a.impact / b.impact, 1.0, round_off * 10.0);
  EXPECT_NEAR(a.sliding / b.sliding, 1.0, round_off * 10.0);
}

TEST(KwuClasses, RefuseWhatMakesNoSense) {
  expect_refused([] { KwuClasses(0.0, 1.0); }, {"largest normal force = 0 N", "> 0"});
  expect_refused([] { KwuClasses(1.0, -1.0); }, {"largest sliding speed = -1 m/s"});
  const KwuClasses classes(1.0, 1.0);
  expect_refused([&] { (void)classes.indices({0.0, 1.0}); }, {"k1 = 0"});
  expect_refused([&] { (void)classes.indices({1.0, 0.0}); }, {"k2 = 0 s2/N/m2"});
  expect_refused([&] { (void)classes.indices({1.0, 1.0, -5.0}); }, {"k = -5"});
  expect_refused([&] { (void)classes.indices({1.0, 1.0, 5.0, 0.0}); }, {"force C = 0 N"});
}

} // namespace kwu_epri_test
