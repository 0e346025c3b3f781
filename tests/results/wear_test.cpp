// SPDX-License-Identifier: GPL-3.0-or-later
// Wear in every result file.
#include "folder.hpp"
#include "results/wear_file.hpp"
#include "results/wear_json.hpp"
#include "results/write.hpp"
#include "synthetic.hpp"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fretwork::results::wear_test {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

constexpr std::size_t widest = 112; // columns that a terminal shows without wrapping, roughly
constexpr double round_off = 1e-13; ///< of a few products

RunResults worn(int contacts, int structures = 1) {
  RunResults results = made_up({.contacts = contacts, .outputs = 20, .structures = structures});
  results.wear = made_up_wear(results);
  return results;
}

/// NaN and infinity included.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

nlohmann::json summary_of(const RunResults& results) {
  const Folder folder;
  write_summary(folder / "summary.json", results);
  std::string text;
  for (const std::string& line : lines_of(folder / "summary.json"))
    text += line;
  return nlohmann::json::parse(text);
}

WearOfSupport with(std::int64_t tube, const std::string& name, double rate, double depth, double years) {
  WearOfSupport s;
  s.tube = tube;
  s.name = name;
  s.work_rate = wear::work_rate_between(0.5 * rate, rate, 2.0 * rate);
  s.volume = {{rate}, {0.5 * rate}, {2.0 * rate}};
  s.depth = {{depth}, {0.5 * depth}, {2.0 * depth}};
  s.life = {"reached", {years, 0.5 * years, 2.0 * years}};
  return s;
}

} // namespace

TEST(WearByTube, SumsVolumesAndTakesTheDeepestAndTheShortestLife) {
  const auto tubes =
      wear_by_tube({with(1, "a", 1.0, 3.0, 7.0), with(0, "b", 4.0, 9.0, 2.0), with(1, "c", 2.0, 1.0, 5.0)});
  ASSERT_EQ(tubes.size(), 2u);
  EXPECT_EQ(tubes[0].tube, 0);
  EXPECT_EQ(tubes[0].supports, 1);
  EXPECT_EQ(tubes[0].first, "b");
  EXPECT_EQ(tubes[1].supports, 2);
  EXPECT_EQ(tubes[1].work_rate.value, 3.0);
  EXPECT_EQ(tubes[1].work_rate.high, 6.0);
  EXPECT_EQ(tubes[1].volume.low, 1.5);
  EXPECT_EQ(tubes[1].deepest, "a");
  EXPECT_EQ(tubes[1].depth.value, 3.0);
  EXPECT_EQ(tubes[1].depth.high, 6.0);
  EXPECT_EQ(tubes[1].first, "c");
  EXPECT_EQ(tubes[1].years.value, 5.0);
  EXPECT_EQ(tubes[1].years.low, 2.5);
}

TEST(WearByTube, EndsWithTheFirstOfTubesAndSupports) {
  const double never = std::numeric_limits<double>::infinity();
  auto card = with(0, "card", 4.0, 0.0, never), plate = with(0, "plate", 4.0, 9.0, 20.0);
  card.life = {"never", {never, never, never}};
  card.support_life = {"reached", {10.0, 8.0, 12.0}};
  plate.support_life = {"reached", {15.0, 14.0, 16.0}};
  const auto tubes = wear_by_tube({plate, card});
  EXPECT_EQ(tubes[0].first, "card");
  EXPECT_EQ(tubes[0].body, "support");
  EXPECT_EQ(tubes[0].years.value, 10.0);
  EXPECT_EQ(tubes[0].years.low, 8.0);
  EXPECT_EQ(first_life(card).value, 10.0);
  EXPECT_EQ(first_life(plate).value, 15.0);
  card.support_life = {};
  plate.support_life.years = {30.0, 25.0, 35.0};
  EXPECT_EQ(wear_by_tube({plate, card})[0].body, "tube");
  plate.life = card.life;
  plate.support_life = {};
  const auto nothing = wear_by_tube({plate, card});
  EXPECT_EQ(nothing[0].first + nothing[0].body, "");
  EXPECT_EQ(nothing[0].years.value, never);
}

