// SPDX-License-Identifier: GPL-3.0-or-later
// Scars of several flat faces: the support that they make, and every result file.
#include "folder.hpp"
#include "results/wear_json.hpp"
#include "results/write.hpp"
#include "synthetic.hpp"
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fretwork::results::wear_sides_test {
namespace {

using testing::HasSubstr;

WearOfSide side(const std::string& name, double volume, double depth, double years) {
  WearOfSide s;
  s.name = name;
  s.states = {{"this run", 1.0, wear::work_rate_between(0.5 * volume, volume, 2.0 * volume)}};
  s.work_rate = s.states[0].work_rate;
  const auto over_time = [](double value) {
    return WearCurves{{0.0, value}, {0.0, 0.5 * value}, {0.0, 2.0 * value}};
  };
  s.volume = over_time(volume);
  s.support_volume = over_time(0.1 * volume);
  s.depth = over_time(depth);
  s.support_depth = over_time(0.1 * depth);
  s.scar_width = 10.0 * depth;
  s.life = {"reached", {years, 0.5 * years, 2.0 * years}};
  return s;
}

WearOfSide outside(const std::string& name) {
  WearOfSide s = side(name, 0.0, no_value, no_value);
  s.volume = s.support_volume = s.depth;
  s.life.end = "outside_law";
  s.outside = "V0 is below S";
  return s;
}

WearOfSupport support(std::vector<WearOfSide> sides) {
  WearOfSupport s;
  s.time = {0.0, wear::year};
  s.sides = std::move(sides);
  combine_sides(s);
  return s;
}

/// Made up results whose second support has two scars.
RunResults worn() {
  RunResults results = made_up({.contacts = 2, .outputs = 20});
  results.contacts[1].sides = {{0, "+y"}, {2, "-y"}};
  results.contact_summaries[1].sides[2] = {3e-4, 1e-5, 12.0};
  results.wear = made_up_wear(results);
  results.wear->opening.reset();
  WearOfSupport& two = results.wear->supports[1];
  for (const auto& [name, volume] : {std::pair("+y", 1e-9), std::pair("-y", 2e-9)}) {
    two.sides.push_back(side(name, volume, 1e5 * volume, 1e-8 / volume));
    for (WearCurves* curves : {&two.sides.back().volume, &two.sides.back().support_volume,
                               &two.sides.back().depth, &two.sides.back().support_depth})
      for (auto* list : {&curves->value, &curves->low, &curves->high})
        list->resize(two.time.size(), list->back());
  }
  combine_sides(two);
  return results;
}

} // namespace

TEST(WearBySide, MakesTheSupportOfItsDeepestScar) {
  const WearOfSupport s = support({side("+y", 1.0, 5.0, 8.0), side("-y", 3.0, 7.0, 6.0)});
  EXPECT_EQ(s.volume.last().value, 4.0);
  EXPECT_EQ(s.volume.last().low, 2.0);
  EXPECT_EQ(s.depth.last().value, 7.0);
  EXPECT_EQ(s.depth.last().high, 14.0);
  EXPECT_EQ(s.support_depth.last().value, 0.1 * 7.0);
  EXPECT_EQ(s.scar_width, 70.0);
  EXPECT_EQ(s.life.end, "reached");
  EXPECT_EQ(s.life.years.value, 6.0);
  EXPECT_EQ(s.life.years.low, 3.0);
  EXPECT_EQ(s.life.years.high, 12.0);
  EXPECT_TRUE(s.outside.empty());
}

TEST(WearBySide, LeavesOutSidesOutsideTheirLaw) {
  const WearOfSupport s = support({outside("+y"), side("-y", 3.0, 7.0, 6.0)});
  EXPECT_EQ(s.volume.last().value, 3.0);
  EXPECT_EQ(s.depth.last().value, 7.0);
  EXPECT_EQ(s.life.end, "reached");
  EXPECT_EQ(s.life.years.value, 6.0);
  EXPECT_EQ(s.outside, "side +y: V0 is below S");
  const WearOfSupport none = support({outside("+y"), outside("-y")});
  EXPECT_TRUE(std::isnan(none.volume.last().value));
  EXPECT_EQ(none.life.end, "outside_law");
}

TEST(WearBySide, HasNoDepthWhereAScarLeavesItsGeometry) {
  const WearOfSupport s = support({side("+y", 9.0, no_value, 2.0), side("-y", 3.0, 7.0, 6.0)});
  EXPECT_EQ(s.volume.last().value, 12.0);
  EXPECT_TRUE(std::isnan(s.depth.last().value));
  EXPECT_EQ(s.life.years.value, 2.0);
}

TEST(WearBySide, IsInEveryResultFile) {
  const RunResults out = worn();
  const Folder folder;
  write_summary(folder / "summary.json", out);
  std::string text;
  for (const std::string& line : lines_of(folder / "summary.json"))
    text += line;
  const auto summary = nlohmann::json::parse(text);
  EXPECT_FALSE(summary["contacts"][0].contains("sides"));
  EXPECT_EQ(summary["contacts"][1]["sides"]["-y"]["work_rate"], 3e-4);
  EXPECT_EQ(summary["contacts"][1]["sides"]["-y"]["standard_error"]["work_rate"], 1e-5);
  EXPECT_EQ(summary["contacts"][1]["sides"]["-y"]["standard_error"]["work_rate_batches"], 12.0);
  EXPECT_FALSE(summary["wear"]["supports"][0].contains("sides"));
  const auto& sides = summary["wear"]["supports"][1]["sides"];
  ASSERT_EQ(sides.size(), 2u);
  EXPECT_EQ(sides[1]["name"], "-y");
  EXPECT_EQ(sides[1]["volume_m3"]["high"], 4e-9);
  EXPECT_EQ(sides[1]["depth_m"]["value"], 1e5 * 2e-9);
  EXPECT_EQ(sides[1]["life_years"]["value"], 1e-8 / 2e-9);
  EXPECT_EQ(sides[1]["states"][0]["work_rate"]["low"], 1e-9);

  write_archive(folder / "results.h5", out);
  const RunResults in = read_archive(folder.path());
  EXPECT_TRUE(in.wear->supports[0].sides.empty());
  const auto &a = in.wear->supports[1].sides, &b = out.wear->supports[1].sides;
  ASSERT_EQ(a.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(a[k].name, b[k].name);
    EXPECT_EQ(a[k].depth.high, b[k].depth.high);
    EXPECT_EQ(a[k].work_rate.low, b[k].work_rate.low);
    EXPECT_EQ(a[k].life.years.value, b[k].life.years.value);
    EXPECT_EQ(a[k].states[0].name, "this run");
    EXPECT_EQ(a[k].scar_width, b[k].scar_width);
  }

  export_csv(folder.path(), out);
  const auto table = lines_of(folder / "tsp2_wear_sides.csv");
  ASSERT_EQ(table.size(), 3u);
  EXPECT_THAT(table[0], HasSubstr("side,work_rate [W],work_rate_low [W],work_rate_high [W],volume [m3]"));
  EXPECT_THAT(table[2], HasSubstr("-y,2e-09,1e-09,4e-09,2e-09"));
  EXPECT_FALSE(std::filesystem::exists(folder / "tsp1_wear_sides.csv"));
  export_csv(folder.path(), made_up({.contacts = 2, .outputs = 20})); // removes it
  EXPECT_FALSE(std::filesystem::exists(folder / "tsp2_wear_sides.csv"));

  const auto lines = wear_lines(*out.wear);
  EXPECT_THAT(lines[2], HasSubstr("  tsp2 "));
  EXPECT_THAT(lines[3], HasSubstr("    side +y"));
  EXPECT_THAT(lines[4], HasSubstr("    side -y"));
  EXPECT_THAT(lines[5], HasSubstr("all supports"));
}

} // namespace fretwork::results::wear_sides_test
