// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A table as an HDF5 file: a column a dataset, in groups. The same columns give the same bytes.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fretwork::results {

struct NumberColumn {
  std::string group, name;
  std::string unit; ///< empty: dimensionless
  std::vector<double> values;
};

/// @param attributes  texts of the file
/// @throws core::Error if it cannot be written
void write_columns(const std::filesystem::path& file, const std::map<std::string, std::string>& attributes,
                   const std::vector<NumberColumn>& columns);

} // namespace fretwork::results