TEST(WearByTube, CountsLivesThatHaveNoValue) {
  auto plate = with(0, "plate", 4.0, 9.0, 20.0), card = plate, bar = plate;
  plate.life = {"reached", {20.0, 18.0, 22.0}};
  card.name = "card";
  card.life = {"outside_law", {}};
  bar.name = "bar";
  bar.life = {"never", {no_value, no_value, no_value}};
  bar.life.years.value = std::numeric_limits<double>::infinity();
  bar.support_life = {"beyond_geometry", {}};
  Wear wear{{plate, card, bar}, wear_by_tube({plate, card, bar}), {}};
  EXPECT_EQ(wear.tubes[0].unknown_lives, 2);
  EXPECT_EQ(wear.tubes[0].first, "plate");
  EXPECT_EQ(wear_json(wear, {"c"})["tubes"][0]["unknown_lives"], 2);
  for (WearOfSupport& support : wear.supports)
    support.time = {0.0};
  const std::vector<std::string> lines = wear_lines(wear);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
    return line.ends_with("first: plate; 2 unknown");
  })) << testing::PrintToString(lines);
  EXPECT_EQ(wear_by_tube({plate})[0].unknown_lives,
            0); // supports without a limit of their own have no life to know
}

TEST(WearOnTheTerminal, HasTheWearOfSupportsBelow) {
  const std::vector<std::string> lines = wear_lines(*worn(4).wear);
  const auto head = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
    return line.starts_with("  the supports themselves");
  });
  ASSERT_EQ(lines.end() - head, 5);
  // half of the tube's 2e-14 m2/N x 1e-4 W x 40 years; no limit but of the last
  EXPECT_THAT(head[1], MatchesRegex("  tsp1 +1e-14 +1.26 .*no limit *"));
  EXPECT_THAT(head[4], MatchesRegex("  tsp4 .* 77 \\(66 to 88\\) +1"));
  EXPECT_THAT(lines[5], HasSubstr("first: tsp4 (the support)"));
}

TEST(WearByTube, LeavesOutWhatHasNoDepthAndNoLife) {
  WearOfSupport outside = with(0, "outside", 1.0, no_value, no_value);
  outside.volume = {{no_value}, {no_value}, {no_value}};
  const auto tubes = wear_by_tube({outside, with(0, "b", 4.0, 9.0, 2.0)});
  EXPECT_EQ(tubes[0].deepest, "b");
  EXPECT_EQ(tubes[0].first, "b");
  EXPECT_EQ(tubes[0].depth.value, 9.0);
  EXPECT_TRUE(std::isnan(tubes[0].volume.value)); // a sum without all its terms would be too small
}

TEST(WearByTube, HasNoEndThatOneOfItsSupportsDoesNotHave) {
  auto beyond = with(0, "a", 4.0, 3.0, 9.0); // its upper work rate wears through the geometry
  beyond.depth.high.back() = no_value;
  for (const auto& supports :
       {std::vector{beyond, with(0, "b", 4.0, 2.0, 8.0)}, std::vector{with(0, "b", 4.0, 2.0, 8.0), beyond}}) {
    const auto tubes = wear_by_tube(supports);
    EXPECT_EQ(tubes[0].depth.value, 3.0);
    EXPECT_EQ(tubes[0].depth.low, 1.5);
    EXPECT_TRUE(std::isnan(tubes[0].depth.high));
  }
}

// The deepest scar may be the one that has no depth.
TEST(WearByTube, NamesTheLargestScarBeyondItsGeometry) {
  const auto tubes = wear_by_tube({with(0, "a", 1.0, 3.0, 9.0), with(0, "small", 4.0, no_value, 2.0),
                                   with(0, "large", 5.0, no_value, 1.0), with(1, "b", 1.0, 2.0, 3.0)});
  EXPECT_TRUE(std::isnan(tubes[0].depth.value));
  EXPECT_EQ(tubes[0].deepest, "large");
  EXPECT_EQ(tubes[0].first, "large");
  EXPECT_EQ(tubes[1].depth.value, 2.0);
}

