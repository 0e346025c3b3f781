// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of a step that keeps the energy: its bound, its direction, its derivatives.
#include "transient/conserving_friction.hpp"
#include <algorithm>
#include <gtest/gtest.h>

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
  const Rubbing at = friction(dx, normal, force);
  const auto expect = [](Vec2 by, const Rubbing& after, const Rubbing& before, double step, double size) {
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
      const Rubbing found = friction(dx, normal, {});
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
