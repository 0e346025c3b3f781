// SPDX-License-Identifier: GPL-3.0-or-later
// [gap_opening]: the run repeated at the gaps that its wear has opened.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app::test {
namespace {

constexpr double bracketed = 1e-9;           ///< of times and depths from bracketed roots
constexpr double gap = 1e-5, wall = 1.09e-3; // m, of the bundle

const std::string short_run =
    "[transient]\nduration = 0.3\n[output]\nevery = 1.0e-3\nstatistics_from = 0.05\n";
const std::string archard = "[[wear]]\ncoefficient = 2.0e-14\nlength = 0.02\n";

/// The bundle with a load across the other one, so that its first tube slides.
std::string sliding_bundle(const Workshop& folder, int tubes) {
  return bundle(folder, tubes, short_run) + across("drive0");
}

std::string opening(const std::string& keys) { return "[gap_opening]\n" + keys; }

const nlohmann::json& opened(const Results& run) { return run.summary["wear"]["gap_opening"]; }

/// The study with another gap of its contacts.
std::string with_gap(std::string study, double other) {
  const std::string old = "gap = 1.0e-5";
  study.replace(study.find(old), old.size(), fmt::format("gap = {}", other));
  return study;
}

} // namespace

TEST(GapOpening, WithWorkRatesThatDoNotChangeKeepsTheLife) {
  const Workshop folder;
  const Results run = folder.run_text(
      bundle(folder, 1, "[transient]\nduration = 0.01\n") + archard +
      "support_coefficient = 1e-14\nstates = [{ share = 1, work_rate = [1e-3, 2e-3, 4e-3] }]\n" +
      opening("wall_share = 0.1\nleast_wall_share = 0.1\nyears = 10000\n"));
  const auto &support = run.summary["wear"]["supports"][0], &stages = opened(run)["supports"][0];
  EXPECT_EQ(opened(run)["end"], "life_reached");
  EXPECT_GT(opened(run)["years"].size(), 3u);
  for (const char* end : {"value", "low", "high"})
    EXPECT_TRUE(close_to(stages["life_years"][end], support["life_years"][end], bracketed)) << end;
  EXPECT_TRUE(close_to(opened(run)["years"].back(), support["life_years"]["value"], bracketed));
  EXPECT_TRUE(close_to(stages["depth_m"].back()["value"], 0.4 * wall, bracketed));
  EXPECT_EQ(stages["gap_m"][0], gap);
  EXPECT_TRUE(close_to(stages["gap_m"][1], gap + 0.1 * wall, bracketed)); // of both bodies together
}

TEST(GapOpening, GoesOnFromInitialWear) {
  const Workshop folder;
  const auto run_with = [&](const std::string& keys, const std::string& stages) {
    return folder.run_text(
        bundle(folder, 1, "[transient]\nduration = 0.01\n") + archard + keys +
        "support_coefficient = 1e-14\ninitial_wear = 0.2\nstates = [{ share = 1, work_rate = 2e-3 }]\n" +
        opening("wall_share = 0.1\nleast_wall_share = 0.1\nyears = 10000\n" + stages));
  };
  const Results run = run_with("", "");
  const auto &support = run.summary["wear"]["supports"][0], &stages = opened(run)["supports"][0];
  EXPECT_EQ(opened(run)["end"], "life_reached");
  EXPECT_TRUE(close_to(support["initial_depth_m"], 0.2 * wall, bracketed));
  EXPECT_TRUE(close_to(stages["life_years"]["value"], support["life_years"]["value"], bracketed));
  EXPECT_EQ(stages["gap_m"][0], gap);
  EXPECT_TRUE(close_to(stages["gap_m"][1], gap + 0.1 * wall, bracketed));
  EXPECT_TRUE(close_to(stages["depth_m"].back()["value"], 0.4 * wall, bracketed));
  // the sector with the most work begins with that depth
  const Results sectors = run_with("geometry = \"sectors\"\nsectors = 8\n", "stages = 1\n");
  const auto& worn = sectors.summary["wear"]["supports"][0];
  EXPECT_TRUE(close_to(worn["initial_depth_m"], 0.2 * wall, bracketed));
  EXPECT_TRUE(close_to(opened(sectors)["supports"][0]["life_years"]["value"], worn["life_years"]["value"],
                       bracketed));
}

