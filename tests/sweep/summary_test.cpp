// SPDX-License-Identifier: GPL-3.0-or-later
// What a summary says of messages of cases.
#include "sweep/summary.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fretwork::sweep::summary_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Row row(std::int64_t number, Outcome outcome, std::string message) {
  return {number, "", outcome, {}, std::move(message)};
}

TEST(CaseWarnings, AreTogetherByOutcome) {
  const Table table{{},
                    {row(0, Outcome::done, "a long step of 3 s"), row(1, Outcome::refused, "gap = -1 m"),
                     row(2, Outcome::done, ""), row(3, Outcome::refused, "gap = -3 m"),
                     row(4, Outcome::done, "few modes | a long step of 5 s"),
                     row(5, Outcome::failed, "diverged | at once")}};
  EXPECT_THAT(case_warnings(table),
              ElementsAre("2 cases refused, the first is case 1: gap = -3 to -1 m",
                          "case 5 failed: diverged | at once",
                          "2 cases done with a warning, the first is case 0: a long step of 3 to 5 s",
                          "case 4 done with a warning: few modes"));
}

TEST(CaseWarnings, OfManyKindsAreThoseOfMostCases) {
  Table table;
  for (std::int64_t k = 0; k < 20; ++k)
    table.rows.push_back(row(k, Outcome::failed, std::string(static_cast<std::size_t>(k) + 1, 'a')));
  for (std::int64_t k = 20; k < 23; ++k)
    table.rows.push_back(row(k, Outcome::done, "few modes"));
  const auto warnings = case_warnings(table);
  ASSERT_EQ(warnings.size(), 11u);
  EXPECT_EQ(warnings[0], "cases have more kinds of messages than these:");
  EXPECT_EQ(warnings[1], "3 cases done with a warning, the first is case 20: few modes");
}

} // namespace
} // namespace fretwork::sweep::summary_test
