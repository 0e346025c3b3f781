// SPDX-License-Identifier: GPL-3.0-or-later
// Impacts without rebound at long steps: the force jumps to C_N v at the touch and falls within a small part of the step.
#include "single_mass.hpp"
#include <gtest/gtest.h>

namespace fretwork::tests::damped_impacts_test {
namespace {

constexpr double contact_frequency = 100.0, speed = 1.0, gap = 2.3e-3; // rad/s, m/s, m
constexpr double longest = 1.25 / contact_frequency;                   // s

/// @param rate  r_n, 1/s
SingleMass damped(double rate) {
  SingleMass out;
  out.velocity = {0.0, 0.0, speed};
  out.gap = gap;
  out.normal = {contact_frequency * contact_frequency, rate};
  out.duration = 0.2;
  return out;
}

} // namespace

// To r_n h = 115 in up to 64 intervals a step. One interval of r_n dt = 2 had half the largest force.
TEST(DampedImpacts, HaveTheirLargestAndRmsForceAtTheLongestStep) {
  for (const double resolution : {2.0, 20.0, 50.0, 110.0})
    for (const int steps : {16, 17, 18, 19}) { // they touch elsewhere in one
      const SingleMass mass = damped(resolution / longest);
      const History run = simulate(scene_of(mass), splitting(mass.duration / steps), mass.duration);
      const post::ContactSummary& found = run.statistics.at(0);
      EXPECT_TRUE(run.choice.warnings.empty()) << resolution;
      const double damper = resolution / longest * speed;
      if (resolution > 10.0) { // the damper alone makes it
        EXPECT_NEAR(found.normal_max / damper, 1.0, 2e-3) << resolution << " " << steps;
      }
      const MassFigures exact = integrate(mass, 1e-7);
      EXPECT_NEAR(found.normal_rms / exact.normal_rms, 1.0, 0.01) << resolution << " " << steps;
      EXPECT_NEAR(found.normal_max / exact.normal_max, 1.0, 5e-3) << resolution << " " << steps;
    }
}

} // namespace fretwork::tests::damped_impacts_test
