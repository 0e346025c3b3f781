// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/number_rows.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"
#include <algorithm>
#include <charconv>
#include <cmath>

namespace fretwork::study {
namespace {

constexpr std::string_view blanks = " \t";

bool has(std::string_view line, char separator) { return line.find(separator) != std::string_view::npos; }

/// Whether none of the cells is a number.
bool is_header(const std::vector<std::string>& cells) {
  return std::none_of(cells.begin(), cells.end(), [](const std::string& cell) { return to_real(cell); });
}

} // namespace

std::vector<std::string> cells_of(std::string_view line) {
  const char separator = has(line, ';') ? ';' : has(line, '\t') ? '\t' : has(line, ',') ? ',' : ' ';
  std::vector<std::string> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    std::string cell(trimmed(line.substr(at, end - at)));
    if (separator == ';')
      std::replace(cell.begin(), cell.end(), ',', '.');
    cells.push_back(std::move(cell));
    at = end + 1;
    if (separator == ' ') // several blanks are one
      at = std::max(at, std::min(line.find_first_not_of(blanks, std::min(at, line.size())), line.size() + 1));
  }
  return cells;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<double> to_real(std::string_view cell) {
  cell = trimmed(cell);
  if (!cell.empty() && cell.front() == '+')
    cell.remove_prefix(1);
  double number = 0.0;
  const auto [end, failure] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (failure != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(number))
    return std::nullopt;
  return number;
}

CellRows::CellRows(const std::filesystem::path& file, std::size_t fewest_cells)
    : file_(file), fewest_cells_(fewest_cells) {
  core::check_input_file(file, "file " + file.string());
  stream_.open(file);
  if (!stream_)
    throw core::Error("file " + file.string() + " cannot be read; check its permissions");
}

bool CellRows::next() {
  constexpr int most_headers = 2; // names, units
  while (std::getline(stream_, text_)) {
    ++number_;
    const std::string_view line = trimmed(text_);
    if (line.empty() || line.front() == '#')
      continue;
    cells_ = cells_of(line);
    in_rows_ = in_rows_ || headers_ == most_headers || cells_.size() < fewest_cells_ || !is_header(cells_);
    if (in_rows_)
      return true;
    if (headers_++ == 0)
      columns_ = cells_;
  }
  return false;
}

void CellRows::refuse(const std::string& problem) const {
  throw core::Error(file_.string() + ":" + std::to_string(number_) + ": \"" + std::string(trimmed(text_)) +
                    "\": " + problem);
}

NumberRows read_number_rows(const std::filesystem::path& file) {
  NumberRows out;
  CellRows rows(file, 1);
  while (rows.next()) {
    std::vector<double> row;
    for (const std::string& cell : rows.cells())
      if (const auto value = to_real(cell))
        row.push_back(*value);
      else
        rows.refuse("a row of finite numbers is expected");
    const std::size_t wanted = !rows.columns().empty() ? rows.columns().size()
                               : out.rows.empty()      ? row.size()
                                                       : out.rows.front().size();
    if (row.size() != wanted)
      rows.refuse(std::to_string(row.size()) + " numbers, the others have " + std::to_string(wanted) +
                  "; give every row as many");
    out.rows.push_back(std::move(row));
  }
  out.columns = rows.columns();
  if (out.rows.empty())
    throw core::Error("file " + file.string() + " has no row; give rows of numbers");
  return out;
}

} // namespace fretwork::study
