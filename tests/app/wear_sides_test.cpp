// SPDX-License-Identifier: GPL-3.0-or-later
// A tube between flat faces, or lands, wears a scar at each.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include "wear/depth.hpp"
#include "wear/laws.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::wear_sides_test {
namespace {

constexpr double round_off = 1e-12;   ///< of sums and products of a few numbers
constexpr double of_sums = 1e-9;      ///< work summed by contact and by side, over some ten thousand steps
constexpr double bracketed = 1e-9;    ///< of times and depths from bracketed roots
constexpr double gap = 1e-5;          // m
constexpr double radius = 9.525e-3;   // m
constexpr double coefficient = 2e-14; // m2/N
const wear::FlatBar bar{radius, 0.02};

const std::string archard = "coefficient = 2.0e-14\nlength = 0.02\n";

/// A tube that slides between two bars, nearer to that at +y, and [[wear]].
std::string between_bars(const Workshop& folder, const std::string& wear,
                         const std::string& obstacle = "obstacle = \"plane_y\"\ngap = 1.0e-5") {
  std::string study = bundle(folder, 1, "[transient]\nduration = 0.3\n") + across("drive0");
  const std::string old = "gap = 1.0e-5";
  study.replace(study.find(old), old.size(), "y_axis = [0, 1, 0]\noffset = [-5.0e-6, 0]\n" + obstacle);
  return study + "[[wear]]\n" + wear;
}

const nlohmann::json& support(const Results& run) { return run.summary["wear"]["supports"][0]; }

double rate_of(const Results& run, const char* side) {
  return run.statistics("support0")["sides"][side]["work_rate"];
}

} // namespace

TEST(WearSides, HaveTheirOwnWorkDepthAndYears) {
  const Workshop folder;
  const Results run =
      folder.run_text(between_bars(folder, archard + "support_coefficient = 1e-14\nyears = 0.1\n"));
  const auto& sides = support(run)["sides"];
  ASSERT_EQ(sides.size(), 2u);
  double volume = 0.0, depth = 0.0, years = std::numeric_limits<double>::infinity(), work = 0.0;
  for (const auto& side : sides) {
    const auto& contact = run.statistics("support0")["sides"][side["name"].get<std::string>()];
    const double w = contact["work_rate"], error = contact["standard_error"]["work_rate"];
    ASSERT_GT(w, 0.0);
    EXPECT_EQ(side["work_rate"]["value"], w);
    EXPECT_TRUE(close_to(side["work_rate"]["high"], w + error, round_off));
    const double own = coefficient * w * 0.1 * wear::year, both = 1.5 * own;
    EXPECT_TRUE(close_to(side["volume_m3"]["value"], own, round_off));
    EXPECT_TRUE(close_to(side["depth_m"]["value"], wear::depth(bar, both).value() / 1.5, bracketed));
    EXPECT_TRUE(close_to(side["support_depth_m"]["value"], wear::depth(bar, both).value() / 3.0, bracketed));
    work += w;
    volume += own;
    depth = std::max(depth, side["depth_m"]["value"].get<double>());
    years = std::min(years, side["life_years"]["value"].get<double>());
  }
  EXPECT_NE(rate_of(run, "+y"), rate_of(run, "-y"));
  EXPECT_TRUE(close_to(work, run.statistics("support0")["work_rate"], of_sums));
  EXPECT_EQ(support(run)["work_rate"]["value"], run.statistics("support0")["work_rate"]);
  EXPECT_TRUE(close_to(support(run)["volume_m3"]["value"], volume, round_off));
  EXPECT_EQ(support(run)["depth_m"]["value"], depth);
  EXPECT_EQ(support(run)["life_years"]["value"], years);
}

