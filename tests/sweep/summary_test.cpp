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

TEST(CaseWarnings, CountCasesWhoseMessagesAreAlikeOnce) {
  const Table table{{},
                    {row(0, Outcome::done, "\"all\" is unstable | \"no bars\" is unstable"),
                     row(1, Outcome::done, "\"all\" is unstable | \"no bars\" is unstable")}};
  EXPECT_THAT(
      case_warnings(table),
      ElementsAre("2 cases done with a warning, the first is case 0: \"all\", \"no bars\" is unstable"));
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

TEST(SummaryText, HasTheOutputsInTheirReadingOrder) {
  nlohmann::json summary{{"design", "monte_carlo"},
                         {"cases", 2},
                         {"rows", 2},
                         {"done", 2},
                         {"warnings", nlohmann::json::array()}};
  for (const char* name : {"a.work_rate", "total.work_rate", "total.energy_residual", "worst.work_rate",
                           "worst.work_rate.error", "worst.years"}) {
    summary["columns"].push_back(name);
    summary["units"][name] = "";
    if (!std::string(name).ends_with(".error"))
      summary["statistics"]["outputs"][name]["quantiles"] = {
          {{"probability", 0.5}, {"value", 1.0}, {"low", 0.5}, {"high", 2.0}}};
  }
  summary["statistics"]["limits"] = nlohmann::json::array();
  summary["statistics"]["sensitivities"] = nlohmann::json::object();
  summary["statistics"]["method"] = "spearman";
  summary["statistics"]["convergence"] = {
      {"output", "worst.years"}, {"quantile", 0.5}, {"relative_error", 0.05}, {"error", 0.1}, {"cases", 2},
      {"cases_needed", 8},       {"reached", false}};
  summary["statistics"]["first_support"] = {
      {"cases", 8},
      {"never", 2},
      {"supports",
       {{{"support", "plate"}, {"body", "tube"}, {"share", 0.5}, {"low", 0.2}, {"high", 0.8}},
        {{"support", "card"}, {"body", "support"}, {"share", 0.25}, {"low", 0.05}, {"high", 0.6}}}}};
  const std::string text = summary_text(summary);
  std::size_t before = 0;
  for (const char* line :
       {"\n  worst.years", "\n  worst.work_rate", "\n  total.work_rate", "\n  total.energy_residual"}) {
    const std::size_t at = text.find(line);
    ASSERT_NE(at, std::string::npos) << line << " is not in " << text;
    EXPECT_GT(at, before) << line;
    before = at;
  }
  EXPECT_THAT(text, HasSubstr("first to its limit  plate 50 % (20 to 80), card (the support) 25 % (5 to 60), "
                              "none 25 % of 8 cases"));
  EXPECT_THAT(text, testing::Not(HasSubstr("a.work_rate")));
}

TEST(SummaryText, SaysIntervalsOfOneEndInWords) {
  nlohmann::json summary{{"design", "monte_carlo"}, {"cases", 8}, {"rows", 8}, {"done", 8}};
  summary["warnings"] = nlohmann::json::array();
  summary["columns"] = {"a.years", "b.years"};
  summary["units"] = nlohmann::json::object();
  summary["statistics"] = {{"limits", nlohmann::json::array()}, {"sensitivities", nlohmann::json::object()}};
  const auto quantile = [](const nlohmann::json& value, const nlohmann::json& low,
                           const nlohmann::json& high) {
    return nlohmann::json{{"probability", 0.5}, {"value", value}, {"low", low}, {"high", high}};
  };
  const nlohmann::json none;
  summary["statistics"]["outputs"]["a.years"]["quantiles"] = {
      quantile(3.0, none, 5.97), quantile(3.0, 1.5, none), quantile(3.0, none, none)};
  summary["statistics"]["outputs"]["b.years"]["quantiles"] = {
      quantile(3.0, none, "never"), quantile("never", "never", none), quantile(3.0, 2.0, "never")};
  summary["statistics"]["convergence"] = {{"output", "a.years"}, {"quantile", 0.5}, {"relative_error", 0.05},
                                          {"error", 0.1},        {"cases", 8},      {"cases_needed", 8},
                                          {"reached", false}};
  EXPECT_THAT(summary_text(summary),
              testing::ContainsRegex("a.years +3 .below 5.97. +3 .above 1.5. +3 .no interval.\n"));
  EXPECT_THAT(summary_text(summary),
              testing::ContainsRegex("b.years +3 .no interval. +never +3 .2 to never.\n"));
}

TEST(SummaryText, SaysWhichCasesCannotBeJudged) {
  nlohmann::json summary{{"design", "monte_carlo"}, {"cases", 8}, {"rows", 8}, {"done", 8}};
  summary["warnings"] = nlohmann::json::array();
  summary["columns"] = {"a.years"};
  summary["units"]["a.years"] = "a";
  summary["statistics"] = {{"limits", nlohmann::json::array()}, {"sensitivities", nlohmann::json::object()}};
  summary["statistics"]["outputs"]["a.years"]["quantiles"] = {
      {{"probability", 0.5}, {"value", 1.0}, {"low", 0.5}, {"high", 2.0}}};
  summary["statistics"]["convergence"] = {{"output", "a.years"}, {"quantile", 0.5}, {"relative_error", 0.05},
                                          {"error", 0.1},        {"cases", 8},      {"cases_needed", 8},
                                          {"reached", false}};
  auto& first = summary["statistics"]["first_support"];
  first = {
      {"cases", 8},
      {"never", 1},
      {"not_judged", 2},
      {"supports", {{{"support", "plate"}, {"body", "tube"}, {"share", 0.5}, {"low", 0.2}, {"high", 0.8}}}},
      {"unknown",
       {{{"support", "card"}, {"body", "support"}, {"cases", 2}},
        {{"support", "plate"}, {"body", "tube"}, {"cases", 1}}}}};
  const std::string head = "  first to its limit  ";
  const std::string why =
      "    not judged: no life (outside its law, or beyond its geometry) of card (the support) "
      "in 2 cases, plate in 1 case; upper ends of the intervals include these cases\n";
  EXPECT_THAT(summary_text(summary),
              HasSubstr(head + "plate 50 % (20 to 80), none 12 %, not judged 25 % of 8 cases\n" + why));
  first["supports"] = nlohmann::json::array();
  first["never"] = 0;
  first["not_judged"] = 8;
  EXPECT_THAT(summary_text(summary), HasSubstr(head + "not judged 100 % of 8 cases\n" + why));
}

} // namespace
} // namespace fretwork::sweep::summary_test
