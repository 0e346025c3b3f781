// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged results, and a folder whose files come from a stranger.
#include "core/child_process.hpp"
#include "mesh_text.hpp"
#include "paths.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <sys/stat.h>

namespace fretwork::app::test::trust_test {
namespace {

constexpr int input_is_wrong = 1, computation_failed = 2; ///< exit statuses

/// A folder that is the current one while it lives.
class Strange : public testing::Test {
protected:
  Strange() : before_(fs::current_path()) { fs::current_path(folder_.path("")); }
  ~Strange() override { fs::current_path(before_); }
  [[nodiscard]] Outcome tube(const std::vector<std::string>& more = {"--no-report"}) const {
    std::vector<std::string> all{
        "run",   example("straight_tube").string(), "-o",    "results",
        "--set", "transient.duration=0.02",         "--set", "output.statistics_from=0"};
    all.insert(all.end(), more.begin(), more.end());
    return folder_.fretwork(all);
  }
  void change(const std::string& name, std::size_t at) const {
    std::fstream file(folder_.path("results") / name, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(at));
    file.put('~');
  }
  /// `fretwork` with its output to a file.
  [[nodiscard]] int status_with_output_to(const std::string& file,
                                          const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{"sh", "-c", "exec \"$@\" >" + file, "sh",
                                 (test_paths::binary_dir() / "bin" / "fretwork").string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return core::run_child(all).status;
  }
  Workshop folder_;

private:
  fs::path before_;
};

TEST_F(Strange, DamagedResultsAreComputedAgainAndNotExported) {
  ASSERT_EQ(tube().status, 0);
  const std::string whole = bytes_of("results/results.h5");
  change("results.h5", whole.size() / 2);
  EXPECT_EQ(folder_.fretwork({"export", "results"}).status, input_is_wrong);
  EXPECT_EQ(folder_.fretwork({"report", "results"}).status, input_is_wrong);
  EXPECT_TRUE(says(tube().out, "results.h5 is not as it was written"));
  EXPECT_TRUE(bytes_of("results/results.h5") == whole);
  change("summary.json", 100);
  EXPECT_TRUE(says(tube().out, "summary.json is not as it was written"));
}

TEST_F(Strange, DamagedModesAreComputedAgainAndTold) {
  ASSERT_EQ(tube().status, 0);
  const std::string whole = bytes_of("results/results.h5");
  change("modes.h5", bytes_of("results/modes.h5").size() / 2);
  fs::remove("results/summary.json");
  EXPECT_TRUE(says(tube().out, "modes.h5 is damaged"));
  EXPECT_TRUE(bytes_of("results/results.h5") == whole);
}

TEST_F(Strange, PetscTakesNoOptions) {
  (void)folder_.write(".petscrc", "-log_view :" + folder_.path("made").string() + "\n");
  const EnvironmentVariable options("PETSC_OPTIONS", "-log_view :" + folder_.path("made").string());
  const Outcome outcome = tube();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(fs::exists("made"));
}

TEST_F(Strange, TheReportTakesNoModules) {
  for (const char* module : {"h5py.py", "numpy.py", "page.py", "json.py"})
    (void)folder_.write(module, "open(r'" + folder_.path("made").string() + "', 'w')\n");
  const Outcome outcome = tube({});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(fs::exists("made"));
}

TEST_F(Strange, PipesAndDevicesAreRefused) {
  ASSERT_EQ(mkfifo("pipe.msh", 0600), 0);
  ASSERT_EQ(mkfifo("pipe.toml", 0600), 0);
  (void)folder_.write("study.toml", steel_pipe("pipe.msh"));
  for (const char* study : {"pipe.toml", "/dev/zero", "study.toml"}) {
    const Outcome outcome = folder_.fretwork({"check", study});
    EXPECT_EQ(outcome.status, input_is_wrong) << study;
    EXPECT_TRUE(says(outcome.err, "is not a regular file")) << study;
  }
}

TEST_F(Strange, NestingWithoutEndIsRefused) {
  constexpr std::size_t many = 100'000;
  std::string dotted = "a";
  for (std::size_t i = 0; i < many; ++i)
    dotted += ".a";
  for (const std::string& text :
       {"a = " + std::string(many, '[') + std::string(many, ']'), dotted + " = 1", "[" + dotted + "]"}) {
    const Outcome outcome = folder_.fretwork({"check", folder_.write("deep.toml", text + "\n").string()});
    EXPECT_EQ(outcome.status, input_is_wrong);
    EXPECT_TRUE(says(outcome.err, "nested more than 64 deep"));
  }
}

TEST_F(Strange, MessagesAreShortAndNotObeyed) {
  const std::string key = std::string(1'000'000, 'k');
  const Outcome outcome = folder_.fretwork({"check", folder_.write("long.toml", key + " = 1\n").string()});
  EXPECT_EQ(outcome.status, input_is_wrong);
  EXPECT_LT(outcome.err.size(), 3000u);
  const Outcome strange =
      folder_.fretwork({"check", folder_.write("escape.toml", "\"\\u001b[31m\" = 1\n").string()});
  EXPECT_EQ(strange.status, input_is_wrong);
  EXPECT_EQ(strange.err.find('\x1b'), std::string::npos);
}

TEST_F(Strange, OutputThatCannotBeWrittenIsNoSuccess) {
  if (!fs::exists("/dev/full"))
    GTEST_SKIP() << "no /dev/full on this system";
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"check", example("oscillator").string()},
        {"--help"},
        {"--version"},
        {"run", "--help"}})
    EXPECT_EQ(status_with_output_to("/dev/full", command), computation_failed) << command.front();
}

