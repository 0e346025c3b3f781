// SPDX-License-Identifier: GPL-3.0-or-later
// Grids, overrides of cases, and the worst cases of a table.
#include "core/error.hpp"
#include "sweep/design.hpp"
#include "sweep/summary.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace fretwork::sweep::design_test {
namespace {

study::Sweep grid() {
  study::Sweep sweep;
  sweep.design = study::SweepDesign::grid;
  sweep.variables = {
      {"gap", {"contacts.a.gap", "contacts.b.gap"}, study::SweepLevels{{"1e-4", "2e-4"}, {0.5, 0.5}}},
      {"seed", {"loads.0.random.seed"}, study::SweepSeeds{10}},
      {"friction", {"contacts.a.friction"}, study::SweepLevels{{"0", "0.1", "0.3"}, {}}}};
  return sweep;
}

TEST(Design, GridHasAllCombinations) {
  const Draws draws = full_grid(grid());
  ASSERT_EQ(draws.rows(), 6);
  ASSERT_EQ(draws.cols(), 2);
  const std::vector<std::string> fifth{"contacts.a.gap=2e-4", "contacts.b.gap=2e-4", "loads.0.random.seed=14",
                                       "contacts.a.friction=0.1"};
  EXPECT_EQ(overrides_of(grid(), draws, 4), fifth);
}

TEST(Design, GivesEachLoadASeedOfItsOwn) {
  study::Sweep sweep;
  sweep.variables = {{"seeds", {"loads.x.random.seed", "loads.y.random.seed"}, study::SweepSeeds{7}}};
  const std::vector<std::string> expected{"loads.x.random.seed=9", "loads.y.random.seed=1000009"};
  EXPECT_EQ(overrides_of(sweep, Draws(3, 0), 2), expected);
  EXPECT_EQ(value_number(sweep.variables[0], 0.0, 2), 9.0);
}

TEST(Design, NumbersAreWrittenSoThatTheyReadBack) {
  const study::SweepVariable gap{"gap", {"a"}, study::SweepDistribution{"normal", {0.0, 1.0}, {}}};
  const double drawn = 0.1 + 1e-17 / 3.0;
  EXPECT_EQ(std::stod(value_text(gap, drawn, 0)), drawn);
  const study::SweepVariable count{"n", {"a"}, study::SweepDistribution{"integers", {1.0, 9.0}, {}}};
  EXPECT_EQ(value_text(count, 7.0, 0), "7");
}

TEST(Design, ListedValuesAreNumbersOfTheirOwn) {
  const auto number = [](const std::vector<std::string>& values, double place) {
    return value_number({"v", {"a"}, study::SweepLevels{values, {}}}, place, 0);
  };
  EXPECT_EQ(number({"0.5", "0.1", "0.3"}, 0.0), 0.5);
  EXPECT_EQ(number({"0.5", "0.1", "0.3"}, 2.0), 0.3);
  EXPECT_EQ(number({"true", "false"}, 0.0), 1.0);
  EXPECT_EQ(number({"true", "false"}, 1.0), 0.0);
  EXPECT_EQ(number({"\"circle\"", "\"plane_y\""}, 1.0), 1.0);
  EXPECT_EQ(value_names({"v", {"a"}, study::SweepLevels{{"true"}, {}}}),
            (std::vector<std::string>{"false", "true"}));
  EXPECT_TRUE(value_names({"v", {"a"}, study::SweepLevels{{"1", "2"}, {}}}).empty());
  EXPECT_EQ(value_number({"seed", {"a"}, study::SweepSeeds{10}}, 0.0, 3), 13.0);
}

TEST(Design, WorstCasesAreTheLargestThatAreDone) {
  Table table;
  table.outputs = {{"work", "W"}};
  const double nan = std::nan("");
  table.rows = {{0, "", Outcome::done, {2.0}},
                {1, "", Outcome::failed, {}},
                {2, "", Outcome::done, {5.0}},
                {3, "", Outcome::done, {nan}},
                {4, "", Outcome::done, {3.0}}};
  EXPECT_EQ(worst_cases(table, "work", 2), (std::vector<std::int64_t>{2, 4}));
  EXPECT_EQ(worst_cases(table, "work", 9).size(), 3u);
  EXPECT_THROW((void)worst_cases(table, "works", 1), core::Error);
  table.outputs = {{"worst.years", "a"}};
  EXPECT_EQ(worst_cases(table, "worst.years", 1), (std::vector<std::int64_t>{table.rows[0].number}));
}

TEST(Design, CasesAreComparedByWorkOrWhereNothingSlidesByForce) {
  Table table;
  table.outputs = {{"a.work_rate", "W"}, {"worst.work_rate", "W"}, {"worst.normal_max", "N"}};
  table.rows = {{0, "", Outcome::done, {0.0, 0.0, 5.0}}, {1, "", Outcome::done, {0.0, 0.0, 7.0}}};
  EXPECT_EQ(measure_of(table), "worst.normal_max");
  table.rows[1].values[1] = 1e-3;
  EXPECT_EQ(measure_of(table), "worst.work_rate");
  table.rows.clear();
  EXPECT_EQ(measure_of(table), "worst.work_rate");
  table.outputs = {{"tube.stress", "Pa"}, {"tube.stress_std", "Pa"}};
  EXPECT_EQ(measure_of(table), "tube.stress") << "without contacts";
}

TEST(Design, RangesOfAGridSayInWhichCase) {
  Table table;
  table.outputs = {{"a.normal_max", "N"}, {"worst.normal_max", "N"}, {"worst.work_rate", "W"}};
  table.rows = {{3, "", Outcome::done, {1.0, 5.0, 0.0}},
                {4, "", Outcome::failed, {}},
                {7, "", Outcome::done, {2.0, 4.0, 0.0}}};
  const std::string lines = range_lines(table);
  EXPECT_NE(lines.find("worst.normal_max N"), std::string::npos) << lines;
  EXPECT_LT(lines.find("4 (case 7)"), lines.find("5 (case 3)")) << lines;
  EXPECT_EQ(lines.find("a.normal_max"), std::string::npos) << "of all contacts only";
  EXPECT_EQ(lines.find("work_rate"), std::string::npos) << "nothing slides";
}

} // namespace
} // namespace fretwork::sweep::design_test
