// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/profile.hpp"
#include "core/error.hpp"
#include "hand_made.hpp"
#include "post/contact_statistics.hpp"
#include "post/force_speed_classes.hpp"
#include "post/sector_work.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace sector_work_test {

using namespace fretwork;
using fretwork::tests::HandMade;

namespace {

using std::numbers::pi;

constexpr double step = 1e-3;       // s
constexpr double round_off = 1e-12; ///< of sums of some thousand terms

/// Presses with 10 N on the wall at an angle and slides by 1 um in the step.
void slide(transient::ContactState& state, double angle, double path = 1e-6) {
  state.normal_force = 10.0;
  state.axes.ny = -std::cos(angle);
  state.axes.nz = -std::sin(angle);
  state.slid = path;
  state.slides = true;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

template <class T> std::string saved(T& observer) {
  core::StateArchive archive;
  archive(observer);
  return std::move(archive).bytes();
}

} // namespace

TEST(SectorStatistics, GiveTheWorkRateOfEachContactBySector) {
  post::SectorStatistics sectors({4, 36}, 0.0);
  HandMade feed(sectors, 2, step);
  slide(feed.contact(0), 0.25 * pi); // the third of four
  feed.step();
  slide(feed.contact(0), -0.25 * pi);
  slide(feed.contact(1), 0.01);
  feed.step();
  const auto rates = sectors.rates();
  const double rate = 10.0 * 1e-6 / (2.0 * step);
  ASSERT_EQ(rates[0].size(), 4u);
  EXPECT_NEAR(rates[0][2], rate, round_off);
  EXPECT_NEAR(rates[0][1], rate, round_off);
  EXPECT_EQ(rates[0][0] + rates[0][3], 0.0);
  ASSERT_EQ(rates[1].size(), 36u);
  EXPECT_NEAR(rates[1][18], rate, round_off);
}

// A hole of three facets has three normals; work at places along one of them is that of their angles. A round hole has its normals.
TEST(SectorStatistics, GoByThePlaceInAHoleThatHasOpenedByAngle) {
  auto contacts = fretwork::tests::centred(2);
  const std::vector<contact::PolarPoint> corners = {{0.0, 1.0}, {2.0 * pi / 3.0, 1.0}, {4.0 * pi / 3.0, 1.0}};
  contacts[0].support.obstacle = contact::Profile(corners);
  contacts[0].rest = {0.0, 0.1, 0.0};
  post::SectorStatistics by_place({36, 36}, 0.0, contacts), by_normal({36, 36}, 0.0);
  for (const double angle :
       {0.35, 1.75}) { // of the facet between the first two corners, whose normal points to -pi/3
    for (post::SectorStatistics* sectors : {&by_place, &by_normal}) {
      HandMade feed(*sectors, 2, step);
      for (const std::size_t c : {0u, 1u})
        slide(feed.contact(c), pi / 3.0 + 0.01);
      feed.y(0) = 0.5 * std::cos(angle) - contacts[0].rest.y();
      feed.z(0) = 0.5 * std::sin(angle);
      feed.y(1) = feed.z(1) = -0.5;
      feed.step();
    }
  }
  const wear::SectorWork sectors(36);
  const auto at = [&](double angle) {
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < sectors.size(); ++k)
      if (std::abs(sectors.middle(k) - angle) < std::abs(sectors.middle(nearest) - angle))
        nearest = k;
    return nearest;
  };
  const double rate = 10.0 * 1e-6 / step / 2.0;
  for (const double angle : {0.35, 1.75}) {
    EXPECT_NEAR(by_place.rates()[0][at(angle)], rate, round_off);
    EXPECT_EQ(by_normal.rates()[0][at(angle)], 0.0);
  }
  EXPECT_NEAR(by_normal.rates()[0][at(pi / 3.0 + 0.01)], 2.0 * rate, round_off);
  EXPECT_EQ(by_place.rates()[1], by_normal.rates()[1]);
}

TEST(SectorStatistics, SumToTheWorkRateWhateverTheSteps) {
  post::SectorStatistics sectors({36}, 2.5 * step);
  post::ContactStatistics statistics(tests::centred(1), 2.5 * step);
  for (transient::Observer* observer :
       {static_cast<transient::Observer*>(&sectors), static_cast<transient::Observer*>(&statistics)}) {
    HandMade feed(*observer, 1, step);
    for (int k = 0; k < 3000; ++k) {
      feed.step_length(step * (1.0 + 0.5 * (k % 3)));
      if (k % 5 != 0)
        slide(feed.contact(0), 0.37 * k, 1e-6 * (1 + k % 7));
      feed.step();
    }
  }
  const double work_rate = statistics.summaries()[0].work_rate;
  ASSERT_GT(work_rate, 0.0);
  EXPECT_NEAR(sum(sectors.rates()[0]) / work_rate, 1.0, round_off);
}

