// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_made.hpp"
#include "post/contact_statistics.hpp"
#include <gtest/gtest.h>

namespace contact_statistics_test {

using namespace fretwork;
using namespace fretwork::tests;
using post::ContactStatistics;
using post::ContactSummary;

namespace {

constexpr double h = 0.01;
constexpr double round_off = 1e-12;

} // namespace

TEST(ContactStatistics, CountMaximalIntervalsOfForceAsImpacts) {
  ContactStatistics statistics(centred(1), 0.0);
  HandMade run(statistics, 1, h);
  run.open(5);
  run.closed(3, 10.0, 0.2);
  run.open(1); // one open step parts two impacts
  run.closed(1, 30.0, 0.6);
  run.open(10);
  const ContactSummary s = statistics.summaries()[0];
  EXPECT_EQ(s.impacts, 2);
  EXPECT_NEAR(s.contact_time_ratio, 4.0 / 20.0, round_off);
  EXPECT_NEAR(s.impact_velocity_mean, 0.4, round_off);
  EXPECT_NEAR(s.impact_velocity_rms, std::sqrt(0.2), round_off); // of 0.2 and 0.6
  EXPECT_NEAR(s.impact_velocity_max, 0.6, round_off);
  EXPECT_NEAR(s.contact_duration_mean, 2.0 * h, round_off);
  EXPECT_NEAR(s.contact_duration_max, 3.0 * h, round_off);
}

TEST(ContactStatistics, OfAContactThatIsClosedFromTheStartHaveOneImpact) {
  ContactStatistics statistics(centred(1), 0.0);
  HandMade run(statistics, 1, h);
  run.closed(10, 5.0, 0.1);
  const ContactSummary s = statistics.summaries()[0];
  EXPECT_EQ(s.impacts, 1);
  EXPECT_NEAR(s.contact_time_ratio, 1.0, round_off);
  EXPECT_NEAR(s.contact_duration_max, 10.0 * h, round_off);
}

TEST(ContactStatistics, AverageTheNormalForceOverAllTimeAndInContact) {
  ContactStatistics statistics(centred(1), 0.0);
  HandMade run(statistics, 1, h);
  run.closed(2, 10.0);
  run.closed(2, 20.0);
  run.open(6);
  const ContactSummary s = statistics.summaries()[0];
  EXPECT_NEAR(s.normal_mean, 60.0 / 10.0, round_off);
  EXPECT_NEAR(s.normal_rms, std::sqrt(1000.0 / 10.0), round_off);
  EXPECT_EQ(s.normal_max, 20.0);
  EXPECT_NEAR(s.normal_in_contact_mean, 60.0 / 4.0, round_off);
  EXPECT_NEAR(s.normal_in_contact_rms, std::sqrt(1000.0 / 4.0), round_off);
}

TEST(ContactStatistics, OfTheWindowLeaveOutWhatIsBeforeIt) {
  ContactStatistics statistics(centred(1), 0.1); // the first ten steps are before it
  HandMade run(statistics, 1, h);
  run.closed(2, 500.0, 9.0);
  run.y(0) = 7.0;
  run.open(5);
  run.closed(6, 10.0,
             8.0); // starts before the window: no impact of it, but its time and force in the window count
  run.y(0) = 0.5;
  run.open(1);
  run.closed(2, 20.0, 0.3);
  run.open(4);
  const ContactSummary s = statistics.summaries()[0];
  EXPECT_EQ(s.impacts, 1);
  EXPECT_NEAR(s.contact_time_ratio, 5.0 / 10.0, round_off);
  EXPECT_NEAR(s.normal_mean, (3 * 10.0 + 2 * 20.0) / 10.0, round_off);
  EXPECT_EQ(s.normal_max, 20.0);
  EXPECT_NEAR(s.impact_velocity_max, 0.3, round_off);
  EXPECT_NEAR(s.contact_duration_mean, 2.0 * h, round_off);
  EXPECT_NEAR(s.contact_duration_max, 2.0 * h, round_off);
  EXPECT_NEAR(s.y.max, 7.0 + 6.5 / 8.0,
              round_off); // three of its steps are in the window: the crest of 7, 7 and 0.5
  EXPECT_NEAR(s.y.mean, (3 * 7.0 + 7 * 0.5) / 10.0, round_off);
}

TEST(ContactStatistics, OfAnEmptyWindowAreZero) {
  ContactStatistics statistics(centred(2), 100.0);
  HandMade run(statistics, 2, h);
  run.closed(5, 10.0, 0.1);
  for (const ContactSummary& s : statistics.summaries()) {
    EXPECT_EQ(s.impacts, 0);
    EXPECT_EQ(s.normal_max, 0.0);
    EXPECT_EQ(s.contact_time_ratio, 0.0);
  }
}

TEST(ContactStatistics, CountTheWorkRateOnlyWhileTheContactSlides) {
  ContactStatistics statistics(centred(1), 0.0);
  HandMade run(statistics, 1, h);
  for (const bool slides : {true, false}) {
    auto& state = run.contact(0);
    state.normal_force = 10.0;
    state.friction = {0.0, -3.0};
    state.displacement = {3e-4, 4e-4};
    state.slides = slides;
    state.slid = slides ? 5e-4 : 0.0;
    state.friction_work = slides ? 1e-3 : 0.0;
    run.step();
  }
  run.open(8);
  const ContactSummary s = statistics.summaries()[0];
  EXPECT_NEAR(s.work_rate, 10.0 * 5e-4 / (10 * h), round_off);
  EXPECT_NEAR(s.friction_power, 1e-3 / (10 * h), round_off);
  EXPECT_NEAR(s.tangential_rms, std::sqrt(2.0 * 9.0 / 10.0), round_off);
  EXPECT_NEAR(s.tangential_max, 3.0, round_off);
}

// A motion along y slides across it by round-off alone.
TEST(ContactStatistics, TakeSlidingOfRoundOffAsNone) {
  for (const double slid : {1e-20, 1e-6}) {
    ContactStatistics statistics(centred(1), 0.0);
    HandMade run(statistics, 1, h);
    for (int k = 0; k < 200; ++k) {
      auto& state = run.contact(0);
      run.y(0) = std::sin(0.3 * k);
      state.normal_force = 10.0;
      state.slides = k % 5 != 0;
      state.slid = state.slides ? slid : 0.0;
      state.friction_work = state.slid;
      run.step();
    }
    const ContactSummary s = statistics.summaries()[0];
    const post::StandardErrors sums = statistics.errors_of_sums();
    EXPECT_EQ(s.work_rate > 0.0, slid > 1e-9) << slid;
    EXPECT_EQ(s.friction_power > 0.0, slid > 1e-9) << slid;
    EXPECT_EQ(s.error.work_rate > 0.0, slid > 1e-9) << slid;
    EXPECT_EQ(sums.work_rate > 0.0, slid > 1e-9) << slid;
  }
}

// Work in bursts on one side, evenly on the other: each side has the error of its own batches.
TEST(ContactStatistics, HaveTheWorkRateOfEachSideWithItsError) {
  ContactStatistics statistics(centred(1), 0.0);
  HandMade run(statistics, 1, h);
  constexpr int steps = 640;
  for (int k = 0; k < steps; ++k) {
    auto& state = run.contact(0);
    state.normal_force = 10.0;
    state.slides = true;
    state.slid = k % 2 == 0 && k % 160 >= 80 ? 0.0 : 1e-4;
    state.axes = {k % 2 == 0 ? -1.0 : 1.0, 0.0}; // even steps: +y
    run.step();
  }
  const ContactSummary s = statistics.summaries()[0];
  const double half = 10.0 * 1e-4 / (2.0 * h);
  EXPECT_NEAR(s.sides[0].work_rate, 0.5 * half, round_off);
  EXPECT_NEAR(s.sides[2].work_rate, half, round_off);
  EXPECT_NEAR(s.sides[0].work_rate + s.sides[2].work_rate, s.work_rate, round_off);
  EXPECT_GT(s.sides[0].error, 0.1 * half);
  EXPECT_LT(s.sides[2].error, 0.01 * half);
  EXPECT_GT(s.sides[0].batches, 1.0);
  EXPECT_EQ(s.sides[1].work_rate, 0.0);
  EXPECT_TRUE(std::isnan(s.sides[1].error));
}

TEST(ContactStatistics, SumWhatTheStepsTell) {
  ContactStatistics statistics(centred(1), 0.0);
  HandMade run(statistics, 1, h);
  for (int k = 0; k < 2; ++k) { // closed for half of a step, sliding for a quarter
    auto& state = run.contact(0);
    state.normal_force = 10.0;
    run.in_full(0) = true;
    state.closed = 0.5;
    state.normal_square = 300.0;
    state.peak = 30.0;
    state.friction_square = 20.0;
    state.sliding = 0.25;
    state.wear_work = 2e-3;
    state.slid = 1e-3;
    state.touches = 1;
    state.approach = 0.2 + 0.2 * k;
    run.step();
  }
  run.open(8);
  const ContactSummary s = statistics.summaries()[0];
  EXPECT_EQ(s.impacts, 2);
  EXPECT_NEAR(s.contact_time_ratio, 0.1, round_off);
  EXPECT_NEAR(s.contact_duration_mean, 0.5 * h, round_off);
  EXPECT_NEAR(s.normal_rms, std::sqrt(600.0 / 10.0), round_off);
  EXPECT_NEAR(s.normal_in_contact_rms, std::sqrt(600.0 / 1.0), round_off);
  EXPECT_NEAR(s.normal_mean, 2.0, round_off);
  EXPECT_EQ(s.normal_max, 30.0);
  EXPECT_NEAR(s.work_rate, 4e-3 / (10 * h), round_off);
  EXPECT_NEAR(s.sliding_distance, 2e-3, round_off);
  EXPECT_NEAR(s.sticking_ratio, 0.5, round_off);
  EXPECT_NEAR(s.tangential_rms, std::sqrt(40.0 / 10.0), round_off);
  EXPECT_NEAR(s.impact_velocity_mean, 0.3, round_off);
  EXPECT_NEAR(s.impact_velocity_rms, std::sqrt(0.1), round_off); // of 0.2 and 0.4
}

TEST(ContactStatistics, DescribeTheMotionOverAllSteps) {
  ContactStatistics statistics(centred(1), 0.0);
  HandMade run(statistics, 1, h);
  for (const double y : {3.0, -1.0, 3.0, -1.0}) {
    run.y(0) = y;
    run.z(0) = 4.0;
    run.step();
  }
  const ContactSummary s = statistics.summaries()[0];
  EXPECT_NEAR(s.y.mean, 1.0, round_off);
  EXPECT_NEAR(s.y.std, 2.0, round_off);
  EXPECT_EQ(s.y.min, -1.0);
  EXPECT_EQ(s.y.max, 3.0);
  EXPECT_NEAR(s.z.mean, 4.0, round_off);
  EXPECT_EQ(s.z.std, 0.0);
  EXPECT_NEAR(s.radial_rms, std::sqrt((9.0 + 1.0) / 2.0 + 16.0), round_off);
  EXPECT_NEAR(s.radial_max, 5.0, round_off);
}

TEST(ContactStatistics, MeasureRadiiFromTheObstaclesCentre) {
  std::vector<transient::ContactPoint> contacts = centred(1);
  contacts[0].rest = {7.0, 3.0, -4.0}; // x_loc is along the tube
  ContactStatistics statistics(contacts, 0.0);
  HandMade run(statistics, 1, h);
  for (const double z : {4.0, -4.0}) { // the centre but for y, then twice as far as at rest
    run.y(0) = z > 0.0 ? -3.0 : 3.0;
    run.z(0) = z;
    run.step();
  }
  const ContactSummary s = statistics.summaries()[0];
  EXPECT_NEAR(s.radial_max, 10.0, round_off);
  EXPECT_NEAR(s.radial_rms, 10.0 / std::sqrt(2.0), round_off);
  EXPECT_EQ(s.y.max, 3.0) << "displacements are those from rest";
}

TEST(ContactStatistics, KnowTheLargestPenetration) {
  std::vector<transient::ContactPoint> contacts = centred(2);
  for (transient::ContactPoint& contact : contacts)
    contact.support.normal = {100.0};
  contacts[1].support.normal.damping = 1.0;
  contacts[1].rest.y() = 0.5;
  ContactStatistics statistics(contacts, h);
  HandMade run(statistics, 2, h);
  for (const double y : {0.9, 0.6, 0.7, 0.6}) { // the first is before the window
    run.contact(0).normal_force = run.contact(1).normal_force = 20.0 * y;
    run.y(1) = y;
    run.step();
  }
  run.y(1) = 0.8; // open, behind the damper
  run.step();
  EXPECT_NEAR(statistics.summaries()[1].penetration_max, 0.5 + 0.7 - 1.0, round_off);
  run.y(1) = 0.6;
  run.contact(1).normal_force = 12.0;
  run.contact(1).deepest = 0.23; // between positions
  run.step();
  const auto all = statistics.summaries();
  EXPECT_NEAR(all[0].penetration_max, 14.0 / 100.0, round_off) << "F_N = K_N p";
  EXPECT_NEAR(all[1].penetration_max, 0.23, round_off) << "the damper has a share of F_N";
}

TEST(ContactStatistics, KeepContactsApart) {
  ContactStatistics statistics(centred(3), 0.0);
  HandMade run(statistics, 3, h);
  for (int i = 0; i < 10; ++i) {
    if (i % 2 == 0)
      run.contact(1).normal_force = 1.0;
    if (i < 5)
      run.contact(2).normal_force = 2.0;
    run.step();
  }
  const auto all = statistics.summaries();
  EXPECT_EQ(all[0].impacts, 0);
  EXPECT_EQ(all[1].impacts, 5);
  EXPECT_EQ(all[2].impacts, 1);
  EXPECT_NEAR(all[1].normal_mean, 0.5, round_off);
  EXPECT_NEAR(all[2].normal_mean, 1.0, round_off);
}

TEST(ContactStatistics, AddUpImpulseSlidingAndLosses) {
  ContactStatistics statistics(centred(1), 2 * h); // two steps are before the window
  HandMade run(statistics, 1, h);
  for (int i = 0; i < 6; ++i) { // sticks for two steps of the window, slides for two
    auto& state = run.contact(0);
    state.normal_force = 10.0 + i;
    state.displacement = {3e-4, -4e-4};
    state.slides = i >= 4;
    state.slid = state.slides ? 5e-4 : i == 3 ? 1e-4 : 0.0; // in the fourth it comes to rest
    state.friction_work = state.slides ? 1e-3 : 0.0;
    state.damper_work = 5e-4;
    run.step();
  }
  run.open(4);
  const ContactSummary s = statistics.summaries()[0];
  EXPECT_NEAR(s.impulse, (12.0 + 13.0 + 14.0 + 15.0) * h, round_off);
  EXPECT_NEAR(s.sliding_distance, 2 * 5e-4 + 1e-4, round_off);
  EXPECT_NEAR(s.sticking_ratio, 0.5, round_off);
  EXPECT_NEAR(s.friction_work, 2e-3, round_off);
  EXPECT_NEAR(s.damping_work, 2e-3, round_off);
  EXPECT_NEAR(s.work_rate * 8 * h, (14.0 + 15.0) * 5e-4 + 13.0 * 1e-4, round_off); // the same path
}

TEST(ContactStatistics, AverageTheDeparturesOfTheWindowsImpacts) {
  ContactStatistics statistics(centred(1), 0.1);
  HandMade run(statistics, 1, h);
  run.open(8);
  run.closed(4, 10.0, 0.5); // starts before the window
  run.open(2, 9.0);
  run.closed(2, 10.0, 0.5);
  run.open(2, 0.2);
  run.closed(2, 10.0, 0.5);
  run.open(2, 0.4);
  run.closed(2, 10.0, 0.5); // has not ended
  const ContactSummary s = statistics.summaries()[0];
  EXPECT_EQ(s.impacts, 3);
  EXPECT_NEAR(s.departure_velocity_mean, 0.3, round_off);
  EXPECT_NEAR(s.departure_velocity_max, 0.4, round_off);
}

} // namespace contact_statistics_test
