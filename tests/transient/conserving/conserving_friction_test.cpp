// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of a step that keeps the energy: its bound, its direction, its derivatives.
#include "transient/conserving/conserving_friction.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace conserving_friction_test {

using namespace fretwork;
using namespace fretwork::transient;
using contact::Vec2;

namespace {

constexpr double h = 1e-3, difference = 1e-6; ///< s; of the arguments, relative to their size
constexpr double of_differences = 1e-6;       ///< relative: difference^2 and round-off/difference
constexpr double round_off = 1e-12;
const contact::FrictionLaw law{1e4, 5.0, 0.3, 0.3};
const contact::FrictionLaw along_t{1e4, 5.0, 0.3, 0.3, contact::FrictionMemoryKind::return_map, {0.0, 1.0}};

/// Derivatives of `friction`(dx, normal, force) by central differences.
template <class F> void expect_derivatives(const F& friction, Vec2 dx, double normal, Vec2 force) {
  const StepFriction at = friction(dx, normal, force);
  const auto expect = [](Vec2 by, const StepFriction& after, const StepFriction& before, double step,
                         double size) {
    EXPECT_NEAR(by.x, (after.force.x - before.force.x) / (2.0 * step), of_differences * size);
    EXPECT_NEAR(by.t, (after.force.t - before.force.t) / (2.0 * step), of_differences * size);
  };
  const double small = difference * contact::norm(dx), little = difference * normal,
               stiffness = law.stiffness + law.damping / h;
  for (const Vec2 e : {Vec2{1.0, 0.0}, Vec2{0.0, 1.0}}) {
    const auto column = [e](const contact::Sym2& m) {
      return Vec2{m.xx * e.x + m.xt * e.t, m.xt * e.x + m.tt * e.t};
    };
    expect(column(at.by_displacement), friction(dx + small * e, normal, force),
           friction(dx - small * e, normal, force), small, stiffness);
    expect(column(at.by_force), friction(dx, normal, force + little * e),
           friction(dx, normal, force - little * e), little, 1.0);
  }
  expect(at.by_normal, friction(dx, normal + little, force), friction(dx, normal - little, force), little,
         1.0);
}

} // namespace

TEST(ConservingFriction, GoesAlongTheTrialWithinItsBound) {
  for (const auto& l : {law, along_t})
    for (const double normal : {1.0, 100.0}) { // slips, sticks
      const Vec2 spring{0.4 * l.along.x, -0.3};
      const auto friction = [&](Vec2 dx, double n, Vec2) { return along_trial(l, spring, 0.3, n, dx, h); };
      const Vec2 dx{2e-4, 1e-4};
      const StepFriction found = friction(dx, normal, {});
      EXPECT_EQ(found.slides, normal < 10.0);
      const Vec2 trial{l.along.x * (spring.x - (0.5 * l.stiffness + l.damping / h) * dx.x),
                       spring.t - (0.5 * l.stiffness + l.damping / h) * dx.t};
      const double size = std::min(contact::norm(trial), 0.3 * normal);
      EXPECT_LT(contact::norm(found.force - (size / contact::norm(trial)) * trial), round_off * size);
      expect_derivatives(friction, dx, normal, {});
    }
}

TEST(ConservingFriction, OpposesTheMotionOrStopsIt) {
  constexpr double rho = 2e3;
  for (const auto& l : {law, along_t})
    for (const double normal : {1.0, 100.0}) {
      const auto friction = [&](Vec2 dx, double n, Vec2 force) { return opposing(l, rho, n, dx, force); };
      const Vec2 dx{2e-4, 1e-4};
      EXPECT_LE(contact::norm(friction(dx, normal, {0.1, -0.5}).force), 0.3 * normal * (1.0 + round_off));
      expect_derivatives(friction, dx, normal, {0.1, -0.5});
      // what it solves: opposite to dx at the bound, or any force within it where nothing moves
      const Vec2 moved{l.along.x * dx.x, dx.t}, bound = (-0.3 * normal / contact::norm(moved)) * moved;
      EXPECT_LT(contact::norm(friction(dx, normal, bound).force - bound), round_off * normal);
      const Vec2 within{l.along.x * 0.1 * normal, 0.1 * normal};
      EXPECT_LT(contact::norm(friction({}, normal, within).force - within), round_off * normal);
    }
}

