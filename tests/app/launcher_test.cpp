// SPDX-License-Identifier: GPL-3.0-or-later
// Processes of an MPI job before MPI starts: by the environment of a launcher, only the first one speaks and writes.
#include "program.hpp"

namespace fretwork::app::test::launcher_test {
namespace {

/// As process `rank` of a job of four by Hydra, the launcher of MPICH and Intel MPI.
Outcome as_rank(int rank, const Workshop& folder, const std::vector<std::string>& arguments) {
  const EnvironmentVariable own("PMI_RANK", std::to_string(rank)), size("PMI_SIZE", "4");
  return folder.fretwork(arguments);
}

} // namespace

TEST(Launched, OnlyTheFirstProcessSaysThatTheCommandLineIsWrong) {
  const Workshop folder;
  const std::pair<std::vector<std::string>, std::string> wrong[] = {
      {{"runn"}, "there is no command \"runn\""},
      {{}, "a command is missing"},
      {{"run"}, "study is required"},
      {{"check", "study.toml", "--sett", "a=1"}, "--sett"}};
  for (const auto& [arguments, message] : wrong)
    for (const int rank : {0, 1, 3}) {
      const Outcome outcome = as_rank(rank, folder, arguments);
      EXPECT_EQ(outcome.status, 1) << message;
      EXPECT_EQ(outcome.out, "") << message;
      if (rank == 0)
        EXPECT_TRUE(says(outcome.err, message));
      else
        EXPECT_EQ(outcome.err, "") << message << " of rank " << rank;
    }
}

TEST(Launched, OnlyTheFirstProcessGivesHelp) {
  const Workshop folder;
  for (const char* option : {"--help", "--version"}) {
    EXPECT_NE(as_rank(0, folder, {option}).out, "") << option;
    const Outcome other = as_rank(2, folder, {option});
    EXPECT_EQ(other.status, 0) << option;
    EXPECT_EQ(other.out + other.err, "") << option;
  }
}

TEST(Launched, OnlyTheFirstProcessWritesTheFilesOfAnExport) {
  const Workshop folder;
  (void)folder.run(example("oscillator"), "results");
  const std::vector<std::string> arguments{"export", folder.path("results").string(), "--format", "csv"};
  const fs::path written = folder.path("results") / "export-csv";
  const Outcome other = as_rank(1, folder, arguments);
  EXPECT_EQ(other.status, 0);
  EXPECT_EQ(other.out + other.err, "");
  EXPECT_FALSE(fs::exists(written));
  const Outcome first = as_rank(0, folder, arguments);
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.out, "");
  EXPECT_TRUE(fs::exists(written));
}

TEST(Launched, OnlyTheFirstProcessSaysThatThereAreNoResults) {
  const Workshop folder;
  EXPECT_EQ(as_rank(0, folder, {"export", folder.path("none").string()}).status, 1);
  const Outcome other = as_rank(1, folder, {"export", folder.path("none").string()});
  EXPECT_EQ(other.out + other.err, "");
}

} // namespace fretwork::app::test::launcher_test
