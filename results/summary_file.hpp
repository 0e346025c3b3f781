// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// summary.json with its checksum: written, and read back.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace fretwork::results {

struct FoundSummary {
  nlohmann::json summary; ///< an object; null where the file is of no use
  std::string refusal;    ///< why it is of no use; empty where there is no such file
};

/// Writes a summary with its checksum as the last key. Text that is not UTF-8 is replaced.
/// @throws core::Error if it cannot be written
void save_summary(const std::filesystem::path& file, nlohmann::ordered_json summary);

/// Verifies the checksum first.
[[nodiscard]] FoundSummary read_summary(const std::filesystem::path& file);

/// What an object has under a key where that is text; empty otherwise.
[[nodiscard]] std::string text_of(const nlohmann::json& table, const char* key);

/// SHA-256 of the tables beside a summary that are read back (flow.csv, spectra.csv), by name: its key files_sha256.
[[nodiscard]] nlohmann::ordered_json digests_of_tables(const std::filesystem::path& folder);
/// The first table that a summary names and that is not there as it was written; empty where all are.
[[nodiscard]] std::string changed_table(const std::filesystem::path& folder, const nlohmann::json& summary);

} // namespace fretwork::results
