// SPDX-License-Identifier: GPL-3.0-or-later
// Loads as one modal force.
#include "signals/record.hpp"
#include "vibration/load_sum.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace load_sum_test {

using namespace fretwork;
using namespace fretwork::signals;
using namespace fretwork::vibration;

TEST(LoadSum, AddsLoadsWhateverTheyFollow) {
  const Harmonic same{1.0, 3.0};
  const std::vector<Load> loads = {{same, Eigen::Vector3d(1, 2, 3)},
                                   {Constant{2.0}, Eigen::Vector3d(1, 0, 0)},
                                   {same, Eigen::Vector3d(10, 20, 30)}};
  LoadSum sum(loads, 3, 1.0, 1e-3);
  kernels::Array force(8, -1.0);
  sum.at(0.05, force.data());
  const double s = std::sin(2.0 * std::numbers::pi * 3.0 * 0.05);
  EXPECT_DOUBLE_EQ(force[0], 11.0 * s + 2.0);
  EXPECT_DOUBLE_EQ(force[1], 22.0 * s);
  EXPECT_DOUBLE_EQ(force[2], 33.0 * s);
  for (std::size_t i = 3; i < 8; ++i)
    EXPECT_EQ(force[i], 0.0); // padding
  EXPECT_FALSE(sum.constant());
  EXPECT_FALSE(sum.empty());
}

TEST(LoadSum, GivesEachRandomSignalItsOwnValueWhateverGridsTheyShare) {
  const double duration = 2.0, h = 1e-3;
  const std::vector<TimeFunction> functions = {Random{1.0, 5.0, 45.0, 1}, Random{2.0, 0.0, 45.0, 2},
                                               Harmonic{1.0, 3.0}, Random{1.0, 5.0, 90.0, 3},
                                               Random{3.0, 5.0, 45.0, 4}};
  std::vector<Load> loads;
  std::vector<Signal> signals;
  for (std::size_t s = 0; s < functions.size(); ++s) {
    loads.push_back({functions[s], Eigen::VectorXd::Unit(5, static_cast<Eigen::Index>(s))});
    signals.emplace_back(functions[s], duration);
  }
  EXPECT_EQ(signals[0].grid(), signals[1].grid());
  EXPECT_NE(signals[0].grid(), signals[3].grid());
  LoadSum sum(loads, 5, duration, h);
  kernels::Array at(8), instant(8);
  for (const double time : {0.0, 0.4567, 1.1, 2.0}) {
    sum.at(time, at.data());
    sum.instant(time, instant.data());
    for (std::size_t s = 0; s < signals.size(); ++s) {
      EXPECT_EQ(at[s], signals[s].over_step(time, h, Signal::window(time, h))) << s;
      EXPECT_EQ(instant[s], signals[s](time)) << s;
    }
  }
}

TEST(LoadSum, TakesAnInstantAsItIsAndAStepByItsMean) {
  LoadSum sum({{Table{{0.0, 0.5, 0.5, 1.0}, {0.0, 0.0, 2.0, 2.0}}, Eigen::Vector2d(1, 0)}}, 2, 1.0, 0.2);
  kernels::Array force(8);
  sum.instant(0.45, force.data());
  EXPECT_EQ(force[0], 0.0);
  sum.at(0.45, force.data());
  EXPECT_NEAR(force[0], 0.5, 1e-14); // a quarter of the step is past the jump
}

TEST(LoadSum, IsALineAndABendInAStep) {
  constexpr double h = 0.1;
  const std::vector<TimeFunction> functions = {
      Constant{2.0}, Harmonic{1.0, 0.8}, Table{{0.0, 0.25, 1.0}, {0.0, 3.0, -1.0}}, Random{1.0, 0.2, 1.0, 5}};
  std::vector<Load> loads;
  for (std::size_t s = 0; s < functions.size(); ++s)
    loads.push_back({functions[s], Eigen::VectorXd::Unit(4, static_cast<Eigen::Index>(s))});
  LoadSum sum(loads, 4, 1.0, h, {}, LoadSum::Records::by_polygon);
  EXPECT_TRUE(sum.bends());
  kernels::Array first(8, -1.0), last(8, -1.0), bend(8, -1.0), again(8);
  for (const double start : {0.0, 0.2, 0.7}) {
    sum.in_step(start, start + h, first.data(), last.data(), bend.data());
    for (std::size_t s = 0; s < functions.size(); ++s) {
      const InStep of = Signal(functions[s], 1.0).in_step(start, start + h);
      EXPECT_NEAR(first[s], of.mean - of.slope, 1e-14) << s;
      EXPECT_NEAR(last[s], of.mean + of.slope, 1e-14) << s;
      EXPECT_NEAR(bend[s], of.bend, 1e-14) << s;
    }
    for (std::size_t i = 4; i < 8; ++i)
      EXPECT_EQ(first[i] + last[i] + bend[i], 0.0); // padding
    sum.in_step(start, start + h, first.data(), again.data(), nullptr);
    EXPECT_EQ(again, last);
  }
  // a record follows its nearest polygon, without a bend
  Table record;
  for (int i = 0; i <= 400; ++i) {
    record.time.push_back(2.5e-3 * i);
    record.value.push_back(std::sin(6.0 * record.time.back()));
  }
  LoadSum recorded({{record, Eigen::VectorXd::Unit(1, 0)}}, 1, 1.0, h, {}, LoadSum::Records::by_polygon);
  EXPECT_FALSE(recorded.bends());
  recorded.in_step(0.2, 0.3, first.data(), last.data(), nullptr);
  recorded.in_step(0.3, 0.4, again.data(), bend.data(), nullptr);
  const std::vector<double> corners = nearest_polygon(record, h, 20);
  EXPECT_NEAR(first[0], corners[2], 1e-9);
  EXPECT_NEAR(last[0], corners[3], 1e-9);
  EXPECT_EQ(last[0], again[0]);
  EXPECT_GT(std::abs(corners[3] - std::sin(6.0 * 0.3)), 1e-3); // no value of it
}

TEST(LoadSum, KnowsWhenItIsConstantOrNothing) {
  const Load steady{Constant{2.0}, Eigen::Vector2d(1, 1)}, idle{Harmonic{1.0, 5.0}, Eigen::Vector2d::Zero()};
  EXPECT_TRUE(LoadSum({steady}, 2, 1.0, 1e-3).constant());
  EXPECT_TRUE(LoadSum({steady, idle}, 2, 1.0, 1e-3).constant()); // a load that moves no mode is left out
  EXPECT_TRUE(LoadSum({idle}, 2, 1.0, 1e-3).empty());
  EXPECT_TRUE(LoadSum({}, 2, 1.0, 1e-3).empty());
  LoadSum opposite(
      {{Harmonic{1.0, 5.0}, Eigen::Vector2d(1, 2)}, {Harmonic{1.0, 5.0}, Eigen::Vector2d(-1, -2)}}, 2, 1.0,
      1e-3);
  kernels::Array force(8);
  opposite.at(0.01, force.data());
  EXPECT_EQ(force[0], 0.0);
  EXPECT_EQ(force[1], 0.0);
}

} // namespace load_sum_test
