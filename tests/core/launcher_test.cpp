// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/launcher.hpp"
#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>

namespace launcher_test {

using fretwork::core::environment_without_launcher;

namespace {

/// Rank of a process with these variables; -1: none.
int rank_in(const std::map<std::string, std::string>& variables) {
  return fretwork::core::launched_rank([&](const char* name) -> const char* {
           const auto found = variables.find(name);
           return found == variables.end() ? nullptr : found->second.c_str();
         })
      .value_or(-1);
}

} // namespace

TEST(Launcher, GivesTheRankByItsOwnVariable) {
  EXPECT_EQ(rank_in({}), -1);
  EXPECT_EQ(rank_in({{"OMPI_COMM_WORLD_RANK", "3"}, {"OMPI_COMM_WORLD_SIZE", "4"}}), 3);
  EXPECT_EQ(rank_in({{"PMI_RANK", "2"}, {"PMI_SIZE", "4"}}), 2); // Hydra: MPICH, Intel MPI; Slurm's pmi2
  EXPECT_EQ(rank_in({{"PMIX_RANK", "1"}, {"PMIX_NAMESPACE", "job"}, {"SLURM_PROCID", "1"}}), 1);
}

TEST(Launcher, OfABatchSystemIsNoMpiJob) {
  EXPECT_EQ(rank_in({{"SLURM_PROCID", "1"}, {"SLURM_NTASKS", "4"}}), -1);
}

TEST(Launcher, ThatIsInnermostGivesTheRank) { // mpirun in an srun
  EXPECT_EQ(rank_in({{"OMPI_COMM_WORLD_RANK", "0"}, {"PMI_RANK", "5"}, {"PMIX_RANK", "6"}}), 0);
}

TEST(Launcher, GivesNoRankByWhatIsNoNumber) {
  for (const char* text : {"", "x", "1x", "-1", " 1", "1.0", "99999999999"})
    EXPECT_EQ(rank_in({{"PMI_RANK", text}}), -1) << text;
}

TEST(Launcher, IsLeftOutOfTheEnvironmentOfAProcessOfItsOwn) {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK", "SLURM_PROCID", "LAUNCHER_TEST"})
    setenv(name, "1", 1);
  const auto left = environment_without_launcher();
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK", "SLURM_PROCID", "LAUNCHER_TEST"})
    unsetenv(name);
  EXPECT_EQ(std::count(left.begin(), left.end(), "LAUNCHER_TEST=1"), 1);
  for (const std::string& entry : left)
    EXPECT_FALSE(entry.starts_with("OMPI_") || entry.starts_with("PMI") || entry.starts_with("SLURM_"))
        << entry;
}

} // namespace launcher_test