TEST_F(Strange, ARunWithoutAnEndIsRefused) {
  const Outcome outcome = tube({"--no-report", "--set", "transient.duration=1e6", "--set",
                                "transient.step=1e-6", "--set", "output.every=1e3"});
  EXPECT_EQ(outcome.status, input_is_wrong);
  EXPECT_TRUE(says(outcome.err, "more than transient.max_hours = 24"));
}

TEST_F(Strange, OneRunAtATimeWorksInAFolder) {
  ASSERT_EQ(tube().status, 0);
  EXPECT_FALSE(fs::exists("results/.lock"));
  // flock(1) holds what another run would hold
  const auto child =
      core::run_child({"flock", "results/.lock", (test_paths::binary_dir() / "bin" / "fretwork").string(),
                       "run", example("straight_tube").string(), "-o", "results"});
  EXPECT_EQ(child.status, input_is_wrong);
  EXPECT_TRUE(says(child.output, "the results folder \"results\" is in use by "));
  EXPECT_EQ(tube().status, 0) << "a lock file that is left over locks nothing";
}

TEST_F(Strange, AFolderInThePlaceOfResultsIsTold) {
  fs::create_directories("results/results.h5/a");
  const Outcome outcome = tube();
  EXPECT_EQ(outcome.status, input_is_wrong);
  EXPECT_TRUE(says(outcome.err, "results.h5: cannot be written: Is a directory"));
}

TEST_F(Strange, AContactOfAHeldNodeIsWarnedOf) {
  (void)folder_.write("mesh.msh", straight_line("beam", {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 4).text());
  const std::string stop =
      "[[contacts]]\nname = \"stop\"\ngroup = \"beam_end\"\nobstacle = \"circle\"\ngap = 1e-4\n"
      "normal_stiffness = 1e6\n[transient]\nduration = 0.01\n";
  const auto warned = [&](const std::string& end) {
    const std::string study = steel_pipe("mesh.msh") + tube_between("beam", "\"all\"", end) + stop;
    return says(folder_.fretwork({"check", folder_.write("study.toml", study).string()}).out,
                "contact \"stop\": its node is restrained in both normal directions");
  };
  EXPECT_TRUE(warned(R"(["uy", "uz"])"));
  EXPECT_FALSE(warned(R"(["ux", "uy"])"));
  EXPECT_FALSE(warned(""));
}

TEST_F(Strange, ADurationOfNothingIsRefused) {
  const Outcome outcome = tube({"--set", "transient.duration=1e-300"});
  EXPECT_EQ(outcome.status, input_is_wrong);
  EXPECT_TRUE(says(outcome.err, "shorter than a nanosecond"));
}

} // namespace
} // namespace fretwork::app::test::trust_test
