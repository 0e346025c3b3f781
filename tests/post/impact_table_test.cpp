// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_made.hpp"
#include "post/impact_table.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace impact_table_test {

using namespace fretwork;
using namespace fretwork::tests;
using post::ContactImpacts;
using post::Impact;
using post::ImpactTable;

namespace {

constexpr double h = 0.01;
constexpr double round_off = 1e-12;
constexpr std::size_t plenty = 100;

std::vector<Impact> rows(ImpactTable&& table) { return std::move(table).impacts()[0].rows; }

} // namespace

TEST(ImpactTable, GivesEachImpactARow) {
  ImpactTable table(1, 0.0, 0.0, plenty);
  HandMade run(table, 1, h);
  run.open(5);
  run.closed(2, 10.0, 0.2);
  run.closed(1, 40.0, 99.0);
  run.open(1, 0.15); // one open step parts two impacts
  run.closed(1, 30.0, 0.6);
  run.open(10, 0.5);
  const auto all = rows(std::move(table));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_NEAR(all[0].start, 5 * h, round_off);
  EXPECT_NEAR(all[0].duration, 3 * h, round_off);
  EXPECT_EQ(all[0].peak, 40.0);
  EXPECT_NEAR(all[0].impulse, 60.0 * h, round_off);
  EXPECT_EQ(all[0].velocity_before, 0.2);
  EXPECT_EQ(all[0].velocity_after, 0.15);
  EXPECT_EQ(all[0].rebounds, 0);
  EXPECT_NEAR(all[1].start, 9 * h, round_off);
  EXPECT_NEAR(all[1].duration, h, round_off);
  EXPECT_EQ(all[1].peak, 30.0);
  EXPECT_EQ(all[1].velocity_before, 0.6);
  EXPECT_EQ(all[1].velocity_after, 0.5);
}

TEST(ImpactTable, JoinsWhatShortOpeningsPart) {
  constexpr double rest = 3.5 * h; // three open steps are a rebound, four are a rest
  ImpactTable table(1, 0.0, rest, plenty);
  HandMade run(table, 1, h);
  run.open(2);
  run.closed(2, 10.0, 0.9);
  run.open(3, 0.8);
  run.closed(1, 50.0, 0.7);
  run.open(1, 0.3);
  run.closed(2, 20.0, 0.2);
  run.open(4, 0.1);
  run.closed(1, 5.0, 0.05);
  run.open(6, 0.04);
  const auto all = rows(std::move(table));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].rebounds, 2);
  EXPECT_NEAR(all[0].start, 2 * h, round_off);
  EXPECT_NEAR(all[0].duration, 9 * h, round_off); // the openings included
  EXPECT_EQ(all[0].peak, 50.0);
  EXPECT_NEAR(all[0].impulse, (20.0 + 50.0 + 40.0) * h, round_off);
  EXPECT_EQ(all[0].velocity_before, 0.9);
  EXPECT_EQ(all[0].velocity_after, 0.1);
  EXPECT_EQ(all[1].rebounds, 0);
  EXPECT_NEAR(all[1].start, 15 * h, round_off);
  EXPECT_EQ(all[1].velocity_after, 0.04);
}

TEST(ImpactTable, AddsUpWhatDampersAndFrictionTake) {
  ImpactTable table(1, 0.0, 0.0, plenty);
  HandMade run(table, 1, h);
  for (const double work : {1.0, 2.0, 4.0}) {
    run.contact(0).normal_force = 1.0;
    run.contact(0).damper_work = work;
    run.contact(0).friction_work = 10.0 * work;
    run.step();
  }
  run.open(3);
  EXPECT_NEAR(rows(std::move(table)).at(0).energy_lost, 77.0, round_off);
}

TEST(ImpactTable, LeavesOutTheImpactUnderWayWhenTheWindowStarts) {
  ImpactTable table(1, 0.1, 2.5 * h, plenty); // ten steps are before the window
  HandMade run(table, 1, h);
  run.closed(2, 500.0, 9.0);
  run.open(6);
  run.closed(4, 300.0, 8.0); // two steps of it are in the window
  run.open(2);
  run.closed(1, 200.0, 7.0); // its rebound
  run.open(3);
  run.closed(2, 20.0, 0.3);
  run.open(3, 0.2);
  const auto all = rows(std::move(table));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].velocity_before, 0.3);
  EXPECT_EQ(all[0].peak, 20.0);
}

TEST(ImpactTable, KeepsTheFirstImpactsAndCountsTheOthers) {
  ImpactTable table(2, 0.0, 0.0, 3);
  HandMade run(table, 2, h);
  for (int i = 0; i < 10; ++i) {
    run.closed(1, 1.0 + i, 0.1);
    run.open(1);
  }
  const auto all = std::move(table).impacts();
  ASSERT_EQ(all[0].rows.size(), 3u);
  EXPECT_EQ(all[0].rows[2].peak, 3.0);
  EXPECT_EQ(all[0].left_out, 7);
  EXPECT_TRUE(all[1].rows.empty());
  EXPECT_EQ(all[1].left_out, 0);
}

TEST(ImpactTable, HasARowForAnImpactThatTheEndOfTheRunCuts) {
  ImpactTable table(1, 0.0, 0.0, plenty);
  HandMade run(table, 1, h);
  run.open(4);
  run.closed(3, 10.0, 0.2);
  const auto all = rows(std::move(table));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all[0].duration, 3 * h, round_off);
  EXPECT_TRUE(std::isnan(all[0].velocity_after));
}

TEST(ImpactTable, KnowsNoSpeedAfterWhereARunEndsInARebound) {
  ImpactTable table(1, 0.0, 5 * h, plenty);
  HandMade run(table, 1, h);
  run.closed(1, 10.0, 0.2);
  run.open(1, 0.1);
  run.closed(1, 10.0, 0.1);
  const auto all = rows(std::move(table));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].rebounds, 1);
  EXPECT_TRUE(std::isnan(all[0].velocity_after));
}

TEST(ImpactTable, KeepsContactsApart) {
  ImpactTable table(3, 0.0, 0.0, plenty);
  HandMade run(table, 3, h);
  for (int i = 0; i < 10; ++i) {
    if (i % 2 == 0)
      run.contact(1).normal_force = 1.0;
    if (i < 5)
      run.contact(2).normal_force = 2.0;
    run.step();
  }
  const auto all = std::move(table).impacts();
  EXPECT_TRUE(all[0].rows.empty());
  EXPECT_EQ(all[1].rows.size(), 5u);
  ASSERT_EQ(all[2].rows.size(), 1u);
  EXPECT_NEAR(all[2].rows[0].impulse, 10.0 * h, round_off);
}

} // namespace impact_table_test
