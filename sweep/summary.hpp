// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the cases of a sweep say together: counts, quantiles with intervals, probabilities, sensitivities, convergence (doc/sweep.md).
#pragma once
#include "sweep/table.hpp"
#include <nlohmann/json_fwd.hpp>

namespace fretwork::sweep {

/// Counts and failures; unless the design is a grid the statistics, by OpenTURNS.
/// @param cases  of the sweep, in the table or not
/// @throws core::Error for an output that does not exist, or without OpenTURNS
[[nodiscard]] nlohmann::json summarize(const study::Sweep& sweep, const Draws& draws, const Table& table);

/// Numbers of the done cases with the largest values of an output, the largest first.
[[nodiscard]] std::vector<std::int64_t> worst_cases(const Table& table, const std::string& output,
                                                    std::int64_t count);

/// The summary in lines for the terminal.
[[nodiscard]] std::string summary_text(const nlohmann::json& summary);

} // namespace fretwork::sweep
