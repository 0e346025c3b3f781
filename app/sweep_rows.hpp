// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The rows that the folder of a sweep has from earlier calls.
#pragma once
#include "app/sweep_plan.hpp"
#include <mpi.h>

namespace fretwork::app {

/// Removes those that lie in a folder and its folders: that of the shard (plan.inputs.directory), or of all (folder_of_rows).
void remove_rows(const std::filesystem::path& folder);

/// The folder of the rows of all shards.
[[nodiscard]] std::filesystem::path folder_of_rows(const SweepPlan& plan);

/// All of them, whatever the shard, that are of these inputs.
[[nodiscard]] sweep::FoundRows read_rows(const SweepPlan& plan, const sweep::Draws& draws);

/// The message on them.
/// @param there  of this shard and these inputs, that this call has not computed
[[nodiscard]] std::string found_text(std::int64_t there, const sweep::FoundRows& found);

/// Collective: numbers of the cases of this shard that no file has.
/// @param found  on rank 0
[[nodiscard]] std::vector<std::int64_t> missing_cases(MPI_Comm comm, const SweepPlan& plan,
                                                      std::int64_t cases, const sweep::FoundRows& found);

/// `1 row is`, `3 rows are`
[[nodiscard]] std::string rows_are(std::int64_t count);

} // namespace fretwork::app
