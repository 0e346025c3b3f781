// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/sweep_rows.hpp"
#include "core/mpi.hpp"
#include "core/names.hpp"
#include "results/figures.hpp"
#include <fmt/format.h>

namespace fretwork::app {

namespace fs = std::filesystem;

fs::path folder_of_rows(const SweepPlan& plan) { return plan.directory / "shards"; }

void remove_rows(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code absent;
  for (fs::recursive_directory_iterator at(folder, absent), end; at != end; at.increment(absent))
    if (at->path().extension() == ".rows")
      files.push_back(at->path());
  for (const fs::path& file : files)
    fs::remove(file);
}

sweep::FoundRows read_rows(const SweepPlan& plan, const sweep::Draws& draws) {
  return sweep::read_rows(folder_of_rows(plan), draws.rows(),
                          [&](std::int64_t number) { return identity_of(plan, draws, number); });
}

std::string rows_are(std::int64_t count) {
  return results::counted(count, "row") + (count == 1 ? " is" : " are");
}

std::string found_text(std::int64_t there, const sweep::FoundRows& found) {
  std::string out;
  if (there > 0)
    out += fmt::format("{} there already (--force computes all cases)\n", rows_are(there));
  if (found.of_others > 0)
    out += fmt::format("{} of another state of the study: not used\n", rows_are(found.of_others));
  if (found.corrupt > 0)
    out += fmt::format("{} not as written ({}): the cases are computed again\n", rows_are(found.corrupt),
                       core::list_names(found.where));
  return out;
}

std::vector<std::int64_t> missing_cases(MPI_Comm comm, const SweepPlan& plan, std::int64_t cases,
                                        const sweep::FoundRows& found) {
  std::vector<std::int64_t> missing;
  if (core::rank(comm) == 0)
    for (std::int64_t number = 0, next = 0; number < cases; ++number) {
      const auto place = static_cast<std::size_t>(next);
      const bool there = place < found.rows.size() && found.rows[place].number == number;
      next += there ? 1 : 0;
      if (!there && plan.shard.has(number))
        missing.push_back(number);
    }
  auto count = static_cast<std::int64_t>(missing.size());
  MPI_Bcast(&count, 1, MPI_INT64_T, 0, comm);
  missing.resize(static_cast<std::size_t>(count));
  MPI_Bcast(missing.data(), static_cast<int>(count), MPI_INT64_T, 0, comm);
  return missing;
}

} // namespace fretwork::app
