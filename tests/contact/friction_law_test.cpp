// SPDX-License-Identifier: GPL-3.0-or-later
// The friction law at one instant, its memory and its energy, regime by regime.
#include "contact/support.hpp"
#include "uniform.hpp"
#include <gtest/gtest.h>

namespace friction_law_test {

using namespace fretwork;
using namespace fretwork::contact;

namespace {

constexpr double bound_tolerance = 1e-12; // |F| meets its bound to round-off
constexpr double round_off = 1e-12;       // of energies, relative to the largest term
constexpr double h = 1e-4;

const FrictionLaw law{1e6, 50.0, 0.3, 0.3};
const FrictionLaw two_coefficients{1e6, 50.0, 0.5, 0.3};

FrictionLaw reference(FrictionLaw l) {
  l.kind = FrictionMemoryKind::reference;
  return l;
}

/// A node driven along a path under a normal force: the law as explicit schemes use it.
struct Driven {
  FrictionLaw law;
  FrictionMemory memory{};
  double step = h, friction_work = 0.0, damper_work = 0.0;

  Friction move(double normal_force, Vec2 dx) {
    const Friction friction = evaluate(law, memory, normal_force, dx, (1.0 / step) * dx);
    const FrictionStep end = close_step(law, friction_table(law, step), memory, friction, dx);
    memory = end.memory;
    friction_work += end.friction_work;
    damper_work += end.damper_work;
    return friction;
  }
};

} // namespace

TEST(FrictionEvaluate, SticksByItsSpringAndDamper) {
  const Friction f = evaluate(law, {{3.0, -2.0}, false}, 100.0, {1e-6, 2e-6}, {0.1, -0.05});
  EXPECT_FALSE(f.slides);
  EXPECT_DOUBLE_EQ(f.force.x, 3.0 - 1.0 - 5.0);
  EXPECT_DOUBLE_EQ(f.force.t, -2.0 - 2.0 + 2.5);
}

TEST(FrictionEvaluate, SlipsAtTheDynamicBoundAgainstTheMotion) {
  const Friction f = evaluate(two_coefficients, {}, 10.0, {3e-5, -4e-5}, {});
  EXPECT_TRUE(f.slides);
  EXPECT_NEAR(f.force.x, -0.3 * 10.0 * 0.6, bound_tolerance);
  EXPECT_NEAR(f.force.t, 0.3 * 10.0 * 0.8, bound_tolerance);
}

TEST(FrictionEvaluate, BreaksLooseAtTheStaticBoundAndSticksAgainBelowTheDynamicOne) {
  const Vec2 still{};
  const auto slides = [&](double spring, bool sliding) {
    return evaluate(two_coefficients, {{spring, 0.0}, sliding}, 10.0, still, still).slides;
  };
  EXPECT_FALSE(slides(4.9, false)); // between mu_d F_N = 3 and mu_s F_N = 5
  EXPECT_TRUE(slides(4.9, true));
  EXPECT_TRUE(slides(5.1, false));
  EXPECT_FALSE(slides(2.9, true));
}

TEST(FrictionEvaluate, OfTheReferenceSlipsAgainstTheVelocityAndWithoutOneAlongTheTrial) {
  const FrictionMemory memory{{8.0, 0.0}, false};
  const Friction moving = evaluate(reference(law), memory, 10.0, {}, {0.0, 1e-3});
  EXPECT_NEAR(moving.force.t, -3.0, bound_tolerance);
  EXPECT_NEAR(moving.force.x, 0.0, bound_tolerance);
  const Friction still = evaluate(reference(law), memory, 10.0, {}, {});
  EXPECT_NEAR(still.force.x, 3.0, bound_tolerance);
}

TEST(FrictionMemory, OfASlipRelaxesToTheForceAndOfTheReferenceIsSetToIt) {
  const Vec2 force{-3.0, 0.0}, dx{1e-5, 0.0};
  const FrictionMemory memory{{-2.0, 0.0}, false};
  const FrictionTable table = friction_table(law, h);
  EXPECT_DOUBLE_EQ(table.relaxation, std::exp(-law.stiffness * h / law.damping));
  const FrictionStep slip = close_step(law, table, memory, {force, true}, dx);
  EXPECT_NEAR(slip.memory.spring.x, -3.0 + table.relaxation * 1.0, bound_tolerance);
  EXPECT_TRUE(slip.memory.sliding);
  const FrictionStep set = close_step(reference(law), table, memory, {force, true}, dx);
  EXPECT_EQ(set.memory.spring.x, -3.0);
  EXPECT_EQ(set.slip.x, dx.x);
}

TEST(FrictionMemory, DiesOutWhenOpenAndForgetsItsSliding) {
  const FrictionMemory memory{{3.0, 4.0}, true};
  const FrictionTable table = friction_table(law, 1e-5);
  const FrictionStep open = open_step(law, table, memory);
  EXPECT_DOUBLE_EQ(norm(open.memory.spring), 5.0 * std::exp(-0.2));
  EXPECT_FALSE(open.memory.sliding);
  EXPECT_NEAR(open.damper_work, law.spring_energy(memory.spring) - law.spring_energy(open.memory.spring),
              round_off * open.damper_work);
  EXPECT_EQ(norm(open_step(reference(law), table, memory).memory.spring), 0.0);
}

TEST(FrictionMemory, WithoutADamperFollowsAtOnce) {
  FrictionLaw bare = law;
  bare.damping = 0.0;
  EXPECT_EQ(friction_table(bare, h).relaxation, 0.0);
  EXPECT_EQ(norm(open_step(bare, friction_table(bare, h), {{1.0, 1.0}, false}).memory.spring), 0.0);
}

TEST(FrictionRegimes, ASlidingNodeThatTurnsBackSticksThroughTwiceTheBound) {
  // slow, so that the damper is of no weight: slip at -mu F_N, reversal, stick along 2 mu F_N / K_T, slip at
  // +mu F_N
  Driven node{law, {}, 1.0};
  const double dx = 1e-7, normal = 10.0, bound = law.mu_dynamic * normal;
  for (int i = 0; i < 100; ++i)
    node.move(normal, {dx, 0.0});
  EXPECT_NEAR(node.memory.spring.x, -bound, bound * bound_tolerance);
  int stuck = 0;
  for (int i = 0; i < 100; ++i)
    stuck += !node.move(normal, {-dx, 0.0}).slides;
  EXPECT_NEAR(stuck, 2.0 * bound / (law.stiffness * dx), 1.5); // the bound is met within a step
  EXPECT_NEAR(node.memory.spring.x, bound, bound * bound_tolerance);
}

TEST(FrictionRegimes, LiftOffLeavesNoForce) {
  const Friction f = evaluate(law, {{3.0, 0.0}, true}, 0.0, {1e-5, 0.0}, {0.1, 0.0});
  EXPECT_EQ(norm(f.force), 0.0);
}

TEST(FrictionRegimes, ASliderWithoutDynamicFrictionLetsItsSpringGo) {
  // it breaks loose at mu_s F_N and slides freely: the spring relaxes, whatever path follows
  for (const double damping : {0.0, 50.0}) {
    const FrictionLaw free{1e6, damping, 0.1, 0.0};
    Driven node{free};
    constexpr double normal = 10.0, dx = 1e-7;
    while (!node.move(normal, {dx, 0.0}).slides)
      ASSERT_LT(norm(node.memory.spring), free.mu_static * normal * (1.0 + bound_tolerance));
    const double most = 0.5 * free.mu_static * normal * free.mu_static * normal / free.stiffness;
    for (int i = 0; i < 1000; ++i) {
      EXPECT_EQ(norm(node.move(normal, {dx, 0.0}).force), 0.0);
      ASSERT_LE(free.spring_energy(node.memory.spring), most);
    }
    EXPECT_LT(free.spring_energy(node.memory.spring), round_off * most);
    EXPECT_EQ(node.friction_work, 0.0);
  }
}

TEST(FrictionEnergy, OfAClosedCycleIsLost) {
  tests::Uniform uniform(12);
  for (const FrictionLaw& l : {law, two_coefficients, reference(law)}) {
    Driven node{l};
    double work = 0.0, lost = 0.0;
    constexpr int points = 2000;
    for (int cycle = 0; cycle < 3; ++cycle) {
      work = 0.0;
      lost = node.friction_work + node.damper_work;
      for (int i = 0; i < points; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / points,
                     arc = 2e-4 * 2.0 * std::numbers::pi / points;
        const Vec2 dx{-arc * std::sin(angle), 0.5 * arc * std::cos(angle)};
        work += dot(node.move(20.0, dx).force, dx);
      }
      lost = node.friction_work + node.damper_work - lost;
    }
    EXPECT_LT(work, 0.0);
    constexpr double settled =
        1e-6; // the third cycle starts and ends with the same spring, to this share of the loss
    EXPECT_NEAR(-work, lost, settled * lost);
  }
}

TEST(AutomaticTangentialDamping, MakesTheStuckModeCritical) {
  const double kt = 4e5, k = 1e4, m = 2.5, xi = 0.03;
  const double total = automatic_tangential_damping(kt, k, m, xi) + 2.0 * xi * std::sqrt(k * m);
  EXPECT_DOUBLE_EQ(total / (2.0 * std::sqrt((k + kt) * m)), 1.0);
  EXPECT_DOUBLE_EQ(automatic_tangential_damping(kt, 0.0, m, xi), 2.0 * std::sqrt(kt * m)); // a rigid mode
}

TEST(HarmonicSliding, LosesPerCycleWhatThePenalisedLawSays) {
  // amplitude a under constant F_N: 4 mu F_N (a - mu F_N / K_T)
  constexpr double a = 2e-4, normal = 40.0, frequency = 1.0,
                   accuracy = 1e-4; // the damper's share at 1 Hz, C_T w / K_T
  const FrictionLaw l{4e5, 2.0, 0.25, 0.25};
  constexpr int points = 20000;
  Driven node{l, {}, 1.0 / (frequency * points)};
  double before = 0.0;
  for (int i = 0; i < 2 * points; ++i) {
    if (i == points)
      before = node.friction_work;
    const auto at = [&](int j) { return a * std::sin(2.0 * std::numbers::pi * j / points); };
    node.move(normal, {0.0, at(i + 1) - at(i)});
  }
  const double loss = 4.0 * l.mu_dynamic * normal * (a - l.mu_dynamic * normal / l.stiffness);
  EXPECT_NEAR((node.friction_work - before) / loss, 1.0, accuracy);
}

} // namespace friction_law_test