TEST(ConservingFriction, ActsForTheShareOfTheStepInWhichTheContactIsClosed) {
  const Vec2 spring{0.4, -0.3}, dx{2e-4, 1e-4};
  for (const bool starts_open : {false, true})
    for (const double share : {0.3, 0.9})
      for (const double normal : {1.0, 100.0}) { // slips, sticks
        const auto friction = [&](double s) {
          return along_trial(law, spring, 0.3, normal, dx, h, {s, starts_open});
        };
        const StepFriction at = friction(share);
        const Vec2 slope = (1.0 / (2.0 * difference)) *
                           (friction(share + difference).force - friction(share - difference).force);
        EXPECT_LT(contact::norm(at.by_share - slope), 1e-5 * (contact::norm(at.by_share) + 1.0));
        // in stick: the mean of the law along a uniform motion
        if (!at.slides) {
          const double left = starts_open ? std::exp(-(1.0 - share) * law.stiffness * h / law.damping) : 1.0;
          const Vec2 mean = left * spring - (0.5 * share * law.stiffness + law.damping / h) * dx;
          EXPECT_LT(contact::norm(at.force - share * mean), round_off);
        }
      }
}

namespace {

/// The spring without C_T along a uniform motion under a constant bound, by radial returns.
Vec2 by_radial_returns(Vec2 spring, Vec2 push, double bound) {
  constexpr int parts = 200000; // errors of 1e-5 of the turning
  for (int i = 0; i < parts; ++i) {
    spring = spring + (1.0 / parts) * push;
    if (const double size = contact::norm(spring); size > bound)
      spring = (bound / size) * spring;
  }
  return spring;
}

} // namespace

TEST(ConservingFriction, TurnsTheSpringWithoutDamperByTheLaw) {
  const contact::FrictionLaw plastic{1e4, 0.0, 0.3, 0.3};
  constexpr double normal = 10.0, bound = 3.0, of_returns = 2e-5;
  for (const Vec2 spring : {Vec2{3.0, 0.0}, Vec2{2.0, -1.0}, Vec2{0.0, -3.0}})
    for (const Vec2 dx : {Vec2{1e-4, 2e-4}, Vec2{-3e-4, 5e-4}, Vec2{-2e-3, 1e-4}}) {
      const auto friction = along_trial(plastic, spring, 0.3, normal, dx, h);
      if (!friction.slides)
        continue;
      const ClosedStep step =
          close_part(plastic, {spring, true}, {friction.force, true}, normal, normal, dx, h, {});
      EXPECT_LT(contact::norm(step.spring - by_radial_returns(spring, -1e4 * dx, bound)), of_returns * bound);
    }
}

TEST(ConservingFriction, SharesOutTheWorkAndNeverGivesEnergy) {
  for (const double damping : {0.0, 0.1, 1.0, 20.0})
    for (const double normal : {1.0, 4.0, 100.0})
      for (const double end_normal : {0.0, 0.7 * normal, 1.5 * normal})
        for (const ClosedPart part : {ClosedPart{1.0, false}, ClosedPart{0.4, false}, ClosedPart{0.4, true}})
          for (const Vec2 spring : {Vec2{}, Vec2{0.3, 0.0}, Vec2{-0.2, 0.9}})
            for (const Vec2 dx : {Vec2{}, Vec2{1e-5, -2e-5}, Vec2{3e-4, 2e-4}}) {
              const contact::FrictionLaw l{1e4, damping, 0.3, 0.3};
              const auto f = along_trial(l, spring, 0.3, normal, dx, h, part);
              const ClosedStep step =
                  close_part(l, {spring, f.slides}, {f.force, f.slides}, normal, end_normal, dx, h, part);
              EXPECT_NEAR(step.friction_work + step.damper_work + step.given_up + step.stored,
                          -contact::dot(f.force, dx), round_off);
              EXPECT_NEAR(step.stored, l.spring_energy(step.spring) - l.spring_energy(spring), round_off);
              for (const double loss : {step.friction_work, step.damper_work, step.given_up})
                EXPECT_GE(loss, -round_off);
              EXPECT_GE(step.slid, 0.0);
              EXPECT_LE(step.slid, contact::norm(dx) * (1.0 + round_off));
            }
}

} // namespace conserving_friction_test
