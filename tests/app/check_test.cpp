// SPDX-License-Identifier: GPL-3.0-or-later
// `check` refuses what `run` refuses, and says what a run would be.
#include "mesh_text.hpp"
#include "paths.hpp"
#include "study_text.hpp"
#include "tubes.hpp"
#include <cmath>
#include <fmt/format.h>
#include <regex>

namespace fretwork::app::test::check_test {
namespace {

const std::string support =
    "[[contacts]]\nname = \"plate\"\ngroup = \"mid0\"\naxis = [1.0, 0.0, 0.0]\ngap = 2.0e-4\n"
    "normal_stiffness = 1.0e6\n";

std::vector<std::string> with(const std::string& command, const fs::path& study,
                              const std::vector<std::string>& set) {
  std::vector<std::string> all{command, study.string()};
  for (const std::string& key : set) {
    all.emplace_back("--set");
    all.push_back(key);
  }
  return all;
}

TEST(Check, EndsOnSeveralRanks) {
  const Workshop folder;
  const Outcome outcome = folder.fretwork(
      {"check", folder.write("study.toml", tubes(folder, 1) + support + push(0, 200.0)).string()}, 2);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, ": fine"));
}

TEST(Check, RefusesWhatTheRunRefuses) {
  const Workshop folder;
  const fs::path study = folder.write("study.toml", tubes(folder, 1) + support + push(0, 200.0));
  const std::vector<std::vector<std::string>> wrong = {
      {"modes.damping=[0.01, 0.02]"}, {"modes.up_to_hz=1"},
      {"output.every=1e-14"},         {"output.statistics_from=0.0199999", "transient.step=1e-4"},
      {"transient.duration=1e9"},
  };
  for (const auto& set : wrong) {
    const Outcome checked = folder.fretwork(with("check", study, set)),
                  run = folder.fretwork(with("run", study, set));
    EXPECT_EQ(run.status, 1) << set[0];
    EXPECT_EQ(checked.status, 1) << set[0] << checked.out;
    EXPECT_EQ(checked.err, run.err);
  }
  EXPECT_EQ(folder.fretwork(with("check", study, {})).status, 0);
}

TEST(Check, TellsTheWarningsAndNotesOfARun) {
  const Workshop folder;
  MeshText mesh = straight_line("tube", {0, 0, 0}, {1, 0, 0}, 8);
  for (const int node : {2, 4, 6})
    mesh.points.emplace_back("plate", node);
  folder.write("mesh.msh", mesh.text());
  const fs::path study = folder.write(
      "study.toml",
      steel_pipe("mesh.msh") + tube_between("tube") +
          "[[contacts]]\ngroup = \"plate\"\naxis = [1, 0, 0]\ngap = 2e-4\nnormal_stiffness = 1e6\n"
          "restitution = 0.7\n[[initial]]\ngroup = \"plate\"\nvelocity = [0.0, 1.0, 0.0]\n[modes]\ncount = "
          "8\n[transient]\nduration = 0.02\n"
          "[sweep]\ndesign = \"grid\"\n[[sweep.variables]]\nkey = \"contacts.plate.gap\"\nvalues = [1e-4, "
          "2e-4]\n");
  const Outcome check = folder.fretwork(with("check", study, {}));
  const Results run = folder.run(study, "results");
  ASSERT_EQ(check.status, 0) << check.err;
  const auto count = [&](const std::string& line) {
    std::size_t found = 0;
    for (std::size_t at = check.out.find(line); at != std::string::npos; at = check.out.find(line, at + 1))
      ++found;
    return found;
  };
  const auto expect = [&](const char* key, const char* label) {
    for (const std::string message : run.summary[key])
      EXPECT_EQ(count(fmt::format("{}: {}\n", label, message)), 1u) << message << "\n" << check.out;
  };
  expect("warnings", "warning");
  expect("notes", "note");
  const std::string notes = run.summary["notes"].dump();
  for (const char* part : {"for restitution 0.7", "supports of groups are numbered", "fretwork sweep"})
    EXPECT_TRUE(says(notes, part));
  EXPECT_EQ(count("supports of groups are numbered along them"), 1u);
}

TEST(Check, SaysThatAStudyWithoutTransientIsForModesAlone) {
  const Workshop folder;
  std::string text = tubes(folder, 1) + support;
  const std::string transient = "[transient]\nduration = 0.02\n";
  text.erase(text.find(transient), transient.size());
  const fs::path study = folder.write("study.toml", text);
  EXPECT_TRUE(says(folder.fretwork(with("check", study, {})).out, "no [transient]: run would refuse it"));
  EXPECT_TRUE(says(folder.fretwork(with("run", study, {})).err, "the study has no [transient]"));
}

