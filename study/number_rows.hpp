// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Files of rows of numbers. Each line has its own separator: a semicolon (numbers may then have a decimal comma), else a tab, a comma, or
/// blanks. Empty lines and lines that begin with # are passed over; the first other line is a header where none of its cells is a
/// number, and a second one like it its units, which are passed over.
#pragma once
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fretwork::study {

struct NumberRows {
  std::vector<std::string> columns;      ///< names of the header; empty without one
  std::vector<std::vector<double>> rows; ///< at least one, all of one size
};

/// @throws core::Error naming file and line, for a file that cannot be read, without rows, or with cells that are no numbers
[[nodiscard]] NumberRows read_number_rows(const std::filesystem::path& file);

/// The rows of a file of cells, one after the other.
class CellRows {
public:
  /// @param fewest_cells  that a line without a number must have to be a header
  /// @throws core::Error for a file that cannot be read
  CellRows(const std::filesystem::path& file, std::size_t fewest_cells);

  /// Goes to the next row. @return false: there is none
  [[nodiscard]] bool next();
  /// Of the row, at least one.
  [[nodiscard]] const std::vector<std::string>& cells() const { return cells_; }
  /// Names of the header, known from the first row on; empty without one.
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  /// @throws core::Error  always, with file, number and text of the line
  [[noreturn]] void refuse(const std::string& problem) const;

private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::size_t fewest_cells_;
  std::string text_; ///< of the line
  int number_ = 0;   ///< of the line, from 1 on
  int headers_ = 0;
  bool in_rows_ = false;
  std::vector<std::string> cells_, columns_;
};

/// The cells of a line, without blanks about them, a decimal comma made a point.
[[nodiscard]] std::vector<std::string> cells_of(std::string_view line);

/// Without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// A finite number that fills the cell but for blanks.
[[nodiscard]] std::optional<double> to_real(std::string_view cell);

} // namespace fretwork::study
