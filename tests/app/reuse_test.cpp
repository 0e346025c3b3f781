// SPDX-License-Identifier: GPL-3.0-or-later
// What is computed again and what is not; the same study gives the same bytes.
#include "program.hpp"
#include <fmt/format.h>

namespace fretwork::app::test::reuse_test {
namespace {

/// 0.2 s of the straight tube.
Outcome tube(const Workshop& folder, const std::string& output, const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{"run",
                               example("straight_tube").string(),
                               "--no-report",
                               "-o",
                               folder.path(output).string(),
                               "--set",
                               "transient.duration=0.2",
                               "--set",
                               "output.statistics_from=0"};
  all.insert(all.end(), more.begin(), more.end());
  const Outcome outcome = folder.fretwork(all);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome;
}

std::string file(const Workshop& folder, const std::string& output, const std::string& name) {
  return bytes_of(folder.path(output) / name);
}

TEST(Reuse, SecondRunSaysUpToDateAndTouchesNothing) {
  const Workshop folder;
  (void)tube(folder, "results");
  std::vector<std::pair<fs::path, fs::file_time_type>> times;
  for (const auto& entry : fs::directory_iterator(folder.path("results")))
    times.emplace_back(entry.path(), fs::last_write_time(entry.path()));
  EXPECT_TRUE(says(tube(folder, "results").out, "up to date"));
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder.path("results"))) {
    EXPECT_TRUE(fs::exists(entry.path()));
    ++files;
  }
  EXPECT_EQ(files, times.size());
  for (const auto& [path, time] : times)
    EXPECT_EQ(fs::last_write_time(path), time) << path;
}

TEST(Reuse, RunIsRepeatedWhereAResultIsMissing) {
  const Workshop folder;
  (void)tube(folder, "results");
  const std::string series = file(folder, "results", "results.h5");
  fs::remove(folder.path("results") / "results.h5");
  (void)tube(folder, "results");
  EXPECT_EQ(file(folder, "results", "results.h5"), series);
}

TEST(Reuse, ModesStayWhereOnlyALoadChanges) {
  const Workshop folder;
  (void)tube(folder, "results");
  const fs::path modes = folder.path("results") / "modes.h5", mesh = folder.path("results") / "mesh.msh";
  const auto modes_time = fs::last_write_time(modes), mesh_time = fs::last_write_time(mesh);
  const std::string series = file(folder, "results", "results.h5");
  const Outcome changed = tube(folder, "results", {"--set", "loads.mid_spans.harmonic.amplitude=21"});
  EXPECT_EQ(changed.out.find("up to date"), std::string::npos);
  EXPECT_EQ(fs::last_write_time(modes), modes_time);
  EXPECT_EQ(fs::last_write_time(mesh), mesh_time);
  EXPECT_NE(file(folder, "results", "results.h5"), series);
  // modes read from the folder give what modes computed afresh give
  (void)tube(folder, "afresh", {"--set", "loads.mid_spans.harmonic.amplitude=21"});
  EXPECT_EQ(file(folder, "results", "results.h5"), file(folder, "afresh", "results.h5"));
}

TEST(Reuse, ModesAreComputedAgainWhereTheDensityChanges) {
  const Workshop folder;
  (void)tube(folder, "results");
  const double before = read_results(folder.path("results")).summary["modes"]["frequencies_hz"][0];
  const std::string modes = file(folder, "results", "modes.h5");
  const auto mesh_time = fs::last_write_time(folder.path("results") / "mesh.msh");
  (void)tube(folder, "results", {"--set", "materials.steel.density=48000"});
  EXPECT_NE(file(folder, "results", "modes.h5"), modes);
  EXPECT_EQ(fs::last_write_time(folder.path("results") / "mesh.msh"), mesh_time);
  constexpr double solver = 1e-6; // relative, of the lowest mode of a slender tube
  EXPECT_TRUE(close_to(read_results(folder.path("results")).summary["modes"]["frequencies_hz"][0],
                       before / 2.0, solver));
}

TEST(Reuse, ContentOfTheMeshFileCounts) {
  const Workshop folder;
  const fs::path of_example = example("cantilever_stop");
  (void)folder.write("beam.msh", bytes_of(of_example.parent_path() / "beam.msh"));
  const double before = folder.run_text(bytes_of(of_example)).summary["modes"]["frequencies_hz"][0];
  std::string longer = bytes_of(of_example.parent_path() / "beam.msh");
  longer.replace(longer.find("11 1.0 0 0"), 10, "11 1.2 0 0");
  (void)folder.write("beam.msh", longer);
  EXPECT_LT(folder.run_text(bytes_of(of_example)).summary["modes"]["frequencies_hz"][0].get<double>(),
            0.9 * before);
}

TEST(Reuse, RowsOfALoadFileCount) {
  const Workshop folder;
  const fs::path of_example = example("oscillator");
  (void)folder.write("mass.msh", bytes_of(of_example.parent_path() / "mass.msh"));
  const std::string study =
      bytes_of(of_example) + "[[loads]]\ngroup = \"mass\"\ndirection = [1, 0, 0]\ntable = \"force.csv\"\n";
  (void)folder.write("force.csv", "0,0\n1,0\n");
  const double without = folder.run_text(study).statistics("stop")["normal_force"]["max"];
  (void)folder.write("force.csv", "0,5000\n1,5000\n");
  EXPECT_GT(folder.run_text(study).statistics("stop")["normal_force"]["max"].get<double>(), 1.2 * without);
}