TEST(WearSides, HaveInitialWearOfTheirOwn) {
  const Workshop folder;
  const Results run =
      folder.run_text(between_bars(folder, archard + "years = 0.1\ninitial_wear = { \"+y\" = 0.1 }\n"));
  const auto& sides = support(run)["sides"];
  ASSERT_EQ(sides.size(), 2u);
  for (const auto& side : sides) {
    const double before = side["name"] == "+y" ? wear::volume(bar, 0.109e-3) : 0.0;
    EXPECT_TRUE(close_to(side["volume_m3"]["value"],
                         before + coefficient * side["work_rate"]["value"].get<double>() * 0.1 * wear::year,
                         of_sums));
    EXPECT_EQ(side["initial_years"].is_null(), before == 0.0);
  }
  EXPECT_TRUE(close_to(support(run)["initial_depth_m"], 0.109e-3, of_sums));
  const std::string other = between_bars(folder, archard + "initial_wear = { \"+z\" = 0.1 }\n");
  const Outcome refused = folder.fretwork({"check", folder.write("study.toml", other).string()});
  EXPECT_TRUE(says(refused.err, "initial_wear.+z: there is no side \"+z\"")) << refused.err;
}

TEST(WearSides, OfAnEggCrateAreFour) {
  const Workshop folder;
  const Results run = folder.run_text(
      between_bars(folder, archard,
                   "obstacle = \"egg_crate\"\ntube_radius = 9.525e-3\nhalf_widths = [0.009535, 0.009535]"));
  const auto& sides = support(run)["sides"];
  ASSERT_EQ(sides.size(), 4u);
  double work = 0.0;
  for (const auto& side : sides)
    work += side["work_rate"]["value"].get<double>();
  EXPECT_TRUE(close_to(work, support(run)["work_rate"]["value"], of_sums));
  EXPECT_GT(rate_of(run, "+z"), 0.0);
}

TEST(WearSides, OfAConvexPolygonAreItsFacets) {
  const Workshop folder;
  const std::string square = "obstacle = \"profile\"\nprofile = [[45, 1.4e-5], [165, 1.4e-5], [285, 1.4e-5]]";
  const Results run =
      folder.run_text(between_bars(folder, archard + "geometry = \"flat_bar\"\nyears = 0.1\n", square));
  const auto& sides = support(run)["sides"];
  ASSERT_EQ(sides.size(), 3u);
  double work = 0.0, deepest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string name = fmt::format("facet {}", k + 1);
    EXPECT_EQ(sides[k]["name"], name);
    const double w = rate_of(run, name.c_str());
    EXPECT_EQ(sides[k]["work_rate"]["value"], w);
    work += w;
    deepest = std::max(deepest, wear::depth(bar, coefficient * w * 0.1 * wear::year).value());
  }
  EXPECT_TRUE(close_to(work, support(run)["work_rate"]["value"], of_sums));
  EXPECT_TRUE(close_to(support(run)["depth_m"]["value"], deepest, bracketed));
  EXPECT_FALSE(support(folder.run_text(between_bars(
                           folder, archard + "geometry = \"drilled_hole\"\nclearance = 1e-5\n", square)))
                   .contains("sides"));
  const Results opened = folder.run_text(between_bars(
      folder, archard + "geometry = \"flat_bar\"\nyears = 0.1\n[gap_opening]\nstages = 2\n", square));
  EXPECT_EQ(opened.summary["wear"]["gap_opening"]["years"].size(), 2u);
}

// Of a broached hole whose tube works on several lands each wears its share: by the sectors of the work, and less deep than one scar.
TEST(WearSides, OfABroachedHoleAreItsLands) {
  const Workshop folder;
  const std::string study =
      between_bars(folder, archard + "support_coefficient = 1e-14\nyears = 0.1\nsectors = 36\n",
                   "obstacle = \"broached\"\ntube_radius = 9.525e-3\nland_radius = 9.535e-3\nlobe_radius = "
                   "0.012\nland_angle = 20");
  const Results run = folder.run_text(study);
  const auto& sides = support(run)["sides"];
  ASSERT_EQ(sides.size(), 3u);
  const wear::Lands land{radius, 1e-5, 0.02, 10.0 * std::numbers::pi / 180.0};
  double work = 0.0, deepest = 0.0, volume = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string name = fmt::format("land {}", k + 1);
    EXPECT_EQ(sides[k]["name"], name);
    const double w = rate_of(run, name.c_str());
    EXPECT_EQ(sides[k]["work_rate"]["value"], w);
    double of_sectors = 0.0; // the 12 sectors about the middle of the land, from -180 degrees on
    for (int s = -6; s < 6; ++s)
      of_sectors +=
          support(
              run)["sectors"]["work_rate"][static_cast<std::size_t>((18 + 12 * static_cast<int>(k) + s) % 36)]
              .get<double>();
    EXPECT_TRUE(close_to(w, of_sectors, of_sums)) << name;
    const double own = coefficient * w * 0.1 * wear::year, depth = wear::depth(land, 1.5 * own).value() / 1.5;
    EXPECT_TRUE(close_to(sides[k]["volume_m3"]["value"], own, round_off));
    EXPECT_TRUE(close_to(sides[k]["depth_m"]["value"], depth, bracketed));
    work += w;
    volume += own;
    deepest = std::max(deepest, depth);
  }
  EXPECT_TRUE(close_to(work, support(run)["work_rate"]["value"], of_sums));
  EXPECT_TRUE(close_to(support(run)["volume_m3"]["value"], volume, of_sums));
  EXPECT_TRUE(close_to(support(run)["depth_m"]["value"], deepest, bracketed));
  EXPECT_LT(deepest, 0.9 * wear::depth(land, 1.5 * volume).value() / 1.5);
  EXPECT_TRUE(says(run.summary["contacts"].dump(), "land 2"));
}

