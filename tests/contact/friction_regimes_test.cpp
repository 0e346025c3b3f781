// SPDX-License-Identifier: GPL-3.0-or-later
// Passages between stick, slip and opening in the plane, where friction laws are most often wrong.
#include "friction_forms.hpp"
#include <gtest/gtest.h>

namespace friction_regimes_test {

using namespace fretwork;
using namespace fretwork::contact;
using namespace fretwork::tests;

namespace {

constexpr double bound_tolerance = 1e-12;
constexpr double normal = 10.0, h = 1e-4;

FrictionLaw law_of(FrictionMemoryKind kind, double damping = 50.0, double mu_static = 0.3) {
  return {1e6, damping, mu_static, 0.3, kind, {1.0, 1.0}};
}

/// A node driven slowly, so that dampers are of no weight.
struct Driven {
  FrictionLaw law;
  FrictionMemory memory{};
  double given = 0.0; ///< J, by whoever drives it

  bool move(Vec2 dx, double normal_force) {
    constexpr double slow = 1.0; // s
    const Friction f = evaluate(law, memory, normal_force, dx, (1.0 / slow) * dx);
    given -= dot(f.force, dx);
    memory = close_step(law, friction_table(law, slow), memory, f, dx).memory;
    return f.slides;
  }
};

} // namespace

TEST(FrictionRegimes2D, ASlowReversalInThePlaneReturnsToStick) {
  const double bound = 0.3 * normal, dx = 1e-8;
  for (const auto kind : kinds)
    for (const double turn : {95.0, 120.0, 150.0, 180.0}) {
      Driven node{law_of(kind)};
      for (int i = 0; i < 1000; ++i)
        node.move({dx, 0.0}, normal);
      EXPECT_TRUE(node.memory.sliding);
      const double angle = turn * std::numbers::pi / 180.0;
      int stuck = 0;
      while (stuck < 100000 && !node.move({dx * std::cos(angle), dx * std::sin(angle)}, normal))
        ++stuck;
      // |T - K_T s| is back at the bound after the chord of the circle of radius mu F_N / K_T
      EXPECT_NEAR(stuck * dx, -2.0 * std::cos(angle) * bound / node.law.stiffness, 2.0 * dx) << turn;
    }
}

TEST(FrictionRegimes2D, ATurnByLessThanARightAngleSlidesOn) {
  for (const auto kind : kinds) {
    Driven node{law_of(kind)};
    for (int i = 0; i < 1000; ++i)
      node.move({1e-8, 0.0}, normal);
    for (int i = 0; i < 4000; ++i) // the angle left falls by e every mu F_N/K_T = 3e-6 m
      EXPECT_TRUE(node.move({1e-8 * std::cos(1.4), 1e-8 * std::sin(1.4)}, normal));
    // and the force has turned against the new motion
    EXPECT_NEAR(std::atan2(-node.memory.spring.t, -node.memory.spring.x), 1.4, 1e-3);
  }
}

TEST(FrictionRegimes2D, StickBrokenByAFallingNormalForceSlipsAlongTheTrial) {
  const Vec2 spring{1.2, -1.6};
  for (const auto kind : kinds) {
    const FrictionLaw law = law_of(kind, 50.0, 0.5);
    const FrictionMemory memory{spring, false};
    EXPECT_FALSE(evaluate(law, memory, 4.1, {}, {}).slides);
    const Friction broken = evaluate(law, memory, 3.9, {}, {});
    EXPECT_TRUE(broken.slides);
    EXPECT_NEAR(broken.force.x, 0.3 * 3.9 * 0.6, bound_tolerance);
    EXPECT_NEAR(broken.force.t, 0.3 * 3.9 * -0.8, bound_tolerance);
    const Friction step =
        step_friction_plane(law, friction_table(law, h), memory, 3.9, {}, {1e-9, 0.0, 1e-9});
    EXPECT_TRUE(step.slides);
    EXPECT_NEAR(step.force.x, broken.force.x, bound_tolerance);
    EXPECT_NEAR(step.force.t, broken.force.t, bound_tolerance);
  }
}

TEST(FrictionRegimes2D, AClosedCycleFromAnEmptySpringCostsEnergy) {
  Uniform uniform(91);
  constexpr int points = 4000;
  for (int i = 0; i < 20; ++i) {
    // a closed path round and round, under a normal force that varies (return_map) or not (reference)
    const double a = uniform(1e-6, 2e-5), b = uniform(0.0, 2e-5), phase = uniform(0.0, 6.0),
                 swing = uniform(0.0, 1.0);
    for (const auto kind : kinds)
      for (const double damping : {0.0, 50.0}) {
        Driven node{law_of(kind, damping)};
        const auto at = [&](int k) {
          const double s = 2.0 * std::numbers::pi * k / points;
          return Vec2{a * (std::cos(s) - 1.0), b * (std::sin(2.0 * s + phase) - std::sin(phase))};
        };
        for (int k = 0; k < points; ++k) {
          const bool varies = kind == FrictionMemoryKind::return_map;
          node.move(at(k + 1) - at(k),
                    varies ? normal * (1.0 + swing * std::sin(12.6 * k / points)) : normal);
        }
        EXPECT_GT(node.given, 0.0);
      }
  }
}

TEST(FrictionRegimes2D, SpringOfTheReferenceIsSetForNothing) {
  // C_T v tips a node into slip before its spring is stretched: the letter of the law sets the spring to the
  // slip force all the same. The energy that appears is booked with the damper.
  const FrictionLaw law = law_of(FrictionMemoryKind::reference),
                    right = law_of(FrictionMemoryKind::return_map);
  const Vec2 v{0.1, 0.0}, dx = 1e-7 * v; // C_T v = 5 N > 3 N, K_T dx = 0.01 N
  const FrictionTable table = friction_table(law, 1e-7);
  const Friction f = evaluate(law, {}, normal, dx, v);
  const FrictionStep set = close_step(law, table, {}, f, dx);
  EXPECT_TRUE(f.slides);
  EXPECT_DOUBLE_EQ(set.damper_work, -0.5 * 9.0 / law.stiffness);
  EXPECT_LT(set.friction_work + set.damper_work, 0.0);
  EXPECT_GE(close_step(right, table, {}, evaluate(right, {}, normal, dx, v), dx).damper_work, 0.0);
}

TEST(FrictionRegimes2D, LineFormTendsToTheLawOfAnInstantAsTheStepGoesToZero) {
  constexpr double mobility = 4.0, order = 0.05; // 1/kg; of the ratio of errors, 1/2
  for (const auto kind : kinds)
    for (const double velocity : {0.01, 0.4}) { // stick, slip
      const FrictionLaw law = law_of(kind);
      const FrictionMemory memory{{0.0, 1.0}, false};
      const Friction instant = evaluate_line(law, memory, normal, 0.0, velocity);
      double last = 0.0;
      for (double step = 1e-6; step > 1e-9; step *= 0.5) {
        const Friction f = step_friction_line(law, friction_table(law, step), memory, normal, velocity,
                                              0.5 * step * mobility);
        EXPECT_EQ(f.slides, instant.slides);
        const double error = std::abs(f.force.t - instant.force.t);
        if (last > 0.0 && error > 0.0) {
          EXPECT_NEAR(error / last, 0.5, order);
        }
        last = error;
      }
      EXPECT_LE(last, 1e-4 * std::abs(instant.force.t));
    }
}

} // namespace friction_regimes_test
