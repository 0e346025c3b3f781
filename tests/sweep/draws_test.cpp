// SPDX-License-Identifier: GPL-3.0-or-later
// Designs by OpenTURNS: laws, strata, correlation, seeds, blocks that do not depend on those after them.
#include "core/error.hpp"
#include "sweep/design.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <set>

namespace fretwork::sweep::draws_test {
namespace {

using study::SweepDesign;
using study::SweepDistribution;

constexpr std::int64_t cases = 4000;
/// Standard errors that a sample's mean, or an empirical probability, may be off by: 1 in 16 000 for each.
constexpr double scatter = 4.0;

study::Sweep sweep_of(SweepDesign design, std::vector<SweepDistribution> laws) {
  study::Sweep out;
  out.design = design;
  out.draws = cases;
  for (std::size_t i = 0; i < laws.size(); ++i)
    out.variables.push_back({"v" + std::to_string(i), {"a.v" + std::to_string(i)}, laws[i]});
  return out;
}

struct LawMean {
  SweepDistribution law;
  double mean, deviation;
};

TEST(Draws, LawsHaveTheirMeansAndBounds) {
  const std::vector<LawMean> laws{{{"uniform", {1.0, 3.0}, {}}, 2.0, 0.577},
                                  {{"normal", {5.0, 2.0}, {}}, 5.0, 2.0},
                                  {{"lognormal", {3.0, 1.0}, {}}, 3.0, 1.0},
                                  {{"triangular", {0.0, 1.0, 5.0}, {}}, 2.0, 1.08},
                                  {{"weibull", {2.0, 1.0, 1.0}, {}}, 3.0, 2.0}, // exponential
                                  {{"integers", {1.0, 3.0}, {}}, 2.0, 0.816},
                                  {{"measured", {1.0, 2.0, 6.0}, {}}, 3.0, 2.16},
                                  {{"normal", {0.0, 1.0}, std::array{0.0, 100.0}}, 0.79788, 0.603}};
  std::vector<SweepDistribution> only;
  for (const LawMean& law : laws)
    only.push_back(law.law);
  const Draws draws = make_design(sweep_of(SweepDesign::monte_carlo, only), 1);
  ASSERT_EQ(draws.rows(), cases);
  for (std::size_t i = 0; i < laws.size(); ++i)
    EXPECT_NEAR(draws.col(static_cast<Eigen::Index>(i)).mean(), laws[i].mean,
                scatter * laws[i].deviation / std::sqrt(static_cast<double>(cases)))
        << laws[i].law.law;
  EXPECT_GE(draws.col(7).minCoeff(), 0.0);
  EXPECT_GE(draws.col(4).minCoeff(), 1.0);
  std::set<double> integers(draws.col(5).begin(), draws.col(5).end());
  EXPECT_EQ(integers, (std::set<double>{1.0, 2.0, 3.0}));
}

TEST(Draws, ListedValuesHaveTheirProbabilities) {
  study::Sweep sweep = sweep_of(SweepDesign::monte_carlo, {});
  sweep.variables = {{"active", {"a"}, study::SweepLevels{{"true", "false"}, {0.9, 0.1}}}};
  const Draws draws = make_design(sweep, 1);
  EXPECT_NEAR(draws.mean(), 0.1, scatter * 0.3 / std::sqrt(static_cast<double>(cases)));
}

TEST(Draws, LatinHypercubeHasOnePointInEveryStratum) {
  const Draws draws = make_design(
      sweep_of(SweepDesign::latin_hypercube, {{"uniform", {0.0, 1.0}, {}}, {"uniform", {0.0, 1.0}, {}}}), 1);
  for (Eigen::Index j = 0; j < 2; ++j) {
    std::vector<int> hits(cases, 0);
    for (const double value : draws.col(j))
      ++hits[static_cast<std::size_t>(value * cases)];
    EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), cases);
  }
}

TEST(Draws, RankCorrelationIsTheOneAskedFor) {
  study::Sweep sweep =
      sweep_of(SweepDesign::monte_carlo, {{"uniform", {0.0, 1.0}, {}}, {"uniform", {0.0, 1.0}, {}}});
  sweep.correlations = {{0, 1, 0.6}};
  const Draws draws = make_design(sweep, 1);
  const auto x = draws.col(0).array() - 0.5, y = draws.col(1).array() - 0.5;
  EXPECT_NEAR(12.0 * (x * y).mean(), 0.6, scatter / std::sqrt(static_cast<double>(cases)));
  sweep.variables.push_back({"v2", {"a.v2"}, SweepDistribution{"uniform", {0.0, 1.0}, {}}});
  sweep.correlations = {{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, -0.9}};
  EXPECT_THROW((void)make_design(sweep, 1), core::Error);
}

TEST(Draws, FollowFromTheSeedAndBlocksDoNotDependOnLaterOnes) {
  for (const SweepDesign design :
       {SweepDesign::monte_carlo, SweepDesign::latin_hypercube, SweepDesign::sobol}) {
    study::Sweep sweep = sweep_of(design, {{"normal", {0.0, 1.0}, {}}, {"uniform", {0.0, 1.0}, {}}});
    sweep.draws = 50;
    const Draws one = make_design(sweep, 1), three = make_design(sweep, 3);
    ASSERT_EQ(three.rows(), 150);
    EXPECT_EQ(one, three.topRows(50)) << name_of(design);
    EXPECT_NE(Draws(three.topRows(50)), Draws(three.middleRows(50, 50))) << name_of(design);
    sweep.seed = 2;
    EXPECT_NE(one, make_design(sweep, 1)) << name_of(design);
  }
}

} // namespace
} // namespace fretwork::sweep::draws_test
