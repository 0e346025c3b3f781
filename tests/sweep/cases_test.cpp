// SPDX-License-Identifier: GPL-3.0-or-later
// Cases of sweeps are runs.
#include "sweep_command.hpp"

namespace fretwork::app::test::sweep_cases_test {

/// The work rates and rms forces of the contacts, as in the run of the case.
void expect_contacts(const Results& run, const std::map<std::string, std::string>& row) {
  for (const auto& contact : run.summary["contacts"]) {
    const std::string name = contact["name"];
    EXPECT_EQ(contact["work_rate"].get<double>(), std::stod(row.at(name + ".work_rate"))) << name;
    EXPECT_EQ(contact["normal_force"]["rms"].get<double>(), std::stod(row.at(name + ".normal_rms"))) << name;
  }
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
  expect_contacts(run, rows[at]);
  double largest = 0.0;
  int known = 0; // errors
  for (const auto& contact : run.summary["contacts"]) {
    const std::string name = contact["name"];
    const auto& errors = contact["standard_error"];
    for (const auto& [column, error] : {std::pair("work_rate", errors["work_rate"]),
                                        {"normal_rms", errors["normal_force"]["rms"]},
                                        {"normal_max", errors["normal_force"]["max"]},
                                        {"impact_rate", errors["impacts_per_second"]},
                                        {"contact_time_ratio", errors["contact_time_ratio"]}}) {
      const std::string& cell = rows[at].at(fmt::format("{}.{}.error", name, column));
      if (error.is_null()) // a window too short, or nothing slides
        EXPECT_EQ(cell, "nan") << name << column;
      else
        EXPECT_EQ(error.get<double>(), std::stod(cell)) << name << column;
      known += error.is_null() ? 0 : 1;
    }
    largest = std::max(largest, contact["work_rate"].get<double>());
  }
  EXPECT_EQ(largest, worst);
  EXPECT_GT(worst, 0.0);
  EXPECT_GT(known, 0);
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
    expect_contacts(run, rows[i]);
    different.insert(rows[i].at("total.work_rate"));
  }
  EXPECT_EQ(different.size(), 8u); // what was kept in memory was that of the case
}

// Friction along the tube loads it in fewer directions: static modes of one case are not those of the other.
TEST_F(Sweeps, ACaseHasTheStaticModesOfItsOwnFriction) {
  const std::string text = sweep_of("straight_tube", R"(
design = "grid"
keep = "worst 2"
[[sweep.variables]]
key = "contacts.support.friction_direction"
values = ["axial", "both"]
)");
  std::vector<std::string> few = short_tube;
  for (const std::string set : {"contacts.support.obstacle=\"plane_y\"", "contacts.support.y_axis=[0,1,0]",
                                "modes.count=8", "modes.static_modes=\"all\""})
    few.insert(few.end(), {"--set", set});
  ASSERT_EQ(sweep(text, "out", few).status, 0);
  const auto rows = table_of(folder.path("out"));
  std::size_t modes[2] = {};
  for (std::size_t i = 0; i < 2; ++i) {
    const Results run = read_results(folder.path("out/runs/case_" + std::to_string(i)));
    expect_contacts(run, rows[i]);
    modes[i] = run.summary["modes"]["static_modes"].get<std::size_t>();
  }
  EXPECT_EQ(modes[0], 8u); // one a support, across the planes
  EXPECT_EQ(modes[1], 16u);
}

/// V/Vc of each assessment and the worst of them, as in the run of the case.
/// @param several  flows: the names of outputs then have that of the flow
void expect_velocity_ratios(const Results& run, const std::map<std::string, std::string>& row,
                            bool several = false) {
  double largest = 0.0;
  ASSERT_FALSE(run.summary["stability"].empty());
  for (const auto& assessment : run.summary["stability"]) {
    const std::string tube = assessment["tube"],
                      name = assessment["name"].get<std::string>() + (several ? "." + tube : "");
    ASSERT_EQ(row.count("stability." + name + ".velocity_ratio"), 1u) << name;
    const double ratio = 1.0 - assessment["cases"][0]["margin"].get<double>();
    EXPECT_NEAR(ratio, std::stod(row.at("stability." + name + ".velocity_ratio")), 1e-9) << name;
    largest = std::max(largest, ratio);
  }
  EXPECT_NEAR(largest, std::stod(row.at("worst.velocity_ratio")), 1e-9);
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
    expect_contacts(run, rows[i]);
    EXPECT_NE(run.summary["energy"]["fluid_J"].get<double>(), 0.0);
    expect_velocity_ratios(run, rows[i]);
    different.insert(rows[i].at("total.work_rate"));
  }
  EXPECT_EQ(different.size(), 2u);
}

