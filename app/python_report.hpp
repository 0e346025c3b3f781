// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The HTML report, made by a Python program of ours in a child process.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace fretwork::app {

/// Writes DIR/report.html from summary.json and results.h5.
/// @throws core::Error with what is missing (an interpreter with h5py and numpy: Debian's python3-h5py,
/// python3-numpy) or the report's own message
void write_report(const std::filesystem::path& directory);

/// Writes it, and says so in a line, or why there is none: the results are whole without it.
[[nodiscard]] std::string make_report(const std::filesystem::path& directory);

/// What differs between runs, as tables; the first is the reference.
/// @param page  file of an HTML page to write as well; empty: none
/// @throws core::Error as write_report
[[nodiscard]] std::string compare_results(const std::vector<std::filesystem::path>& directories,
                                          const std::string& page);

/// Writes DIR/report.html of a sweep from DIR/summary.json and DIR/table.h5.
/// @throws core::Error as write_report
void write_sweep_report(const std::filesystem::path& directory);

} // namespace fretwork::app
