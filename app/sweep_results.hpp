// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a sweep has found, its files (doc/sweep.md, section 2) and the text for the terminal.
#pragma once
#include "app/case_worker.hpp"
#include "app/sweep_plan.hpp"
#include <nlohmann/json.hpp>

namespace fretwork::app {

struct SweepResults {
  sweep::Draws draws;
  SweepFacts facts;
  std::vector<std::string> warnings; ///< of the study as it stands, told before the first case; on rank 0
  sweep::Table table;                ///< rows on rank 0 only
  nlohmann::json summary;            ///< on rank 0: of sweep::summarize, with the cases kept (`worst`)
};

/// Writes table.csv, table.h5 and summary.json into the folder of the sweep; for one rank. Completes the summary by what is known of the study.
/// @return the text for the terminal, without warnings of the study as it stands
/// @throws core::Error where a file cannot be written, or the mesh not be read
[[nodiscard]] std::string write_sweep(const SweepPlan& plan, SweepResults& results);

/// The folder of a case that is kept with all its results.
[[nodiscard]] std::filesystem::path folder_of_case(const SweepPlan& plan, std::int64_t number);

} // namespace fretwork::app