TEST(Check, LeavesNothing) {
  const Workshop folder;
  const fs::path study = folder.write("study.toml", tubes(folder, 1) + support + push(0, 200.0));
  const Outcome outcome = folder.fretwork(with("check", study, {}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(folder.path("study.results")));
  EXPECT_TRUE(says(outcome.out, "8 modes; a run: 0.02 s, "));
}

TEST(Check, SaysWhatTheStepResolves) {
  const Workshop folder;
  const fs::path study = folder.write(
      "study.toml", tubes(folder, 1) + support +
                        "friction = 0.3\ntangential_stiffness = 1.0e6\ntangential_damping = 1.0e9\n" +
                        push(0, 200.0));
  EXPECT_TRUE(says(folder.fretwork(with("check", study, {"transient.step=1e-5"})).out,
                   "\n  step: given in the study\n"));
  EXPECT_TRUE(says(folder.fretwork(with("check", study, {})).out,
                   "a smaller tangential_damping makes the step longer"));
}

/// MB of series that `check` forecasts.
double forecast(const Workshop& folder, const fs::path& study, const std::vector<std::string>& set) {
  const std::string said = folder.fretwork(with("check", study, set)).out;
  std::smatch found;
  EXPECT_TRUE(std::regex_search(said, found, std::regex("results.h5: ([0-9.]+) MB of series"))) << said;
  return std::stod(found[1]);
}

TEST(Check, ForecastsTheSizeOfTheResults) {
  constexpr double three_digits = 0.02; // of the figures that are said, and what HDF5 adds
  const Workshop folder;
  const fs::path study = folder.write("study.toml", tubes(folder, 1) + support + push(0, 200.0));
  const auto size = [&](const std::string& every, const std::string& modal) {
    (void)folder.run(study, "results", {"--set", every, "--set", modal});
    return 1e-6 * static_cast<double>(fs::file_size(folder.path("results") / "results.h5"));
  };
  const std::string fine = "output.every=1e-6", coarse = "output.every=2e-3", all = "output.modal=true",
                    none = "output.modal=false";
  const double of_all = forecast(folder, study, {fine, all}), without = forecast(folder, study, {fine, none});
  const double little = size(coarse, none);
  EXPECT_NEAR(size(fine, all) - little, of_all, three_digits * of_all);
  EXPECT_NEAR(size(fine, none) - little, without, three_digits * without);
  EXPECT_GT(of_all, 1.5 * without);
}

TEST(Check, FindsNothingWrongWithTheExamples) {
  const Workshop folder;
  int checked = 0;
  for (const auto& entry : fs::recursive_directory_iterator(test_paths::source_dir() / "examples")) {
    if (entry.path().filename() != "study.toml")
      continue;
    if (says(bytes_of(entry.path()), "[sweep]"))
      continue; // of a sweep there is no run to check
    const Outcome outcome = folder.fretwork({"check", entry.path().string()});
    EXPECT_EQ(outcome.status, 0) << entry.path() << outcome.err;
    EXPECT_FALSE(says(outcome.out, "inf h")) << entry.path();
    ++checked;
  }
  EXPECT_GT(checked, 5);
}

// Of a pilot run: the same order as the run takes, however busy the machine.
TEST(Check, ForecastsTheTimeOfARun) {
  constexpr double same_order = 10.0;
  const Workshop folder;
  const fs::path study = folder.write("study.toml", tubes(folder, 1) + support + push(0, 200.0));
  const std::vector<std::string> set{"transient.duration=4", "output.every=0.1"};
  std::smatch found;
  const std::string said = folder.fretwork(with("check", study, set)).out;
  ASSERT_TRUE(std::regex_search(said, found, std::regex("steps, about ([0-9.e-]+) s; "))) << said;
  const Results run = folder.run(study, "results", {"--set", set[0], "--set", set[1]});
  const double took = run.summary["timings_s"]["transient"], forecast_s = std::stod(found[1]);
  EXPECT_GT(forecast_s, took / same_order);
  EXPECT_LT(forecast_s, took * same_order);
  const Outcome days = folder.fretwork(
      with("check", study, {"transient.duration=1e5", "output.every=1e2", "transient.max_hours=1e-3"}));
  EXPECT_EQ(days.status, 1) << days.out;
  EXPECT_TRUE(says(days.err, "transient: as its first steps show, a run would take ")) << days.err;
  EXPECT_TRUE(says(days.err, "more than transient.max_hours = 0.001; shorten the duration")) << days.err;
}

TEST(Output, SeriesOfContactsAndModesCanBeLeftOut) {
  const Workshop folder;
  const std::string study = tubes(folder, 1) + support + "series = false\n" + push(0, 200.0);
  const Results run = folder.run_text(study, {"--set", "output.modal=false"});
  EXPECT_TRUE(run.archive.series.contacts.empty());
  EXPECT_EQ(run.archive.series.modal_displacement.size(), 0);
  EXPECT_EQ(run.archive.series.nodes.size(), 1u);
  EXPECT_GT(run.statistics("plate")["impacts"], 0);
  const std::string results = folder.path("results").string();
  const Outcome report = folder.fretwork({"report", results});
  EXPECT_EQ(report.status, 0) << report.err;
  for (const char* format : {"csv", "vtu"})
    EXPECT_EQ(folder.fretwork({"export", results, "--format", format}).status, 0) << format;
}

// A smooth start and a ramp: the acceleration of the curve jumps at rows, the support does not.
TEST(StaticModes, TakeTablesOfDisplacement) {
  const Workshop folder;
  const std::string moved =
      "[[support_motion]]\ngroup = \"tube0_begin\"\ndirection = [0, 1, 0]\nquantity = \"displacement\"\n"
      "table = [[0, 0], [0.005, 0.0], [0.01, 1e-3], [0.02, 2e-3]]\n";
  const std::string study = tubes(folder, 1) + support + moved;
  const auto run = [&](const char* static_modes, const char* count) {
    return folder.run_text(study, {"--set", fmt::format("modes.static_modes={}", static_modes), "--set",
                                   count, "--set", "output.every=1e-4"});
  };
  const Results few = run("all", "modes.count=6"), many = run("none", "modes.count=40");
  constexpr double of_an_impact = 0.1; // relative: 6 modes with static modes against all
  EXPECT_GT(few.statistics("plate")["normal_force"]["max"], 1.0);
  EXPECT_TRUE(close_to(few.statistics("plate")["normal_force"]["max"],
                       many.statistics("plate")["normal_force"]["max"], of_an_impact));
}

} // namespace
} // namespace fretwork::app::test::check_test
