// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Rows of a spectrum: an array of [frequency, density], or a file of such rows with or without a header.
#pragma once
#include "study/table_reader.hpp"
#include <filesystem>

namespace fretwork::study {

struct SpectrumRows {
  std::vector<double> frequency, density; ///< > 0, frequencies ascending, two rows at least
};

/// @throws core::Error naming key, row and file
[[nodiscard]] SpectrumRows read_spectrum_rows(const TableReader& table, const std::string& key,
                                              const std::filesystem::path& folder);

/// Puts the rows of a file in the place of its name.
/// @param path  of the entry of `[[turbulence]]`, for messages
/// @throws core::Error if the file cannot be read
void inline_spectrum_rows(Value& entry, const std::string& path, const std::filesystem::path& folder);

} // namespace fretwork::study
