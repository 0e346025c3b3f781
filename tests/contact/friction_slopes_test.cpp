// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of friction against central differences: both memories, stick and slip, in the plane, along x_loc
// alone and across it alone.
#include "contact/friction_law.hpp"
#include "uniform.hpp"
#include <gtest/gtest.h>

using namespace fretwork;
using namespace fretwork::contact;

namespace {

constexpr double relative_step = 1e-6;
constexpr double difference_error = 1e-7; // relative: eps/step, and step^2 times curvatures of up to 1e3
constexpr double k = 1e6, c = 50.0, mu_static = 0.5, mu_dynamic = 0.3;

struct Case {
  FrictionMemory memory;
  double normal;
  Vec2 dx, velocity;
};

/// Trial forces of up to some times the bound, shared by spring, displacement and damper.
Case draw(tests::Uniform& uniform, Vec2 along) {
  const double normal = uniform(1.0, 20.0), bound = mu_static * normal;
  const Vec2 spring = uniform.vector(bound);
  return {{{along.x * spring.x, along.t * spring.t}, uniform(-1, 1) > 0.0},
          normal,
          uniform.vector(bound / k),
          uniform.vector(bound / c)};
}

Vec2 times(const Sym2& a, Vec2 d) { return {a.xx * d.x + a.xt * d.t, a.xt * d.x + a.tt * d.t}; }

/// (f(h) - f(-h))/(2 h) of a friction; false if its regime is not the same on both sides.
template <class F> bool difference(F f, double h, bool slides, Vec2& by) {
  const Friction after = f(h), before = f(-h);
  by = (0.5 / h) * (after.force - before.force);
  return after.slides == slides && before.slides == slides;
}

} // namespace

TEST(FrictionSlopes, AreThoseOfTheForceInEveryRegime) {
  tests::Uniform uniform(61);
  for (const auto kind : {FrictionMemoryKind::return_map, FrictionMemoryKind::reference})
    for (const Vec2 along : {Vec2{1.0, 1.0}, Vec2{1.0, 0.0}, Vec2{0.0, 1.0}}) {
      const FrictionLaw law{k, c, mu_static, mu_dynamic, kind, along};
      int regimes[2] = {};
      for (int i = 0; i < 3000; ++i) {
        const Case d = draw(uniform, along);
        const double speed = std::hypot(along.x * d.velocity.x, along.t * d.velocity.t);
        const Vec2 trial = d.memory.spring - k * d.dx - c * d.velocity;
        if (speed < 0.02 * norm(d.velocity) || norm(trial) < 0.02 * mu_static * d.normal)
          continue; // forces turn at once there: differences of a finite step tell nothing
        const FrictionSlopes s = friction_slopes(law, d.memory, d.normal, d.dx, d.velocity);
        const Friction f = evaluate(law, d.memory, d.normal, d.dx, d.velocity);
        EXPECT_EQ(s.friction.force.x, f.force.x);
        EXPECT_EQ(s.friction.force.t, f.force.t);
        EXPECT_EQ(s.friction.slides, f.slides);
        bool smooth = true;
        Vec2 by;
        for (const Vec2 e : {Vec2{1.0, 0.0}, Vec2{0.0, 1.0}}) {
          smooth = difference(
              [&](double h) { return evaluate(law, d.memory, d.normal, d.dx + h * e, d.velocity); },
              relative_step * 0.02 * d.normal / k, f.slides, by);
          if (smooth) {
            EXPECT_LT(norm(by - times(s.by_displacement, e)), difference_error * 10.0 * k);
          }
          smooth = smooth &&
                   difference(
                       [&](double h) { return evaluate(law, d.memory, d.normal, d.dx, d.velocity + h * e); },
                       relative_step * 0.02 * norm(d.velocity), f.slides, by);
          if (smooth) {
            EXPECT_LT(norm(by - times(s.by_velocity, e)), difference_error * 10.0 * (c + d.normal / speed));
          }
        }
        if (smooth &&
            difference([&](double h) { return evaluate(law, d.memory, d.normal + h, d.dx, d.velocity); },
                       relative_step * d.normal, f.slides, by)) {
          EXPECT_LT(norm(by - s.by_normal_force), difference_error);
        }
        regimes[f.slides] += smooth;
      }
      EXPECT_GT(regimes[0], 200);
      EXPECT_GT(regimes[1], 200);
    }
}

TEST(FrictionSlopes, OnALineAreThoseOfTheLine) {
  tests::Uniform uniform(62);
  for (const auto kind : {FrictionMemoryKind::return_map, FrictionMemoryKind::reference}) {
    const FrictionLaw law{k, c, mu_static, mu_dynamic, kind, {1.0, 1.0}};
    for (int i = 0; i < 1000; ++i) {
      const Case d = draw(uniform, {0.0, 1.0});
      const FrictionSlopes s = friction_slopes(law, d.memory, d.normal, {0.0, d.dx.t}, {0.0, d.velocity.t});
      const Friction f = evaluate_line(law, d.memory, d.normal, d.dx.t, d.velocity.t);
      EXPECT_EQ(s.friction.slides, f.slides);
      EXPECT_EQ(s.by_displacement.tt, f.slides ? 0.0 : -k);
      EXPECT_EQ(s.by_velocity.tt, f.slides ? 0.0 : -c);
      EXPECT_NEAR(s.by_normal_force.t, f.slides ? std::copysign(mu_dynamic, f.force.t) : 0.0, 1e-15);
      EXPECT_EQ(s.by_displacement.xt, 0.0);
    }
  }
}

TEST(FrictionSlopes, OfTheReferenceAtRestAreThoseOfTheTrial) {
  const FrictionLaw law{k, c, mu_static, mu_dynamic, FrictionMemoryKind::reference, {1.0, 1.0}};
  const FrictionSlopes s = friction_slopes(law, {{8.0, 0.0}, false}, 10.0, {}, {});
  EXPECT_TRUE(s.friction.slides);
  EXPECT_EQ(s.by_displacement.xx, 0.0);
  EXPECT_DOUBLE_EQ(s.by_displacement.tt, -k * mu_dynamic * 10.0 / 8.0);
}