// A scar about the corner of a land loses half of its width; the note says how much deeper that is.
TEST(WearSides, OfLandsSayWhichShareOfTheWorkIsAtCorners) {
  const Workshop folder;
  const Results run = folder.run_text(
      between_bars(folder, archard + "years = 1e-7\n",
                   "obstacle = \"broached\"\ntube_radius = 9.525e-3\nland_radius = 9.535e-3\nlobe_radius = "
                   "0.012\nlands = 4\nland_angle = 20"));
  const auto& corners = support(run)["corners"];
  const double share = corners["work_share"];
  EXPECT_GT(share, 0.05);
  EXPECT_LT(share, 1.0);
  const double half = 10.0 * std::numbers::pi / 180.0;
  const wear::Lands middle{radius, 1e-5, 0.02, half};
  wear::Lands corner = middle;
  corner.middles = {half};
  double deepest = 0.0, about_corner = 0.0;
  for (const auto& side : support(run)["sides"]) {
    const double volume = side["volume_m3"]["value"];
    deepest = std::max(deepest, wear::depth(middle, volume).value());
    about_corner = std::max(about_corner, wear::depth(corner, volume).value());
  }
  EXPECT_TRUE(close_to(support(run)["depth_m"]["value"], deepest, bracketed));
  EXPECT_TRUE(close_to(corners["depth_m"], about_corner, bracketed));
  EXPECT_GT(about_corner, 1.1 * deepest);
  EXPECT_LT(corners["life_years"].get<double>(), support(run)["life_years"]["value"].get<double>());
  EXPECT_TRUE(says(run.summary["notes"].dump(),
                   fmt::format("wear of \\\"support0\\\": {:.0f} % of the work of \\\"support0\\\" is at "
                               "corners of lands",
                               100.0 * share)));
  EXPECT_FALSE(support(folder.run_text(between_bars(folder, archard))).contains("corners"));
}

// A work rate that the study gives has the shares of this run at corners too. Of lands that are not told apart nobody knows the share.
TEST(WearSides, OfLandsAtCornersBearGivenWorkRates) {
  const Workshop folder;
  const std::string hole =
      "obstacle = \"broached\"\ntube_radius = 9.525e-3\nland_radius = 9.535e-3\nlobe_radius = 0.012\n";
  const Results run = folder.run_text(
      between_bars(folder, archard + "years = 1e-7\nstates = [{ share = 1.0, work_rate = 0.5 }]\n",
                   hole + "lands = 4\nland_angle = 20"));
  wear::Lands corner{radius, 1e-5, 0.02, 10.0 * std::numbers::pi / 180.0};
  corner.middles = {corner.half_angle};
  double about_corner = 0.0;
  for (const auto& side : support(run)["sides"])
    about_corner = std::max(about_corner, wear::depth(corner, side["volume_m3"]["value"]).value());
  EXPECT_GT(about_corner, 0.0);
  EXPECT_TRUE(close_to(support(run)["corners"]["depth_m"], about_corner, bracketed));
  EXPECT_FALSE(support(folder.run_text(between_bars(folder, archard, hole + "lands = 9\nland_angle = 20")))
                   .contains("corners"));
}

