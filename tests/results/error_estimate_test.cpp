// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/error_estimate.hpp"
#include "synthetic.hpp"
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace fretwork::results::error_estimate_test {
namespace {

using testing::HasSubstr;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Two contacts whose work rates add up to 2, friction powers to 1, impacts to 100 1/s.
RunResults two_contacts() {
  RunResults results = made_up({.contacts = 2});
  for (post::ContactSummary& c : results.contact_summaries) {
    c.work_rate = 1.0;
    c.friction_power = 0.5;
    c.impact_rate = 50.0;
  }
  return results;
}

Verification verification() {
  Verification v;
  v.contacts = {{{"work_rate", 1.0, 1.01, 0.02, true}}, {{"normal_force.rms", 3.0, 5.0, nan, false}}};
  v.sums = {{"work_rate", 2.0, 2.5, 0.1, false}, {"friction_power", 0.0, 0.0, 0.0, true}};
  return v;
}

} // namespace

TEST(ErrorEstimate, IsTheLargestScatterOfTheSums) {
  RunResults results = two_contacts();
  results.errors_of_sums = {0.02, 0.05, 0.0, 3.0};
  const ErrorEstimate e = error_estimate(results);
  EXPECT_EQ(e.kind, ErrorKind::statistical);
  EXPECT_DOUBLE_EQ(e.relative, 0.05);
  EXPECT_THAT(e.text, HasSubstr("5 % standard error of this window"));
  EXPECT_THAT(e.text, HasSubstr("that of the step is unknown"));
}

TEST(ErrorEstimate, SaysWhereAWindowIsTooShort) {
  RunResults results = two_contacts();
  results.errors_of_sums = {0.02, 0.05, 0.0, 3.0};
  EXPECT_EQ(error_estimate(results).text.find("too short"), std::string::npos);
  results.errors_of_sums.friction_power = 1.04;
  EXPECT_THAT(error_estimate(results).text, HasSubstr("104 % standard error of this window"));
  EXPECT_THAT(error_estimate(results).text, HasSubstr("too short for statistics"));
}

TEST(ErrorEstimate, SaysWhereItIsThatOfImpactsAlone) {
  RunResults results = two_contacts();
  for (post::ContactSummary& c : results.contact_summaries)
    c.work_rate = c.friction_power = 0.0;
  results.errors_of_sums = {0.0, 0.0, 0.0, 105.0};
  EXPECT_THAT(
      error_estimate(results).text,
      HasSubstr("105 % standard error of the rate of impacts in this window (there is no work of sliding)"));
}

TEST(ErrorEstimate, SaysThatThereIsNoneAndWhy) {
  RunResults results = two_contacts();
  results.errors_of_sums = {nan, nan, 0.0, nan};
  EXPECT_EQ(error_estimate(results).kind, ErrorKind::none);
  EXPECT_THAT(error_estimate(results).text, HasSubstr("steps too few for batches"));
  for (post::ContactSummary& c : results.contact_summaries)
    c = {};
  results.errors_of_sums = {};
  EXPECT_THAT(error_estimate(results).text, HasSubstr("no impacts in the window"));
  EXPECT_THAT(error_estimate(made_up({.contacts = 0})).text, HasSubstr("there are no contacts"));
}

TEST(ErrorEstimate, OfAVerifiedRunIsItsDifferenceFromHalfTheStepAndTheScatter) {
  RunResults results = two_contacts();
  results.verification = verification();
  const ErrorEstimate e = error_estimate(results);
  EXPECT_EQ(e.kind, ErrorKind::verified);
  EXPECT_DOUBLE_EQ(e.relative, std::hypot(0.5 / 0.5 / 2.5, 0.025));
  EXPECT_THAT(e.text, HasSubstr("2 of 4 figures agree"));
  // turning verification on never makes the error that is told smaller
  results.errors_of_sums = {0.02, 0.05, 0.0, 3.0};
  EXPECT_DOUBLE_EQ(error_estimate(results).relative, std::hypot(0.2 / 0.5, 0.05));
  EXPECT_THAT(
      error_estimate(results).text,
      HasSubstr("the step changes sums over contacts by at most 40 %, 5 % standard error of this window"));
  results.errors_of_sums.work_rate = results.errors_of_sums.friction_power = 0.02;
  results.verification->sums[0].at_half = 0.1 * results.verification->sums[0].value;
  EXPECT_THAT(error_estimate(results).text,
              HasSubstr("the step changes sums over contacts by more than their size, "));
  results.verification->failure = "the run at half the step stopped";
  EXPECT_NE(error_estimate(results).kind, ErrorKind::verified);
}

TEST(ErrorEstimate, NamesTheFigureThatDiffersMost) {
  const RunResults results = two_contacts();
  const Disagreement found = disagreement(verification(), results.contacts);
  EXPECT_EQ(found.compared, 4u);
  EXPECT_EQ(found.differ, 2u);
  EXPECT_EQ(found.worst, "normal_force.rms of contact \"tsp2\" is 3, at half the step 5");
  Verification v = verification();
  v.sums[0].at_half = 4.0;
  EXPECT_EQ(disagreement(v, results.contacts).worst,
            "work_rate of all contacts is 2, at half the step 4 (standard error of the difference 0.1)");
}

} // namespace fretwork::results::error_estimate_test
