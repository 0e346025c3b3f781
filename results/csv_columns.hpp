// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Columns of equal length as a CSV file, `name [unit]` above each.
#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace fretwork::results {

struct CsvColumn {
  std::string name; ///< with its unit
  Eigen::VectorXd values;
};

/// Adds `name_component [unit]` for each column of a matrix.
void add_columns(std::vector<CsvColumn>& columns, const std::string& name, const Eigen::MatrixXd& values,
                 std::initializer_list<const char*> components, const std::string& unit);

/// @throws core::Error if it cannot be written
void write_csv(const std::filesystem::path& file, const std::vector<CsvColumn>& columns);

} // namespace fretwork::results
