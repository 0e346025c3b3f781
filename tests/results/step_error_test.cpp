// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/error_estimate.hpp"
#include "results/step_error.hpp"
#include "synthetic.hpp"
#include <gmock/gmock.h>

namespace step_error_test {

using namespace fretwork;
using namespace fretwork::results;
using testing::HasSubstr;
using transient::StepError;

namespace {

/// Work 2 J with an error of 0.1 +- 0.02, squares 4 N2 s with 0.4 +- 0.1, nothing else.
StepError work_and_squares() {
  StepError out;
  out.parts = 4;
  out.sums[transient::replayed_work] = 2.0;
  out.errors[transient::replayed_work] = 0.1;
  out.spreads[transient::replayed_work] = 0.02;
  out.sums[transient::replayed_square] = 4.0;
  out.errors[transient::replayed_square] = 0.4;
  out.spreads[transient::replayed_square] = 0.1;
  return out;
}

StepError work(double sum, double error, double spread) {
  StepError out;
  out.parts = 1;
  out.sums[transient::replayed_work] = sum;
  out.errors[transient::replayed_work] = error;
  out.spreads[transient::replayed_work] = spread;
  return out;
}

} // namespace

TEST(StepErrors, AreRelativeToTheirFigureAndHalfOfThatOfASquare) {
  const auto errors = relative_errors(work_and_squares());
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors[0].name, "work_rate");
  EXPECT_DOUBLE_EQ(errors[0].value, 0.05);
  EXPECT_DOUBLE_EQ(errors[0].standard_error, 0.01);
  EXPECT_EQ(errors[1].name, "normal_force_rms");
  EXPECT_DOUBLE_EQ(errors[1].value, 0.05);
  EXPECT_DOUBLE_EQ(errors[1].standard_error, 0.0125);
  EXPECT_TRUE(relative_errors({}).empty());
}

TEST(StepErrors, OfSumsAddUpAndTheirStandardErrorsInSquares) {
  const StepError sum = sum_of({work(2.0, 0.1, 0.03), work(3.0, -0.2, 0.04)});
  EXPECT_DOUBLE_EQ(sum.sums[transient::replayed_work], 5.0);
  EXPECT_DOUBLE_EQ(sum.errors[transient::replayed_work], -0.1);
  EXPECT_DOUBLE_EQ(sum.spreads[transient::replayed_work], 0.05);
}

TEST(StepErrors, ThatStandOutAboveTheAccuracyAreNamed) {
  RunResults results = made_up({.contacts = 2});
  results.accuracy = 0.01;
  results.step_errors = {work(2.0, 0.1, 0.02), work(2.0, 0.1, 0.1)}; // 5 +- 1 %, 5 +- 5 %
  const std::string said = unmet_accuracy(results);
  EXPECT_THAT(said, HasSubstr("\"" + results.contacts[0].name + "\""));
  EXPECT_THAT(said, HasSubstr("work_rate of \"" + results.contacts[0].name + "\": +5 +- 1 %"));
  EXPECT_EQ(said.find("\"" + results.contacts[1].name + "\""), std::string::npos) << "may be chance";
  results.step_errors[0] = work(2.0, 0.015, 0.001); // 0.75 %
  EXPECT_EQ(unmet_accuracy(results), "");
  results.step_errors[0] = work(0.01, 0.001, 1e-5); // 10 % of what matters to nobody
  EXPECT_EQ(unmet_accuracy(results), "");
  results.step_errors.clear();
  EXPECT_EQ(unmet_accuracy(results), "");
}

// Where the standard error of the window is as large, more replays would not help.
TEST(StepErrors, ThatAreKnownTooLittleAreNamed) {
  RunResults results = made_up({.contacts = 2});
  results.accuracy = 0.01;
  results.step_errors = {work(2.0, 0.1, 0.28), work(2.0, 0.0, 0.02)}; // 5 +- 14 %, 0 +- 1 %
  for (auto& of : results.contact_summaries)
    of.work_rate = 1.0, of.error.work_rate = 0.02;
  EXPECT_EQ(unmet_accuracy(results), "");
  const std::string said = uncertain_errors(results);
  EXPECT_THAT(said, HasSubstr("do not resolve the error by the step of \"" + results.contacts[0].name +
                              "\": work_rate of \"" + results.contacts[0].name + "\" +5 +- 14 %;"));
  EXPECT_EQ(said.find("\"" + results.contacts[1].name + "\""), std::string::npos);
  results.contact_summaries[0].error.work_rate = 0.05;
  EXPECT_EQ(uncertain_errors(results), "");
  results.contact_summaries[0].error.work_rate =
      std::numeric_limits<double>::quiet_NaN(); // too short a window
  EXPECT_EQ(uncertain_errors(results), "");
}

