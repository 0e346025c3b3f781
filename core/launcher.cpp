// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/launcher.hpp"
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace fretwork::core {
namespace {

/// Ranks by launcher; the innermost of nested ones first: mpirun in a job of another launcher leaves that one's variables.
constexpr std::array rank_variables{
    "OMPI_COMM_WORLD_RANK", ///< Open MPI's mpirun (its manual, Environment variables set for MPI applications)
    "PMI_RANK", ///< MPICH's and Intel MPI's mpiexec (Hydra), Slurm's pmi2 (PMI-1 and PMI-2, their wire protocol)
    "PMIX_RANK", ///< PRRTE's prun, Slurm's pmix (PMIx standard, Environmental variables)
};

} // namespace

std::optional<int> launched_rank(const Environment& environment) {
  for (const char* name : rank_variables)
    if (const char* text = environment(name)) {
      const char* end = text + std::strlen(text);
      int rank = 0;
      if (const auto [stop, failure] = std::from_chars(text, end, rank);
          failure == std::errc() && stop == end && rank >= 0)
        return rank;
    }
  return std::nullopt;
}

std::optional<int> launched_rank() {
  return launched_rank([](const char* name) -> const char* { return std::getenv(name); });
}

std::vector<std::string> environment_without_launcher() {
  constexpr std::array prefixes{"OMPI_", "ORTE_",  "PRTE_", "PMIX_", "PMI_",
                                "MPI_",  "HYDRA_", "HYDI_", "SLURM_"};
  std::vector<std::string> out;
  for (char** entry = environ; *entry; ++entry)
    if (const std::string text = *entry;
        std::none_of(prefixes.begin(), prefixes.end(), [&](const char* p) { return text.starts_with(p); }))
      out.push_back(text);
  return out;
}

} // namespace fretwork::core
