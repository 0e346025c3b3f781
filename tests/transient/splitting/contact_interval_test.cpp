// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_interval.hpp"
#include <gtest/gtest.h>

namespace contact_interval_test {

using namespace fretwork;
using namespace fretwork::transient;

namespace {

constexpr double usual = 1e-4; // s
constexpr double tolerance = 0.01;

Mobility isotropic(double w) {
  Mobility out;
  for (int i = 0; i < 3; ++i)
    out.add(i, i, w);
  return out;
}

} // namespace

// The gap that the laws follow strays from that of the position as the normal turns. A damper that took the difference, over an interval of 1e-4 of the
// usual length, for a speed would give forces a hundred times too high.
TEST(ContactIntervals, TakeNoDriftOfTheGapForASpeedInShortIntervals) {
  constexpr double stiffness = 1e6, damping = 500.0, speed = 0.1, penetration = 1e-5, drift = 1e-7;
  const contact::Support support{contact::Circle{1e-3}, {stiffness, damping}, {}};
  const ContactIntervals intervals(support, {}, isotropic(1.0), false, usual, tolerance);
  ContactPath path;
  path.u = {1e-3 + penetration, 0.0, 0.0};
  path.v = {speed, 0.0, 0.0};
  path.at = intervals.locate(path.u);
  path.at.gap += drift;
  ContactPast past;
  past.closed = true;
  past.axes = path.at.axes();
  IntervalForces p;
  (void)intervals.find_forces(path, past, intervals.table(1e-4 * usual), false, p);
  const double expected = stiffness * penetration + damping * speed;
  EXPECT_NEAR(p.normal.force, expected, 0.02 * expected); // the spring is compressed by the drift less
}

TEST(ContactIntervals, FollowTheLawOfTheGapOverUsualIntervals) {
  constexpr double stiffness = 1e6, penetration = 1e-5;
  const contact::Support support{contact::Circle{1e-3}, {stiffness}, {}};
  const ContactIntervals intervals(support, {}, isotropic(1e-6), false, usual, tolerance);
  ContactPath path;
  path.u = {0.0, 1e-3 + penetration, 0.0};
  path.at = intervals.locate(path.u);
  ContactPast past;
  past.closed = true;
  past.axes = path.at.axes();
  IntervalForces p;
  (void)intervals.find_forces(path, past, intervals.usual(), false, p);
  EXPECT_NEAR(p.force.z(), -stiffness * penetration, 1e-6 * stiffness * penetration); // towards the axis
  EXPECT_NEAR(p.force.y(), 0.0, 1e-9);
}

} // namespace contact_interval_test
