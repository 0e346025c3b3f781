// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of the program: what they print and leave, what they keep and compute again.
#include "program.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::app::test::commands_test {
namespace {

using nlohmann::json;

/// The keys that scripts rely on: doc/results.md.
const json contract = json::parse(R"({
  "": ["version", "study", "ranks", "seed", "input_sha256", "model", "modes", "contacts", "nodes", "energy", "transient", "timings_s"],
  "/model": ["nodes", "elements", "dofs", "mass_kg"],
  "/modes": ["frequencies_hz", "residuals", "damping", "static_modes", "error_estimate", "effective_mass_kg"],
  "/contacts/0": ["name", "impacts", "contact_time_ratio", "normal_force", "normal_force_in_contact", "tangential_force", "displacement",
                  "work_rate", "friction_power", "impact_velocity", "contact_duration"],
  "/contacts/0/normal_force": ["mean", "rms", "max"],
  "/contacts/0/normal_force_in_contact": ["mean", "rms"],
  "/contacts/0/tangential_force": ["rms", "max"],
  "/contacts/0/displacement/y": ["mean", "std", "min", "max"],
  "/contacts/0/displacement/z": ["mean", "std", "min", "max"],
  "/contacts/0/displacement/radial": ["rms", "max"],
  "/contacts/0/impact_velocity": ["mean", "rms", "max"],
  "/contacts/0/contact_duration": ["mean", "max"],
  "/nodes/0": ["name", "displacement"],
  "/nodes/0/displacement/x": ["mean", "std", "min", "max"],
  "/nodes/0/displacement/y": ["mean", "std", "min", "max"],
  "/nodes/0/displacement/z": ["mean", "std", "min", "max"],
  "/energy": ["input_J", "stored_J", "modal_damping_J", "contact_damping_J", "friction_J", "residual_relative"],
  "/transient": ["scheme", "steps", "rejected", "force_evaluations", "step_min_s", "step_max_s"],
  "/timings_s": ["read", "mesh", "assembly", "modes", "basis", "transient", "output", "total"]
})");

/// The tube of the example with nine observed nodes, for 0.2 s.
std::vector<std::string> short_tube(const std::string& command, const fs::path& results) {
  return {command, example("straight_tube").string(), "-o",    results.string(),
          "--set", "transient.duration=0.2",          "--set", "output.statistics_from=0",
          "--set", "output.nodes=[\"mid_spans\"]"};
}

