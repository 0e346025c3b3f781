// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Time functions of loads and base motions: constant, harmonic, table, random.
#pragma once
#include "signals/time_function.hpp"
#include "study/table_reader.hpp"
#include <filesystem>

namespace fretwork::study {

/// The keys that give a time function, exactly one of which is needed.
inline const std::vector<std::string> time_function_keys{"constant", "harmonic", "table", "random"};

/// The time function of a load (N or N m) or of a base motion (m/s2); `unit` is for messages. Files of tables
/// start from `folder`.
[[nodiscard]] signals::TimeFunction read_time_function(const TableReader& entry,
                                                       const std::filesystem::path& folder, const char* unit);

/// Read rows of s and a value, with separators, header and units as number_rows.hpp says.
/// @throws core::Error naming file, line and row: not two finite numbers, time that decreases, three rows of
/// equal time, no row
[[nodiscard]] signals::Table read_time_table(const std::filesystem::path& file);

/// Replace the table files named by an entry of `[[loads]]`, `[[base_motion]]` or `[[support_motion]]` by their rows, so that a
/// canonical text depends on what a file holds and not on where it is.
void inline_time_table(Value& entry, const std::string& path, const std::filesystem::path& folder);

} // namespace fretwork::study
