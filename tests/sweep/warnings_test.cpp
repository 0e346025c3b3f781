// SPDX-License-Identifier: GPL-3.0-or-later
// What sweeps warn of and refuse.
#include "mesh_text.hpp"
#include "study_text.hpp"
#include "sweep_command.hpp"

namespace fretwork::app::test::sweep_warnings_test {
namespace {

/// A tube in a hole with friction, shaken along y and z by random accelerations of two seeds.
std::string shaken_tube(const Workshop& folder) {
  MeshText mesh = straight_line("tube", core::Vec3::Zero(), core::Vec3(1.0, 0, 0), 12);
  mesh.points.emplace_back("support", 6);
  folder.write("tube.msh", mesh.text());
  return steel_pipe("tube.msh") + tube_between("tube") + R"([modes]
count = 8
damping = 0.01
[[contacts]]
name = "hole"
group = "support"
obstacle = "circle"
axis = [1, 0, 0]
gap = 1.0e-5
normal_stiffness = 1.0e5
tangential_stiffness = 1.0e5
friction = 0.3
[[base_motion]]
direction = [0, 1, 0]
random = { rms = 5.0, band = [20.0, 200.0], seed = 1 }
[[base_motion]]
direction = [0, 0, 1]
random = { rms = 5.0, band = [20.0, 200.0], seed = 2 }
[transient]
duration = 1.0
)";
}

} // namespace

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
values = [1.0e-4, 0.04]
)"),
                                "long");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "case 1 done with a warning: the step 0.04 s does not resolve"));
  const auto rows = table_of(folder.path("long"));
  EXPECT_FALSE(rows.at(0).contains("message")); // the last cell is empty
  EXPECT_TRUE(says(rows.at(1).at("message"), "the step 0.04 s does not resolve"));
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

TEST_F(Sweeps, WarnOfSeedsThatMakeOneSignalOfLoadsAcross) {
  folder.write("study.toml", shaken_tube(folder));
  const std::string head = "[sweep]\nstudy = \"study.toml\"\ndesign = \"grid\"\n[[sweep.variables]]\n"
                           "key = \"base_motion.*.random.seed\"\n",
                    one = head + "values = [5, 6]\n",
                    own = head + "values = [5, 6]\neach = true\n"; // grid: equal in 2 of 4 cases
  const std::string text = "[[base_motion]] entry 1 and [[base_motion]] entry 2 follow one random signal";
  const Outcome check = folder.fretwork({"check", folder.write("sweep.toml", one).string()});
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_TRUE(says(check.out, "2 cases with a warning, the first is case 0: " + text));
  EXPECT_TRUE(says(folder.fretwork({"check", folder.write("own.toml", own).string()}).out,
                   "2 cases with a warning, the first is case 0: " + text));

  ASSERT_EQ(sweep(one, "one").status, 0);
  const auto warnings_of = [&](const std::string& output) {
    return nlohmann::json::parse(bytes_of(folder.path(output) / "summary.json"))["warnings"].dump();
  };
  EXPECT_TRUE(
      says(warnings_of("one"), "2 cases done with a warning, the first is case 0: no contact slides"));
  EXPECT_TRUE(says(warnings_of("one"), "no contact slides in any case, though contacts have friction"));
  ASSERT_EQ(sweep(own, "own").status, 0);
  EXPECT_TRUE(
      says(warnings_of("own"), "2 cases done with a warning, the first is case 0: no contact slides"));
  EXPECT_FALSE(says(warnings_of("own"), "slides in any case")); // it does in the two others
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

} // namespace fretwork::app::test::sweep_warnings_test