TEST(Commands, HelpNamesThemAll) {
  const Workshop folder;
  const Outcome help = folder.fretwork({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* command :
       {"run", "mesh", "modes", "stability", "transient", "check", "report", "export", "compare"}) {
    EXPECT_TRUE(says(help.out, command));
    EXPECT_EQ(folder.fretwork({command, "--help"}).status, 0) << command;
  }
}

TEST(Commands, OneThatIsMistypedIsSuggested) {
  const Workshop folder;
  const Outcome outcome = folder.fretwork({"rnu", example("oscillator").string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(says(outcome.err, "there is no command \"rnu\"; did you mean \"run\"?"));
}

TEST(Commands, APythonThatIsMissingIsSaidByTheReport) {
  const Workshop folder;
  const fs::path results = folder.path("results");
  ASSERT_EQ(folder.fretwork({"transient", example("oscillator").string(), "-o", results.string()}).status, 0);
  const EnvironmentVariable missing("FRETWORK_PYTHON", "/nowhere/python");
  const Outcome report = folder.fretwork({"report", results.string()});
  EXPECT_EQ(report.status, 1);
  EXPECT_TRUE(says(report.err, "/nowhere/python cannot be started"));
  EXPECT_FALSE(fs::exists(results / "report.html"));
}

TEST(Commands, CompareSaysWhatDiffers) {
  const Workshop folder;
  const Results a = folder.run(example("cantilever_stop"), "a"),
                b = folder.run(example("cantilever_stop"), "b", {"--set", "contacts.stop.gap=2e-4"});
  const fs::path page = folder.path("page.html");
  const std::string first = folder.path("a").string(), second = folder.path("b").string();
  const Outcome outcome = folder.fretwork({"compare", first, second, "--html", page.string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* part :
       {"Inputs that differ", "contacts.stop.gap", "0.0002", "Frequencies, Hz", "Work rates, W"})
    EXPECT_TRUE(says(outcome.out, part));
  EXPECT_TRUE(says(bytes_of(page), "Orbit of stop"));
  fs::copy(folder.path("a"), folder.path("copy"));
  EXPECT_TRUE(says(folder.fretwork({"compare", first, folder.path("copy").string()}).out,
                   "Inputs that differ: none"));
}

/// What comparing the folder with `other` and the report of `other` say.
void expect_refused(const Workshop& folder, const fs::path& other, const std::string& message) {
  const std::string first = folder.path("results").string();
  for (const Outcome& outcome :
       {folder.fretwork({"compare", first, other.string()}), folder.fretwork({"report", other.string()})}) {
    EXPECT_EQ(outcome.status, 1) << message;
    EXPECT_TRUE(says(outcome.err, other.string() + message)) << outcome.err;
    EXPECT_FALSE(outcome.err.ends_with("\n\n"));
  }
}

TEST(Commands, CompareAndReportRefuseWhatIsNoRunThatHasEnded) {
  const Workshop folder;
  const fs::path results = folder.path("results");
  ASSERT_EQ(folder.fretwork({"run", example("oscillator").string(), "-o", results.string()}).status, 0);

  expect_refused(folder, folder.path("none"), " does not exist; give the folder that `fretwork run` wrote");
  fs::create_directory(folder.path("empty"));
  expect_refused(folder, folder.path("empty"), "/summary.json does not exist; give the folder that");
  folder.write("results.toml", "");
  expect_refused(folder, folder.path("results.toml"),
                 " is a file; give the folder that `fretwork run` wrote");

  fs::copy(results, folder.path("running"));
  fs::remove(folder.path("running") / "summary.json");
  folder.write("running/checkpoint.h5", "");
  expect_refused(folder, folder.path("running"), ": the run has not ended; wait for it, or start it again");

  fs::copy(results, folder.path("damaged"));
  fs::resize_file(folder.path("damaged") / "results.h5", 3000);
  expect_refused(folder, folder.path("damaged"), "/results.h5 is not as it was written");
}

TEST(Commands, CompareRefusesOneRunTheSameTwiceAndASweep) {
  const Workshop folder;
  const std::string run = folder.path("run").string(), page = folder.path("none/page.html").string();
  ASSERT_EQ(folder.fretwork({"run", example("oscillator").string(), "-o", run}).status, 0);
  fs::copy(run, folder.path("other"));
  const auto says_of = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    const Outcome outcome = folder.fretwork(arguments);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    return outcome.err;
  };
  EXPECT_TRUE(says(says_of({run}), "only " + run + " is given; give the folders of two runs or more"));
  EXPECT_TRUE(says(says_of({run, run + "/"}), run + " is given twice; give the folders of different runs"));
  EXPECT_TRUE(
      says(says_of({run, folder.path("other").string(), "--html", page}), page + " cannot be written"));
  folder.write("other/table.h5", "");
  EXPECT_TRUE(says(says_of({run, folder.path("other").string()}),
                   "holds the results of a sweep, whose table is table.csv"));
}

TEST(Commands, OneNodeIsNoNodes) {
  const Workshop folder;
  const Outcome outcome = folder.fretwork({"check", example("oscillator").string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "1 node, 0 beams, "));
  EXPECT_TRUE(says(outcome.out, " in 1 structure, "));
}

TEST(Commands, VersionIsThatOfTheResults) {
  const Workshop folder;
  const std::string version = folder.fretwork({"--version"}).out;
  const Results run = folder.run(example("oscillator"), "results");
  EXPECT_EQ(version, run.summary["version"].get<std::string>() + "\n");
}

TEST(Commands, CheckComputesNothing) {
  const Workshop folder;
  const fs::path study = folder.write("study.toml", bytes_of(example("cantilever_stop")));
  folder.write("beam.msh", bytes_of(example("cantilever_stop").parent_path() / "beam.msh"));
  const Outcome outcome = folder.fretwork({"check", study.string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* part : {"fine", "11 nodes", "10 beams", "20 free dofs", "1 contact", "1 load"})
    EXPECT_TRUE(says(outcome.out, part));
  EXPECT_FALSE(fs::exists(folder.path("study.results")));
}

TEST(Commands, CheckReadsGeometriesToo) {
  const Workshop folder;
  const Outcome outcome = folder.fretwork({"check", example("straight_tube").string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "91 nodes"));
}

TEST(Commands, StagesFollowEachOther) {
  const Workshop folder;
  const fs::path results = folder.path("results");
  const Outcome mesh = folder.fretwork(short_tube("mesh", results));
  EXPECT_EQ(mesh.status, 0) << mesh.err;
  EXPECT_TRUE(says(mesh.out, "91 nodes, 90 lines"));
  EXPECT_TRUE(fs::exists(results / "mesh.msh"));
  EXPECT_FALSE(fs::exists(results / "modes.h5"));
  const Outcome modes = folder.fretwork(short_tube("modes", results));
  EXPECT_EQ(modes.status, 0) << modes.err;
  const json of_modes = json::parse(bytes_of(results / "summary.json"));
  EXPECT_EQ(of_modes["modes"]["frequencies_hz"].size(), 41u);
  EXPECT_FALSE(of_modes.contains("contacts"));
  EXPECT_FALSE(fs::exists(results / "report.html"));
  const std::string stored = bytes_of(results / "modes.h5");
  const Outcome transient = folder.fretwork(short_tube("transient", results));
  EXPECT_EQ(transient.status, 0) << transient.err;
  const json whole = json::parse(bytes_of(results / "summary.json"));
  EXPECT_EQ(whole["contacts"].size(), 8u);
  EXPECT_EQ(whole["modes"], of_modes["modes"]);
  EXPECT_EQ(bytes_of(results / "modes.h5"), stored);
}

TEST(Commands, ModesAfterARunLeaveItsResults) {
  const Workshop folder;
  const fs::path results = folder.path("results");
  ASSERT_EQ(folder.fretwork(short_tube("transient", results)).status, 0);
  const std::string summary = bytes_of(results / "summary.json"), series = bytes_of(results / "results.h5");
  const Outcome modes = folder.fretwork(short_tube("modes", results));
  EXPECT_EQ(modes.status, 0) << modes.err;
  EXPECT_TRUE(says(modes.out, "201.4"));
  EXPECT_EQ(bytes_of(results / "summary.json"), summary);
  EXPECT_EQ(bytes_of(results / "results.h5"), series);
}

TEST(Commands, RunLeavesSummarySeriesAndReport) {
  const Workshop folder;
  const fs::path results = folder.path("results");
  const Outcome run = folder.fretwork(short_tube("run", results));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  for (const char* part : {"Straight tube on eight supports", "support[7]", "energy", "results: "})
    EXPECT_TRUE(says(run.out, part));
  EXPECT_EQ(run.out.find('\r'), std::string::npos);
  const json summary = json::parse(bytes_of(results / "summary.json"));
  for (const auto& [place, keys] : contract.items())
    for (const auto& key : keys)
      EXPECT_TRUE(summary.at(json::json_pointer(place)).contains(key)) << place << " " << key;
  EXPECT_TRUE(says(bytes_of(results / "report.html"), "support[0]"));
}

TEST(Commands, SetReachesTheRunAndTheRecord) {
  const Workshop folder;
  const Results run = folder.run(example("cantilever_stop"), "results",
                                 {"--set", "modes.damping=[0.05, 0.02, 0.02, 0.02, 0.03]", "--set",
                                  "contacts.stop.normal_stiffness=2e8", "--set", "loads.0.constant=2000",
                                  "--set", "contacts.0.gap=2e-4"});
  EXPECT_EQ(run.summary["modes"]["damping"], (std::vector<double>{0.05, 0.02, 0.02, 0.02, 0.03}));
  ASSERT_EQ(run.archive.contacts.size(), 1u);
  EXPECT_EQ(run.archive.contacts[0].normal_stiffness, 2e8);
  EXPECT_EQ(run.archive.contacts[0].gap, 2e-4);
  EXPECT_TRUE(says(run.archive.record.study_text, "loads.0.constant=2000"));
  EXPECT_EQ(run.summary["overrides"][0]["value"], (std::vector<double>{0.05, 0.02, 0.02, 0.02, 0.03}));
  EXPECT_EQ(run.summary["overrides"][3], json({{"key", "contacts.0.gap"}, {"value", 2e-4}}));
  const Outcome nowhere = folder.fretwork({"run", example("cantilever_stop").string(), "-o",
                                           folder.path("other").string(), "--set", "contacts.stp.gap=1"});
  EXPECT_EQ(nowhere.status, 1);
  EXPECT_TRUE(says(nowhere.err, "contacts.stp.gap=1"));
}

TEST(Commands, QuietSaysNothing) {
  const Workshop folder;
  const Outcome run =
      folder.fretwork({"run", example("oscillator").string(), "-q", "-o", folder.path("results").string()});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out + run.err, "");
}

TEST(Commands, RunsBesideEachOtherShareNoFolder) {
  const Workshop folder;
  // a temporary folder that cannot be used: a run that wanted one, as others at the same time would, fails
  const EnvironmentVariable unusable("TMPDIR", folder.write("file", "").string());
  (void)folder.run(example("oscillator"), "results");
}

TEST(Commands, ReportIsWrittenFromResults) {
  const Workshop folder;
  const fs::path results = folder.path("results");
  (void)folder.run(example("oscillator"), "results");
  EXPECT_FALSE(fs::exists(results / "report.html"));
  const Outcome report = folder.fretwork({"report", results.string()});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_TRUE(says(bytes_of(results / "report.html"), "Mass, spring and stop"));
}

TEST(Commands, ExportsWriteTheirFiles) {
  const Workshop folder;
  const fs::path results = folder.path("results");
  ASSERT_EQ(folder.fretwork(short_tube("transient", results)).status, 0);
  for (const char* format : {"csv", "vtu", "msh"}) {
    const Outcome outcome = folder.fretwork({"export", results.string(), "--format", format});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  EXPECT_TRUE(says(bytes_of(results / "export-csv" / "contact_support[3].csv"), "time"));
  EXPECT_TRUE(says(bytes_of(results / "export-vtu" / "modes.vtu"), "VTKFile"));
  EXPECT_TRUE(says(bytes_of(results / "export-msh" / "modes.msh"), "$NodeData"));
}

TEST(Commands, ExportLeavesNothingOfAnEarlierOne) {
  const Workshop folder;
  const std::string study = example("oscillator").string(), results = folder.path("results").string();
  for (const std::string name : {"stop", "bumper"}) {
    EXPECT_EQ(
        folder.fretwork({"run", study, "--no-report", "-o", results, "--set", "contacts.0.name=" + name})
            .status,
        0);
    EXPECT_EQ(folder.fretwork({"export", results, "--format", "csv"}).status, 0);
  }
  const fs::path exported = fs::path(results) / "export-csv";
  EXPECT_TRUE(fs::exists(exported / "contact_bumper.csv"));
  EXPECT_TRUE(fs::exists(exported / "bumper_impacts.csv"));
  EXPECT_FALSE(fs::exists(exported / "contact_stop.csv"));
  EXPECT_FALSE(fs::exists(exported / "stop_impacts.csv"));
}

TEST(Archive, HasTheShapesOfTheContract) {
  const Workshop folder;
  ASSERT_EQ(folder.fretwork(short_tube("transient", folder.path("results"))).status, 0);
  const Results run = read_results(folder.path("results"));
  const Eigen::Index nt = run.archive.series.time.size(), n = 41;
  EXPECT_EQ(nt, 201);
  EXPECT_EQ(run.archive.series.time(nt - 1), 0.2);
  ASSERT_EQ(run.archive.series.contacts.size(), 8u);
  for (const auto& c : run.archive.series.contacts) {
    EXPECT_EQ(c.displacement.rows(), nt);
    EXPECT_EQ(c.displacement.cols(), 3);
    EXPECT_EQ(c.velocity.rows(), nt);
    EXPECT_EQ(c.velocity.cols(), 3);
    EXPECT_EQ(c.gap.size(), nt);
    EXPECT_EQ(c.normal_force.size(), nt);
    EXPECT_EQ(c.tangential_force.rows(), nt);
    EXPECT_EQ(c.tangential_force.cols(), 2);
  }
  ASSERT_EQ(run.archive.series.nodes.size(), 9u);
  EXPECT_EQ(run.archive.series.nodes.front().name, "mid_spans[0]");
  EXPECT_EQ(run.archive.series.nodes.front().acceleration.rows(), nt);
  EXPECT_EQ(run.archive.series.modal_displacement.rows(), n);
  EXPECT_EQ(run.archive.series.modal_displacement.cols(), nt);
  ASSERT_EQ(run.archive.bases.size(), 1u);
  EXPECT_EQ(run.archive.bases[0].shapes.rows(), 6 * 91);
  EXPECT_EQ(run.archive.bases[0].shapes.cols(), n);
  EXPECT_EQ(run.archive.record.input_sha256, run.summary["input_sha256"].get<std::string>());
  EXPECT_TRUE(says(run.archive.record.study_text, "transient.duration=0.2"));
}

TEST(Export, LeavesNoEmptyFolderWhereThereIsNothingToWrite) {
  const Workshop folder;
  const fs::path results = folder.path("results");
  ASSERT_EQ(folder.fretwork(short_tube("modes", results)).status, 0);
  const Outcome outcome = folder.fretwork({"export", results.string(), "--format", "csv"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(says(outcome.err, "no time series"));
  EXPECT_FALSE(fs::exists(results / "export-csv"));
}

} // namespace
} // namespace fretwork::app::test::commands_test
