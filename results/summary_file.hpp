// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// summary.json as it is read back.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace fretwork::results {

struct FoundSummary {
  nlohmann::json summary; ///< an object; null where the file is of no use
  std::string refusal;    ///< why it is of no use; empty where there is no such file
};

/// Verifies the checksum first.
[[nodiscard]] FoundSummary read_summary(const std::filesystem::path& file);

} // namespace fretwork::results
