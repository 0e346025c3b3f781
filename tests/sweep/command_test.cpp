// SPDX-License-Identifier: GPL-3.0-or-later
// Ranks, shards and stages of sweeps, and their folders.
#include "sweep_command.hpp"

namespace fretwork::app::test::sweep_command_test {

TEST_F(Sweeps, AGridHasARowForEveryCaseAndAFailedOneStopsNoOther) {
  const Outcome outcome = sweep(stops, "out");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "12 (grid), 9 done, 3 without a result"));
  EXPECT_TRUE(says(outcome.out, "3 cases refused, the first is case 6: "));
  EXPECT_FALSE(says(outcome.out, "the statistics are those of the others")); // a grid has none
  const auto rows = table_of(folder.path("out"));
  ASSERT_EQ(rows.size(), 12u);
  EXPECT_EQ(rows[4].at("gap"), "0.001");
  EXPECT_EQ(rows[4].at("stiffness"), "1500000");
  EXPECT_EQ(rows[4].at("outcome"), "done");
  EXPECT_EQ(rows[6].at("outcome"), "refused");
  EXPECT_TRUE(says(rows[6].at("message"), "contacts.stop.gap"));
  // the force of the stop goes with the root of its stiffness
  const double soft = std::stod(rows[0].at("stop.normal_max")),
               hard = std::stod(rows[2].at("stop.normal_max"));
  EXPECT_TRUE(close_to(hard / soft, std::sqrt(2.01 / 1.01) * 2.0 / 2.01 * 1.01, 1e-2));
}

TEST_F(Sweeps, RanksAndShardsGiveTheSameBytes) {
  const std::vector<std::string> tables{"table.csv", "table.h5", "summary.json"};
  ASSERT_EQ(sweep(stops, "one").status, 0);
  ASSERT_EQ(sweep(stops, "three", {}, 3).status, 0);
  for (const char* part : {"2/3", "1/3", "3/3"}) {
    const Outcome outcome = sweep(stops, "shards", {"--shard", part}, part[0] == '1' ? 2 : 0);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_FALSE(fs::exists(folder.path("shards/table.csv")));
  }
  EXPECT_TRUE(says(sweep(stops, "shards", {"--shard", "2/3"}).out, "4 rows are there already"));
  ASSERT_EQ(sweep(stops, "shards", {"--gather"}).status, 0);
  for (const std::string& name : tables) {
    EXPECT_EQ(bytes_of(folder.path("one/" + name)), bytes_of(folder.path("three/" + name))) << name;
    EXPECT_EQ(bytes_of(folder.path("one/" + name)), bytes_of(folder.path("shards/" + name))) << name;
  }
}

TEST_F(Sweeps, GatheringSaysWhatIsMissing) {
  ASSERT_EQ(sweep(stops, "part", {"--shard", "1/2"}).status, 0);
  const Outcome outcome = sweep(stops, "part", {"--gather"});
  EXPECT_TRUE(says(outcome.out, "6 missing"));
  const Outcome none = sweep(stops, "part", {"--gather", "--set", "masses.0.mass=200"});
  EXPECT_EQ(none.status, 1); // and the table stays
  EXPECT_TRUE(says(none.err, "no row of this sweep is there, 6 rows are of another state of the study"));
  EXPECT_TRUE(says(sweep(stops, "part", {"--gather", "--shard", "1/2"}).err, "give one of them"));
  EXPECT_EQ(table_of(folder.path("part")).size(), 6u);
}

TEST_F(Sweeps, SobolIndicesNeedEveryCase) {
  const std::string text = sweep_of("oscillator", R"(
design = "saltelli"
draws = 30
[[sweep.variables]]
name = "speed"
key = "initial.0.velocity.0"
uniform = { from = 0.5, to = 1.5 }
[[sweep.variables]]
name = "gap"
key = "contacts.stop.gap"
uniform = { from = 0.0, to = 1.0e-3 }
)");
  ASSERT_EQ(sweep(text, "out", {"--shard", "1/2"}).status, 0);
  ASSERT_EQ(sweep(text, "out", {"--gather"}).status, 0);
  const auto sensitivities = [&] {
    return nlohmann::json::parse(bytes_of(folder.path("out/summary.json")))["statistics"]["sensitivities"];
  };
  EXPECT_TRUE(sensitivities().empty());
  ASSERT_EQ(sweep(text, "out").status, 0);
  EXPECT_EQ(table_of(folder.path("out")).size(), 120u);
  EXPECT_GT(sensitivities()["stop.normal_max"]["speed"]["value"], 0.9);
}

