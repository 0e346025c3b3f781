// SPDX-License-Identifier: GPL-3.0-or-later
// fretwork sweep from end to end.
#include "program.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <sstream>

namespace fretwork::app::test::command_test {
namespace {

/// `[sweep]` on an example.
std::string sweep_of(const std::string& name, const std::string& text) {
  return "[sweep]\nstudy = \"" + example(name).string() + "\"\n" + text;
}

const std::string stops = sweep_of("oscillator", R"(
design = "grid"
[[sweep.variables]]
name = "gap"
key = "contacts.stop.gap"
values = [0.0, 0.001, -0.001, 0.002]
[[sweep.variables]]
name = "stiffness"
key = "contacts.*.normal_stiffness"
range = { from = 1.0e6, to = 2.0e6, count = 3 }
)");

const std::vector<std::string> short_tube{"--set", "transient.duration=0.1", "--set",
                                          "output.statistics_from=0"};

/// Cells of table.csv by the name of the column without its unit, a map a row.
std::vector<std::map<std::string, std::string>> table_of(const fs::path& directory) {
  std::istringstream in(bytes_of(directory / "table.csv"));
  const auto cells = [](const std::string& line) {
    std::vector<std::string> out;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');)
      out.push_back(cell.substr(0, cell.find(" [")));
    return out;
  };
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> head = cells(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> row = cells(line);
    rows.emplace_back();
    for (std::size_t i = 0; i < std::min(row.size(), head.size()); ++i)
      rows.back()[head[i]] = row[i];
  }
  return rows;
}

class Sweeps : public testing::Test {
protected:
  Outcome sweep(const std::string& text, const std::string& output, std::vector<std::string> more = {},
                int ranks = 0) const {
    std::vector<std::string> arguments{"sweep", folder.write("sweep.toml", text).string(), "-o",
                                       folder.path(output).string(), "--no-report"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return folder.fretwork(arguments, ranks);
  }
  [[nodiscard]] std::string refusal(const std::string& text,
                                    const std::vector<std::string>& more = {}) const {
    const Outcome outcome = sweep(text, "refused", more);
    EXPECT_EQ(outcome.status, 1) << outcome.out;
    return outcome.err;
  }
  const Workshop folder;
};

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

TEST_F(Sweeps, ARowIsARunWithTheSameOverridesBitForBit) {
  const std::string text = sweep_of("straight_tube", R"(
draws = 4
keep = "worst 1"
[[sweep.variables]]
key = "contacts.support.gap"
uniform = { from = 1.0e-4, to = 3.0e-4 }
[[sweep.variables]]
key = "contacts.support.friction"
uniform = { from = 0.1, to = 0.5 }
)");
  ASSERT_EQ(sweep(text, "out", short_tube).status, 0);
  double worst = 0.0;
  std::size_t at = 0;
  const auto rows = table_of(folder.path("out"));
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const double value = std::stod(rows[i].at("worst.work_rate")); value > worst) {
      worst = value;
      at = i;
    }
  const Results run = read_results(folder.path("out/runs/case_" + std::to_string(at)));
  double largest = 0.0;
  for (const auto& contact : run.summary["contacts"]) {
    const std::string name = contact["name"];
    EXPECT_EQ(contact["work_rate"].get<double>(), std::stod(rows[at].at(name + ".work_rate"))) << name;
    EXPECT_EQ(contact["normal_force"]["rms"].get<double>(), std::stod(rows[at].at(name + ".normal_rms")))
        << name;
    largest = std::max(largest, contact["work_rate"].get<double>());
  }
  EXPECT_EQ(largest, worst);
  EXPECT_GT(worst, 0.0);
}

TEST_F(Sweeps, CasesOfOtherStructuresLoadsAndMeshesAreRunsToo) {
  const std::string text = sweep_of("straight_tube", R"(
design = "grid"
keep = "worst 8"
[[sweep.variables]]
name = "thickness"
key = "sections.tube.thickness"
values = [1.0e-3, 1.2e-3]
[[sweep.variables]]
name = "amplitude"
key = "loads.0.harmonic.amplitude"
values = [20.0, 30.0]
[[sweep.variables]]
name = "scale"
key = "mesh.scale"
values = [1.0, 1.05]
)");
  ASSERT_EQ(sweep(text, "out", short_tube, 2).status, 0);
  const auto rows = table_of(folder.path("out"));
  ASSERT_EQ(rows.size(), 8u);
  std::set<std::string> different;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Results run = read_results(folder.path("out/runs/case_" + std::to_string(i)));
    for (const auto& contact : run.summary["contacts"])
      EXPECT_EQ(contact["work_rate"].get<double>(),
                std::stod(rows[i].at(contact["name"].get<std::string>() + ".work_rate")))
          << i;
    different.insert(rows[i].at("total.work_rate"));
  }
  EXPECT_EQ(different.size(), 8u); // what was kept in memory was that of the case
}

TEST_F(Sweeps, FluidelasticForcesAreThoseOfARun) {
  const std::string text = sweep_of("u_bend_flow", R"(
design = "grid"
keep = "worst 2"
[[sweep.variables]]
name = "velocity"
key = "flow.tube.zones.top.velocity"
values = [5.0, 9.0]
)");
  ASSERT_EQ(sweep(text, "out", short_tube).status, 0);
  const auto rows = table_of(folder.path("out"));
  ASSERT_EQ(rows.size(), 2u);
  std::set<std::string> different;
  for (std::size_t i = 0; i < 2; ++i) {
    const Results run = read_results(folder.path("out/runs/case_" + std::to_string(i)));
    for (const auto& contact : run.summary["contacts"])
      EXPECT_EQ(contact["work_rate"].get<double>(),
                std::stod(rows[i].at(contact["name"].get<std::string>() + ".work_rate")))
          << i;
    EXPECT_NE(run.summary["energy"]["fluid_J"].get<double>(), 0.0);
    different.insert(rows[i].at("total.work_rate"));
  }
  EXPECT_EQ(different.size(), 2u);
}

TEST_F(Sweeps, TurbulenceOfASeedAndAMissingSupportAreThoseOfARun) {
  const std::string text = sweep_of("tube_study", R"(
design = "grid"
keep = "worst 2"
[[sweep.variables]]
key = "contacts.inner_bars.active"
values = [true, false]
[[sweep.variables]]
key = "turbulence.*.seed"
seeds = 7
)");
  ASSERT_EQ(sweep(text, "out", short_tube).status, 0);
  const auto rows = table_of(folder.path("out"));
  ASSERT_EQ(rows.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Results run = read_results(folder.path("out/runs/case_" + std::to_string(i)));
    for (const auto& contact : run.summary["contacts"])
      EXPECT_EQ(contact["work_rate"].get<double>(),
                std::stod(rows[i].at(contact["name"].get<std::string>() + ".work_rate")))
          << contact["name"];
    EXPECT_EQ(run.summary["wear"]["tubes"][0]["depth_m"]["value"].get<double>(),
              std::stod(rows[i].at("worst.wear_depth")));
  }
  EXPECT_EQ(rows[1].at("inner_bars[0].work_rate"), "nan");
  EXPECT_EQ(rows[1].at("turbulence.*.seed"), "8");
}

TEST_F(Sweeps, ErrorsAreStandardErrorsWhateverTheConfidenceOfWear) {
  const std::string text = sweep_of("tube_study", R"(
design = "grid"
[[sweep.variables]]
key = "turbulence.*.seed"
values = [7]
)");
  std::vector<std::string> sure = short_tube;
  for (const char* entry : {"plates", "bars"})
    sure.insert(sure.end(), {"--set", fmt::format("wear.{}.confidence=0.95", entry)});
  ASSERT_EQ(sweep(text, "plain", short_tube).status, 0);
  ASSERT_EQ(sweep(text, "sure", sure).status, 0);
  const auto plain = table_of(folder.path("plain")).at(0), confident = table_of(folder.path("sure")).at(0);
  for (const char* output : {"worst.wear_depth.error", "worst.years.error"}) {
    EXPECT_GT(std::stod(plain.at(output)), 0.0) << output;
    EXPECT_EQ(confident.at(output), plain.at(output)) << output;
  }
}

TEST_F(Sweeps, WarnOfStatesOfWearThatDoNotVaryWithTheContacts) {
  std::vector<std::string> states = short_tube;
  states.insert(states.end(),
                {"--set", "wear.bars.states=[{ name = \"startup\", share = 0.1, work_rate = 1e-3 }, "
                          "{ name = \"normal\", share = 0.9 }]"});
  const auto warnings = [&](const std::string& variable) {
    const Outcome outcome =
        sweep(sweep_of("tube_study", "design = \"grid\"\n[[sweep.variables]]\n" + variable), "out", states);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_TRUE(says(
      warnings("key = \"contacts.hot_plates.friction\"\nvalues = [0.2]\n"),
      "\"contacts.hot_plates.friction\" varies in the cases, but not in the operating states \"startup\""));
  EXPECT_FALSE(says(warnings("key = \"turbulence.*.seed\"\nvalues = [7]\n"), "varies in the cases"));
}

TEST_F(Sweeps, WarnOfTheStudyAsItStands) {
  const fs::path study = folder.write("few.toml", sweep_of("straight_tube", R"(
draws = 2
[[sweep.variables]]
key = "contacts.support.gap"
uniform = { from = 1.0e-4, to = 3.0e-4 }
)"));
  const std::vector<std::string> few{"--set", "modes.count=5",           "--set", "transient.duration=0.1",
                                     "--set", "output.statistics_from=0"};
  const auto call = [&](const char* command, std::vector<std::string> more, int ranks = 0) {
    more.insert(more.begin(), {command, study.string()});
    more.insert(more.end(), few.begin(), few.end());
    const Outcome outcome = folder.fretwork(more, ranks);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  const std::string text = "modal truncation: the modes lack flexibility at 8 of 8 contacts";
  EXPECT_TRUE(says(call("check", {}), text));
  EXPECT_TRUE(says(call("sweep", {"-o", folder.path("few").string()}), text));
  const std::string summary = bytes_of(folder.path("few/summary.json"));
  const auto warnings = nlohmann::json::parse(summary)["warnings"];
  EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                          [&](const std::string& warning) { return says(warning, text); }),
            1); // and no case says it again
  EXPECT_TRUE(says(bytes_of(folder.path("few/report.html")), text));
  (void)call("sweep", {"-o", folder.path("two").string()}, 2);
  EXPECT_EQ(bytes_of(folder.path("two/summary.json")), summary);
}

TEST_F(Sweeps, LeaveOutStabilityAndItsWarnings) {
  const std::string text = sweep_of("u_bend_flow", R"(
design = "grid"
[[sweep.variables]]
key = "contacts.*.friction"
values = [0.2]
)");
  ASSERT_EQ(sweep(text, "out", short_tube).status, 0);
  const auto summary = nlohmann::json::parse(bytes_of(folder.path("out/summary.json")));
  EXPECT_FALSE(says(summary["warnings"].dump(), "[[stability]]"));
}

TEST_F(Sweeps, WarnOfCasesThatTheirRunWarnsOf) {
  const Outcome outcome = sweep(sweep_of("oscillator", R"(
design = "grid"
[[sweep.variables]]
key = "transient.step"
values = [1.0e-4, 0.02]
)"),
                                "long");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "case 1 done with a warning: the step 0.02 s does not resolve"));
  const auto rows = table_of(folder.path("long"));
  EXPECT_FALSE(rows.at(0).contains("message")); // the last cell is empty
  EXPECT_TRUE(says(rows.at(1).at("message"), "the step 0.02 s does not resolve"));
}

