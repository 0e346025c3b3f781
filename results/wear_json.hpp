// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Wear in summary.json, on the terminal and as CSV: keys and columns as in doc/results.md.
#pragma once
#include "results/wear_results.hpp"
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace fretwork::results {

/// @param contacts  names of the contacts of the run
[[nodiscard]] nlohmann::ordered_json wear_json(const Wear& wear, const std::vector<std::string>& contacts);

/// Lines of the terminal table, without a label: one a support, at most a dozen, of more the shortest lives; one a tube; one a coefficient of the bank.
[[nodiscard]] std::vector<std::string> wear_lines(const Wear& wear);

/// wear.csv: one support a row; <name>_wear.csv: volume and depth against time; <name>_wear_sectors.csv: work and depth by angle;
/// <name>_wear_sides.csv: the scars of several flat faces;
/// gap_opening.csv, where gaps were opened: one stage of one support a row.
/// @throws core::Error if a file cannot be written
void export_wear_csv(const std::filesystem::path& directory, const Wear& wear);

/// True for the name of a file that export_wear_csv writes.
[[nodiscard]] bool is_wear_csv(const std::string& file_name);

} // namespace fretwork::results