TEST_F(Sweeps, AChangedStudyKeepsNoRow) {
  ASSERT_EQ(sweep(stops, "out").status, 0);
  const double before = std::stod(table_of(folder.path("out"))[0].at("stop.normal_max"));
  EXPECT_TRUE(says(sweep(stops, "out").out, "12 rows are there already (--force computes all cases)"));
  const Outcome changed = sweep(stops, "out", {"--set", "masses.0.mass=200"});
  ASSERT_EQ(changed.status, 0);
  EXPECT_TRUE(says(changed.out, "12 rows are of another state of the study: not used"));
  EXPECT_FALSE(says(changed.out, "there already"));
  EXPECT_GT(std::stod(table_of(folder.path("out"))[0].at("stop.normal_max")), 1.2 * before);
  const auto rows = [&] {
    const std::string bytes = bytes_of(folder.path("out/shards/1_of_1/rank_0.rows"));
    return std::count(bytes.begin(), bytes.end(), '\n');
  };
  EXPECT_EQ(rows(), 24);
  ASSERT_EQ(sweep(stops, "out", {"--force"}).status, 0);
  EXPECT_EQ(rows(), 12);
}

TEST_F(Sweeps, GoesOnUntilAQuantileIsKnown) {
  const std::string text = sweep_of("oscillator", R"(
draws = 20
until = { output = "stop.normal_max", relative_error = 0.03, most_draws = 1000 }
limits = [{ output = "stop.normal_max", above = 1.0e4 }]
[[sweep.variables]]
key = "initial.0.velocity.0"
normal = { mean = 1.0, deviation = 0.2 }
truncated = [0.1, 2.0]
)");
  const Outcome outcome = sweep(text, "out", {}, 2);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "3 % are asked for: enough"));
  EXPECT_FALSE(says(outcome.out, "there already")); // what this call has computed before
  const auto summary = nlohmann::json::parse(bytes_of(folder.path("out/summary.json")));
  const int cases = summary["cases"];
  EXPECT_TRUE(says(sweep(text, "out").out, "20 rows are there already"));
  EXPECT_TRUE(cases == 160 || cases == 320 || cases == 640) << cases; // (2.0/0.03 0.2/sqrt(2/pi))^2 = 280
  // the force goes with the speed: half of the cases lie above that of 1 m/s
  const auto& limit = summary["statistics"]["limits"][0];
  EXPECT_LT(limit["low"], 0.5);
  EXPECT_GT(limit["high"], 0.5);
  EXPECT_GT(summary["statistics"]["sensitivities"]["stop.normal_max"]["initial.0.velocity.0"]["value"], 0.99);
}

TEST_F(Sweeps, AndRunsTakeNoFoldersOfEachOther) {
  const std::string study = example("oscillator").string();
  ASSERT_EQ(sweep(stops, "swept").status, 0);
  const Outcome run = folder.fretwork({"run", study, "-o", folder.path("swept").string(), "--no-report"});
  EXPECT_EQ(run.status, 1);
  EXPECT_TRUE(says(run.err, "holds the results of a sweep; give another folder"));
  ASSERT_EQ(folder.fretwork({"run", study, "-o", folder.path("ran").string(), "--no-report"}).status, 0);
  EXPECT_TRUE(says(sweep(stops, "ran").err, "holds the results of a run; give the sweep another folder"));
}

TEST_F(Sweeps, RemoveRunsOfAnEarlierState) {
  const std::string text = sweep_of("oscillator", R"(
draws = 6
keep = "worst 1"
[[sweep.variables]]
key = "initial.0.velocity.0"
uniform = { from = 0.5, to = 1.5 }
)");
  ASSERT_EQ(sweep(text, "out").status, 0);
  fs::create_directories(folder.path("out/runs/case_999"));
  ASSERT_EQ(sweep(text, "out", {"--set", "masses.0.mass=200"}).status, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path("out/runs")), {}), 1);
}

TEST_F(Sweeps, WithoutAnyResultTheCommandFails) {
  const Outcome outcome = sweep(sweep_of("oscillator", R"(
design = "grid"
[[sweep.variables]]
key = "contacts.stop.gapp"
values = [1, 2]
)"),
                                "none");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(says(outcome.err, "did you mean \"gap\""));
  EXPECT_EQ(table_of(folder.path("none")).size(), 2u);
}

} // namespace fretwork::app::test::sweep_command_test