TEST(GapOpening, GivesTheLivesOfSupports) {
  const Workshop folder;
  const auto stages_of = [&](const std::string& keys) {
    const Results run = folder.run_text(bundle(folder, 1, "[transient]\nduration = 0.01\n") + archard +
                                        "support_coefficient = 1e-14\n" + keys +
                                        "states = [{ share = 1, work_rate = [1e-3, 2e-3, 4e-3] }]\n" +
                                        opening("wall_share = 0.1\nleast_wall_share = 0.1\nyears = 10000\n"));
    return std::pair(run.summary["wear"]["supports"][0]["support_life_years"],
                     opened(run)["supports"][0]["support_life_years"]);
  };
  // the support loses half of what the tube does: 0.218 mm until the tube has lost its limit, which ends the stages
  for (const char* limit : {"5e-5", "4e-4"}) {
    const auto [alone, stages] = stages_of(fmt::format("support_limit = {}\n", limit));
    EXPECT_EQ(stages["end"], "reached");
    for (const char* end : {"value", "low", "high"})
      EXPECT_TRUE(close_to(stages[end], alone[end], bracketed)) << limit << ", " << end;
  }
  EXPECT_TRUE(stages_of("").second.is_null());
}

TEST(GapOpening, HasNoLifeWhereTheWearLeavesItsGeometry) {
  const Workshop folder;
  const Results run = folder.run_text(
      bundle(folder, 1, "[transient]\nduration = 0.01\n") +
      "[[wear]]\ncoefficient = 2.0e-14\nsupport_coefficient = 1e-13\nlength = 0.03\nform = \"reference\"\n"
      "inclination = 1.0\nstates = [{ share = 1, work_rate = [1e-3, 2e-3, 4e-3] }]\n" +
      opening("wall_share = 0.1\nleast_wall_share = 0.1\nyears = 10000\n"));
  EXPECT_EQ(opened(run)["end"], "beyond_geometry");
  for (const auto& life :
       {run.summary["wear"]["supports"][0]["life_years"], opened(run)["supports"][0]["life_years"]}) {
    EXPECT_EQ(life["end"], "beyond_geometry");
    EXPECT_TRUE(life["value"].is_null());
  }
}

TEST(GapOpening, RunsEachStageAtItsGap) {
  const Workshop folder;
  const std::string study = sliding_bundle(folder, 1);
  const Results run = folder.run_text(study + archard + opening("stages = 3\n"));
  const auto& stages = opened(run)["supports"][0];
  ASSERT_EQ(stages["work_rate"].size(), 3u);
  EXPECT_EQ(stages["work_rate"][0]["value"], run.statistics("support0")["work_rate"]);
  for (std::size_t stage = 1; stage < 3; ++stage) {
    const double here = stages["gap_m"][stage];
    EXPECT_TRUE(close_to(here, gap + stages["depth_m"][stage - 1]["value"].get<double>(), bracketed));
    const Results alone = folder.run_text(with_gap(study, here));
    EXPECT_EQ(stages["work_rate"][stage]["value"], alone.statistics("support0")["work_rate"]) << stage;
  }
  EXPECT_NE(stages["work_rate"][0]["value"], stages["work_rate"][2]["value"]);
  EXPECT_EQ(opened(run)["end"], "stages_used");
  EXPECT_TRUE(says(run.summary["warnings"].dump(), "gap opening: 3 stages after"));
  EXPECT_LT(stages["depth_m"][2]["low"], stages["depth_m"][2]["value"]);
  EXPECT_LT(stages["life_years"]["low"], stages["life_years"]["value"]);
  EXPECT_LT(stages["life_years"]["value"], stages["life_years"]["high"]);
}

TEST(GapOpening, LeavesTheFirstRunAsItIsWithoutIt) {
  const Workshop folder;
  const std::string study = sliding_bundle(folder, 2) + archard;
  const Results plain = folder.run_text(study), followed = folder.run_text(study + opening("stages = 2\n"));
  EXPECT_EQ(plain.summary["contacts"], followed.summary["contacts"]);
  EXPECT_EQ(plain.summary["wear"]["supports"], followed.summary["wear"]["supports"]);
  EXPECT_TRUE(same_numbers(plain.archive, followed.archive));
}

