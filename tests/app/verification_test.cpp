// SPDX-License-Identifier: GPL-3.0-or-later
// A run says what its errors are: the scatter of its window, and the error of its step where it is verified.
#include "program.hpp"
#include <cmath>

namespace fretwork::app::test {
namespace {

constexpr double half = 1e-9; ///< steps cover the duration in whole numbers

std::vector<std::string> set(const std::vector<std::string>& values, const std::string& duration = "2.0") {
  std::vector<std::string> out = {"--set", "transient.duration=" + duration};
  for (const std::string& value : values)
    out.insert(out.end(), {"--set", value});
  return out;
}

} // namespace

TEST(Verification, OfTheAutomaticStepAgrees) {
  const Workshop folder;
  const Results run = folder.run(example("straight_tube"), "results", set({"transient.verify=true"}));
  const auto& told = run.summary["verification"];
  ASSERT_EQ(told["sums"].size(), 3u);
  for (const auto& figure :
       told["sums"]) // a chaotic run: not at two standard errors, which chance exceeds once in twenty
    EXPECT_LT(std::abs(figure["difference"].get<double>()),
              4.0 * figure["standard_error"].get<double>() + 0.01 * figure["value"].get<double>())
        << figure;
  EXPECT_EQ(told["contacts"].size(), 8u);
  EXPECT_EQ(told["sums"][0]["value"], run.summary["contact_sums"]["work_rate"]);
  EXPECT_TRUE(close_to(told["step_max_s"], 0.5 * run.summary["transient"]["step_max_s"].get<double>(), half));
  EXPECT_EQ(run.summary["error_estimate"]["kind"], "verified");
}

TEST(Verification, WarnsWhereTheStepIsTooLong) {
  const Workshop folder;
  const Outcome outcome = folder.fretwork([&] {
    std::vector<std::string> arguments = {"run", example("straight_tube"), "-o", folder.path("results"),
                                          "--no-report"};
    const auto more = set({"transient.verify=true", "transient.step=7.5e-4"}, "10.0");
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "statistics change with the step by more than their scatter"));
  EXPECT_TRUE(says(outcome.out, "does not resolve the contact frequency"));
  EXPECT_TRUE(says(outcome.out, "at half step"));
  const Results run = read_results(folder.path("results"));
  EXPECT_FALSE(run.summary["verification"]["agrees"]);
  EXPECT_GT(run.summary["transient"]["resolution"]["w_c_h"], 1.0);
  EXPECT_FALSE(run.summary["warnings"].empty());
}

TEST(Verification, IsTheSameOnTwoRanks) {
  const Workshop folder;
  const std::vector<std::string> more = {"--set", "transient.duration=0.3", "--set", "transient.verify=true"};
  const Results one = folder.run(example("straight_tube"), "one", more);
  const Results two = folder.run(example("straight_tube"), "two", more, 2);
  EXPECT_EQ(one.summary["verification"], two.summary["verification"]);
  EXPECT_EQ(one.summary["contact_sums"], two.summary["contact_sums"]);
}

TEST(ErrorEstimate, IsTheScatterOfTheWindowWithoutVerification) {
  const Workshop folder;
  const Results run = folder.run(example("straight_tube"), "results", set({}));
  EXPECT_FALSE(run.summary.contains("verification"));
  const auto& estimate = run.summary["error_estimate"];
  EXPECT_EQ(estimate["kind"], "statistical");
  // many runs of 2 s scatter by some percent
  EXPECT_GT(estimate["relative"], 0.003);
  EXPECT_LT(estimate["relative"], 0.1);
  for (const auto& contact : run.summary["contacts"]) {
    EXPECT_GT(contact["standard_error"]["work_rate"], 0.0);
    EXPECT_LT(contact["standard_error"]["work_rate"], 0.5 * contact["work_rate"].get<double>());
  }
  EXPECT_TRUE(says(run.summary["transient"]["scheme_reason"], "splitting: collocation would need"));
}

} // namespace fretwork::app::test