TEST(StepErrors, ArePartOfTheErrorEstimate) {
  RunResults results = made_up({.contacts = 2});
  results.step_errors = {work(2.0, 0.1, 0.02), work(2.0, 0.1, 0.02)};
  const ErrorEstimate e = error_estimate(results);
  EXPECT_EQ(e.kind, ErrorKind::measured);
  EXPECT_THAT(e.text, HasSubstr("the step changes work_rate by 5 +- 0.71 % over all contacts (replays)"));
  EXPECT_GT(e.relative, 0.05);
}

namespace {

/// Of one contact: work and impacts, relative, with their standard errors.
ErrorEstimate estimate_of(double of_work, double work_spread, double of_impacts, double impacts_spread) {
  RunResults results = made_up({.contacts = 1});
  results.errors_of_sums = {};
  StepError of = work(1.0, of_work, work_spread);
  of.sums[transient::replayed_impacts] = 1.0;
  of.errors[transient::replayed_impacts] = of_impacts;
  of.spreads[transient::replayed_impacts] = impacts_spread;
  results.step_errors = {of};
  return error_estimate(results);
}

} // namespace

TEST(StepErrors, ThatReplaysResolveComeFirstAndOthersAreBounds) {
  const auto ends_with = [](const std::string& text) {
    return testing::EndsWith("; the step changes " + text + " over all contacts (replays)");
  };
  // of two that are resolved the larger, though another scatters by more than it
  EXPECT_THAT(estimate_of(-0.03, 0.001, 0.02, 0.001).text, ends_with("work_rate by 3 +- 0.1 %"));
  EXPECT_THAT(estimate_of(0.005, 0.001, 0.004, 0.0025).text,
              ends_with("work_rate by 0.5 +- 0.1 % and impacts_per_second by less than 0.9 %"));
  EXPECT_THAT(estimate_of(0.005, 0.001, 0.001, 0.001).text, ends_with("work_rate by 0.5 +- 0.1 %"))
      << "a bound of 0.3 %";
  EXPECT_THAT(estimate_of(0.01, 0.02, 0.015, 0.01).text, ends_with("work_rate by less than 5 %"));
  EXPECT_THAT(estimate_of(0.01, 0.02, 0.0, 0.1).text,
              ends_with("work_rate by less than 5 % and impacts_per_second by less than 20 %"));
  EXPECT_THAT(estimate_of(0.0, 0.0, 0.001, 0.001).text, ends_with("impacts_per_second by less than 0.3 %"));
  EXPECT_THAT(estimate_of(0.0, 0.0, 0.0, 0.0).text, ends_with("work_rate by 0 +- 0 %"));
  // a bound of a third of the figure says little, one above the figure itself nothing
  const auto unknown = [](const std::string& name) {
    return "; by how much the step changes " + name + " is unknown (replays, which scatter too much)";
  };
  EXPECT_THAT(estimate_of(0.01, 0.001, 0.0, 1.635).text,
              testing::EndsWith("; the step changes work_rate by 1 +- 0.1 % over all contacts (replays)" +
                                unknown("impacts_per_second")));
  EXPECT_THAT(estimate_of(0.01, 0.001, 0.0, 0.3).text,
              testing::EndsWith("; the step changes work_rate by 1 +- 0.1 % over all contacts (replays)" +
                                unknown("impacts_per_second (below 60 %)")));
  EXPECT_THAT(
      estimate_of(0.01, 0.6, 0.0, 1.635).text,
      testing::EndsWith("standard error of this window" + unknown("work_rate and impacts_per_second")));
  // an error counts as what is known of it at least
  EXPECT_DOUBLE_EQ(estimate_of(0.01, 0.02, 0.015, 0.01).relative, 0.02);
  EXPECT_DOUBLE_EQ(estimate_of(-0.03, 0.001, 0.02, 0.001).relative, 0.03);
}

// What exceeds the accuracy for the warning is resolved on the line of the error.
TEST(StepErrors, OfWarningsAreResolved) {
  for (const double of : {0.01, 0.03, 0.05, 0.2})
    for (const double spread : {0.0, 0.01, 0.02, 0.1}) {
      RunResults results = made_up({.contacts = 1});
      results.step_errors = {work(1.0, of, spread)};
      if (!unmet_accuracy(results).empty()) {
        EXPECT_TRUE(errors_of_sums(results).largest) << of << " " << spread;
      }
    }
}

} // namespace step_error_test