TEST(WearInTheSummary, HasEverySupportWithItsIntervals) {
  const auto summary = summary_of(worn(4));
  const auto& supports = summary["wear"]["supports"];
  ASSERT_EQ(supports.size(), 4u);
  EXPECT_EQ(supports[1]["name"], "tsp2");
  EXPECT_EQ(supports[1]["contacts"][0], "tsp2");
  EXPECT_EQ(supports[1]["work_rate"]["value"], 2e-4);
  EXPECT_EQ(supports[1]["work_rate"]["has_interval"], true);
  EXPECT_EQ(supports[1]["coefficient_m2_per_N"], 2e-14);
  EXPECT_EQ(supports[1]["coefficient_source"], "690_405 on flat_bar: made up");
  EXPECT_EQ(supports[1]["years"], 40.0);
  EXPECT_NEAR(supports[1]["volume_m3"]["value"].get<double>(), 2e-14 * 2e-4 * 40.0 * 31536000.0, round_off);
  EXPECT_LT(supports[1]["depth_m"]["low"], supports[1]["depth_m"]["high"]);
  EXPECT_EQ(supports[1]["life_years"]["end"], "reached");
  EXPECT_EQ(supports[1]["sectors"]["count"], 36);
  EXPECT_FALSE(supports[1].contains("kwu_epri"));
  EXPECT_EQ(supports[1]["states"][0]["share"], 0.75);
  EXPECT_TRUE(supports[1]["support_life_years"].is_null());
  EXPECT_EQ(supports[2]["life_years"]["end"], "outside_law");
  EXPECT_TRUE(supports[2]["depth_m"]["value"].is_null());
  EXPECT_EQ(supports[2]["outside_law"], "edf_mz does not apply: V0 is below S");
  EXPECT_TRUE(supports[3]["life_years"]["value"].is_null()); // never
  EXPECT_EQ(supports[3]["life_years"]["low"], 123.5);
  EXPECT_EQ(supports[3]["support_life_years"]["value"], 77.0);
  EXPECT_EQ(supports[3]["sectors"]["depth_m"].size(), 36u);
  EXPECT_EQ(summary["wear"]["tubes"][0]["supports"], 4);
  const auto& opening = summary["wear"]["gap_opening"];
  EXPECT_EQ(opening["end"], "life_reached");
  EXPECT_TRUE(opening["reason"].is_null());
  EXPECT_EQ(opening["years"], (std::vector<double>{5.0, 12.5}));
  EXPECT_EQ(opening["supports"][1]["name"], "tsp2");
  EXPECT_EQ(opening["supports"][1]["gap_m"], (std::vector<double>{2e-4, 2.5e-4}));
  EXPECT_EQ(opening["supports"][1]["depth_m"][1]["high"], 1.2 * 3e-4);
  EXPECT_EQ(opening["supports"][1]["life_years"]["low"], 5.0);
  EXPECT_TRUE(opening["supports"][1]["support_life_years"].is_null());
  EXPECT_EQ(opening["supports"][3]["support_life_years"]["low"], 44.0);
}

TEST(WearInTheSummary, IsThereOnlyWhereTheStudyAsksForIt) {
  EXPECT_FALSE(summary_of(made_up({.contacts = 2, .outputs = 20})).contains("wear"));
}

TEST(WearInTheArchive, IsReadBackBitForBit) {
  const RunResults out = worn(4);
  const Folder folder;
  write_archive(folder / "results.h5", out);
  const RunResults in = read_archive(folder.path());
  ASSERT_TRUE(in.wear);
  ASSERT_EQ(in.wear->supports.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const WearOfSupport &a = in.wear->supports[i], &b = out.wear->supports[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.contacts, b.contacts);
    EXPECT_EQ(a.node, b.node);
    EXPECT_EQ(a.law + a.source + a.geometry + a.form + a.outside,
              b.law + b.source + b.geometry + b.form + b.outside);
    EXPECT_TRUE(same({a.coefficient, a.support_coefficient, a.radius, a.wall, a.length, a.clearance,
                      a.inclination, a.limit, a.support_limit, a.scar_width, a.scar_length, a.scar_half_angle,
                      a.initial_depth, a.initial_years},
                     {b.coefficient, b.support_coefficient, b.radius, b.wall, b.length, b.clearance,
                      b.inclination, b.limit, b.support_limit, b.scar_width, b.scar_length, b.scar_half_angle,
                      b.initial_depth, b.initial_years}));
    EXPECT_TRUE(
        same({a.work_rate.value, a.work_rate.low, a.work_rate.high, a.life.years.value, a.life.years.low},
             {b.work_rate.value, b.work_rate.low, b.work_rate.high, b.life.years.value, b.life.years.low}));
    EXPECT_EQ(a.life.end + a.support_life.end, b.life.end + b.support_life.end);
    for (const auto which : {&WearOfSupport::volume, &WearOfSupport::support_volume, &WearOfSupport::depth,
                             &WearOfSupport::support_depth})
      EXPECT_TRUE(same((a.*which).value, (b.*which).value) && same((a.*which).low, (b.*which).low) &&
                  same((a.*which).high, (b.*which).high));
    EXPECT_TRUE(same(a.time, b.time) && same(a.sector_rates, b.sector_rates) &&
                same(a.sector_depth, b.sector_depth));
    ASSERT_EQ(a.states.size(), 2u);
    EXPECT_EQ(a.states[1].name, "state 2");
    EXPECT_EQ(a.states[0].share, 0.75);
    EXPECT_EQ(a.states[0].work_rate.high, b.states[0].work_rate.high);
    EXPECT_EQ(a.states[1].work_rate.has_interval, false);
  }
  EXPECT_EQ(in.wear->tubes.size(), out.wear->tubes.size());
  const GapOpening &a = in.wear->opening.value(), &b = out.wear->opening.value();
  EXPECT_EQ(a.end + a.reason, b.end + b.reason);
  EXPECT_TRUE(same(a.time, b.time));
  ASSERT_EQ(a.supports.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(same(a.supports[i].gap, b.supports[i].gap));
    for (const auto which : {&OpenedSupport::work_rate, &OpenedSupport::depth, &OpenedSupport::support_depth})
      EXPECT_TRUE(same((a.supports[i].*which).value, (b.supports[i].*which).value) &&
                  same((a.supports[i].*which).low, (b.supports[i].*which).low) &&
                  same((a.supports[i].*which).high, (b.supports[i].*which).high));
    EXPECT_EQ(a.supports[i].life.end, "reached");
    EXPECT_EQ(a.supports[i].life.years.high, b.supports[i].life.years.high);
    EXPECT_EQ(a.supports[i].support_life.end, i == 3 ? "reached" : "");
    EXPECT_TRUE(same({a.supports[i].support_life.years.low}, {b.supports[i].support_life.years.low}));
  }
}

