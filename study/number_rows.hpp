// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Files of rows of numbers. Each line has its own separator: a semicolon (numbers may then have a decimal comma), else a tab, a comma, or
/// blanks. Empty lines and lines that begin with # are passed over; the first other line is a header where none of its cells is a
/// number, and a second one like it its units, which are passed over.
#pragma once
#include <filesystem>
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

/// The cells of a line, without blanks about them, a decimal comma made a point.
[[nodiscard]] std::vector<std::string> cells_of(std::string_view line);

/// Whether none of the cells is a number.
[[nodiscard]] bool is_header(const std::vector<std::string>& cells);

/// Without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// A finite number that fills the cell but for blanks.
[[nodiscard]] std::optional<double> to_real(std::string_view cell);

} // namespace fretwork::study
