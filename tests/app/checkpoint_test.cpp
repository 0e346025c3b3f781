// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that are killed and started again: the same results as if nothing had happened.
#include "core/child_process.hpp"
#include "mesh_text.hpp"
#include "paths.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <fmt/format.h>
#include <fstream>

namespace fretwork::app::test::checkpoint_test {
namespace {

constexpr int killed = 128 + 9, computation_failed = 2; ///< exit statuses

/// Arguments of the straight tube with 250 000 steps and a checkpoint every hundredth of a second.
std::vector<std::string> tube(const Workshop& folder, const std::string& output,
                              const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{
      "run",   example("straight_tube").string(), "--no-report", "-o", folder.path(output).string(),
      "--set", "transient.duration=0.25"};
  for (const char* key : {"transient.step=1e-6", "output.statistics_from=0", "output.checkpoint=0.01"}) {
    all.emplace_back("--set");
    all.emplace_back(key);
  }
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Starts the program, waits until it has written `file` anew and for `delay` seconds more, and sends it a signal.
void interrupt(const Workshop& folder, const std::vector<std::string>& arguments, const fs::path& file,
               double delay, const std::string& signal, int expected_status,
               const fs::path& program = test_paths::binary_dir() / "bin" / "fretwork") {
  static const std::string script = R"sh(
    set -m # a program in the background then does not ignore SIGINT
    file=$1; delay=$2; signal=$3; errors=$4; shift 4
    before=$(stat -c %y "$file" 2>/dev/null)
    "$@" >/dev/null 2>"$errors" & program=$!
    while kill -0 $program 2>/dev/null && [ "$(stat -c %y "$file" 2>/dev/null)" = "$before" ]; do sleep 0.002; done
    sleep $delay
    kill -$signal $program 2>/dev/null
    wait $program)sh";
  std::vector<std::string> all{"bash",          "-c",
                               script,          "bash",
                               file.string(),   fmt::format("{}", delay),
                               signal,          folder.path("stderr").string(),
                               program.string()};
  all.insert(all.end(), arguments.begin(), arguments.end());
  EXPECT_EQ(core::run_child(all).status, expected_status);
  EXPECT_TRUE(fs::exists(file));
  EXPECT_FALSE(fs::exists(folder.path("results") / "summary.json"));
}

/// The executable's own bytes and one more: it runs as before.
fs::path another_build(const Workshop& folder) {
  const fs::path copy = folder.path("another_fretwork");
  fs::copy_file(test_paths::binary_dir() / "bin" / "fretwork", copy);
  std::ofstream(copy, std::ios::binary | std::ios::app) << '\0';
  return copy;
}

void kill_after(const Workshop& folder, const std::vector<std::string>& arguments, const fs::path& file,
                double delay) {
  interrupt(folder, arguments, file, delay, "KILL", killed);
}

std::string completed(const Workshop& folder, const std::vector<std::string>& arguments, int ranks = 0) {
  const Outcome outcome = folder.fretwork(arguments, ranks);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.out;
}

void expect_same(const Workshop& folder, const std::string& one, const std::string& other) {
  EXPECT_TRUE(bytes_of(folder.path(one) / "results.h5") == bytes_of(folder.path(other) / "results.h5"));
  EXPECT_EQ(lasting(read_results(folder.path(one)).summary),
            lasting(read_results(folder.path(other)).summary));
}

TEST(Checkpoint, ARunKilledAtSeveralMomentsGivesTheSameBytes) {
  const Workshop folder;
  (void)completed(folder, tube(folder, "whole"));
  const fs::path file = folder.path("results") / "checkpoint.h5";
  for (const double delay : {0.0, 0.013, 0.0})
    kill_after(folder, tube(folder, "results"), file, delay);
  EXPECT_TRUE(
      says(completed(folder, tube(folder, "results")), "going on from " + file.string() + ", at t = 0."));
  expect_same(folder, "whole", "results");
  EXPECT_FALSE(fs::exists(file));
}

TEST(Checkpoint, KeepsTheWorkByAngleOfAWornTube) {
  const Workshop folder;
  std::string study = bytes_of(example("straight_tube"));
  const auto at = study.find("tube.geo");
  ASSERT_NE(at, std::string::npos);
  study.insert(at, (test_paths::source_dir() / "examples" / "straight_tube").string() + "/");
  const fs::path worn = folder.write("worn.toml", study + "\n[[wear]]\ncoefficient = 1e-16\nlength = 0.03\n");
  const auto arguments = [&](const std::string& output) {
    std::vector<std::string> all = tube(folder, output);
    all[1] = worn.string();
    return all;
  };
  (void)completed(folder, arguments("whole"));
  kill_after(folder, arguments("results"), folder.path("results") / "checkpoint.h5", 0.013);
  EXPECT_TRUE(says(completed(folder, arguments("results")), "going on from "));
  expect_same(folder, "whole", "results");
  EXPECT_TRUE(read_results(folder.path("results")).summary.contains("wear"));
}

TEST(Checkpoint, KeepsThePowersUnderAFluidelasticLaw) {
  const Workshop folder;
  const auto arguments = [&](const std::string& output) {
    std::vector<std::string> all = tube(folder, output, {"--set", "transient.step=1e-5"});
    all[1] = example("u_bend_flow").string();
    return all;
  };
  (void)completed(folder, arguments("whole"));
  kill_after(folder, arguments("results"), folder.path("results") / "checkpoint.h5", 0.013);
  EXPECT_TRUE(says(completed(folder, arguments("results")), "going on from "));
  expect_same(folder, "whole", "results");
  const auto law = read_results(folder.path("results")).summary["fluidelastic"][0];
  EXPECT_NE(law["motion"]["power_W"]["fluid"]["mean"], 0.0);
}

TEST(Checkpoint, GoesOnInTheStageOfGapOpeningThatWasKilled) {
  const Workshop folder;
  const fs::path study = folder.write(
      "worn.toml",
      bundle(folder, 1, "[transient]\nduration = 0.5\nstep = 2e-6\n[output]\ncheckpoint = 0.01\n") +
          across("drive0") + "[[wear]]\ncoefficient = 2e-14\nlength = 0.02\n[gap_opening]\nstages = 3\n");
  const auto arguments = [&](const std::string& output) {
    return std::vector<std::string>{"run", study.string(), "--no-report", "-o", folder.path(output).string()};
  };
  (void)completed(folder, arguments("whole"));
  const fs::path second =
      folder.path("results") / "checkpoint-3.h5"; // two numbers a stage: one may be verified
  kill_after(folder, arguments("results"), second, 0.0);
  const std::string told = completed(folder, arguments("results"));
  EXPECT_TRUE(says(told, "going on from " + (folder.path("results") / "checkpoint.h5").string()));
  EXPECT_TRUE(says(told, "going on from " + second.string()));
  expect_same(folder, "whole", "results");
  EXPECT_FALSE(fs::exists(second));
}

TEST(Checkpoint, HowOftenItIsWrittenIsNoInput) {
  const Workshop folder;
  (void)completed(folder, tube(folder, "results", {"--set", "output.checkpoint=0"}));
  EXPECT_TRUE(says(completed(folder, tube(folder, "results")), "up to date"));
}

TEST(Checkpoint, TakesNoOtherFileWithIt) {
  const Workshop folder;
  fs::create_directories(folder.path("results"));
  const fs::path file = folder.path("results") / "checkpoint-mine.h5";
  std::ofstream(file) << "kept";
  (void)completed(folder, tube(folder, "results"));
  EXPECT_TRUE(fs::exists(file));
  EXPECT_FALSE(fs::exists(folder.path("results") / "checkpoint.h5"));
}

TEST(Checkpoint, ThatIsDamagedIsToldAndNotUsed) {
  const Workshop folder;
  (void)completed(folder, tube(folder, "whole"));
  const fs::path file = folder.path("results") / "checkpoint.h5";
  kill_after(folder, tube(folder, "results"), file, 0.0);
  std::string bytes = bytes_of(file);
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(file, std::ios::binary) << bytes;
  EXPECT_TRUE(
      says(completed(folder, tube(folder, "results")), file.string() + " is damaged: the run starts again"));
  expect_same(folder, "whole", "results");
}

TEST(Checkpoint, OfAnotherBuildIsToldAndNotUsed) {
  const Workshop folder;
  (void)completed(folder, tube(folder, "whole"));
  const fs::path file = folder.path("results") / "checkpoint.h5";
  interrupt(folder, tube(folder, "results"), file, 0.0, "KILL", killed, another_build(folder));
  EXPECT_TRUE(says(completed(folder, tube(folder, "results")),
                   file.string() + " was written by another build of version"));
  expect_same(folder, "whole", "results");
}

TEST(Checkpoint, OfAnotherStudyIsToldAndNotUsed) {
  const Workshop folder;
  const std::vector<std::string> other{"--set", "loads.mid_spans.harmonic.amplitude=21"};
  (void)completed(folder, tube(folder, "whole", other));
  const fs::path file = folder.path("results") / "checkpoint.h5";
  kill_after(folder, tube(folder, "results"), file, 0.0);
  EXPECT_TRUE(says(completed(folder, tube(folder, "results", other)),
                   file.string() + " belongs to other inputs: the run starts again"));
  expect_same(folder, "whole", "results");
}

TEST(Checkpoint, ForceStartsAgain) {
  const Workshop folder;
  const fs::path file = folder.path("results") / "checkpoint.h5";
  kill_after(folder, tube(folder, "results"), file, 0.0);
  EXPECT_EQ(completed(folder, tube(folder, "results", {"--force"})).find("going on"), std::string::npos);
}

TEST(Checkpoint, IsWrittenOnSigterm) {
  const Workshop folder;
  (void)completed(folder, tube(folder, "whole"));
  const fs::path file = folder.path("results") / "checkpoint.h5";
  interrupt(folder, tube(folder, "results", {"--set", "output.checkpoint=0.05"}), file, 0.0, "TERM",
            computation_failed);
  EXPECT_TRUE(says(bytes_of(folder.path("stderr")), "ended by SIGTERM at t = 0."));
  EXPECT_TRUE(says(completed(folder, tube(folder, "results")), "going on from " + file.string()));
  expect_same(folder, "whole", "results");
}

TEST(Checkpoint, IsWrittenOnCtrlC) {
  const Workshop folder;
  (void)completed(folder, tube(folder, "whole"));
  const fs::path file = folder.path("results") / "checkpoint.h5";
  interrupt(folder, tube(folder, "results", {"--set", "output.checkpoint=0.05"}), file, 0.0, "INT",
            computation_failed);
  EXPECT_TRUE(says(bytes_of(folder.path("stderr")), "ended by Ctrl-C (SIGINT) at t = 0."));
  EXPECT_TRUE(says(completed(folder, tube(folder, "results")), "going on from " + file.string()));
  expect_same(folder, "whole", "results");
}

/// Sends SIGTERM after the first checkpoint, and SIGKILL to all processes of the program's group once it says that it saves, as Open MPI's
/// mpirun does a second later. Then waits for the checkpoint, half a minute at most.
void end_as_mpirun_does(const Workshop& folder, const std::vector<std::string>& arguments,
                        const fs::path& file) {
  static const std::string script = R"sh(
    set -m # a group of its own
    file=$1; told=$2; shift 2
    "$@" >"$told" 2>&1 & program=$!
    while [ ! -e "$file" ]; do sleep 0.002; done
    sleep 0.1
    rm "$file" # the next is due in 0.2 s
    kill -TERM $program
    while ! grep -q "saves the checkpoint" "$told"; do sleep 0.002; done
    kill -KILL -$program
    wait $program; status=$?
    for (( i = 0; i < 3000; ++i )); do [ -e "$file" ] && break; sleep 0.01; done
    exit $status)sh";
  std::vector<std::string> all{"bash",
                               "-c",
                               script,
                               "bash",
                               file.string(),
                               folder.path("told").string(),
                               (test_paths::binary_dir() / "bin" / "fretwork").string()};
  all.insert(all.end(), arguments.begin(), arguments.end());
  EXPECT_EQ(core::run_child(all).status, killed);
}

TEST(Checkpoint, IsCompletedWhereALauncherKillsTheProgramWhileItSaves) {
  const Workshop folder;
  const std::vector<std::string> large = {"--set", "output.every=5e-6", // some 0.1 s to save
                                          "--set", "output.checkpoint=0.3"};
  (void)completed(folder, tube(folder, "whole", large));
  const fs::path file = folder.path("results") / "checkpoint.h5";
  end_as_mpirun_does(folder, tube(folder, "results", large), file);
  EXPECT_TRUE(says(bytes_of(folder.path("told")), "SIGTERM at t = 0."));
  EXPECT_TRUE(says(completed(folder, tube(folder, "results", large)), "going on from " + file.string()));
  expect_same(folder, "whole", "results");
}

TEST(Checkpoint, IsWrittenOnSigtermDuringTheRunAtHalfTheStepToo) {
  const Workshop folder;
  const std::vector<std::string> verify = {"--set", "transient.verify=true"};
  (void)completed(folder, tube(folder, "whole", verify));
  const fs::path file = folder.path("results") / "checkpoint-2.h5"; // the run itself has ended
  interrupt(folder, tube(folder, "results", verify), file, 0.0, "TERM", computation_failed);
  EXPECT_TRUE(says(bytes_of(folder.path("stderr")), "ended by SIGTERM at t = 0."));
  const std::string told = completed(folder, tube(folder, "results", verify));
  EXPECT_TRUE(says(told, "going on from " + file.string()));
  EXPECT_TRUE(says(told, "checkpoint.h5, at t = 0.249999 s"));
  expect_same(folder, "whole", "results");
  EXPECT_FALSE(fs::exists(file));
}

std::string three_tubes(const Workshop& folder) {
  return bundle(folder, 3, R"([transient]
duration = 0.2
step = 1.0e-6
[output]
every = 1.0e-3
checkpoint = 0.01
)");
}

TEST(Checkpoint, EveryRunOfAStudyHasItsOwnOnAnyNumberOfRanks) {
  const Workshop folder;
  const std::string study = folder.write("study.toml", three_tubes(folder)).string();
  const auto run = [&](const std::string& output) {
    return std::vector<std::string>{"run", study, "--no-report", "-o", folder.path(output).string()};
  };
  (void)completed(folder, run("whole"));
  // the last of one process: by then the others have ended
  kill_after(folder, run("results"), folder.path("results") / "checkpoint-3.h5", 0.0);
  const std::string told = completed(folder, run("results"), 2);
  for (const char* file : {"checkpoint.h5", "checkpoint-2.h5", "checkpoint-3.h5"}) {
    EXPECT_TRUE(says(told, fmt::format("going on from {}", (folder.path("results") / file).string())));
    EXPECT_FALSE(fs::exists(folder.path("results") / file));
  }
  expect_same(folder, "whole", "results");
}

} // namespace
} // namespace fretwork::app::test::checkpoint_test
