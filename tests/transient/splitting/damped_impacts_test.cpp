// SPDX-License-Identifier: GPL-3.0-or-later
// Impacts without rebound at long steps: the force jumps to C_N v at the touch and falls within a small part of the step.
#include "single_mass.hpp"
#include "transient/scene/scheme_limits.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace fretwork::tests::damped_impacts_test {
namespace {

constexpr double contact_frequency = 100.0, speed = 1.0, gap = 2.3e-3; // rad/s, m/s, m
constexpr transient::SchemeLimits limits = transient::limits_of(transient::SchemeKind::splitting);
constexpr double longest = limits.contact.largest / contact_frequency;            // s
constexpr double most_resolved = limits.intervals * limits.normal_damper.largest; // r_n h

/// @param rate  r_n, 1/s   @param frequency  w_c, rad/s
SingleMass damped(double rate, double frequency = contact_frequency) {
  SingleMass out;
  out.velocity = {0.0, 0.0, speed};
  out.gap = gap;
  out.normal = {frequency * frequency, rate};
  out.duration = 0.2;
  return out;
}

} // namespace

// To r_n h = 115 in up to 64 intervals a step. One interval of r_n dt = 2 had half the largest force.
TEST(DampedImpacts, HaveTheirLargestAndRmsForceAtTheLongestStep) {
  for (const double resolution : {2.0, 20.0, 50.0, most_resolved})
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

// The shortest step that a damper asks for, of a contact that the spring hardly moves back.
TEST(DampedImpacts, HaveTheirLargestAndRmsForceWhereTheDamperLimitsTheStep) {
  for (const int steps : {16, 17, 18, 19}) {
    SingleMass mass = damped(0.0);
    const double step = mass.duration / steps;
    mass = damped(most_resolved / step, transient::finest_for_normal_dampers / step);
    const History run = simulate(scene_of(mass), splitting(step), mass.duration);
    EXPECT_TRUE(run.choice.warnings.empty());
    EXPECT_EQ(simulate(scene_of(mass), splitting(1.03 * step), mass.duration).choice.warnings.size(), 1u);
    const MassFigures exact = integrate(mass, 1e-7);
    EXPECT_NEAR(run.statistics.at(0).normal_rms / exact.normal_rms, 1.0, 0.012)
        << steps; // parabolas for e^-1.8
    EXPECT_NEAR(run.statistics.at(0).normal_max / exact.normal_max, 1.0, 5e-3) << steps;
  }
}

// Steps of w_c h = 3 have a position or two in an impact, the largest of which is down to a third of the penetration.
TEST(DampedImpacts, HaveTheirLargestPenetrationBetweenPositions) {
  for (const double ratio : {0.02, 0.1, 0.3})
    for (const int parts : {1, 2, 3, 4}) { // they touch elsewhere in a step
      SingleMass mass = damped(2.0 * ratio * contact_frequency);
      mass.gap = gap + 0.25 * parts * longest * speed;
      const History run = simulate(scene_of(mass), splitting(longest), mass.duration);
      const double exact =
          speed / contact_frequency * std::exp(-ratio / std::sqrt(1.0 - ratio * ratio) * std::acos(ratio));
      EXPECT_NEAR(run.statistics.at(0).penetration_max / exact, 1.0, 0.01) << ratio << " " << parts;
    }
}

// Mean forces over such steps were up to 60 % too low.
TEST(LongSteps, HaveTheLargestFrictionWithinThem) {
  for (const double along : {0.02, 0.1, 0.5, 3.0}) // m/s: sticks, partly, slides
    for (const double damping : {0.0, 5.0})
      for (const int place : {1, 2, 3, 4}) {
        SingleMass mass = damped(0.0);
        mass.velocity.x() = along;
        mass.gap = gap + 0.25 * place * longest * speed;
        mass.mu = 0.3;
        mass.tangential_stiffness = 0.5 * contact_frequency * contact_frequency;
        mass.tangential_damping = damping;
        const double found =
            simulate(scene_of(mass), splitting(longest), mass.duration).statistics.at(0).tangential_max;
        EXPECT_NEAR(found / integrate(mass, 1e-6).tangential_max, 1.0, 0.02)
            << along << " " << damping << " " << place;
      }
}

} // namespace fretwork::tests::damped_impacts_test
