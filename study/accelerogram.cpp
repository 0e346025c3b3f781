// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/accelerogram.hpp"
#include "core/error.hpp"
#include "study/number_rows.hpp"
#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <sstream>

namespace fretwork::study {
namespace {

constexpr double standard_gravity = 9.80665; // m/s2

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

struct Sampling {
  std::size_t points = 0;
  double step = 0.0; ///< s
};

Sampling sampling_of(const std::string& line, const std::string& file) {
  static const std::regex named(R"(npts\s*=\s*(\d+)\s*,\s*dt\s*=\s*([0-9.e+-]+))"),
      plain(R"(^\s*(\d+)\s+([0-9.e+-]+)\s+npts)");
  std::smatch found;
  const std::string text = lower(line);
  if (std::regex_search(text, found, named) || std::regex_search(text, found, plain))
    if (const auto points = to_real(found[1].str()), step = to_real(found[2].str());
        points && step && *step > 0.0)
      return {static_cast<std::size_t>(*points), *step};
  throw core::Error(file + ":4: \"" + line + "\": NPTS and DT are expected, as NPTS= 4000, DT= .0050 SEC");
}

} // namespace

bool is_accelerogram(const std::filesystem::path& file) { return lower(file.extension().string()) == ".at2"; }

transient::Table read_accelerogram(const std::filesystem::path& file) {
  const std::string name = "file " + file.string();
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
  transient::Table table;
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
