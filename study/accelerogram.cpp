// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/accelerogram.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"
#include "study/number_rows.hpp"
#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>
#include <sstream>

namespace fretwork::study {
namespace {

constexpr double standard_gravity = 9.80665; // m/s2
constexpr double most_points = 1e12;         // more than any file holds; exact as an integer

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

struct Sampling {
  std::size_t points = 0;
  double step = 0.0; ///< s
};

/// The number after `name` and `=`.
std::optional<double> named_number(std::string_view line, std::string_view name) {
  const auto at = line.find(name);
  if (at == std::string_view::npos)
    return std::nullopt;
  line = trimmed(line.substr(at + name.size()));
  if (!line.starts_with('='))
    return std::nullopt;
  line = trimmed(line.substr(1));
  return to_real(line.substr(0, line.find_first_not_of("0123456789.e+-")));
}

/// `NPTS= 4000, DT= .0050 SEC` or `4000 0.0050 NPTS, DT`.
Sampling sampling_of(const std::string& line, const std::string& file) {
  const std::string text = lower(line);
  std::optional<double> points = named_number(text, "npts"), step = named_number(text, "dt");
  std::istringstream words(text);
  if (std::string first, second, third;
      !points && words >> first >> second >> third && third.starts_with("npts"))
    points = to_real(first), step = to_real(second);
  if (points && *points >= 0.0 && *points <= most_points && step && *step > 0.0)
    return {static_cast<std::size_t>(*points), *step};
  throw core::Error(file + ":4: \"" + line + "\": NPTS and DT are expected, as NPTS= 4000, DT= .0050 SEC");
}

} // namespace

bool is_accelerogram(const std::filesystem::path& file) { return lower(file.extension().string()) == ".at2"; }

signals::Table read_accelerogram(const std::filesystem::path& file) {
  const std::string name = "file " + file.string();
  core::check_input_file(file, name);
  std::ifstream stream(file);
  std::string header[4];
  for (std::string& line : header)
    if (!std::getline(stream, line))
      throw core::Error(
          name +
          " cannot be read, or has not the four lines of header of a PEER accelerogram; paths start from "
          "the folder of the study");
  if (lower(header[2]).find("units of g") == std::string::npos)
    throw core::Error(name + ":3: \"" + header[2] +
                      "\": values IN UNITS OF G are expected; write other units as rows t,value");
  const Sampling sampling = sampling_of(header[3], file.string());
  signals::Table table;
  for (std::string cell; stream >> cell;) {
    const auto value = to_real(cell);
    if (!value)
      throw core::Error(name + ": \"" + cell + "\" is no finite number");
    table.time.push_back(static_cast<double>(table.time.size()) * sampling.step);
    table.value.push_back(standard_gravity * *value);
  }
  if (table.time.size() != sampling.points || table.time.empty())
    throw core::Error(name + " has " + std::to_string(table.time.size()) + " values, and its header says " +
                      std::to_string(sampling.points) + "; take the whole file");
  return table;
}

} // namespace fretwork::study
