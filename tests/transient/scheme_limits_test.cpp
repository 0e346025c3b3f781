// SPDX-License-Identifier: GPL-3.0-or-later
// doc/schemes.md has the limits of the steps that the program has: neither changes alone.
#include "paths.hpp"
#include "transient/scene/scheme_limits.hpp"
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace scheme_limits_test {

using namespace fretwork::transient;

namespace {

/// The rows of the table of the manual that has this column.
std::vector<std::string> table_with(const std::string& column) {
  std::ifstream file(fretwork::test_paths::source_dir() / "doc/schemes.md");
  std::vector<std::string> rows;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| --- "))
      continue;
    if (inside && !line.starts_with('|'))
      break;
    if (inside)
      rows.push_back(line);
    inside = inside || (line.starts_with('|') && line.find("| " + column + " |") != std::string::npos);
  }
  return rows;
}

std::string cell(const StepBound& bound) {
  if (std::isinf(bound.largest))
    return "-";
  return std::isinf(bound.share) ? fmt::format("{} at any accuracy", bound.largest)
                                 : fmt::format("{}; {}", bound.share, bound.largest);
}

} // namespace

TEST(SchemeLimits, AreThoseOfTheManual) {
  std::vector<std::string> rows;
  for (const SchemeLimits& limits : scheme_limits)
    rows.push_back(fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |", name_of(limits.scheme),
                               limits.intervals, cell(limits.contact), cell(limits.tangential_damper),
                               cell(limits.normal_damper), cell(limits.highest_mode),
                               limits.points_per_period));
  EXPECT_EQ(table_with("m: $w_{max} h$"), rows);
}

TEST(SchemeLimits, OfAllAndOfSplittingAloneAreThoseOfTheManual) {
  std::vector<std::string> values;
  for (const std::string& row : table_with("other bounds")) {
    const std::size_t begin = row.rfind("| ", row.size() - 2) + 2;
    values.push_back(row.substr(begin, row.size() - begin - 2));
  }
  const std::vector<std::string> expected = {
      fmt::format("{}", finest_for_normal_dampers),
      fmt::format("{}", mode_without_contacts),
      fmt::format("{}; {}; {}", points_of_lines, points_without_contacts, fewest_points),
      cell(contact_interval),
      fmt::format("{}; {}", structure_at_contacts.share, contact_beside_structure.share),
      fmt::format("{}; {}", table_share, contact_beside_tables),
      fmt::format("{}; {}; {}", record_share, record_share_without_contacts, fewest_points_of_records),
      fmt::format("{}; {}; {}", scaled_above, scaled_up_to_damper, least_gain_of_scaling),
      fmt::format("{}", coarsest_accuracy)};
  EXPECT_EQ(values, expected);
}

} // namespace scheme_limits_test