TEST_F(Sweeps, WarnOfModesThatAreTooFewForACase) {
  const Outcome outcome = sweep(sweep_of("straight_tube", R"(
design = "grid"
[[sweep.variables]]
key = "contacts.support.normal_stiffness"
values = [1.0e3, 1.0e8]
)"),
                                "hard", short_tube);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(
      says(table_of(folder.path("hard")).at(1).at("message"), "the modes lack flexibility at 8 of 8"));
}

TEST_F(Sweeps, WarnWhereStatisticsAreThoseOfTheCasesThatAreLeft) {
  const Outcome outcome = sweep(sweep_of("oscillator", R"(
draws = 30
[[sweep.variables]]
key = "contacts.stop.gap"
uniform = { from = -1.0e-3, to = 4.0e-3 }
)"),
                                "left");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(
      says(outcome.out, " of 30: the statistics are those of the others, as if these could not occur"));
}

TEST_F(Sweeps, CheckReadsCasesOfOtherStructuresAndMovingSupports) {
  const std::string text = sweep_of("straight_tube", R"(
draws = 3
[[sweep.variables]]
key = "sections.tube.thickness"
uniform = { from = 1.0e-3, to = 1.2e-3 }
)");
  const Outcome outcome = folder.fretwork(
      {"check", folder.write("sweep.toml", text).string(), "--set",
       "support_motion=[{ group = \"ends\", direction = [0, 1, 0], quantity = \"displacement\", "
       "harmonic = { amplitude = 1e-4, frequency = 5 } }]"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "sweep: 3 cases (monte_carlo) of 1 variable\n"));
}

