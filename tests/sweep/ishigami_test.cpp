// SPDX-License-Identifier: GPL-3.0-or-later
// The function of Ishigami and Homma (1990) through the path of a sweep: design, workers, files, statistics. Its Sobol' indices are known:
// f = sin x1 + a sin^2 x2 + b x3^4 sin x1, x uniform on (-pi, pi), a = 7, b = 0.1.
#include "core/temporary_directory.hpp"
#include "sweep/schedule.hpp"
#include "sweep/shard.hpp"
#include "sweep/summary.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>

namespace fretwork::sweep::ishigami_test {
namespace {

constexpr double a = 7.0, b = 0.1, pi = std::numbers::pi;

double ishigami(double x1, double x2, double x3) {
  return std::sin(x1) + a * std::sin(x2) * std::sin(x2) + b * std::pow(x3, 4) * std::sin(x1);
}

study::Sweep sweep_of(study::SweepDesign design, std::int64_t draws) {
  study::Sweep out;
  out.design = design;
  out.draws = draws;
  out.confidence = 0.99;
  for (const char* name : {"x1", "x2", "x3"})
    out.variables.push_back({name, {name}, study::SweepDistribution{"uniform", {-pi, pi}, {}}});
  out.limits = {{"f", 0.0, true}};
  out.until = study::SweepUntil{0.05, "f", 0.5, draws};
  return out;
}

/// The summary of a sweep over two workers that write files of their own.
nlohmann::json summary_of(const study::Sweep& sweep) {
  const Draws draws = make_design(sweep, 1);
  const core::TemporaryDirectory folder;
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(draws.rows()));
  std::iota(numbers.begin(), numbers.end(), 0);
  const auto identity = [](std::int64_t number) { return short_digest(std::to_string(number)); };
  std::int64_t counter = 0;
  const std::int64_t blocks = static_cast<std::int64_t>(guided_blocks(draws.rows(), 2).size());
  for (int worker = 0; worker < 2; ++worker) {
    ShardFile file(folder.path() / ("rank_" + std::to_string(worker) + ".rows"));
    const std::int64_t last = worker == 0 ? blocks / 2 : blocks;
    work(
        numbers, 2, [&] { return counter < last ? counter++ : blocks; },
        [&](std::int64_t number) {
          return evaluated(number, identity(number), [&] {
            return CaseResult{{ishigami(draws(number, 0), draws(number, 1), draws(number, 2))}};
          });
        },
        [&](const Row& row) { file.append(row); });
  }
  return summarize(sweep, draws, {{{"f", ""}}, read_rows(folder.path(), draws.rows(), identity).rows});
}

TEST(Ishigami, SobolIndicesAreWithinTheirConfidence) {
  const auto summary = summary_of(sweep_of(study::SweepDesign::saltelli, 4000));
  EXPECT_EQ(summary["cases"], 4000 * 5);
  const double variance = a * a / 8.0 + b * std::pow(pi, 4) / 5.0 + b * b * std::pow(pi, 8) / 18.0 + 0.5;
  const double of_x1 = 0.5 * std::pow(1.0 + b * std::pow(pi, 4) / 5.0, 2) / variance,
               of_x2 = a * a / 8.0 / variance,
               of_x1_and_x3 = b * b * std::pow(pi, 8) * (1.0 / 18.0 - 1.0 / 50.0) / variance;
  const double first[] = {of_x1, of_x2, 0.0}, total[] = {of_x1 + of_x1_and_x3, of_x2, of_x1_and_x3};
  const auto& indices = summary["statistics"]["sensitivities"]["f"];
  EXPECT_EQ(summary["statistics"]["method"], "sobol");
  for (int i = 0; i < 3; ++i) {
    const auto& index = indices["x" + std::to_string(i + 1)];
    EXPECT_LE(index["low"], first[i]) << i;
    EXPECT_GE(index["high"], first[i]) << i;
    EXPECT_LE(index["total_low"], total[i]) << i;
    EXPECT_GE(index["total_high"], total[i]) << i;
    EXPECT_LT(index["high"].get<double>() - index["low"].get<double>(), 0.2) << i;
  }
}

TEST(Ishigami, QuantilesAndProbabilitiesHaveIntervals) {
  const auto statistics = summary_of(sweep_of(study::SweepDesign::monte_carlo, 2000))["statistics"];
  const auto& quantiles = statistics["outputs"]["f"]["quantiles"];
  ASSERT_EQ(quantiles.size(), 3u);
  for (const auto& quantile : quantiles) {
    EXPECT_LT(quantile["low"], quantile["value"]);
    EXPECT_GT(quantile["high"], quantile["value"]);
  }
  const auto& limit = statistics["limits"][0];
  EXPECT_EQ(limit["cases"], 2000);
  EXPECT_LT(limit["low"], limit["probability"]);
  EXPECT_GT(limit["high"], limit["probability"]);
  EXPECT_NEAR(statistics["outputs"]["f"]["mean"].get<double>(), a / 2.0, 0.4); // 5 standard errors
  // monotone in none but x1
  const auto& ranks = statistics["sensitivities"]["f"];
  EXPECT_GT(ranks["x1"]["low"], 0.2);
  EXPECT_LT(ranks["x3"]["low"], 0.0);
  EXPECT_GT(ranks["x3"]["high"], 0.0);
}

TEST(Sensitivities, AreThoseOfListedValuesWhateverTheirOrder) {
  study::Sweep sweep = sweep_of(study::SweepDesign::monte_carlo, 60);
  sweep.variables = {{"number", {"a"}, study::SweepLevels{{"0.5", "0.1", "0.3"}, {0.3, 0.4, 0.3}}},
                     {"boolean", {"b"}, study::SweepLevels{{"true", "false"}, {0.5, 0.5}}}};
  const Draws draws = make_design(sweep, 1);
  Table table{{{"f", ""}, {"g", ""}}, {}};
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    const double friction = std::stod(value_text(sweep.variables[0], draws(i, 0), i));
    const bool active = value_text(sweep.variables[1], draws(i, 1), i) == "true";
    table.rows.push_back({i, "", Outcome::done, {friction, active ? 1.0 : 0.0}});
  }
  const auto found = summarize(sweep, draws, table)["statistics"]["sensitivities"];
  EXPECT_NEAR(found["f"]["number"]["value"].get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(found["g"]["boolean"]["value"].get<double>(), 1.0, 1e-12);
}

TEST(Ishigami, ConvergenceSaysHowManyCasesAreNeeded) {
  const auto few = summary_of(sweep_of(study::SweepDesign::monte_carlo, 100))["statistics"]["convergence"];
  EXPECT_FALSE(few["reached"].get<bool>());
  EXPECT_GT(few["cases_needed"], 100);
  const auto needed = few["cases_needed"].get<std::int64_t>();
  const auto many =
      summary_of(sweep_of(study::SweepDesign::monte_carlo, 2 * needed))["statistics"]["convergence"];
  EXPECT_TRUE(many["reached"].get<bool>()) << many;
}

} // namespace
} // namespace fretwork::sweep::ishigami_test
