// SPDX-License-Identifier: GPL-3.0-or-later
// Cases over workers: each once, no worker idle for long, failures kept apart.
#include "core/error.hpp"
#include "sweep/schedule.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <new>
#include <numeric>
#include <random>
#include <set>

namespace fretwork::sweep::schedule_test {
namespace {

TEST(Schedule, BlocksShrinkToSingleCases) {
  const auto ends = guided_blocks(1000, 2);
  EXPECT_EQ(ends.back(), 1000);
  EXPECT_EQ(ends.front(), 1000 / 16);
  std::int64_t before = 0, size = 1000;
  for (const std::int64_t end : ends) {
    EXPECT_GE(end - before, 1);
    EXPECT_LE(end - before, size);
    size = end - before;
    before = end;
  }
  EXPECT_EQ(size, 1);
  EXPECT_TRUE(guided_blocks(0, 3).empty());
}

/// Time of the last worker over the ideal, each block taken by the worker that is free first.
double slowdown(const std::vector<double>& costs, int workers) {
  const auto ends = guided_blocks(static_cast<std::int64_t>(costs.size()), workers);
  std::vector<double> busy(static_cast<std::size_t>(workers), 0.0);
  std::size_t next = 0;
  for (const std::int64_t end : ends) {
    const auto free = std::min_element(busy.begin(), busy.end());
    for (; next < static_cast<std::size_t>(end); ++next)
      *free += costs[next];
  }
  const double ideal = std::accumulate(costs.begin(), costs.end(), 0.0) / workers;
  return *std::max_element(busy.begin(), busy.end()) / ideal;
}

TEST(Schedule, NoWorkerIsIdleWhereCostsDifferByTwenty) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    std::mt19937 numbers(seed);
    std::uniform_real_distribution<double> uniform(1.0, 20.0);
    std::vector<double> costs(200);
    std::generate(costs.begin(), costs.end(), [&] { return uniform(numbers); });
    constexpr double two_ranks_are_worth = 1.9; // of the acceptance: 1.8
    EXPECT_LT(slowdown(costs, 2), 2.0 / two_ranks_are_worth) << seed;
    std::vector<double> ascending = costs;
    std::sort(ascending.begin(), ascending.end()); // the dear ones last
    EXPECT_LT(slowdown(ascending, 2), 2.0 / two_ranks_are_worth) << seed;
  }
  std::vector<double> many(10000, 1.0);
  for (std::size_t i = 0; i < many.size(); i += 7)
    many[i] = 20.0;
  constexpr double hundred_ranks = 1.1; // a case of 20 in the end over 371 of each
  EXPECT_LT(slowdown(many, 100), hundred_ranks);
  EXPECT_LT(guided_blocks(10000, 100).size(), 5000u); // takings of the counter
}

TEST(Schedule, EveryCaseIsDoneOnceByWhicheverWorker) {
  const std::vector<std::int64_t> numbers{3, 5, 8, 13, 21, 34, 55};
  std::int64_t counter = 0;
  std::vector<Row> rows;
  for (int worker = 0; worker < 2; ++worker) // the first one takes a part and stops, as one that is killed
    work(
        numbers, 2, [&] { return worker == 0 && counter == 3 ? 1000 : counter++; },
        [](std::int64_t number) {
          return Row{number, std::to_string(number)};
        },
        [&](const Row& row) { rows.push_back(row); });
  ASSERT_EQ(rows.size(), numbers.size());
  std::set<std::int64_t> seen;
  for (const Row& row : rows)
    seen.insert(row.number);
  EXPECT_EQ(seen, std::set<std::int64_t>(numbers.begin(), numbers.end()));
}

TEST(Schedule, WhatACaseThrowsIsItsOutcome) {
  const auto outcome_of = [](const auto& exception) {
    return evaluated(7, "seven", [&]() -> CaseResult { throw exception; });
  };
  const Row refused = outcome_of(core::Error("a gap below 0"));
  EXPECT_EQ(refused.outcome, Outcome::refused);
  EXPECT_EQ(refused.message, "a gap below 0");
  EXPECT_EQ(refused.number, 7);
  EXPECT_EQ(refused.identity, "seven");
  EXPECT_EQ(outcome_of(core::ComputationError("diverged")).outcome, Outcome::failed);
  EXPECT_EQ(outcome_of(std::bad_alloc()).outcome, Outcome::failed);
  EXPECT_EQ(outcome_of(std::logic_error("ours")).outcome, Outcome::defect);
  const Row done = evaluated(8, "eight", [] { return CaseResult{{1.0}, {"few modes", "a long step"}}; });
  EXPECT_EQ(done.outcome, Outcome::done);
  EXPECT_EQ(done.message, "few modes | a long step");
  // the override of the case is nothing that the user has typed
  EXPECT_EQ(
      outcome_of(core::Error("--set contacts.stop.gap=-1: contacts.stop.gap = -1: must not be negative"))
          .message,
      "contacts.stop.gap = -1: must not be negative");
  EXPECT_EQ(done.values, std::vector<double>{1.0});
}

} // namespace
} // namespace fretwork::sweep::schedule_test