TEST_F(Sweeps, CheckRefusesWhatNoCaseIsComputedFor) {
  const auto check = [&](const std::string& text) {
    return folder.fretwork({"check", folder.write("sweep.toml", sweep_of("oscillator", text)).string()});
  };
  const std::string variable = "[[sweep.variables]]\nkey = \"contacts.stop.gap\"\n";
  const Outcome some = check("draws = 40\n" + variable + "uniform = { from = -1.0e-3, to = 4.0e-3 }\n");
  EXPECT_EQ(some.status, 0) << some.err;
  EXPECT_TRUE(says(some.out, "sweep: 40 cases (monte_carlo) of 1 variable"));
  EXPECT_TRUE(says(some.out, "cases refused, the first is case "));
  const Outcome unknown =
      check("draws = 4\n[[sweep.variables]]\nkey = \"contacts.stop.gapp\"\nvalues = [1]\n");
  EXPECT_EQ(unknown.status, 1);
  EXPECT_FALSE(says(unknown.out, "fine"));
  EXPECT_TRUE(says(unknown.err, "no case of the sweep would be computed; case 0: "));
  EXPECT_TRUE(says(unknown.err, "did you mean \"gap\""));
  const Outcome limit =
      check("draws = 4\nlimits = [{ output = \"stop.work\", above = 1 }]\n" + variable + "values = [1]\n");
  EXPECT_EQ(limit.status, 1);
  EXPECT_TRUE(says(limit.err, "sweep.toml:4: sweep.limits.0.output: no output is called \"stop.work\""));
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

TEST_F(Sweeps, DepthsBeyondTheGeometryAreInfinite) {
  const Outcome outcome = sweep(sweep_of("tube_study", R"(
draws = 4
limits = [{ output = "worst.wear_depth", above = 1.0e-3 }]
[[sweep.variables]]
key = "wear.plates.coefficient"
values = [1.0e-10]
)"),
                                "out", short_tube);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(table_of(folder.path("out")).at(0).at("worst.wear_depth"), "inf");
  EXPECT_TRUE(says(outcome.out, "worn away"));
  EXPECT_TRUE(says(outcome.out, "4 of 4 cases"));
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

TEST_F(Sweeps, WrongInputIsRefusedWithItsCure) {
  const auto with = [](const std::string& text) { return sweep_of("oscillator", text); };
  const std::string variable = "[[sweep.variables]]\nkey = \"contacts.stop.gap\"\n",
                    law = "values = [0, 1e-3]\n";
  EXPECT_TRUE(says(refusal("[mesh]\nfile = \"a.msh\"\n"), "a.msh"));
  EXPECT_TRUE(says(refusal(with("draws = 3\n" + variable)), "exactly one of"));
  EXPECT_TRUE(says(refusal(with(variable + law)), "draws, the number of cases, is needed"));
  EXPECT_TRUE(
      says(refusal(with("draws = 3\ndesing = \"grid\"\n" + variable + law)), "did you mean \"design\""));
  EXPECT_TRUE(says(refusal(with("draws = 3\n[[sweep.variables]]\nkey = \"contacts.tsp*.gap\"\n" + law)),
                   "the pattern fits no key"));
  EXPECT_TRUE(says(refusal(with("draws = 3\n[[sweep.variables]]\nkey = \"contacts.tsp.gap\"\n" + law)),
                   "contacts has no entry \"tsp\""));
  EXPECT_TRUE(says(refusal(with("draws = 3\n" + variable + "normal = { mean = 1, deviation = -1 }\n")),
                   "sweep.variables.0.normal.deviation = -1"));
  EXPECT_TRUE(says(refusal(with("design = \"grid\"\n" + variable + "uniform = { from = 0, to = 1 }\n")),
                   "a grid needs values"));
  EXPECT_TRUE(
      says(refusal(with("draws = 3\nlimits = [{ output = \"stop.work\", above = 1 }]\n" + variable + law)),
           "no output is called \"stop.work\""));
  EXPECT_TRUE(says(
      refusal(with("draws = 3\nuntil = { relative_error = 0.1 }\n" + variable + law), {"--shard", "1/2"}),
      "leave until out"));
  EXPECT_TRUE(says(refusal(with("draws = 3\n" + variable + law + "truncated = [0, 1]\n")),
                   "truncated = [0, 1]: is for continuous distributions"));
  EXPECT_TRUE(
      says(refusal(with("draws = 3\n" + variable + "uniform = { from = 0, to = 1 }\ntruncated = [2, 3]\n")),
           "variable \"contacts.stop.gap\": truncated = [2.0, 3.0] leaves nothing of its distribution"));
  EXPECT_TRUE(
      says(refusal(with("draws = 3\n" + variable + law), {"--shard", "3/2"}), "i/n with 1 <= i <= n"));
  EXPECT_TRUE(
      says(refusal(with("draws = 3\n" + variable + law + variable + law)), "two variables are called"));
}

TEST_F(Sweeps, TheExampleOfTheTubeRunsReduced) {
  const std::string study = (example("tube_sweep")).string();
  const Outcome outcome = folder.fretwork(
      {"sweep", study, "-o", folder.path("out").string(), "--no-report", "--set", "sweep.draws=6", "--set",
       "sweep.keep=\"worst 1\"", "--set", "transient.duration=0.2", "--set", "output.statistics_from=0"},
      2);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "6 (monte_carlo), 6 done"));
  EXPECT_TRUE(says(outcome.out, "worst.years"));
  EXPECT_EQ(table_of(folder.path("out")).size(), 6u);
}

} // namespace
} // namespace fretwork::app::test::command_test
