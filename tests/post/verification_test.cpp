// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/verification.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace verification_test {

using namespace fretwork::post;

namespace {

constexpr double accuracy = 0.01;
constexpr Criterion criterion{accuracy, 2.0};
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

ContactSummary with_work(double work, double error) {
  ContactSummary s;
  s.work_rate = work;
  s.error.work_rate = error;
  return s;
}

/// Whether a work rate of 100 +- `error` agrees with another by twice the standard error of the difference.
bool agrees(double other, double error) {
  return compare(with_work(100.0, error), with_work(other, error), criterion)[0].agrees;
}

} // namespace

TEST(Verification, AllowsTheAccuracyAndTheScatterTogether) {
  EXPECT_TRUE(agrees(100.49, 0.0)); // half of the accuracy: the error may be twice the difference
  EXPECT_FALSE(agrees(100.51, 0.0));
  EXPECT_FALSE(agrees(99.49, 0.0));
  const double noise = 2.0 * std::sqrt(2.0) * 3.0; // of two runs of 3
  EXPECT_TRUE(agrees(100.0 + noise + 0.5, 3.0));
  EXPECT_FALSE(agrees(100.0 + noise + 1.0, 3.0));
}

TEST(Verification, ComparesWhatHasNoScatterAsItIs) {
  EXPECT_TRUE(agrees(100.49, not_a_number));
  EXPECT_FALSE(agrees(100.51, not_a_number));
  EXPECT_TRUE(compare({}, {}, criterion)[0].agrees); // nothing happens in both
}

TEST(Verification, AsksTheAccuracyOfTheRunNotOfTheDifference) {
  // statistics of known order and error: 100 (1 + C h^p), at h = 1
  for (const int order : {1, 2, 4}) {
    const auto judged = [&](double error) {
      const auto at = [&](double h) { return with_work(100.0 * (1.0 + error * std::pow(h, order)), 0.0); };
      return compare(at(1.0), at(0.5), {accuracy})[0].agrees;
    };
    EXPECT_FALSE(judged(1.05 * accuracy)) << order; // of the larger figure, which has the error in it
    EXPECT_FALSE(judged(-1.05 * accuracy)) << order;
    const double most = 0.98 * accuracy * least_share_shown / (1.0 - std::pow(0.5, order));
    EXPECT_TRUE(judged(most)) << order; // the whole accuracy where the order is one
    EXPECT_TRUE(judged(-most)) << order;
  }
}

TEST(Verification, NeverAgreesWithWhatIsNotANumber) { EXPECT_FALSE(agrees(not_a_number, 1.0)); }

TEST(Verification, AllowsMoreToTheWorstOfManyFigures) {
  EXPECT_EQ(critical_factor(1), 2.0);
  constexpr double of_tables = 1e-3;                    // quantiles of the normal distribution in 4 digits
  EXPECT_NEAR(critical_factor(10), 2.8376, of_tables);  // p = 0.00455
  EXPECT_NEAR(critical_factor(100), 3.5062, of_tables); // p = 0.000455
}

TEST(Verification, AllowsTheLargestForceTheScatterOfLargestValues) {
  constexpr double of_tables = 1e-3;
  EXPECT_NEAR(factor_of_largest(2.0), 2.0738, of_tables);    // sqrt(3)/pi ln(2/p - 1), p = 0.0455
  EXPECT_NEAR(factor_of_largest(3.5062), 4.6251, of_tables); // p = 0.000455
  const auto agree = [](double other, double error) {
    ContactSummary run, half;
    run.normal_max = 100.0;
    half.normal_max = other;
    run.error.normal_max = half.error.normal_max = error;
    const auto figures = compare(run, half, criterion);
    EXPECT_EQ(figures[6].name, "normal_force.max");
    return figures[6].agrees;
  };
  const double noise = factor_of_largest(2.0) * std::sqrt(2.0) * 10.0;
  EXPECT_TRUE(agree(100.0 - noise, 10.0));
  EXPECT_FALSE(agree(100.0 - noise - 1.0, 10.0));
  EXPECT_FALSE(agree(99.0, not_a_number)); // a single impact
  EXPECT_TRUE(agree(99.6, not_a_number));
}

TEST(Verification, PutsEachFigureUnderItsName) {
  ContactSummary run, half;
  run.work_rate = 1;
  run.friction_power = 2;
  run.impact_rate = 3;
  run.contact_time_ratio = 4;
  run.normal_mean = 5;
  run.normal_rms = 6;
  run.normal_max = 7;
  run.y.std = 8;
  run.z.std = 9;
  run.error = {.work_rate = 0.1,
               .friction_power = 0.2,
               .normal_rms = 0.6,
               .impact_rate = 0.3,
               .y_std = 0.8,
               .z_std = 0.9,
               .contact_time_ratio = 0.4,
               .normal_max = 0.7,
               .normal_mean = 0.5};
  const auto figures = compare(run, half, criterion);
  ASSERT_EQ(figures.size(), compared_of_a_contact);
  const char* names[] = {"work_rate",          "friction_power",     "impacts_per_second",
                         "contact_time_ratio", "normal_force.mean",  "normal_force.rms",
                         "normal_force.max",   "displacement.y.std", "displacement.z.std"};
  for (std::size_t k = 0; k < figures.size(); ++k) {
    EXPECT_EQ(figures[k].name, names[k]);
    EXPECT_EQ(figures[k].value, static_cast<double>(k) + 1.0);
    EXPECT_EQ(figures[k].difference(), static_cast<double>(k) + 1.0);
    EXPECT_DOUBLE_EQ(figures[k].error, 0.1 * (static_cast<double>(k) + 1.0));
  }
}

TEST(Verification, AddsUpTheContacts) {
  ContactSummary one, two;
  one.work_rate = 1.0;
  two.work_rate = 2.0;
  one.friction_power = 0.25;
  two.impact_rate = 7.0;
  StandardErrors a, b;
  a.work_rate = 3.0;
  b.work_rate = 4.0;
  const auto sums = compare_sums({one, two}, a, {two, two}, b, criterion);
  ASSERT_EQ(sums.size(), 3u);
  EXPECT_EQ(sums[0].value, 3.0);
  EXPECT_EQ(sums[0].at_half, 4.0);
  EXPECT_EQ(sums[0].error, 5.0);
  EXPECT_TRUE(sums[0].agrees);
  EXPECT_EQ(sums[1].value, 0.25);
  EXPECT_FALSE(sums[1].agrees);
  EXPECT_EQ(sums[2].at_half, 14.0);
}

} // namespace verification_test
