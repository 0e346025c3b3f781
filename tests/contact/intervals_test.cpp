// SPDX-License-Identifier: GPL-3.0-or-later
// The laws over intervals: contact/normal_interval.hpp, contact/friction_interval.hpp.
#include "contact/friction_interval.hpp"
#include "contact/normal_interval.hpp"
#include "contact/restitution.hpp"
#include "uniform.hpp"
#include <gtest/gtest.h>
#include <numbers>

namespace intervals_test {

using namespace fretwork;
using namespace fretwork::contact;

namespace {

constexpr double round_off = 1e-12;

/// An impact of a free mass of 1 kg at 1 m/s, w_c = 1 rad/s.
struct Impact {
  double speed = 0.0, time = 0.0, lost = 0.0; ///< m/s, s, J: rebound, time with a force, by the damper
};
Impact impact(const NormalLaw& law, double dt, double phase) {
  Impact out;
  double p = -phase * dt, rate = 1.0;
  for (int i = 0; i < 1000000 && (p > -2.0 * dt || rate > 0.0); ++i) {
    const NormalInterval n = normal_over_interval(law, dt, dt, 1.0, implicit_share(law.damping * dt),
                                                  {p, p + dt * rate, rate, 0.0});
    p = n.end;
    rate -= dt * n.force;
    out.time += dt * (n.to - n.from);
    out.lost += n.damper_work;
    EXPECT_GE(n.force, 0.0);
    EXPECT_NEAR(0.5 * (n.first + n.last) * (n.to - n.from), n.force, round_off);
  }
  out.speed = -rate;
  return out;
}

constexpr int phases = 40;
/// Mean over the places of the touch in an interval.
Impact mean_impact(const NormalLaw& law, double dt) {
  Impact out;
  for (int i = 0; i < phases; ++i) {
    const Impact one = impact(law, dt, (i + 0.5) / phases);
    out.speed += one.speed / phases;
    out.time += one.time / phases;
    out.lost += one.lost / phases;
  }
  return out;
}

} // namespace

TEST(NormalInterval, KeepsTheEnergyOfAnImpactWithoutLosses) {
  for (const double dt : {0.1, 0.5, 1.5})
    for (int i = 0; i < phases; ++i) {
      const Impact one = impact({1.0}, dt, (i + 0.5) / phases);
      EXPECT_NEAR(one.speed, 1.0, 1e-9)
          << dt << ", phase " << i; // what Newton's method leaves, some intervals long
      EXPECT_NEAR(one.lost, 0.0, 1e-9);
    }
}

TEST(NormalInterval, HasTheFrequencyOfTheContact) {
  // x^2/24 of the frequency, and the ends of the contact by straight lines: of order 2
  EXPECT_NEAR(mean_impact({1.0}, 0.5).time / std::numbers::pi, 1.0, 1e-2);
  EXPECT_NEAR(mean_impact({1.0}, 0.25).time / std::numbers::pi, 1.0, 3e-3);
}

TEST(NormalInterval, RestsWhereTheLawRests) {
  constexpr double load = 0.3, stiffness = 2.0;
  for (const double dt : {0.1, 1.0, 10.0})
    for (const double damping : {0.0, 0.4, 50.0}) {
      const double share = implicit_share(damping * dt);
      const double end = load / stiffness + share * load * dt * dt;
      const NormalInterval n =
          normal_over_interval({stiffness, damping}, dt, dt, 1.0, share, {load / stiffness, end, 0.0, load});
      EXPECT_NEAR(n.force, load, 1e-10)
          << dt << " " << damping; // of end, which is large against the penetration
      EXPECT_NEAR(n.end, load / stiffness, 1e-10 * end);
    }
}

TEST(NormalInterval, IsOfOrderTwoWithADamperThatActsAtOnce) {
  for (const double xi : {0.05, 0.14, 0.3}) {
    const double e = restitution_of_ratio(xi);
    const auto error = [&](double dt) { return std::abs(mean_impact({1.0, 2.0 * xi}, dt).speed / e - 1.0); };
    EXPECT_LT(error(0.25), 6e-3) << xi;
    EXPECT_GT(std::log2(error(0.25) / error(0.125)), 1.7) << xi;
  }
}

TEST(NormalInterval, TurnsNoSpeedRoundByAStiffDamper) {
  // xi = 3.7 leaves 1.6 %, whatever dt; 1e4: nothing
  for (const double dt : {0.01, 0.1, 0.5, 1.0})
    EXPECT_NEAR(mean_impact({1.0, 7.4}, dt).speed, 0.0163, 1.5e-3) << dt;
  for (const double dt : {0.01, 0.3})
    EXPECT_LT(std::abs(impact({1.0, 2e4}, dt, 0.5).speed), 1e-3) << dt;
}

namespace {

const FrictionLaw law{2.0, 0.0, 0.5, 0.5};

/// A path that its force does not change.
template <class V, class M> TangentialPath<V, M> driven(V velocity) { return {velocity, {}, {}}; }

} // namespace

TEST(FrictionInterval, LeadsASpringWithoutDamperBackToTheBoundRadially) {
  // perfect plasticity: a spring at the bound, pushed at right angles, turns towards the motion: tan(a/2) falls as exp(-K x/bound)
  constexpr double bound = 0.5, length = 1.0, speed = 0.3;
  for (const int intervals : {16, 32, 64}) {
    Vec2 spring{bound, 0.0};
    const double dt = length / intervals;
    for (int i = 0; i < intervals; ++i) {
      const PieceTable table = piece_table(law, 0.0, dt);
      const auto f = friction_over_interval(law, table, 0.0, spring, true, dt, 1.0, 1.0,
                                            driven<Vec2, Sym2>({0.0, speed}));
      spring = f.spring;
      EXPECT_NEAR(norm(spring), bound, round_off);
      EXPECT_GE(f.slider_work, 0.0);
    }
    const double turned =
        2.0 * std::atan(std::exp(-law.stiffness * speed * length / bound)); // from -velocity
    const double angle = std::acos(-spring.t / bound);
    EXPECT_NEAR(angle, turned, 0.2 / intervals) << intervals; // of order 1
  }
}

TEST(FrictionInterval, StaysWithinItsBoundOnTheMean) {
  tests::Uniform draw(7);
  constexpr int draws = 200000;
  for (int i = 0; i < draws; ++i) {
    const FrictionLaw any{draw.scale(0.01, 100.0), draw.scale(0.01, 100.0), 0.5, draw(0.2, 0.5)};
    const double dt = draw.scale(0.01, 2.0), normal0 = draw(0.0, 2.0), normal1 = draw(0.0, 2.0);
    const double bound = any.mu_static * 0.5 * (normal0 + normal1) * dt * (1.0 + round_off);
    const PieceTable table = piece_table(any, 1.0, dt);
    const Vec2 spring = draw.vector(any.mu_static * normal0), velocity = draw.vector(1.0),
               acceleration = draw.vector(1.0);
    const auto line = friction_over_interval(any, table, 1.0, spring.t, false, dt, normal0, normal1,
                                             {velocity.t, acceleration.t, 1.0});
    ASSERT_LE(std::abs(line.impulse), bound) << i;
    const auto plane = friction_over_interval(any, table, 1.0, spring, false, dt, normal0, normal1,
                                              {velocity, acceleration, {1.0, 0.0, 1.0}});
    ASSERT_LE(norm(plane.impulse), bound) << i;
  }
}

TEST(FrictionInterval, StartsToSlideInsideTheInterval) {
  // at rest until K_T v t = mu N: what it slides after that; with a growing normal force the bound is met later
  constexpr double dt = 1.0, v = 0.5; // K v = 1 N/s
  for (const double growth : {0.0, 0.8}) {
    const double begin = 0.5 / (1.0 - 0.5 * growth);
    const auto f = friction_over_interval(law, piece_table(law, 0.0, dt), 0.0, 0.0, false, dt, 1.0,
                                          1.0 + growth, driven<double, double>(v));
    EXPECT_NEAR(f.sliding_time, dt - begin, round_off);
    EXPECT_NEAR(f.slid, v * (dt - begin), round_off);
    EXPECT_NEAR(f.spring, -0.5 * (1.0 + growth), round_off);
    EXPECT_TRUE(f.sliding);
  }
}

TEST(FrictionInterval, StopsToSlideInsideTheInterval) {
  // a mass that friction brings to rest: after v/(mu N), whatever the interval
  constexpr double v = 0.2, stop = 0.4;
  const FrictionLaw stiff{1e6, 0.0, 0.5, 0.5};
  const auto f = friction_over_interval(stiff, piece_table(stiff, 1.0, 1.0), 1.0, -0.5, true, 1.0, 1.0, 1.0,
                                        {v, 0.0, 1.0});
  EXPECT_NEAR(f.sliding_time, stop, 1e-3); // the spring's stretch: mu N/K
  EXPECT_NEAR(f.slid, 0.5 * v * stop, 1e-3 * v * stop);
  EXPECT_NEAR(f.slider_work, 0.5 * v * v, 1e-3 * v * v);
  EXPECT_FALSE(f.sliding);
}

TEST(FrictionInterval, WorksAsMuchInOneIntervalAsInMany) {
  // a slide that begins above the dynamic bound, under a falling normal force: the spring drops while that is still large
  constexpr double dt = 1.0, v = 0.4, normal0 = 2.0, normal1 = 0.2, begin = -1.6;
  constexpr int many = 64;
  for (const double damping : {0.0, 1e-3, 0.3, 3.0, 100.0}) {
    const FrictionLaw slipping{2.0, damping, 0.8, 0.5};
    double spring = begin, work = 0.0, slid = 0.0;
    for (int i = 0; i < many; ++i) {
      const double n0 = normal0 + (normal1 - normal0) * i / many,
                   n1 = normal0 + (normal1 - normal0) * (i + 1) / many;
      const auto f = friction_over_interval(slipping, piece_table(slipping, 0.0, dt / many), 0.0, spring,
                                            true, dt / many, n0, n1, driven<double, double>(v));
      EXPECT_TRUE(f.sliding);
      spring = f.spring;
      work += f.slider_work;
      slid += f.slid;
    }
    const auto one = friction_over_interval(slipping, piece_table(slipping, 0.0, dt), 0.0, begin, true, dt,
                                            normal0, normal1, driven<double, double>(v));
    EXPECT_NEAR(one.spring, spring, round_off) << damping;
    EXPECT_NEAR(one.slid, slid, round_off) << damping;
    EXPECT_NEAR(one.slider_work, work, round_off) << damping;
  }
}

TEST(FrictionInterval, RestsUnderItsForce) {
  for (const double damping : {0.0, 0.3, 100.0}) {
    const FrictionLaw damped{2.0, damping, 0.5, 0.5};
    const auto f = friction_over_interval(damped, piece_table(damped, 1.0, 0.7), 1.0, 0.2, false, 0.7, 1.0,
                                          1.0, {0.0, -0.2, 1.0});
    EXPECT_NEAR(f.displacement, 0.0, round_off) << damping;
    EXPECT_NEAR(f.spring, 0.2, round_off) << damping;
  }
}

} // namespace intervals_test