TEST(Reuse, ForceComputesTheSameBytesAgain) {
  const Workshop folder;
  (void)tube(folder, "results");
  const std::string series = file(folder, "results", "results.h5"),
                    modes = file(folder, "results", "modes.h5");
  const nlohmann::json summary = read_results(folder.path("results")).summary;
  const Outcome again = tube(folder, "results", {"--force"});
  EXPECT_EQ(again.out.find("up to date"), std::string::npos);
  EXPECT_EQ(file(folder, "results", "results.h5"), series);
  EXPECT_EQ(file(folder, "results", "modes.h5"), modes);
  EXPECT_EQ(lasting(read_results(folder.path("results")).summary), lasting(summary));
}

TEST(Reuse, ModesAloneDoNotReplaceARunOfOtherInputs) {
  const Workshop folder;
  (void)tube(folder, "results");
  const std::string series = file(folder, "results", "results.h5"),
                    summary = file(folder, "results", "summary.json");
  const auto modes = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all{"modes", example("straight_tube").string(), "-o",
                                 folder.path("results").string()};
    all.insert(all.end(), more.begin(), more.end());
    return folder.fretwork(all);
  };
  const Outcome same = modes({"--set", "transient.duration=0.2", "--set", "output.statistics_from=0"});
  EXPECT_EQ(same.status, 0) << same.err;
  EXPECT_EQ(file(folder, "results", "summary.json"), summary);
  const Outcome other = modes({});
  EXPECT_EQ(other.status, 1);
  EXPECT_TRUE(says(other.err, "a run that is not of this study as it stands"));
  EXPECT_EQ(file(folder, "results", "results.h5"), series);
  EXPECT_EQ(file(folder, "results", "summary.json"), summary);
  const std::string mesh = file(folder, "results", "mesh.msh");
  const Outcome finer = modes({"--set", "mesh.element_size=0.2"});
  EXPECT_EQ(finer.status, 1);
  EXPECT_EQ(file(folder, "results", "mesh.msh"), mesh);
  EXPECT_EQ(modes({"--force"}).status, 0);
  EXPECT_FALSE(read_results(folder.path("results")).summary.contains("transient"));
}

// The first rank alone looks at the folder: the other ends with it, and says nothing.
TEST(Reuse, ModesAloneDoNotReplaceARunOnTwoRanks) {
  const Workshop folder;
  (void)tube(folder, "results");
  const auto kept = [&] {
    std::vector<std::string> out;
    for (const char* name : {"results.h5", "summary.json", "modes.h5", "mesh.msh"})
      out.push_back(file(folder, "results", name));
    return out;
  };
  const std::vector<std::string> before = kept();
  const auto command = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all{name, example("straight_tube").string(), "-o",
                                 folder.path("results").string()};
    all.insert(all.end(), more.begin(), more.end());
    return folder.fretwork(all, 2);
  };
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--set", "mesh.element_size=0.2"}}) {
    const Outcome refused = command("modes", more);
    EXPECT_NE(refused.status, 0);
    EXPECT_NE(refused.status, 124) << "still running";
    const std::string why = "a run that is not of this study as it stands";
    const std::size_t at = refused.err.find(why);
    ASSERT_NE(at, std::string::npos) << refused.err;
    EXPECT_EQ(refused.err.find(why, at + 1), std::string::npos) << refused.err;
    EXPECT_EQ(kept(), before);
  }
  EXPECT_EQ(command("modes", {"--force"}).status, 0);
  EXPECT_FALSE(read_results(folder.path("results")).summary.contains("transient"));
}

TEST(Reuse, SeesAChangeInAFileThatAGeometryIncludes) {
  const Workshop folder;
  (void)folder.write("length.geo", "L = 1.0;\n");
  (void)folder.write(
      "tube.geo",
      "Include \"length.geo\";\nPoint(1) = {0, 0, 0, 0.1};\nPoint(2) = {L, 0, 0, 0.1};\nLine(1) = {1, 2};\n"
      "Physical Curve(\"tube\") = {1};\nPhysical Point(\"foot\") = {1};\n");
  (void)folder.write("study.toml", "[mesh]\nfile = \"tube.geo\"\n[materials.m]\nyoung_modulus = "
                                   "2e11\npoisson_ratio = 0.3\ndensity = 8000.0\n"
                                   "[sections.s]\nshape = \"circle\"\ndiameter = 0.01\n[[beams]]\ngroup = "
                                   "\"tube\"\nmaterial = \"m\"\nsection = \"s\"\n"
                                   "[[restraints]]\ngroup = \"foot\"\nfixed = \"all\"\n[modes]\ncount = 2\n");
  const auto first_frequency = [&] {
    const Outcome outcome =
        folder.fretwork({"modes", folder.path("study.toml").string(), "-o", folder.path("results").string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(file(folder, "results", "summary.json"))["modes"]["frequencies_hz"][0]
        .get<double>();
  };
  const double before = first_frequency();
  (void)folder.write("length.geo", "L = 2.0;\n");
  EXPECT_NEAR(first_frequency(), 0.25 * before, 1e-3 * before);
}

TEST(Reuse, OutputInstantsDoNotChangeStatistics) {
  const Workshop folder;
  (void)tube(folder, "coarse", {"--set", "output.every=7e-3"});
  (void)tube(folder, "fine", {"--set", "output.every=1e-4"});
  const Results coarse = read_results(folder.path("coarse")), fine = read_results(folder.path("fine"));
  EXPECT_EQ(coarse.archive.series.time.size(), 29);
  EXPECT_EQ(fine.archive.series.time.size(), 2001);
  for (const char* part : {"contacts", "energy", "transient", "modes"})
    EXPECT_EQ(coarse.summary[part], fine.summary[part]) << part;
}

} // namespace
} // namespace fretwork::app::test::reuse_test
