// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_made.hpp"
#include "post/node_statistics.hpp"
#include <gtest/gtest.h>

using namespace fretwork;
using namespace fretwork::tests;

namespace {

constexpr double round_off = 1e-13;

} // namespace

TEST(NodeStatistics, AreThoseOfTheDisplacementMadeFromTheModes) {
  Eigen::MatrixXd first(3, 2), second(3, 2);
  first << 1, 0, 0, 2, 1, 1;
  second << -1, 3, 0, 0, 5, -5;
  post::NodeStatistics statistics({first, second}, 0.0);
  HandMade run(statistics, 0, 0.1);
  const std::vector<Eigen::Vector2d> states = {{1.0, 2.0}, {3.0, -2.0}, {0.0, 1.0}};
  for (const auto& q : states) {
    run.q()[0] = q(0);
    run.q()[1] = q(1);
    run.step();
  }
  const auto all = statistics.summaries();
  ASSERT_EQ(all.size(), 2u);
  const Eigen::MatrixXd rows[] = {first, second};
  for (std::size_t node = 0; node < 2; ++node)
    for (int d = 0; d < 3; ++d) {
      Eigen::Vector3d u;
      for (int i = 0; i < 3; ++i)
        u(i) = rows[node].row(d).dot(states[static_cast<std::size_t>(i)]);
      const auto& m = all[node].displacement[static_cast<std::size_t>(d)];
      EXPECT_NEAR(m.mean, u.mean(), round_off);
      EXPECT_NEAR(m.std, std::sqrt((u.array() - u.mean()).square().mean()), round_off);
      EXPECT_EQ(m.min, u.minCoeff());
      EXPECT_EQ(m.max, u.maxCoeff());
    }
}

TEST(NodeStatistics, StartAtTheirWindow) {
  post::NodeStatistics statistics({Eigen::MatrixXd::Identity(3, 3)}, 0.2);
  HandMade run(statistics, 0, 0.1);
  for (const double x : {100.0, -100.0, 1.0, 3.0}) { // at 0.05, 0.15, 0.25, 0.35 s
    run.q()[0] = x;
    run.step();
  }
  const auto m = statistics.summaries()[0].displacement[0];
  EXPECT_EQ(m.mean, 2.0);
  EXPECT_EQ(m.min, 1.0);
  EXPECT_EQ(m.max, 3.0);
}

TEST(NodeStatistics, WeighEachStepByItsLength) {
  post::NodeStatistics statistics({Eigen::MatrixXd::Identity(3, 3)}, 0.0);
  HandMade run(statistics, 0, 0.1);
  for (const auto& [x, step] : {std::pair{1.0, 0.1}, {5.0, 0.3}}) {
    run.q()[0] = x;
    run.step_length(step);
    run.step();
  }
  const auto m = statistics.summaries()[0].displacement[0];
  EXPECT_NEAR(m.mean, 4.0, round_off);
  EXPECT_NEAR(m.std, std::sqrt(3.0), round_off);
}

TEST(NodeStatistics, OfNoNodeAreNone) {
  post::NodeStatistics statistics({}, 0.0);
  HandMade run(statistics, 0, 0.1);
  run.open(3);
  EXPECT_TRUE(statistics.summaries().empty());
}
