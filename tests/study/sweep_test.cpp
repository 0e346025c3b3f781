// SPDX-License-Identifier: GPL-3.0-or-later
// [sweep]: what is read, which keys a pattern stands for, a sweep of another study.
#include "core/error.hpp"
#include "folder.hpp"
#include "study/sweep.hpp"
#include <gtest/gtest.h>

namespace fretwork::study::sweep_test {
namespace {

Sweep sweep_of(const std::string& variables, const std::string& keys = "draws = 10\n") {
  const Folder folder;
  return read_sweep(parse(folder.write("s.toml", full_study + "\n[sweep]\n" + keys + variables)));
}

std::vector<std::string> keys_of(const std::string& key) {
  return sweep_of("[[sweep.variables]]\nkey = \"" + key + "\"\nvalues = [1, 2]\n").variables.at(0).keys;
}

TEST(SweepKeys, APatternIsComparedWithNames) {
  EXPECT_EQ(keys_of("contacts.tsp*.gap"),
            (std::vector<std::string>{"contacts.tsp1.gap", "contacts.tsp2.gap"}));
  EXPECT_EQ(keys_of("contacts.tsp?.offset"),
            (std::vector<std::string>{"contacts.tsp1.offset", "contacts.tsp2.offset"}));
}

TEST(SweepKeys, ItemsOfAnArrayAreFoundByTheirIndices) {
  EXPECT_EQ(keys_of("contacts.tsp1.offset.*"),
            (std::vector<std::string>{"contacts.tsp1.offset.0", "contacts.tsp1.offset.1"}));
}

TEST(SweepKeys, WithoutAPatternTheKeyIsTaken) {
  EXPECT_EQ(keys_of("contacts.tsp1.gap"), std::vector<std::string>{"contacts.tsp1.gap"});
}

TEST(Sweep, HasDefaultsAndDistributions) {
  const Sweep sweep = sweep_of(R"(
[[sweep.variables]]
name = "gap"
key = "contacts.tsp*.gap"
normal = { mean = 2.0e-4, deviation = 1.0e-5 }
truncated = [1.0e-4, 3.0e-4]
[[sweep.variables]]
key = "contacts.tsp1.friction"
range = { from = 0.1, to = 0.3, count = 3 }
[[sweep.variables]]
key = "loads.2.random.seed"
seeds = 5
)");
  EXPECT_EQ(sweep.design, SweepDesign::monte_carlo);
  EXPECT_EQ(sweep.quantiles, (std::vector<double>{0.05, 0.5, 0.95}));
  ASSERT_EQ(sweep.variables.size(), 3u);
  const auto& gap = std::get<SweepDistribution>(sweep.variables[0].source);
  EXPECT_EQ(gap.law, "normal");
  EXPECT_EQ(gap.parameters, (std::vector<double>{2e-4, 1e-5}));
  EXPECT_EQ(gap.truncated, (std::array{1e-4, 3e-4}));
  EXPECT_EQ(std::stod(std::get<SweepLevels>(sweep.variables[1].source).values[1]), 0.2);
  EXPECT_EQ(std::get<SweepSeeds>(sweep.variables[2].source).first, 5);
  EXPECT_EQ(sweep.variables[2].name, "loads.2.random.seed");
}

std::vector<std::string> values_of(const std::string& source) {
  const Sweep sweep = sweep_of("[[sweep.variables]]\nkey = \"contacts.tsp1.gap\"\n" + source + "\n");
  return std::get<SweepLevels>(sweep.variables.at(0).source).values;
}

TEST(Sweep, RangesOfWholeNumbersAreIntegers) {
  for (const int count : {2, 3, 24, 30, 49, 98, 1000}) {
    const std::string n = std::to_string(count);
    const auto values = values_of("range = { from = 1, to = " + n + ", count = " + n + " }");
    ASSERT_EQ(values.size(), static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
      EXPECT_EQ(values[static_cast<std::size_t>(i)], std::to_string(i + 1)) << n;
  }
  EXPECT_EQ(values_of("range = { from = 0, to = 2e8, count = 3 }"),
            (std::vector<std::string>{"0", "100000000", "200000000"}));
  EXPECT_EQ(values_of("range = { from = -1, to = 1, count = 3 }"),
            (std::vector<std::string>{"-1", "0", "1"}));
}

TEST(Sweep, RangesOfDecimalsAreThoseDecimals) {
  EXPECT_EQ(values_of("range = { from = 0.1, to = 0.7, count = 7 }"),
            (std::vector<std::string>{"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"}));
  EXPECT_EQ(values_of("range = { from = -0.3, to = 0.3, count = 7 }"),
            (std::vector<std::string>{"-0.3", "-0.2", "-0.1", "0", "0.1", "0.2", "0.3"}));
  EXPECT_EQ(std::stod(values_of("range = { from = 0, to = 1, count = 4 }").at(1)), 1.0 / 3.0);
  EXPECT_EQ(std::stod(values_of("range = { from = 0.12345678901234567, to = 1, count = 2 }").at(0)),
            0.12345678901234567); // an end is what is given
  EXPECT_EQ(values_of("range = { from = 0, to = 0, count = 2 }"), (std::vector<std::string>{"0", "0"}));
}

TEST(Sweep, ValuesHaveTheFewestDigitsThatReadBackTheSame) {
  EXPECT_EQ(values_of("values = [0.15e-3, 0.30e-3, 1e8, 2.0, 7]"),
            (std::vector<std::string>{"0.00015", "0.0003", "100000000", "2", "7"}));
}

TEST(Sweep, EachMakesAVariableOfEveryKey) {
  const Sweep sweep = sweep_of(
      "[[sweep.variables]]\nkey = \"contacts.tsp*.gap\"\neach = true\nuniform = { from = 0, to = 1 }\n");
  ASSERT_EQ(sweep.variables.size(), 2u);
  EXPECT_EQ(sweep.variables[1].name, "contacts.tsp2.gap");
  const Sweep seeds = sweep_of("[[sweep.variables]]\nkey = \"contacts.tsp*.gap\"\neach = true\nseeds = 5\n");
  EXPECT_EQ(std::get<SweepSeeds>(seeds.variables[0].source).first, 5);
  EXPECT_EQ(std::get<SweepSeeds>(seeds.variables[1].source).first, 1000005);
}

TEST(Sweep, MayBeOfAnotherStudy) {
  const Folder folder;
  const auto study = folder.write("study.toml", full_study);
  const auto file =
      folder.write("sweep.toml", "[sweep]\nstudy = \"study.toml\"\ndraws = 2\n[[sweep.variables]]\nkey = "
                                 "\"contacts.tsp1.gap\"\nvalues = [1e-4]\n");
  EXPECT_EQ(read(file).contacts.size(), read(study).contacts.size());
  EXPECT_EQ(read(file).file, read(study).file);
  EXPECT_EQ(read_sweep(parse(file)).draws, 2);
  EXPECT_THROW((void)read_sweep(parse(study)), core::Error);
  const auto both = folder.write("both.toml", "title = \"a\"\n[sweep]\nstudy = \"study.toml\"\n");
  EXPECT_THROW((void)parse(both), core::Error);
  const auto chain = folder.write("chain.toml", "[sweep]\nstudy = \"sweep.toml\"\n");
  EXPECT_THROW((void)parse(chain), core::Error);
}

TEST(Sweep, AStudyWithAWrongSweepIsRefused) {
  const Folder folder;
  EXPECT_THROW((void)read(folder.write("s.toml", full_study + "\n[sweep]\ndraws = 0\n")), core::Error);
}

TEST(Sweep, LimitsOfAGridAreRefused) {
  const std::string values = "[[sweep.variables]]\nkey = \"contacts.tsp1.gap\"\nvalues = [1e-4, 2e-4]\n";
  EXPECT_NO_THROW((void)sweep_of(values, "design = \"grid\"\n"));
  try {
    (void)sweep_of(values, "design = \"grid\"\nlimits = [{ output = \"worst.work_rate\", above = 1 }]\n");
    FAIL() << "they have no effect";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("the cases of a grid have no probabilities"), std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace fretwork::study::sweep_test
