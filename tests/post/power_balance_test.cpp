// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_made.hpp"
#include "post/power_balance.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace power_balance_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

constexpr double round_off = 1e-12;

/// Each term grows by its own power; 2 J are stored at the start.
void run_steps(HandMade& run, int steps, double step) {
  transient::Energy& e = run.energy();
  e.initial = 2.0;
  if (e.stored == 0.0)
    e.stored = e.initial;
  for (int i = 0; i < steps; ++i) {
    e.load_work += 1.0 * step;
    e.fluid_work += 7.0 * step;
    e.modal_damping += 2.0 * step;
    e.contact_damping += 3.0 * step;
    e.friction += 0.5 * step;
    e.stored += 2.5 * step;
    run.step();
  }
}

void expect_powers(const post::PowerBalance& p) {
  EXPECT_NEAR(p.loads.mean, 1.0, round_off);
  EXPECT_NEAR(p.fluid.mean, 7.0, round_off);
  EXPECT_NEAR(p.modal_damping.mean, 2.0, round_off);
  EXPECT_NEAR(p.contact_damping.mean, 3.0, round_off);
  EXPECT_NEAR(p.friction.mean, 0.5, round_off);
  EXPECT_NEAR(p.stored.mean, 2.5, round_off);
  EXPECT_NEAR(p.fluid.error, 0.0, round_off);
}

} // namespace

TEST(PowerStatistics, OfARunThatTheyWatchFromItsBeginning) {
  post::PowerStatistics powers(0.0);
  HandMade run(powers, 0, 0.1);
  run_steps(run, 40, 0.1);
  expect_powers(powers.balance());
}

/// The step that ends in the window but whose middle is before it is not part of it.
TEST(PowerStatistics, BeginWhereTheLastRecordBeforeTheWindowEnds) {
  post::PowerStatistics powers(1.0);
  HandMade run(powers, 0, 0.1);
  run.energy().fluid_work = 100.0; // before the window
  run_steps(run, 5, 0.1);
  run.energy().friction += 1000.0;
  run_steps(run, 55, 0.1);
  expect_powers(powers.balance());
}

TEST(PowerStatistics, OfNoRecordAreZero) {
  EXPECT_EQ(post::PowerStatistics(1.0).balance().fluid.mean, 0.0);
  post::PowerStatistics before(10.0);
  HandMade run(before, 0, 0.1);
  run_steps(run, 5, 0.1);
  EXPECT_EQ(before.balance().fluid.mean, 0.0);
}

/// A power that changes its sign from batch to batch: the mean and its error, s/sqrt(n).
TEST(PowerStatistics, HaveStandardErrorsByBatches) {
  post::PowerStatistics powers(0.0);
  HandMade run(powers, 0, 0.25);
  const double signs[] = {1, 1, -1, 1, -1, -1, 1, -1, 1, -1, -1, 1, 1, -1, 1, -1}; // neighbours hardly alike
  for (const double sign : signs) {
    run.energy().fluid_work += 0.25 * (3.0 + sign);
    run.step();
  }
  const post::MeanPower fluid = powers.balance().fluid;
  EXPECT_NEAR(fluid.mean, 3.0, round_off);
  EXPECT_GT(fluid.error, 0.5 / std::sqrt(16.0));
  EXPECT_LT(fluid.error, 1.5 / std::sqrt(16.0));
}

TEST(PowerStatistics, GoOnFromASavedState) {
  post::PowerStatistics whole(1.0), first(1.0), second(1.0);
  HandMade run_whole(whole, 0, 0.1), run_first(first, 0, 0.1);
  run_steps(run_whole, 30, 0.1);
  run_steps(run_first, 17, 0.1);
  core::StateArchive saved;
  first.visit(saved);
  core::StateArchive restored(std::move(saved).bytes());
  second.visit(restored);
  // records of the second part continue those of the first
  transient::Record record;
  record.step = 0.1;
  record.energy = run_first.energy();
  for (int i = 17; i < 30; ++i) {
    record.time = 0.1 * i + 0.05;
    transient::Energy& e = record.energy;
    e.load_work += 0.1;
    e.fluid_work += 0.7;
    e.modal_damping += 0.2;
    e.contact_damping += 0.3;
    e.friction += 0.05;
    e.stored += 0.25;
    second.step(record);
  }
  expect_powers(second.balance());
  EXPECT_NEAR(second.balance().fluid.mean, whole.balance().fluid.mean, round_off);
}

} // namespace power_balance_test
