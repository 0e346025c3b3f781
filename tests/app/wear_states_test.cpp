// SPDX-License-Identifier: GPL-3.0-or-later
// Operating states of wear: one study makes the runs of all its states.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"

namespace fretwork::app::test::wear_states_test {
namespace {

constexpr double round_off = 1e-12; ///< of a sum of three terms, one of which was printed with 17 digits

std::string with_states(const Workshop& folder, const std::string& states) {
  return bundle(folder, 1, "[transient]\nduration = 0.3\n") + across("drive0") +
         "[[wear]]\ncoefficient = 2.0e-14\nlength = 0.02\nstates = [" + states + "]\n";
}

const std::vector<std::string> part_load{"--set", "loads.0.random.rms=15"};
const std::string half_and_half = "{ share = 0.5 }, { share = 0.5, results = \"part\" }";

std::string notes_of(const Results& run) { return run.summary["notes"].dump(); }
std::string warnings_of(const Results& run) { return run.summary["warnings"].dump(); }
double work_rate(const Results& run) { return run.statistics("support0")["work_rate"]; }

/// A sweep of the gap, with half and half.
Outcome sweep_of_states(const Workshop& folder) {
  const fs::path study = folder.write(
      "sweep.toml", with_states(folder, half_and_half) +
                        "[sweep]\ndraws = 2\n[[sweep.variables]]\nkey = \"contacts.support0.gap\"\n"
                        "uniform = { from = 1e-5, to = 2e-5 }\n");
  return folder.fretwork({"sweep", study.string(), "--no-report", "-o", folder.path("sweep").string()});
}

} // namespace

TEST(WearStates, AreMadeByTheStudyThatNamesThem) {
  const Workshop folder;
  const fs::path study = folder.write("study.toml", with_states(folder, half_and_half));
  const Results part = folder.run(study, "part", part_load), whole = folder.run(study, "whole");
  EXPECT_FALSE(part.summary.contains("wear"));
  EXPECT_FALSE(says(warnings_of(part), "wear is not computed"));
  EXPECT_TRUE(says(notes_of(part), "this run is an operating state of wear.0: wear is computed by the run of "
                                   "its state without results"));
  ASSERT_TRUE(whole.summary.contains("wear"));
  EXPECT_NE(work_rate(part), work_rate(whole));
  EXPECT_TRUE(close_to(whole.summary["wear"]["supports"][0]["work_rate"]["value"],
                       0.5 * (work_rate(part) + work_rate(whole)), round_off));
}

TEST(WearStates, ThatHaveNotBeenMadeLeaveTheTransientWithoutWear) {
  const Workshop folder;
  const fs::path study = folder.write("study.toml", with_states(folder, half_and_half));
  const std::string told = "wear.0.states[1].results = \"" + folder.path("part").string() + "\"";
  const Outcome checked = folder.fretwork({"check", study.string()});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_TRUE(says(checked.out, told));
  const Results first = folder.run(study, "whole");
  EXPECT_GT(work_rate(first), 0.0);
  EXPECT_FALSE(first.summary.contains("wear"));
  EXPECT_TRUE(says(first.summary["warnings"][0], told));
  (void)folder.run(study, "part", part_load);
  EXPECT_TRUE(folder.run(study, "whole").summary.contains("wear")); // not up to date any more
}

TEST(WearStates, ThatAllNameTheirFoldersHaveTheSameWearInEachRun) {
  const Workshop folder;
  const fs::path study = folder.write(
      "study.toml",
      with_states(folder, "{ share = 0.5, results = \"full\" }, { share = 0.5, results = \"part\" }"));
  EXPECT_TRUE(says(warnings_of(folder.run(study, "full")), "wear is not computed"));
  const Results part = folder.run(study, "part", part_load), full = folder.run(study, "full");
  EXPECT_TRUE(close_to(part.summary["wear"]["supports"][0]["work_rate"]["value"],
                       full.summary["wear"]["supports"][0]["work_rate"]["value"], round_off));
  EXPECT_EQ(part.summary["wear"]["supports"][0]["states"].size(), 2u);
  // the work rates of each run are what the other one depends on: neither ages the other
  EXPECT_TRUE(says(folder
                       .fretwork({"transient", study.string(), "-o", folder.path("part").string(), "--set",
                                  "loads.0.random.rms=15"})
                       .out,
                   "up to date"));
}

TEST(WearStates, DoNotAgeByTheRunsOfOtherStates) {
  const Workshop folder;
  const fs::path study =
      folder.write("study.toml",
                   with_states(folder, "{ share = 0.4 }, { share = 0.3, results = \"part\" }, { share = 0.3, "
                                       "results = \"other\" }"));
  (void)folder.run(study, "part", part_load);
  (void)folder.run(study, "other");
  EXPECT_TRUE(says(folder
                       .fretwork({"transient", study.string(), "-o", folder.path("part").string(), "--set",
                                  "loads.0.random.rms=15"})
                       .out,
                   "up to date"));
}

TEST(WearStates, AreOfTheTubeAndTheSupportsOfTheStudy) {
  const Workshop folder;
  const fs::path study = folder.write("study.toml", with_states(folder, half_and_half));
  const auto part_with = [&](const std::string& override) {
    (void)folder.run(study, "part", {"--set", override});
    return folder.fretwork({"check", study.string()});
  };
  const Outcome gap = part_with("contacts.support0.gap=2e-5");
  EXPECT_EQ(gap.status, 0) << gap.err;
  EXPECT_TRUE(says(gap.out,
                   "differs from this study: contact \"support0\" has a gap of 2e-05 m there, 1e-05 m here"));
  EXPECT_TRUE(says(part_with("contacts.support0.friction=0.2").out, "has friction 0.2 there, 0.3 here"));
  EXPECT_FALSE(says(part_with("loads.0.random.rms=15").out, "differs from this study"));
  for (const auto& [override, found] :
       {std::pair("materials.steel.young_modulus=1e11", "is on a beam of 1e+11 Pa, 12000 kg/m3 there"),
        std::pair("sections.tube.thickness=0.002", "is on a beam of another section there"),
        std::pair("contacts.support0.group=\"drive0\"", "is at ")}) {
    const Outcome other = part_with(override);
    EXPECT_EQ(other.status, 1) << other.out;
    EXPECT_TRUE(says(other.err, "is of another structure: contact \"support0\""));
    EXPECT_TRUE(says(other.err, found));
  }
}

TEST(WearStates, ThatHaveNotBeenMadeAreRefusedByASweep) {
  const Workshop folder;
  const Outcome sweep = sweep_of_states(folder);
  EXPECT_NE(sweep.status, 0);
  EXPECT_TRUE(
      says(sweep.err + sweep.out, "wear is not computed, its states have runs that have not been made"));
}

TEST(WearStates, OfASweepAreOfItsTubeAndItsSupports) {
  const Workshop folder;
  const fs::path study = folder.write("study.toml", with_states(folder, half_and_half));
  (void)folder.run(study, "part", {"--set", "contacts.support0.friction=0.2"});
  const Outcome warned = sweep_of_states(folder);
  EXPECT_EQ(warned.status, 0) << warned.err;
  const std::string told = "differs from this study: contact \"support0\" has friction 0.2 there, 0.3 here";
  EXPECT_TRUE(says(warned.out, told));
  const auto summary = nlohmann::json::parse(bytes_of(folder.path("sweep") / "summary.json"));
  ASSERT_EQ(summary["warnings"].size(), 3u);
  EXPECT_TRUE(says(summary["warnings"][0], told));
  EXPECT_TRUE(says(summary["warnings"][1], "varies in the cases, but not in the operating state"));
  EXPECT_TRUE(says(summary["warnings"][2], "2 cases done with a warning"));
  (void)folder.run(study, "part", {"--set", "sections.tube.thickness=0.002"});
  const Outcome refused = sweep_of_states(folder);
  EXPECT_EQ(refused.status, 1) << refused.out;
  EXPECT_TRUE(says(refused.err, "is of another structure: contact \"support0\""));
}

} // namespace fretwork::app::test::wear_states_test
