// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/number_rows.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

namespace fretwork::study {
namespace {

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    cells.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  return cells;
}

} // namespace

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

NumberRows read_number_rows(const std::filesystem::path& file) {
  core::check_input_file(file, "file " + file.string());
  std::ifstream stream(file);
  if (!stream)
    throw core::Error("file " + file.string() + " cannot be read; check its permissions");
  NumberRows out;
  std::string text;
  for (int number = 1; std::getline(stream, text); ++number) {
    const std::string_view line = trimmed(text);
    if (line.empty() || line.front() == '#')
      continue;
    const auto refuse = [&](const std::string& problem) {
      throw core::Error(file.string() + ":" + std::to_string(number) + ": \"" + std::string(line) +
                        "\": " + problem);
    };
    const std::vector<std::string_view> cells = cells_of(line);
    const bool words =
        std::none_of(cells.begin(), cells.end(), [](std::string_view cell) { return to_real(cell); });
    if (words && out.rows.empty() && out.columns.empty()) {
      out.columns.assign(cells.begin(), cells.end());
      continue;
    }
    std::vector<double> row;
    for (const std::string_view cell : cells)
      if (const auto value = to_real(cell))
        row.push_back(*value);
      else
        refuse("a row of finite numbers between commas is expected");
    const std::size_t wanted = !out.columns.empty() ? out.columns.size()
                               : out.rows.empty()   ? row.size()
                                                    : out.rows.front().size();
    if (row.size() != wanted)
      refuse(std::to_string(row.size()) + " numbers, the others have " + std::to_string(wanted) +
             "; give every row as many");
    out.rows.push_back(std::move(row));
  }
  if (out.rows.empty())
    throw core::Error("file " + file.string() + " has no row; give rows of numbers between commas");
  return out;
}

} // namespace fretwork::study
