// SPDX-License-Identifier: GPL-3.0-or-later
// The step forms of friction: a velocity that answers the force.
#include "contact/friction_law.hpp"
#include "uniform.hpp"
#include <array>
#include <gtest/gtest.h>

namespace friction_step_test {

using namespace fretwork;
using namespace fretwork::contact;

namespace {

constexpr double bound_tolerance = 1e-12; // |F| meets its bound to round-off
constexpr double solved = 1e-10; // residual of (M + s I) F = b, relative to b: Newton's last step is below it
constexpr double h = 1e-4;

const FrictionLaw law{1e6, 50.0, 0.5, 0.3};

FrictionLaw reference(FrictionLaw l) {
  l.kind = FrictionMemoryKind::reference;
  return l;
}

Vec2 times(const Mobility& a, Vec2 f) { return {a.xx * f.x + a.xt * f.t, a.xt * f.x + a.tt * f.t}; }

struct Case {
  FrictionMemory memory;
  double normal;
  Vec2 free_velocity;
  Mobility mobility;
};

/// Any direction, any anisotropy up to 1e6, any weight of the mobility in the equation.
Case draw(tests::Uniform& uniform) {
  const double angle = uniform(0.0, std::numbers::pi), c = std::cos(angle), s = std::sin(angle);
  const double big = uniform.scale(1e-8, 1e2), small = big * uniform.scale(1e-6, 1.0);
  return {{uniform.vector(5.0), uniform(-1, 1) > 0.0},
          uniform(0.0, 20.0),
          uniform.vector(uniform.scale(1e-4, 1.0)),
          {big * c * c + small * s * s, (big - small) * c * s, big * s * s + small * c * c}};
}

/// Checks (M + s I) F = b with s >= 0.
void expect_solved(const Mobility& m, Vec2 b, Vec2 force) {
  const Vec2 rest = b - times(m, force);
  const double s = dot(rest, force) / dot(force, force);
  EXPECT_GE(s, -solved * norm(b) / norm(force));
  EXPECT_LE(norm(rest - s * force), solved * norm(b));
}

} // namespace

TEST(FrictionStepPlane, SolvesItsEquations) {
  tests::Uniform uniform(21);
  const FrictionTable table = friction_table(law, h);
  int slips = 0;
  for (int i = 0; i < 20000; ++i) {
    const Case c = draw(uniform);
    const Friction f = step_friction_plane(law, table, c.memory, c.normal, c.free_velocity, c.mobility);
    const double gh = table.gradient;
    const Mobility m{1.0 + gh * c.mobility.xx, gh * c.mobility.xt, 1.0 + gh * c.mobility.tt};
    const Vec2 b = c.memory.spring - gh * c.free_velocity;
    slips += f.slides;
    if (f.slides) {
      EXPECT_NEAR(norm(f.force), law.mu_dynamic * c.normal, bound_tolerance * law.mu_dynamic * c.normal);
      expect_solved(m, b, f.force);
    } else {
      EXPECT_LE(norm(f.force),
                (c.memory.sliding ? law.mu_dynamic : law.mu_static) * c.normal * (1.0 + bound_tolerance));
      EXPECT_LE(norm(b - times(m, f.force)), solved * norm(b));
    }
  }
  EXPECT_GT(slips, 4000); // both regimes were met
  EXPECT_LT(slips, 16000);
}

TEST(FrictionStepPlane, OfTheReferenceOpposesTheVelocityItLeaves) {
  tests::Uniform uniform(22);
  const FrictionLaw l = reference(law);
  const FrictionTable table = friction_table(l, h);
  int stopped = 0, slips = 0;
  for (int i = 0; i < 20000; ++i) {
    const Case c = draw(uniform);
    const Friction f = step_friction_plane(l, table, c.memory, c.normal, c.free_velocity, c.mobility);
    EXPECT_LE(norm(f.force), (f.slides || c.memory.sliding ? l.mu_dynamic : l.mu_static) * c.normal *
                                 (1.0 + bound_tolerance));
    if (!f.slides)
      continue;
    ++slips;
    const Vec2 velocity = c.free_velocity + times(c.mobility, f.force);
    EXPECT_LE(dot(velocity, f.force), solved * norm(c.free_velocity) * norm(f.force));
    if (norm(velocity) < solved * norm(c.free_velocity))
      ++stopped;
    else
      expect_solved(c.mobility, -1.0 * c.free_velocity, f.force);
  }
  EXPECT_GT(slips, 2000);
  EXPECT_GT(stopped, 20);
}

TEST(FrictionStepPlane, TakesANodeThatCannotMoveOrMovesOnALine) {
  for (const FrictionLaw& l : {law, reference(law)}) {
    const FrictionTable table = friction_table(l, h);
    const FrictionMemory memory{{0.0, 4.0}, false};
    const Friction fixed = step_friction_plane(l, table, memory, 10.0, {}, {0.0, 0.0, 0.0});
    EXPECT_EQ(fixed.force.t, 4.0);
    const Friction fixed_slip = step_friction_plane(l, table, memory, 1.0, {}, {0.0, 0.0, 0.0});
    EXPECT_NEAR(fixed_slip.force.t, l.mu_dynamic, bound_tolerance);
    // mobility along one oblique line: rank 1
    const Vec2 line{0.6, 0.8};
    const double weight = 1e-3;
    const Mobility a{weight * 0.36, weight * 0.48, weight * 0.64};
    const Friction slip = step_friction_plane(l, table, {}, 1.0, 2.0 * line, a);
    EXPECT_TRUE(slip.slides);
    EXPECT_NEAR(dot(slip.force, line), -l.mu_dynamic, bound_tolerance);
  }
}

TEST(FrictionStepPlane, AgreesWithTheLineWhereNothingMovesAlongX) {
  tests::Uniform uniform(23);
  for (const FrictionLaw& l : {law, reference(law), FrictionLaw{1e6, 0.0, 0.3, 0.3}}) {
    const FrictionTable table = friction_table(l, h);
    for (int i = 0; i < 5000; ++i) {
      const Case c = draw(uniform);
      const FrictionMemory memory{{0.0, c.memory.spring.t}, c.memory.sliding};
      const Mobility mobility{0.0, 0.0, c.mobility.tt};
      const Friction plane =
          step_friction_plane(l, table, memory, c.normal, {0.0, c.free_velocity.t}, mobility);
      const Friction line = step_friction_line(l, table, memory, c.normal, c.free_velocity.t, c.mobility.tt);
      EXPECT_EQ(plane.slides, line.slides);
      EXPECT_EQ(plane.force.x, 0.0);
      EXPECT_NEAR(plane.force.t, line.force.t,
                  bound_tolerance * (std::abs(line.force.t) + l.mu_static * c.normal));
    }
  }
}

TEST(FrictionStep, TendsToTheLawOfAnInstantAsTheStepGoesToZero) {
  const Mobility w{7.0, 2.0, 4.0};                                   // 1/kg; over a step (h/2) of it
  const std::array velocities = {Vec2{0.02, -0.01}, Vec2{0.4, 0.3}}; // stick, slip
  for (const FrictionLaw& l : {law, reference(law)})
    for (const Vec2 velocity : velocities) {
      const FrictionMemory memory{{1.0, 0.5}, false};
      const double normal = 8.0;
      const Friction instant = evaluate(l, memory, normal, {}, velocity);
      double last = 0.0;
      for (double step = 1e-5; step > 1e-9; step *= 0.5) {
        const Mobility half{0.5 * step * w.xx, 0.5 * step * w.xt, 0.5 * step * w.tt};
        const Friction f = step_friction_plane(l, friction_table(l, step), memory, normal, velocity, half);
        EXPECT_EQ(f.slides, instant.slides);
        const double error = norm(f.force - instant.force);
        if (step < 1e-6 &&
            error > 0.0) { // order 1: the instant is the start of the step, the step's force its mean
          EXPECT_NEAR(error / last, 0.5, 0.05);
        }
        last = error;
      }
      EXPECT_LT(last, 1e-4 * norm(instant.force));
    }
}

} // namespace friction_step_test
