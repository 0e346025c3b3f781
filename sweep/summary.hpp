// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the cases of a sweep say together: counts, quantiles with intervals, probabilities, sensitivities, convergence (doc/sweep.md).
#pragma once
#include "sweep/table.hpp"
#include <nlohmann/json_fwd.hpp>

namespace fretwork::sweep {

inline constexpr double round_off_of_outputs =
    1e-12; ///< displacements, m, and forces, N: nothing moves so little

/// Counts, failures, warnings of the cases; unless the design is a grid the statistics, by OpenTURNS.
/// @throws core::Error for an output that does not exist, or without OpenTURNS
[[nodiscard]] nlohmann::json summarize(const study::Sweep& sweep, const Draws& draws, const Table& table);

/// What the messages of the rows say, those that are alike together: of cases without a result, then of done ones.
/// @param done  what lines call a done case with a warning
[[nodiscard]] std::vector<std::string> case_warnings(const Table& table,
                                                     const std::string& done = "done with a warning");

/// Of a sweep whose contacts have friction: a warning where contacts act in its cases and slide in none; else empty.
[[nodiscard]] std::string no_sliding_warning(const Table& table);

/// @throws core::Error where limits or `until` are asked of an output that there is not
void check_outputs(const study::Sweep& sweep, const std::vector<Column>& outputs);

/// The output that cases are compared by where the study names none: worst.work_rate, or, where nothing slides in any of them, worst.normal_max; of a
/// study without contacts the first that is no round-off.
[[nodiscard]] std::string measure_of(const Table& table);

/// Numbers of the done cases with the largest values of an output, the largest first; of years the smallest.
[[nodiscard]] std::vector<std::int64_t> worst_cases(const Table& table, const std::string& output,
                                                    std::int64_t count);

/// Of a grid: the least and the largest value of each output of all contacts, and in which case; of a study without contacts of each output.
[[nodiscard]] std::string range_lines(const Table& table);

/// The summary in lines for the terminal.
[[nodiscard]] std::string summary_text(const nlohmann::json& summary);

} // namespace fretwork::sweep
