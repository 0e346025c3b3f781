// SPDX-License-Identifier: GPL-3.0-or-later
// A run says what its errors are: the scatter of its window, and the error of its step where it is verified.
#include "mesh_text.hpp"
#include "program.hpp"
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fretwork::app::test::verification_test {
namespace {

constexpr double half = 1e-9; ///< steps cover the duration in whole numbers

std::vector<std::string> set(const std::vector<std::string>& values, const std::string& duration = "2.0") {
  std::vector<std::string> out = {"--set", "transient.duration=" + duration};
  for (const std::string& value : values)
    out.insert(out.end(), {"--set", value});
  return out;
}

/// A mass on a spring, shaken by a force of 10 Hz against a stop: it soon moves with that period, and its statistics over whole periods
/// (batches of steps, 128 or a multiple a period) do not scatter.
Results shaken_against_a_stop(const Workshop& folder, const std::string& name,
                              const std::vector<std::string>& more) {
  folder.write("mesh.msh", lone_points({"mass"}).text());
  const fs::path study = folder.write("study.toml", R"([mesh]
file = "mesh.msh"
[[masses]]
group = "mass"
mass = 2.0
[[restraints]]
group = "mass"
fixed = ["ux", "uz", "rx", "ry", "rz"]
[[springs]]
group = "mass"
stiffness = [0.0, 2.0e4, 0.0, 0.0, 0.0, 0.0]
[modes]
count = 1
damping = 0.05
[[loads]]
group = "mass"
direction = [0.0, 1.0, 0.0]
harmonic = { amplitude = 40.0, frequency = 10.0 }
[[contacts]]
name = "stop"
group = "mass"
obstacle = "stop_y"
gap = 5.0e-4
axis = [1.0, 0.0, 0.0]
normal_stiffness = 1.0e5
normal_damping = 20.0
[transient]
duration = 10.0
accuracy = 0.005
verify = true
[output]
every = 0.01
statistics_from = 3.6
)");
  return folder.run(study, name, more);
}

double deviation(const Results& run) { return run.statistics("stop")["displacement"]["y"]["std"]; }

/// Figures of the contact by name: value, whether it agrees with that at half the step.
std::map<std::string, std::pair<double, bool>> figures(const Results& run) {
  std::map<std::string, std::pair<double, bool>> out;
  for (const auto& figure : run.summary["verification"]["contacts"][0]["figures"])
    out[figure["name"]] = {figure["value"], figure["agrees"]};
  return out;
}

} // namespace

TEST(Verification, RefusesAStepWhoseErrorIsAboveTheAccuracyAndTakesHalfOfIt) {
  const Workshop folder;
  const auto euler = [&](int steps_a_period) {
    return shaken_against_a_stop(
        folder, fmt::format("euler{}", steps_a_period),
        {"--set", "transient.scheme=euler", "--set", fmt::format("transient.step={}", 0.1 / steps_a_period)});
  };
  const Results exact = shaken_against_a_stop(folder, "exact", {"--set", "transient.step=5e-5"});
  EXPECT_TRUE(exact.summary["verification"]["agrees"]);
  constexpr double accuracy = 0.005;
  const Results coarse = euler(128), fine = euler(256);
  // of order 1: the error is 0.7 %, the difference from half the step 0.36 %
  EXPECT_FALSE(close_to(deviation(coarse), deviation(exact), accuracy));
  EXPECT_TRUE(close_to(deviation(coarse), deviation(fine), accuracy));
  EXPECT_FALSE(coarse.summary["verification"]["agrees"]);
  EXPECT_TRUE(says(coarse.summary["warnings"].dump(), " of contact \\\"stop\\\" is "));
  EXPECT_FALSE(figures(coarse)["displacement.y.std"].second);
  EXPECT_TRUE(close_to(deviation(fine), deviation(exact), accuracy));
  EXPECT_TRUE(figures(fine)["displacement.y.std"].second);
  // figures: refused where its error is above the accuracy, and only there
  const auto reference = figures(exact);
  for (auto& run : {figures(coarse), figures(fine)})
    for (const auto& [name, figure] : run) {
      const double value = reference.at(name).first;
      if (value == 0.0 ||             // nothing slides
          name == "normal_force.max") // which Euler has at the ends of its steps only: no power of the step
        continue;
      if (!close_to(figure.first, value, 1.2 * accuracy)) {
        EXPECT_FALSE(figure.second) << name << " " << figure.first << ", exact " << value;
      }
      if (close_to(figure.first, value, 0.8 * accuracy)) {
        EXPECT_TRUE(figure.second) << name << " " << figure.first << ", exact " << value;
      }
    }
}

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

TEST(Verification, WarnsWhereTheStepIsTooLong) { // for the scheme: impacts are wrong in steps of w_c h = 1.5
  const Workshop folder;
  const Outcome outcome = folder.fretwork([&] {
    std::vector<std::string> arguments = {"run", example("straight_tube"), "-o", folder.path("results"),
                                          "--no-report"};
    const auto more =
        set({"transient.verify=true", "transient.scheme=energy_conserving", "transient.step=7.5e-4"}, "10.0");
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

TEST(ErrorEstimate, IsTheScatterOfTheWindowAndTheMeasuredErrorOfTheStep) {
  const Workshop folder;
  const Results run = folder.run(example("straight_tube"), "results", set({"output.nodes=[\"mid_spans\"]"}));
  EXPECT_FALSE(run.summary.contains("verification"));
  const auto& estimate = run.summary["error_estimate"];
  EXPECT_EQ(estimate["kind"], "measured");
  const auto& of_step = run.summary["contact_sums"]["step_error"]["work_rate"];
  EXPECT_GT(of_step["standard_error"], 0.0);
  EXPECT_LT(std::abs(of_step["relative"].get<double>()), 0.02);
  // many runs of 2 s scatter by some percent
  EXPECT_GT(estimate["relative"], 0.003);
  EXPECT_LT(estimate["relative"], 0.1);
  for (const auto& contact : run.summary["contacts"]) {
    EXPECT_GT(contact["standard_error"]["work_rate"], 0.0);
    EXPECT_LT(contact["standard_error"]["work_rate"], 0.5 * contact["work_rate"].get<double>());
  }
  EXPECT_EQ(run.summary["nodes"].size(), 9u);
  for (const auto& node : run.summary["nodes"]) {
    const double error = node["standard_error"]["displacement"]["y"]["std"];
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, 0.5 * node["displacement"]["y"]["std"].get<double>());
  }
  EXPECT_TRUE(says(run.summary["transient"]["scheme_reason"], "splitting; collocation would take about "));
}

} // namespace fretwork::app::test::verification_test