// The reference form of lands is a formula of all of them together.
TEST(WearSides, AreNotThoseOfTheReferenceFormOfLands) {
  const Workshop folder;
  const Results run = folder.run_text(
      between_bars(folder, archard + "form = \"reference\"\n",
                   "obstacle = \"broached\"\ntube_radius = 9.525e-3\nland_radius = 9.535e-3\nlobe_radius = "
                   "0.012\nland_angle = 20"));
  EXPECT_FALSE(support(run).contains("sides"));
}

TEST(WearSides, AreThoseOfFlatBarsOnly) {
  const Workshop folder;
  const Results named = folder.run_text(between_bars(folder, archard + "geometry = \"ring\"\n"));
  EXPECT_FALSE(support(named).contains("sides"));
  const Results hole = folder.run_text(between_bars(folder, archard, "gap = 1.0e-5"));
  EXPECT_FALSE(support(hole).contains("sides"));
  EXPECT_FALSE(hole.statistics("support0").contains("sides"));
}

// A law that is not linear in the work rate: the rate is split before the law.
TEST(WearSides, HaveTheirOwnRateInTheLaw) {
  const Workshop folder;
  const Results run =
      folder.run_text(between_bars(folder, "law = \"edf_mz\"\nlength = 0.02\nyears = 5\nstates = [{ share = "
                                           "0, name = \"this\" }, { share = 1, work_rate = 0.02 }]\n"));
  const double plus = rate_of(run, "+y"), minus = rate_of(run, "-y");
  for (const auto& [k, rate] :
       {std::pair(0, 0.02 * plus / (plus + minus)), std::pair(1, 0.02 * minus / (plus + minus))}) {
    const auto& side = support(run)["sides"][static_cast<std::size_t>(k)];
    EXPECT_TRUE(close_to(side["work_rate"]["value"], rate, round_off)); // the shares of this run
    const auto worn = wear::worn_volume(wear::EdfMz{}, rate);
    ASSERT_TRUE(worn.volume);
    EXPECT_TRUE(close_to(side["volume_m3"]["value"], worn.volume->at(5.0 * wear::year), round_off));
  }
}

TEST(WearSides, OfAnotherRunAreItsOwn) {
  const Workshop folder;
  const fs::path study = folder.write(
      "study.toml",
      between_bars(folder, archard + "states = [{ share = 0.5 }, { share = 0.5, results = \"part\" }]\n"));
  const Results part = folder.run(study, "part", {"--set", "loads.0.random.rms=15"}),
                whole = folder.run(study, "whole");
  for (const auto& side : support(whole)["sides"]) {
    const std::string name = side["name"];
    EXPECT_TRUE(close_to(side["work_rate"]["value"],
                         0.5 * (rate_of(part, name.c_str()) + rate_of(whole, name.c_str())), round_off));
  }
  (void)folder.run(study, "part",
                   {"--set", "contacts.support0.obstacle=\"circle\""}); // as before there were sides
  const Outcome refused =
      folder.fretwork({"run", study.string(), "--no-report", "-o", folder.path("whole").string()});
  EXPECT_NE(refused.status, 0);
  EXPECT_TRUE(
      says(refused.err, "has no work of contact \"support0\" on its side +y; make it from this study"));
}

TEST(WearSides, OpenEachByItsOwnDepth) {
  const Workshop folder;
  const Results run = folder.run_text(between_bars(folder, archard + "[gap_opening]\nstages = 2\n"));
  const auto& stages = run.summary["wear"]["gap_opening"]["supports"][0];
  ASSERT_EQ(stages["work_rate"].size(), 2u);
  const double time = run.summary["wear"]["gap_opening"]["years"][0].get<double>() * wear::year;
  const double plus = wear::depth(bar, coefficient * rate_of(run, "+y") * time).value(),
               minus = wear::depth(bar, coefficient * rate_of(run, "-y") * time).value();
  EXPECT_TRUE(close_to(stages["depth_m"][0]["value"], std::max(plus, minus), bracketed));
  std::string opened = between_bars(folder, archard);
  const std::string old = "offset = [-5.0e-6, 0]\nobstacle = \"plane_y\"\ngap = 1.0e-5";
  opened.replace(opened.find(old), old.size(),
                 fmt::format("offset = [{}, 0]\nobstacle = \"plane_y\"\ngap = {}",
                             -5e-6 + 0.5 * (plus - minus), gap + 0.5 * (plus + minus)));
  const Results alone = folder.run_text(opened);
  EXPECT_TRUE(close_to(stages["work_rate"][1]["value"], alone.statistics("support0")["work_rate"], 1e-3));
  EXPECT_NE(plus, minus);
}

