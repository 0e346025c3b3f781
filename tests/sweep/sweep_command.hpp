// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// fretwork sweep from end to end.
#pragma once
#include "program.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <sstream>

namespace fretwork::app::test {

/// `[sweep]` on an example.
inline std::string sweep_of(const std::string& name, const std::string& text) {
  return "[sweep]\nstudy = \"" + example(name).string() + "\"\n" + text;
}

inline const std::string stops = sweep_of("oscillator", R"(
design = "grid"
[[sweep.variables]]
name = "gap"
key = "contacts.stop.gap"
values = [0.0, 0.001, -0.001, 0.002]
[[sweep.variables]]
name = "stiffness"
key = "contacts.*.normal_stiffness"
range = { from = 1.0e6, to = 2.0e6, count = 3 }
)");

inline const std::vector<std::string> short_tube{"--set", "transient.duration=0.1", "--set",
                                                 "output.statistics_from=0"};

/// Cells of table.csv by the name of the column without its unit, a map a row.
inline std::vector<std::map<std::string, std::string>> table_of(const fs::path& directory) {
  std::istringstream in(bytes_of(directory / "table.csv"));
  const auto cells = [](const std::string& line) {
    std::vector<std::string> out;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');)
      out.push_back(cell.substr(0, cell.find(" [")));
    return out;
  };
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> head = cells(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> row = cells(line);
    rows.emplace_back();
    for (std::size_t i = 0; i < std::min(row.size(), head.size()); ++i)
      rows.back()[head[i]] = row[i];
  }
  return rows;
}

class Sweeps : public testing::Test {
protected:
  Outcome sweep(const std::string& text, const std::string& output, std::vector<std::string> more = {},
                int ranks = 0) const {
    std::vector<std::string> arguments{"sweep", folder.write("sweep.toml", text).string(), "-o",
                                       folder.path(output).string(), "--no-report"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return folder.fretwork(arguments, ranks);
  }
  [[nodiscard]] std::string refusal(const std::string& text,
                                    const std::vector<std::string>& more = {}) const {
    const Outcome outcome = sweep(text, "refused", more);
    EXPECT_EQ(outcome.status, 1) << outcome.out;
    return outcome.err;
  }
  const Workshop folder;
};

} // namespace fretwork::app::test