TEST(GapOpening, EndsWhereNothingWearsAndAtTheEndOfTheYears) {
  const Workshop folder;
  const auto end_of = [&](const std::string& rate, const std::string& keys) {
    const Results run =
        folder.run_text(bundle(folder, 1, "[transient]\nduration = 0.01\n") + archard +
                        "states = [{ share = 1, work_rate = " + rate + " }]\n" + opening(keys));
    return std::pair(opened(run)["end"].get<std::string>(),
                     opened(run)["supports"][0]["life_years"]["end"].get<std::string>());
  };
  EXPECT_EQ(end_of("0", ""), std::pair(std::string("geometry_stands"), std::string("never")));
  EXPECT_EQ(end_of("1e-6", "years = 0.5\n"),
            std::pair(std::string("horizon_reached"), std::string("reached")));
}

TEST(GapOpening, BySectorsOpensAProfile) {
  const Workshop folder;
  const Results run = folder.run_text(sliding_bundle(folder, 1) + archard +
                                      "geometry = \"sectors\"\nsectors = 12\n" + opening("stages = 3\n"));
  const auto& stages = opened(run)["supports"][0];
  ASSERT_EQ(stages["gap_m"].size(), 3u);
  double before = gap;
  for (std::size_t stage = 1; stage < 3; ++stage) { // of the sector that has opened most
    EXPECT_GT(stages["gap_m"][stage], before);
    EXPECT_TRUE(close_to(stages["gap_m"][stage], gap + stages["depth_m"][stage - 1]["value"].get<double>(),
                         bracketed));
    before = stages["gap_m"][stage];
  }
}

TEST(GapOpening, IsTheSameOnTwoRanksAndReadFromItsResults) {
  const Workshop folder;
  const fs::path study =
      folder.write("study.toml", sliding_bundle(folder, 2) + archard + opening("stages = 3\n"));
  const Results one = folder.run(study, "one"), two = folder.run(study, "two", {}, 2);
  EXPECT_EQ(one.summary["wear"], two.summary["wear"]);
  EXPECT_TRUE(bytes_of(folder.path("one") / "results.h5") == bytes_of(folder.path("two") / "results.h5"));
  ASSERT_TRUE(one.archive.wear->opening);
  EXPECT_EQ(one.archive.wear->opening->supports[1].gap,
            opened(one)["supports"][1]["gap_m"].get<std::vector<double>>());
  EXPECT_EQ(folder.fretwork({"export", folder.path("one").string()}).status, 0);
  EXPECT_TRUE(says(bytes_of(folder.path("one") / "export-csv" / "gap_opening.csv"),
                   "support,stage,end [s],gap [m],work_rate [W]"));
}

TEST(GapOpening, IsRefusedWhereNoGapCanOpen) {
  const Workshop folder;
  const auto refused = [&](const std::string& study) {
    const Outcome outcome = folder.fretwork({"check", folder.write("study.toml", study).string()});
    EXPECT_EQ(outcome.status, 1) << outcome.out;
    return outcome.err;
  };
  std::string planes = sliding_bundle(folder, 1);
  planes.replace(planes.find("gap = 1.0e-5"), 12, "gap = 1.0e-5\nobstacle = \"plane_y\"\ny_axis = [0, 1, 0]");
  EXPECT_TRUE(says(refused(planes + archard + "geometry = \"sectors\"\nclearance = 1e-5\n" + opening("")),
                   "contact \"support0\": with [gap_opening] only a circle or a drilled hole with a gap > 0, "
                   "not between two nodes, opens by sectors; give another geometry"));
  EXPECT_TRUE(says(refused(sliding_bundle(folder, 1) + archard +
                           "geometry = \"sectors\"\nclearance = 1e-5\nsectors = 2\n" + opening("")),
                   "wear.0.sectors = 2: with [gap_opening] the sectors enclose the hole; give 3 or more"));
  EXPECT_TRUE(says(refused(sliding_bundle(folder, 1) + opening("")), "there is no [[wear]]"));
  const Outcome sweep = folder.fretwork(
      {"sweep",
       folder
           .write("study.toml", sliding_bundle(folder, 1) + archard + opening("") +
                                    "[sweep]\ndraws = 2\n[[sweep.variables]]\nkey = "
                                    "\"contacts.support0.gap\"\nuniform = { from = 1e-5, to = 2e-5 }\n")
           .string()});
  EXPECT_EQ(sweep.status, 1);
  EXPECT_TRUE(says(sweep.err, "a sweep computes wear at the gaps of each case"));
}

} // namespace fretwork::app::test