TEST(WearInTheArchive, IsThereOnlyWhereTheStudyAsksForIt) {
  const Folder folder;
  write_archive(folder / "results.h5", made_up({.contacts = 2, .outputs = 20}));
  EXPECT_FALSE(read_archive(folder.path()).wear);
}

TEST(WearOnTheTerminal, FitsItsWidthAndShowsTheShortestLives) {
  const auto lines = wear_lines(*worn(20).wear);
  EXPECT_EQ(lines.size(), 1u + 10u + 1u + 1u + 1u + 1u + 1u + 2u + 10u + 1u +
                              10u); // the last ones of gap opening, and of the supports
  for (const std::string& line : lines)
    EXPECT_LE(line.size(), widest) << line;
  EXPECT_THAT(lines[0], HasSubstr("in 40 years"));
  EXPECT_THAT(lines[0], HasSubstr("years to 0.436 mm"));
  EXPECT_THAT(lines[1], HasSubstr("tsp20"));
  EXPECT_THAT(lines[1], HasSubstr("25 (21.7 to 29.4)"));
  EXPECT_THAT(lines[11], HasSubstr("the 10 of 20 supports with the shortest lives"));
  EXPECT_THAT(lines[12], HasSubstr("first: tsp20"));
  EXPECT_EQ(lines[13], "  in brackets: +- one standard error of the work rate");
  EXPECT_EQ(lines[14], "  depths begin at 0.1 mm (initial_wear) at 1 of 20 supports");
  EXPECT_EQ(lines[15], "  K = 2e-14 m2/N: 690_405 on flat_bar: made up");
  EXPECT_EQ(lines[16], "  gaps opened in 2 stages up to 12.5 years: a tube has lost its limit");
  EXPECT_THAT(lines[18],
              HasSubstr("tsp20                   0.2 -> 0.25         0.002 -> 0.003     0.3 (0.24 to 0.36)"));
}

TEST(WearOnTheTerminal, SaysWhatDepthsBeginAt) {
  RunResults run = worn(3);
  const auto line = [&] {
    const auto lines = wear_lines(*run.wear);
    const auto at = std::find_if(lines.begin(), lines.end(), [](const std::string& text) {
      return text.starts_with("  depths begin at");
    });
    return at == lines.end() ? std::string() : *at;
  };
  EXPECT_EQ(line(), "");
  auto& supports = run.wear->supports;
  for (WearOfSupport& s : supports) {
    s.sides.clear();
    s.initial_depth = 1.5e-4;
  }
  EXPECT_EQ(line(), "  depths begin at 0.15 mm (initial_wear)");
  supports[0].initial_depth = 0.0;
  supports[1].sides.resize(3); // two of them worn, which the support by itself does not tell
  supports[1].initial_depth = 0.0;
  supports[1].sides[0].initial_depth = 2e-4;
  supports[1].sides[2].initial_depth = 1e-4;
  for (WearOfSide& side : supports[1].sides)
    side.volume = supports[1].volume;
  EXPECT_EQ(line(), "  depths begin at 0.1 to 0.2 mm (initial_wear) at 2 of 3 supports");
}