TEST_F(Sweeps, KeepTheWorstByAnOutputAndNeedNoContacts) {
  std::string text = sweep_of("straight_tube", R"(
design = "grid"
keep = "worst 1"
keep_by = "tube.stress"
[[sweep.variables]]
key = "loads.1.harmonic.amplitude"
values = [5.0, 40.0, 10.0]
)");
  const std::vector<std::string> short_run = {"--set", "transient.duration=0.3", "--set",
                                              "output.section_forces=[\"tube\"]"};
  ASSERT_EQ(sweep(text, "out", short_run).status, 0);
  EXPECT_TRUE(fs::exists(folder.path("out/runs/case_1")));
  std::string free = bytes_of(example("straight_tube"));
  free.erase(free.find("[[contacts]]"), free.find("[[loads]]") - free.find("[[contacts]]"));
  fs::copy_file(example("straight_tube").parent_path() / "tube.geo", folder.path("tube.geo"));
  const Outcome outcome = sweep(free + "[sweep]\n" + text.substr(text.find("design")), "free", short_run);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "(case 1)"));
  const auto rows = table_of(folder.path("free"));
  EXPECT_GT(std::stod(rows[1].at("tube.stress")), std::stod(rows[0].at("tube.stress")));
  EXPECT_EQ(rows[0].count("total.work_rate"), 0u);
  text.replace(text.find("tube.stress"), 11, "tube.strain");
  EXPECT_TRUE(says(sweep(text, "none", short_run).err, "no output is called \"tube.strain\""));
}

TEST_F(Sweeps, TheTableStandsWhereACaseCannotBeKept) {
  const std::string text = sweep_of("straight_tube", R"(
design = "grid"
keep = "worst 2"
[[sweep.variables]]
name = "every"
key = "output.every"
values = [1.0e-3, 1.0e-9]
)");
  const Outcome outcome = sweep(text, "out", short_tube);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "case 1 could not be kept: output.every = 1e-09 over")) << outcome.out;
  EXPECT_FALSE(says(outcome.out, "case_1")) << outcome.out;
  EXPECT_EQ(table_of(folder.path("out")).size(), 2u);
  const auto summary = nlohmann::json::parse(bytes_of(folder.path("out/summary.json")));
  EXPECT_EQ(summary["worst"], nlohmann::json({0}));
  EXPECT_TRUE(fs::exists(folder.path("out/runs/case_0/results.h5")));
  // of all cases: before the first one
  const auto with_every = [&](const std::string& keep) {
    return sweep_of("straight_tube",
                    "design = \"grid\"\n" + keep +
                        "[[sweep.variables]]\nkey = \"contacts.support.gap\"\nvalues = [1e-4]\n");
  };
  std::vector<std::string> dense = short_tube;
  dense.insert(dense.end(), {"--set", "output.every=1e-9"});
  EXPECT_TRUE(says(refusal(with_every("keep = \"worst 1\"\n"), dense), "sample less often"));
  EXPECT_EQ(sweep(with_every(""), "none", dense).status, 0); // a table has no series
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
    expect_velocity_ratios(run, rows[i]);
  }
  EXPECT_GT(std::stod(rows[1].at("stability.all supports.velocity_ratio")), // without inner bars
            1.1 * std::stod(rows[0].at("stability.all supports.velocity_ratio")));
  EXPECT_EQ(rows[1].at("inner_bars[0].work_rate"), "nan");
  EXPECT_EQ(rows[1].at("turbulence.*.seed"), "8");
}

