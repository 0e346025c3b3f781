// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_made.hpp"
#include "post/force_statistics.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace force_statistics_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

constexpr double round_off = 1e-12;
constexpr double of_directions = 2e-5; // of a deviation that is looked for in 720 directions

/// Its components are the modes themselves.
post::FollowedForce force(bool section) { return {"", Eigen::MatrixXd::Identity(6, 6), {}, {}, {}, section}; }

using Values = std::array<double, 6>;

std::vector<Values> random_values(std::size_t count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<Values> out(count);
  for (Values& values : out)
    for (double& value : values)
      value = 3.0 + normal(random);
  for (Values& values : out) // moments that go together: the worst fibre is no axis
    values[5] = 0.7 * values[4] + 0.1 * values[5];
  return out;
}

std::vector<post::ForceSummary> summaries_of(const std::vector<post::FollowedForce>& forces,
                                             const std::vector<Values>& all) {
  post::ForceStatistics statistics(forces, 0.0);
  HandMade run(statistics, 0, 0.01);
  for (const Values& values : all) {
    std::copy(values.begin(), values.end(), run.q().begin());
    run.step();
  }
  return statistics.summaries();
}

double deviation(const std::vector<Values>& all, const std::array<double, 6>& weights) {
  double sum = 0.0, squares = 0.0;
  for (const Values& values : all) {
    double value = 0.0;
    for (std::size_t c = 0; c < 6; ++c)
      value += weights[c] * values[c];
    sum += value;
    squares += value * value;
  }
  const auto n = static_cast<double>(all.size());
  return std::sqrt(squares / n - sum * sum / (n * n));
}

} // namespace

TEST(ForceStatistics, AreThoseOfEachComponent) {
  const auto all = random_values(50);
  for (const bool section : {true, false}) {
    const auto summary = summaries_of({force(section)}, all)[0];
    double shear = 0.0, moment = 0.0;
    for (std::size_t c = 0; c < 6; ++c) {
      Values weights{};
      weights[c] = 1.0;
      EXPECT_NEAR(summary.components[c].std, deviation(all, weights), round_off) << c;
      double least = all[0][c], most = all[0][c], sum = 0.0;
      for (const Values& values : all) {
        least = std::min(least, values[c]);
        most = std::max(most, values[c]);
        sum += values[c] / static_cast<double>(all.size());
      }
      EXPECT_EQ(summary.components[c].min, least);
      EXPECT_EQ(summary.components[c].max, most);
      EXPECT_NEAR(summary.components[c].mean, sum, round_off);
    }
    for (const Values& v : all) {
      shear = std::max(shear, std::hypot(v[1], v[2], section ? 0.0 : v[0]));
      moment = std::max(moment, std::hypot(v[4], v[5], section ? 0.0 : v[3]));
    }
    EXPECT_NEAR(summary.force, shear, round_off);
    EXPECT_NEAR(summary.moment, moment, round_off);
    EXPECT_TRUE(std::isnan(summary.stress)) << "no outline is known";
    EXPECT_TRUE(std::isnan(summary.stress_std));
  }
}

TEST(ForceStatistics, StressOfAPipeIsThatOfItsWorstFibre) {
  const auto all = random_values(400);
  post::FollowedForce pipe = force(true);
  pipe.fibre = post::OuterFibre{true, 2.0, 5.0, 5.0};
  const auto summary = summaries_of({force(false), pipe}, all)[1];
  double largest = 0.0, time = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const double stress = std::abs(all[i][0]) / 2.0 + 5.0 * std::hypot(all[i][4], all[i][5]);
        stress > largest) {
      largest = stress;
      time = (static_cast<double>(i) + 0.5) * 0.01;
    }
  for (double p = 0.0; p < 2.0 * std::numbers::pi; p += 1e-3)
    worst = std::max(worst, deviation(all, {0.5, 0.0, 0.0, 0.0, 5.0 * std::cos(p), 5.0 * std::sin(p)}));
  EXPECT_NEAR(summary.stress, largest, round_off * largest);
  EXPECT_NEAR(summary.stress_time, time, round_off);
  EXPECT_NEAR(summary.stress_std, worst, of_directions * worst);
  // independent values: the error of a deviation is std/sqrt(2 n)
  EXPECT_NEAR(summary.stress_std_error, worst / std::sqrt(800.0), 0.4 * worst / std::sqrt(800.0));
  EXPECT_GT(summary.batches, 2.0);
}

TEST(ForceStatistics, StressOfARectangleIsThatOfACorner) {
  const auto all = random_values(60);
  post::FollowedForce bar = force(true);
  bar.fibre = post::OuterFibre{false, 4.0, 3.0, 8.0};
  const auto summary = summaries_of({bar}, all)[0];
  double largest = 0.0;
  for (const Values& v : all)
    largest = std::max(largest, std::abs(v[0]) / 4.0 + 3.0 * std::abs(v[4]) + 8.0 * std::abs(v[5]));
  EXPECT_NEAR(summary.stress, largest, round_off * largest);
  EXPECT_NEAR(summary.stress_std,
              std::max(deviation(all, {0.25, 0, 0, 0, 3.0, 8.0}), deviation(all, {0.25, 0, 0, 0, 3.0, -8.0})),
              1e-9 * summary.stress_std);
}

TEST(ForceStatistics, ContainWhatImposedMotionsStrain) {
  post::FollowedForce moved = force(true);
  moved.imposed = Eigen::MatrixXd::Zero(6, 1);
  moved.imposed(4, 0) = 10.0;
  post::ForceStatistics statistics({moved}, 0.0);
  signals::PrescribedMotion motion;
  motion.displacement0 = 0.5;
  statistics.add_imposed_motion({moved}, {motion}, 1.0);
  HandMade run(statistics, 0, 0.1);
  run.q()[4] = 2.0;
  run.step();
  EXPECT_NEAR(statistics.summaries()[0].components[4].max, 7.0, round_off);
  EXPECT_NEAR(statistics.summaries()[0].moment, 7.0, round_off);
}

TEST(ForceStatistics, StartAtTheirWindowAndWeighEachStepByItsLength) {
  post::ForceStatistics statistics({force(true)}, 0.2);
  HandMade run(statistics, 0, 0.1);
  for (const auto& [x, step] : {std::pair{100.0, 0.1}, {-100.0, 0.1}, {1.0, 0.1}, {5.0, 0.3}}) {
    run.q()[0] = x;
    run.step_length(step);
    run.step();
  }
  const auto axial = statistics.summaries()[0].components[0];
  EXPECT_NEAR(axial.mean, 4.0, round_off);
  EXPECT_EQ(axial.min, 1.0);
  EXPECT_EQ(axial.max, 5.0);
}

} // namespace force_statistics_test
