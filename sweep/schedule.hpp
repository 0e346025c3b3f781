// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Cases over workers that take them as they become free: guided self-scheduling (Polychronopoulos and Kuck, IEEE Trans. Computers C-36,
/// 1987). The blocks are the same for every worker, so that all that workers share is a counter of blocks taken. Blocks are large at first
/// and single cases in the end: few takings, and no worker waits for more than a case.
#pragma once
#include "sweep/row.hpp"
#include <functional>

namespace fretwork::sweep {

/// Ends of the blocks of `cases` cases for so many workers: each block is a share of what is left.
[[nodiscard]] std::vector<std::int64_t> guided_blocks(std::int64_t cases, int workers);

/// The row of a case: what `evaluate` gives, or what it throws as the outcome: core::Error refused, core::ComputationError and
/// std::bad_alloc failed, any other a defect.
[[nodiscard]] Row evaluated(std::int64_t number, const std::string& identity,
                            const std::function<CaseResult()>& evaluate);

/// What a worker does: takes blocks until none is left, evaluates their cases, hands over the rows.
/// @param numbers   of the cases to be done, the same for all workers
/// @param take      the number of the next block, each given to one worker
/// @param evaluate  the row of a case
/// @param finish    takes a row
void work(const std::vector<std::int64_t>& numbers, int workers, const std::function<std::int64_t()>& take,
          const std::function<Row(std::int64_t)>& evaluate, const std::function<void(const Row&)>& finish);

} // namespace fretwork::sweep