TEST(WearOnTheTerminal, HasTheLivesOfSupportsWithOpenedGaps) {
  const auto lines = wear_lines(*worn(4).wear);
  const auto head = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
    return line.starts_with("  lives of the supports, with opened gaps");
  });
  ASSERT_GT(lines.end() - head, 2);
  EXPECT_THAT(head[1], MatchesRegex("  tsp4 +0.15 \\(0.12 to 0.18\\) +55 \\(44 to 66\\)"));
  EXPECT_THAT(head[2], HasSubstr("K m2/N")); // of the others nothing
}

TEST(WearOnTheTerminal, SaysWhatItsIntervalsAre) {
  RunResults run = worn(2);
  for (WearOfSupport& support : run.wear->supports)
    support.confidence = 0.95;
  EXPECT_THAT(terminal_table(run), HasSubstr("in brackets: intervals of 95 % confidence"));
  run.wear->supports[1].confidence.reset();
  EXPECT_THAT(terminal_table(run), HasSubstr("in brackets: intervals of the confidence of each [[wear]]"));
}

TEST(WearOnTheTerminal, SaysNeverAndOutsideTheLaw) {
  const auto lines = wear_lines(*worn(4).wear);
  EXPECT_THAT(lines[3], HasSubstr("outside the law"));
  for (const std::string& line : lines)
    EXPECT_THAT(line, Not(HasSubstr("nan")));
  EXPECT_THAT(lines[4], HasSubstr("never (124 to never)"));
  EXPECT_THAT(terminal_table(worn(2)), HasSubstr("in 40 years"));
  EXPECT_THAT(terminal_table(made_up({.contacts = 2})), Not(HasSubstr("years")));
}

TEST(WearOnTheTerminal, ShowsRoundOffAsZero) {
  RunResults run = worn(2);
  WearOfSupport& support = run.wear->supports[0];
  support.work_rate.value = 5.4e-45;
  support.volume.value.back() = 1.4e-49;
  support.depth.value.back() = 1.1e-31;
  support.depth.low.back() = 9.3e-32;
  support.depth.high.back() = 1.3e-31;
  support.life.years = {9.8e42, 8e42, 1.3e43};
  EXPECT_THAT(wear_lines(*run.wear)[1], MatchesRegex("  tsp1 +0 +0 +0 .*  never  archard.*"));
}

TEST(WearOnTheTerminal, AlignsItsColumns) {
  RunResults run = worn(2);
  run.wear->supports[0].life.years = {1371.0, 957.0, 2412.0};
  const auto lines = wear_lines(*run.wear);
  const auto of_law = [](const std::string& line) { return line.find("archard"); };
  EXPECT_THAT(lines[1], HasSubstr("1371 (957 to 2412)"));
  EXPECT_EQ(of_law(lines[1]), of_law(lines[2]));
  EXPECT_EQ(of_law(lines[1]), lines[0].find("law, m2/N"));
}

TEST(ExportCsv, HasFilesOfWear) {
  const Folder folder;
  RunResults results = worn(2);
  results.wear->supports[1].source = "a \"b\", c";
  results.wear->supports[0].initial_depth = 2.5e-4;
  results.wear->supports[0].initial_years = 12.5;
  export_csv(folder.path(), results);
  const auto table = lines_of(folder / "wear.csv");
  ASSERT_EQ(table.size(), 3u);
  EXPECT_THAT(table[0],
              HasSubstr("support,tube,law,coefficient [m2/N],source,work_rate [W],work_rate_low [W]"));
  EXPECT_THAT(table[1], HasSubstr("\"tsp1\",0,archard,2e-14,"));
  EXPECT_THAT(table[0], testing::EndsWith(",initial_depth [m],initial_years [years]"));
  EXPECT_THAT(table[1], testing::EndsWith(",0.00025,12.5"));
  EXPECT_THAT(table[2], HasSubstr("\"a \"\"b\"\", c\""));
  EXPECT_EQ(lines_of(folder / "gap_opening.csv").size(), 1u + 2u * 2u);
  EXPECT_EQ(lines_of(folder / "tsp1_wear.csv").size(), 42u);
  EXPECT_EQ(lines_of(folder / "tsp2_wear_sectors.csv").size(), 37u);
  EXPECT_EQ(lines_of(folder / "tsp2_wear_sectors.csv")[0], "from [rad],to [rad],work_rate [W]");
  export_csv(folder.path(), made_up({.contacts = 2, .outputs = 20})); // removes them
  EXPECT_FALSE(std::filesystem::exists(folder / "wear.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "gap_opening.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "tsp2_wear_sectors.csv"));
}

} // namespace fretwork::results::wear_test
