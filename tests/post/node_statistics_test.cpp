// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_made.hpp"
#include "post/contact_statistics.hpp"
#include "post/node_statistics.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace node_statistics_test {

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
      post::Extremes extremes(1);
      for (int i = 0; i < 3; ++i) {
        u(i) = rows[node].row(d).dot(states[static_cast<std::size_t>(i)]);
        extremes.watch(&u(i), 0.1 * i);
      }
      const auto& m = all[node].displacement[static_cast<std::size_t>(d)];
      EXPECT_NEAR(m.mean, u.mean(), round_off);
      EXPECT_NEAR(m.std, std::sqrt((u.array() - u.mean()).square().mean()), round_off);
      EXPECT_EQ(m.min, extremes.min(0));
      EXPECT_EQ(m.max, extremes.max(0));
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

TEST(NodeStatistics, TellTheErrorThatAContactTellsOfTheSameMotion) {
  post::NodeStatistics nodes({Eigen::MatrixXd::Identity(3, 3)}, 1.0);
  post::ContactStatistics contacts(centred(1), 1.0);
  HandMade of_nodes(nodes, 0, 0.1), of_contacts(contacts, 1, 0.1);
  std::mt19937 draw(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const double y = 3.0 + normal(draw), z = 2.0 * normal(draw);
    of_nodes.q()[0] = of_contacts.y(0) = y;
    of_nodes.q()[1] = of_contacts.z(0) = z;
    of_nodes.step();
    of_contacts.step();
  }
  const post::NodeSummary node = nodes.summaries()[0];
  const post::StandardErrors expected = contacts.summaries()[0].error;
  EXPECT_NEAR(node.std_error[0], expected.y_std, round_off);
  EXPECT_NEAR(node.std_error[1], expected.z_std, round_off);
  EXPECT_EQ(node.std_error[2], 0.0) << "at rest";
  EXPECT_GE(node.batches, 8.0 - 0.5);
}

TEST(NodeStatistics, TellTheErrorOfIndependentValues) {
  // Of N independent normal values the deviation has the error s/sqrt(2 N); from 32 batches or more it is known to 1/sqrt(64), and no
  // draw should be off by 4 times that.
  constexpr double s = 2.0, spread = 4.0 / 8.0;
  constexpr int values = 64 * 500;
  post::NodeStatistics statistics({Eigen::MatrixXd::Identity(3, 3)}, 0.0);
  HandMade run(statistics, 0, 0.1);
  std::mt19937 draw(11);
  std::normal_distribution<double> normal(100.0, s);
  for (int i = 0; i < values; ++i) {
    run.q()[0] = i == 0 ? 110.0 : normal(draw); // sums are about the first value, which must not matter
    run.step();
  }
  const double expected = s / std::sqrt(2.0 * values);
  EXPECT_NEAR(statistics.summaries()[0].std_error[0], expected, spread * expected);
}

TEST(NodeStatistics, OfAShortWindowHaveNoErrors) {
  post::NodeStatistics statistics({Eigen::MatrixXd::Identity(3, 3)}, 0.0);
  HandMade run(statistics, 0, 0.1);
  EXPECT_EQ(statistics.summaries()[0].batches, 0.0) << "before the first step";
  run.open(5);
  EXPECT_TRUE(std::isnan(statistics.summaries()[0].std_error[0]));
}

TEST(NodeStatistics, OfNoNodeAreNone) {
  post::NodeStatistics statistics({}, 0.0);
  HandMade run(statistics, 0, 0.1);
  run.open(3);
  EXPECT_TRUE(statistics.summaries().empty());
}

} // namespace node_statistics_test
