// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/expected_time.hpp"
#include "scenes.hpp"
#include <gtest/gtest.h>

namespace fretwork::app::test::expected_time_test {
namespace {

using tests::Vec3;
constexpr double mass = 1.0;                          // kg
constexpr std::chrono::duration<double> budget{0.03}; // s, of a pilot run

/// A mass under a harmonic force between two planes, which it reaches where the gap is small.
transient::Scene between_planes(double gap, double duration) {
  transient::Scene scene = tests::mass_point(mass, Vec3::Constant(1e4), duration);
  scene.contacts = {
      tests::contact_of(mass, {contact::PlanePair{gap, contact::PlaneAxis::y}, {1e6}, {1e6, 0.0, 0.3, 0.3}})};
  scene.loads = {tests::force_on(mass, {0.0, 60.0, 20.0}, signals::Harmonic{1.0, 7.0})};
  return scene;
}

PilotTime pilot(const transient::Scene& scene) {
  return pilot_time(scene, transient::choose_step(scene, {}), budget);
}

} // namespace

TEST(PilotTime, IsALeastTimeWhereContactsAreOpen) {
  EXPECT_EQ(time_text(PilotTime{4.0}), "about 4 s");
  EXPECT_EQ(time_text(PilotTime{4.0, true}), "at least 4 s (contacts are still open in the first steps)");
}

TEST(PilotTime, GrowsWithTheDuration) {
  const PilotTime short_run = pilot(between_planes(1e-3, 0.1)), long_run = pilot(between_planes(1e-3, 1e6));
  EXPECT_LT(short_run.seconds, long_run.seconds);
  EXPECT_GT(long_run.seconds, 10.0 * budget.count());
  EXPECT_FALSE(long_run.contacts_open);
}

TEST(PilotTime, SaysWhereNoContactHasClosed) {
  EXPECT_TRUE(pilot(between_planes(1.0, 1e6)).contacts_open);
  transient::Scene free = between_planes(1.0, 1e6);
  free.contacts.clear();
  EXPECT_FALSE(pilot(free).contacts_open);
}

} // namespace fretwork::app::test::expected_time_test
