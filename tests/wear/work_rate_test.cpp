// SPDX-License-Identifier: GPL-3.0-or-later
#include "refusal.hpp"
#include "wear/work_rate.hpp"
#include <array>
#include <cmath>
#include <limits>

namespace work_rate_test {

using namespace fretwork::wear;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double round_off = 1e-15;

} // namespace

TEST(WorkRate, HasTheIntervalOfItsConfidence) {
  constexpr double printed = 1e-6; // t(6) of 95 % = 2.446912, t(3) = 3.182446, t(2) = 4.302653
  // d = 6 of an error of 10 % from 6.185567 degrees, of 6 that of 57.7 % leaves 3, of 1000 one of 100 % leaves 2
  const auto factor = [](double error, double batches) {
    const WorkRate rate = work_rate_with_confidence(2e-3, 2e-3 * error, batches, 0.95);
    EXPECT_NEAR(rate.low * rate.high / (rate.value * rate.value), 1.0, 4.0 * round_off);
    EXPECT_FALSE(rate.low_at_zero);
    EXPECT_TRUE(rate.has_interval);
    return std::log(rate.high / rate.value) / error;
  };
  EXPECT_NEAR(factor(0.1, 1.0 + 1.0 / (1.0 / 6.0 - 0.005)), 2.446912, printed);
  EXPECT_NEAR(factor(std::sqrt(1.0 / 3.0), 7.0), 3.182446, printed);
  EXPECT_NEAR(factor(1.0, 1001.0), 4.302653, 0.01);
  EXPECT_NEAR(factor(2.0, 1001.0), 4.302653, printed) << "no fewer degrees than 2";
  EXPECT_NEAR(factor(0.01, 2.0), 12.7062, 0.1) << "but those of the batches";
  EXPECT_EQ(work_rate_with_confidence(2e-3, 0.0, 8.0, 0.95).high, 2e-3);
  EXPECT_EQ(work_rate_with_confidence(0.0, 0.0, 8.0, 0.95).high, 0.0);
  EXPECT_TRUE(std::isfinite(work_rate_with_confidence(2e-3, 2e-3, 3.0, 1.0 - 1e-12).high));
  EXPECT_FALSE(work_rate_with_confidence(2e-3, not_a_number, 0.0, 0.95).has_interval);
  expect_refused([] { (void)work_rate_with_confidence(2e-3, 1e-4, 1.0, 0.95); }, {"1 batches"});
  expect_refused([] { (void)work_rate_with_confidence(2e-3, 1e-4, 8.0, 1.0); }, {"confidence 1"});
}

TEST(WorkRate, HasItsInterval) {
  const WorkRate rate = work_rate_with_error(2e-3, 5e-4);
  EXPECT_EQ(rate.low, 1.5e-3);
  EXPECT_EQ(rate.high, 2.5e-3);
  EXPECT_TRUE(rate.has_interval);
  EXPECT_FALSE(rate.low_at_zero);
  EXPECT_FALSE(work_rate_with_error(2e-3, not_a_number).has_interval); // a window too short for batches
  EXPECT_EQ(work_rate_with_error(2e-3, not_a_number).high, 2e-3);
  EXPECT_EQ(work_rate_between(1e-3, 2e-3, 4e-3).high, 4e-3);
}

TEST(WorkRate, SaysThatItsLowerEndIsZero) {
  const WorkRate rate = work_rate_with_error(1e-3, 2e-3);
  EXPECT_EQ(rate.low, 0.0);
  EXPECT_TRUE(rate.low_at_zero);
  EXPECT_EQ(rate.high, 3e-3);
}

TEST(WorkRate, OfASupportIsTheSumOverItsPoints) {
  const std::array points{work_rate_with_error(2e-3, 5e-4), work_rate(1e-3),
                          work_rate_with_error(1e-3, 2e-3)};
  const WorkRate sum = sum_of_points(points);
  EXPECT_NEAR(sum.value, 4e-3, round_off);
  EXPECT_NEAR(sum.low, 2.5e-3, round_off);
  EXPECT_NEAR(sum.high, 6.5e-3, round_off);
  EXPECT_TRUE(sum.low_at_zero);
  EXPECT_TRUE(sum.has_interval);
  EXPECT_FALSE(sum_of_points(std::array{work_rate(1.0)}).has_interval);
}

TEST(WorkRate, RefusesWhatMakesNoSense) {
  expect_refused([] { (void)work_rate(-1.0); }, {"work rate: value = -1 W"});
  expect_refused([] { (void)work_rate_with_error(1.0, -1.0); }, {"standard error = -1 W"});
  expect_refused([] { (void)work_rate_with_error(infinity, 1.0); }, {"value = inf W"});
  expect_refused([] { (void)work_rate_between(-1.0, 1.0, 2.0); }, {"lower end = -1 W"});
  expect_refused([] { (void)work_rate_between(1.0, 1.0, infinity); }, {"upper end = inf W"});
  expect_refused([] { (void)work_rate_between(1.0, 3.0, 2.0); }, {"3 W is not between its ends 1 and 2 W"});
  expect_refused([] { (void)work_rate_between(1.0, -3.0, 2.0); }, {"value = -3 W"});
  expect_refused([] { (void)sum_of_points({}); }, {"without contact points"});
}

} // namespace work_rate_test
