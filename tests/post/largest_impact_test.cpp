// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_made.hpp"
#include "post/largest_impact.hpp"
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <utility>

namespace largest_impact_test {

using namespace fretwork;
using namespace fretwork::tests;
using post::LargestImpact;

namespace {

constexpr double h = 0.01;

double largest(const std::vector<post::ForcePoint>& history) {
  double out = 0.0;
  for (const post::ForcePoint& point : history)
    out = std::max(out, point.normal);
  return out;
}

} // namespace

TEST(LargestImpact, IsKeptAtEveryStepBetweenPointsWithoutForce) {
  LargestImpact impacts(2, 0.0);
  HandMade run(impacts, 2, h);
  run.closed(2, 3.0);
  run.open(5);
  for (const double force : {2.0, 7.0, 4.0}) {
    run.contact(0).normal_force = force;
    run.contact(0).friction = {3.0, 4.0};
    run.step();
  }
  run.open(3);
  run.closed(1, 5.0);
  const auto history = impacts.histories()[0];
  std::vector<double> forces, times;
  for (const post::ForcePoint& point : history) {
    forces.push_back(point.normal);
    times.push_back(point.time);
  }
  EXPECT_EQ(forces, (std::vector<double>{0, 3, 3, 0, 0, 2, 7, 4, 0, 0, 5}));
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_NEAR(history[6].time, 8.5 * h, 1e-12);
  EXPECT_EQ(history[6].tangential, 5.0);
  EXPECT_TRUE(impacts.histories()[1].empty()) << "it touched nothing";
}

/// Two impacts, the first of two steps and open at the end of the second, with a contact-free macro-step between them.
TEST(LargestImpact, HasNoForceBetweenTwoImpacts) {
  LargestImpact impacts(1, 0.0);
  transient::ContactState state;
  const int contact = 0;
  transient::Record record;
  record.states = {&state, 1};
  double end = 0.0;
  const auto step = [&](double length, double force, int touches, bool opened) {
    state = {};
    state.normal_force = state.peak = force;
    state.touches = touches;
    state.opened_at = opened ? 0.7 : 0.0;
    state.closed_at = touches > 0 ? 0.2 : 0.0;
    record.active = {&contact, force > 0.0 ? 1u : 0u};
    record.opened = {&contact, opened ? 1u : 0u};
    record.step = length;
    record.time = end + 0.5 * length;
    end += length;
    impacts.step(record);
  };
  step(h, 3.0, 1, false);
  step(h, 1.0, 0, true);
  step(5.0 * h, 0.0, 0, false);
  step(h, 9.0, 1, true);
  const auto history = impacts.histories()[0];
  const std::vector<std::pair<double, double>> expected{{0.0, 0.0}, {0.5, 3.0}, {1.5, 1.0}, {2.0, 0.0},
                                                        {7.0, 0.0}, {7.5, 9.0}, {8.0, 0.0}};
  ASSERT_EQ(history.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_DOUBLE_EQ(history[i].time, expected[i].first * h) << i;
    EXPECT_EQ(history[i].normal, expected[i].second) << i;
  }
}

/// Two impacts within a step, of which the second goes on in the next one, which it leaves at once.
TEST(LargestImpact, HasTheForcesWithinSteps) {
  LargestImpact impacts(2, 0.0);
  std::vector<transient::ContactState> states(2);
  transient::Record record;
  record.states = states;
  record.step = h;
  const int contact = 1;
  record.active = {&contact, 1};
  states[1].normal_force = 1.0;
  states[1].touches = 2;
  std::vector<transient::ForcePiece> pieces{{1, 0.1, 0.3, {0.0, 0.0, 4.0}, {0.0, 0.0, 2.0}, 2.9},
                                            {1, 0.5, 0.75, {5.0, 7.0, 6.0}, {1.0, 1.0, 1.0}, 1.0},
                                            {1, 0.75, 1.0, {7.0, 9.0, 8.0}, {1.0, 3.0, 2.0}, 3.0}};
  record.pieces = pieces;
  record.time = 0.5 * h;
  impacts.step(record);
  pieces = {{1, 0.0, 0.2, {9.0, 0.0, 9.0}, {3.0, 0.0, 1.5}, 3.0}};
  record.pieces = pieces;
  record.time = 1.5 * h;
  record.opened = {&contact, 1};
  states[1].opened_at = 0.2;
  impacts.step(record);
  const auto history = impacts.histories()[1];
  const std::vector<std::array<double, 3>> expected{{0.1, 0.0, 0.0},
                                                    {0.15, 4.5, 2.25},
                                                    {0.2, 6.0, 2.9},
                                                    {0.25, 4.5, 2.25},
                                                    {0.3, 0.0, 0.0},
                                                    {0.3, 0.0, 0.0},
                                                    {0.5, 0.0, 0.0},
                                                    {0.5, 5.0, 1.0},
                                                    {0.5625, 5.5, 1.0},
                                                    {0.625, 6.0, 1.0},
                                                    {0.6875, 6.5, 1.0},
                                                    {0.75, 7.0, 1.0},
                                                    {0.8125, 7.5, 1.5},
                                                    {0.875, 8.0, 2.0},
                                                    {0.9375, 8.5, 2.5},
                                                    {1.0, 9.0, 3.0},
                                                    {1.0 + 0.2 / 3.0, 12.0, 2.0},
                                                    {1.1, 11.25, 1.5},
                                                    {1.15, 7.3125, 0.75},
                                                    {1.2, 0.0, 0.0},
                                                    {1.2, 0.0, 0.0}};
  ASSERT_EQ(history.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_DOUBLE_EQ(history[i].time, expected[i][0] * h) << i;
    EXPECT_DOUBLE_EQ(history[i].normal, expected[i][1]) << i;
    EXPECT_DOUBLE_EQ(history[i].tangential, expected[i][2]) << i;
  }
  EXPECT_TRUE(impacts.histories()[0].empty());
}

/// A step of more pieces than a history has points; the window begins within the impact.
TEST(LargestImpact, HasItsPeakWhereMoreOfTheStepFollowsThanItKeeps) {
  LargestImpact impacts(1, 0.0);
  transient::ContactState state;
  state.normal_force = 1.0;
  constexpr int count = 700;
  std::vector<transient::ForcePiece> pieces;
  for (int i = 0; i < count; ++i)
    pieces.push_back(
        {0,
         1.0 * i / count,
         (i + 1.0) / count,
         i == 2 ? contact::ParabolicForce{1.0, 1.0, 5.0} : contact::ParabolicForce{1.0, 1.0, 1.0},
         {}});
  transient::Record record;
  const int contact = 0;
  record.states = {&state, 1};
  record.active = {&contact, 1};
  record.pieces = pieces;
  record.step = h;
  record.time = 0.5 * h;
  impacts.step(record);
  const auto history = impacts.histories()[0];
  EXPECT_EQ(history.front().normal, 1.0); // it touched before
  EXPECT_EQ(largest(history), pieces[2].normal.largest());
  EXPECT_LE(history.size(), LargestImpact::points);
}

TEST(LargestImpact, HasAForceThatJumpsUp) {
  LargestImpact impacts(1, 0.0);
  transient::ContactState state;
  state.normal_force = 1.0;
  state.touches = 1;
  const std::vector<transient::ForcePiece> pieces{{0, 0.0, 0.5, {0.0, 4.0, 2.0}, {}},
                                                  {0, 0.5, 1.0, {5.0, 0.0, 2.5}, {}}};
  transient::Record record;
  const int contact = 0;
  record.states = {&state, 1};
  record.active = {&contact, 1};
  record.pieces = pieces;
  record.step = h;
  record.time = 0.5 * h;
  impacts.step(record);
  EXPECT_EQ(largest(impacts.histories()[0]), 5.0);
}

TEST(LargestImpact, IsThatOfTheWindowHoweverManyFollow) {
  LargestImpact impacts(1, 2.0 * h);
  HandMade run(impacts, 1, h);
  run.closed(2, 100.0); // before the window
  run.open(1);
  run.closed(1, 9.0);
  for (std::size_t i = 0; i < 2 * LargestImpact::points; ++i) {
    run.open(1);
    run.closed(1, 1.0);
  }
  const auto history = impacts.histories()[0];
  EXPECT_EQ(largest(history), 9.0);
  EXPECT_LE(history.size(), LargestImpact::points);
}

TEST(LargestImpact, OfALongContactHasBothSidesOfItsPeak) {
  LargestImpact impacts(1, 0.0);
  HandMade run(impacts, 1, h);
  constexpr int steps = 1000, peak = 600;
  for (int i = 0; i < steps; ++i) {
    run.contact(0).normal_force = i == peak ? 50.0 : 10.0;
    run.step();
  }
  const auto history = impacts.histories()[0];
  ASSERT_EQ(history.size(), LargestImpact::points);
  EXPECT_EQ(history[LargestImpact::points / 2 - 1].normal, 50.0);
}

} // namespace largest_impact_test