TEST(SectorStatistics, CountOnlyTheWindowAndWhatSlides) {
  post::SectorStatistics sectors({4}, 1.1 * step);
  HandMade feed(sectors, 1, step);
  slide(feed.contact(0), 0.1);
  feed.step(); // before the window
  feed.contact(0).normal_force = 10.0;
  feed.step(); // sticks
  slide(feed.contact(0), 0.1);
  feed.step();
  feed.open(1);
  EXPECT_NEAR(sum(sectors.rates()[0]), 1e-5 / (3.0 * step), round_off);
}

TEST(SectorStatistics, LeaveOutContactsThatAreNotWatched) {
  post::SectorStatistics sectors({0, 4}, 0.0);
  EXPECT_EQ(sectors.rates()[1], std::vector<double>(4, 0.0)); // before the first step
  HandMade feed(sectors, 2, step);
  slide(feed.contact(0), 0.1);
  slide(feed.contact(1), 0.1);
  feed.step();
  EXPECT_TRUE(sectors.rates()[0].empty());
  EXPECT_GT(sum(sectors.rates()[1]), 0.0);
}

TEST(SectorStatistics, GoOnFromWhatTheyHaveSaved) {
  post::SectorStatistics whole({5, 0, 7}, 0.0), first({5, 0, 7}, 0.0), second({5, 0, 7}, 0.0);
  const auto feed_from = [](transient::Observer& observer, int from, int to) {
    HandMade feed(observer, 3, step);
    for (int k = from; k < to; ++k) {
      slide(feed.contact(0), 0.7 * k);
      slide(feed.contact(2), -0.3 * k);
      feed.step();
    }
  };
  feed_from(whole, 0, 40);
  feed_from(first, 0, 17);
  core::StateArchive restored(saved(first));
  restored(second);
  restored.end();
  feed_from(second, 17, 40);
  EXPECT_EQ(second.rates(), whole.rates());
  post::SectorStatistics other({5}, 0.0);
  core::StateArchive unfit(saved(first));
  EXPECT_THROW(
      {
        unfit(other);
        unfit.end();
      },
      core::StateMismatch);
}

TEST(SectorStatistics, RefuseANumberOutOfRange) {
  EXPECT_THROW(post::SectorStatistics({-1}, 0.0), core::Error);
  EXPECT_THROW(post::SectorStatistics({3601}, 0.0), core::Error);
}

TEST(ForceSpeedClasses, CountTheTimeInContactByForceAndSpeed) {
  post::ForceSpeedClasses classes({std::nullopt, wear::KwuMaxima{50.0, 0.05}}, 0.0);
  HandMade feed(classes, 2, step);
  slide(feed.contact(0), 0.0);
  slide(feed.contact(1), 0.0, 35e-6); // 10 N, 0.035 m/s: classes 1 and 4
  feed.step();
  feed.contact(1).normal_force = 45.0; // sticks: classes 5 and 1
  feed.step();
  feed.open(3);
  ASSERT_EQ(classes.classes().size(), 1u);
  EXPECT_NEAR(classes.classes()[0].share(3, 0), 0.5, round_off);
  EXPECT_NEAR(classes.classes()[0].share(0, 4), 0.5, round_off);
  post::ForceSpeedClasses other({std::nullopt, wear::KwuMaxima{50.0, 0.05}}, 0.0);
  core::StateArchive restored(saved(classes));
  restored(other);
  restored.end();
  EXPECT_EQ(other.classes()[0].share(0, 4), classes.classes()[0].share(0, 4));
}

TEST(ForceSpeedClasses, TakeForceAndSpeedWhileTheContactIsClosed) {
  post::ForceSpeedClasses classes({wear::KwuMaxima{50.0, 0.05}}, 0.0);
  HandMade feed(classes, 1, step);
  feed.in_full(0) = true;
  slide(feed.contact(0), 0.0, 4.5e-6); // mean 10 N over a step of which a quarter is closed: 40 N, 0.018 m/s
  feed.contact(0).act_for(0.25, true);
  feed.step();
  EXPECT_EQ(classes.classes()[0].share(1, 3), 1.0);
}

TEST(KwuClasses, OfSeveralPointsAreCountedTogether) {
  wear::KwuClasses one(50.0, 0.05), two(50.0, 0.05);
  one.add(45.0, 0.005, 3.0);
  two.add(5.0, 0.045, 1.0);
  two.add(60.0, 0.045, 1.0); // above the maximum
  one.add(two);
  EXPECT_NEAR(one.share(0, 4), 0.6, round_off);
  EXPECT_NEAR(one.share(4, 0), 0.2, round_off);
  EXPECT_NEAR(one.share_above(), 0.2, round_off);
}

} // namespace sector_work_test