// Two contacts of one bar each that press on the tube from opposite sides: one sum, and the work of each contact on its side.
TEST(WearSides, OfBarsInTwoContactsAreThoseOfOneSupport) {
  const Workshop folder;
  const auto bar_at = [](const char* name, int angle) {
    return fmt::format(
        "[[contacts]]\nname = \"{}\"\ngroup = \"support0\"\nobstacle = \"bars_y\"\ntube_radius = "
        "9.525e-3\nbars = 9.525e-3\noffset = [-2.0e-6, 0]\naxis = [1, 0, 0]\nangle = {}\n"
        "normal_stiffness = 1.0e6\nfriction = 0.3\ntangential_stiffness = 1.0e6\n",
        name, angle);
  };
  std::string study = between_bars(
      folder, archard + "years = 0.1\nname = \"bars\"\ncontacts = \"bar_*\"\none_support = true\n");
  study += bar_at("bar_up", 90) + bar_at("bar_down", 270);
  const Results run = folder.run_text(study);
  const auto& bars = run.summary["wear"]["supports"].back();
  ASSERT_EQ(bars["sides"].size(), 2u);
  const double up = run.statistics("bar_up")["work_rate"], down = run.statistics("bar_down")["work_rate"];
  ASSERT_GT(std::min(up, down), 0.0);
  EXPECT_EQ(bars["sides"][0]["name"], "+y");
  EXPECT_EQ(bars["sides"][0]["work_rate"]["value"], up);
  EXPECT_EQ(bars["sides"][1]["name"], "-y");
  EXPECT_EQ(bars["sides"][1]["work_rate"]["value"], down);
  EXPECT_TRUE(close_to(bars["work_rate"]["value"], up + down, round_off));
  const double years = 0.1 * wear::year;
  EXPECT_TRUE(close_to(bars["depth_m"]["value"],
                       wear::depth(bar, coefficient * std::max(up, down) * years).value(), bracketed));
  const auto& sectors = bars["sectors"]["work_rate"]; // from -180 degrees on
  const auto work_at = [&](std::size_t middle) {
    return sectors[middle - 1].get<double>() + sectors[middle].get<double>();
  };
  EXPECT_TRUE(close_to(work_at(18), up, of_sums));
  EXPECT_TRUE(close_to(sectors[0].get<double>() + sectors[35].get<double>(), down, of_sums));
}

TEST(WearSides, OpenEachLandByItsOwnDepth) {
  const Workshop folder;
  const Results run =
      folder.run_text(between_bars(folder, archard + "[gap_opening]\nstages = 2\n",
                                   "obstacle = \"broached\"\ntube_radius = 9.525e-3\nland_radius = "
                                   "9.535e-3\nlobe_radius = 0.012\nland_angle = 20"));
  const auto& stages = run.summary["wear"]["gap_opening"]["supports"][0];
  ASSERT_EQ(stages["work_rate"].size(), 2u);
  const double time = run.summary["wear"]["gap_opening"]["years"][0].get<double>() * wear::year;
  const wear::Lands land{radius, 1e-5, 0.02, 10.0 * std::numbers::pi / 180.0};
  double deepest = 0.0;
  for (const char* name : {"land 1", "land 2", "land 3"})
    deepest = std::max(deepest, wear::depth(land, coefficient * rate_of(run, name) * time).value());
  EXPECT_TRUE(close_to(stages["depth_m"][0]["value"], deepest, bracketed));
  EXPECT_TRUE(close_to(stages["gap_m"][1], 1e-5 + deepest, bracketed));
  EXPECT_NE(stages["work_rate"][0]["value"], stages["work_rate"][1]["value"]);
}

} // namespace fretwork::app::test::wear_sides_test
