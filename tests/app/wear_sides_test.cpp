// SPDX-License-Identifier: GPL-3.0-or-later
// A tube between flat faces wears a scar at each.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include "wear/depth.hpp"
#include "wear/laws.hpp"
#include <cmath>
#include <fmt/format.h>

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

} // namespace fretwork::app::test::wear_sides_test