// Pins that stick hold along the friction of their contacts, which a case may change; others do not.
TEST_F(Sweeps, VelocityRatiosFollowWhatPinsTake) {
  const std::string text = sweep_of("u_bend_flow", R"(
design = "grid"
[[sweep.variables]]
name = "friction"
key = "contacts.bars.friction"
values = [0.0, 0.3]
[[sweep.variables]]
name = "velocity"
key = "flow.tube.zones.top.velocity"
values = [5.0, 60.0]
)");
  const Outcome outcome = sweep(text, "out", short_tube);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::map<std::string, std::map<std::string, double>> held, loose; // by velocity and friction
  for (const auto& row : table_of(folder.path("out"))) {
    held[row.at("velocity")][row.at("friction")] = std::stod(row.at("stability.bars hold.velocity_ratio"));
    loose[row.at("velocity")][row.at("friction")] = std::stod(row.at("stability.loose bars.velocity_ratio"));
  }
  ASSERT_EQ(held.size(), 2u);
  for (auto& [velocity, ratios] : held) {
    ASSERT_EQ(ratios.size(), 2u);
    EXPECT_GT(ratios.begin()->second, 1.01 * ratios.rbegin()->second) << velocity;
    EXPECT_EQ(loose[velocity].begin()->second, loose[velocity].rbegin()->second);
  }
  EXPECT_TRUE(says(outcome.out, "fluid-elastically unstable")) << outcome.out;
}

// Each flow has its own V/Vc, and a case of one flow leaves those of the others.
TEST_F(Sweeps, VelocityRatiosOfSeveralFlowsHaveTheirNames) {
  fs::copy_file(example("bundle_flow").parent_path() / "tube.geo", folder.path("tube.geo"));
  const std::string text = bytes_of(example("bundle_flow")) + R"(
[sweep]
design = "grid"
keep = "worst 2"
[[sweep.variables]]
name = "void"
key = "flow.tube_2.zones.0.void_fraction"
values = [0.8, 0.6]
)";
  const Outcome outcome =
      sweep(text, "out", {"--set", "transient.duration=0.01", "--set", "output.statistics_from=0"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto rows = table_of(folder.path("out"));
  ASSERT_EQ(rows.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Results run = read_results(folder.path("out/runs/case_" + std::to_string(i)));
    EXPECT_EQ(run.summary["stability"].size(), 10u);
    expect_velocity_ratios(run, rows[i], true);
    EXPECT_EQ(rows[i].count("stability.free bends.velocity_ratio"), 0u);
  }
  const auto ratio = [&](std::size_t row, const std::string& flow) {
    return std::stod(rows[row].at("stability.free bends." + flow + ".velocity_ratio"));
  };
  EXPECT_EQ(ratio(1, "tube_1"), ratio(0, "tube_1"));
  EXPECT_GT(std::abs(ratio(1, "tube_2") / ratio(0, "tube_2") - 1.0), 0.01);
}

TEST_F(Sweeps, CasesThatCannotBeAssessedHaveTheirOtherOutputs) {
  const std::string text = sweep_of("u_bend_flow", R"(
design = "grid"
[[sweep.variables]]
name = "phase"
key = "flow.tube.zones.top.phase"
values = ["liquid", "gas"]
)");
  const Outcome outcome = sweep(text, "out", short_tube);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto rows = table_of(folder.path("out"));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_GT(std::stod(rows[0].at("worst.velocity_ratio")), 0.0);
  EXPECT_EQ(rows[1].at("worst.velocity_ratio"), "nan");
  EXPECT_EQ(rows[1].at("outcome"), "done");
  EXPECT_TRUE(says(bytes_of(folder.path("out") / "table.csv"), "the case has no V/Vc"));
}

TEST_F(Sweeps, CasesWarnOfWhereTheirContactsAre) {
  const std::string text = sweep_of("straight_tube", R"(
design = "grid"
[[sweep.variables]]
key = "contacts.support.gap"
values = [1.0e-4, 1.2e-2]
)");
  const Outcome outcome = sweep(text, "out", short_tube);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string table = bytes_of(folder.path("out/table.csv"));
  const std::size_t first = table.find("its clearance of 0.012 m is of the size of the tube");
  EXPECT_NE(first, std::string::npos) << table;
  EXPECT_GT(first, table.find("\n1,")); // of case 1 only
  EXPECT_TRUE(says(outcome.out, "is one a diameter")) << outcome.out;
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

} // namespace fretwork::app::test::sweep_cases_test
