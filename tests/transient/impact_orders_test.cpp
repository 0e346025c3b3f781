// SPDX-License-Identifier: GPL-3.0-or-later
// Orders of convergence through impacts: a free mass that meets a stop at 1 m/s and an angle, wherever in a step the touch lies. The scheme
// with located events has the right velocity of departure.
#include "scenes.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace impact_orders_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;

namespace {

constexpr double coarse = 1e-3, duration = 0.032; // s; w_c coarse = 0.32, contact times of 10 ms
constexpr int phases = 32;
constexpr double golden = 0.618033988749895; // its multiples fill a step evenly, on no grid of steps

struct Impact {
  double normal_damping, friction, tangential_damping, across; // N s/m, -, N s/m, m/s
};

Scene scene_of(const Impact& impact, double phase) {
  Scene s = mass_point(1.0, Vec3::Zero(), duration);
  start(s, 1.0, Vec3::Zero(), Vec3(impact.across, 1.0, 0.0));
  contact::FrictionLaw law;
  if (impact.friction > 0.0)
    law = {3e4, impact.tangential_damping, impact.friction, impact.friction};
  s.contacts = {contact_of(
      1.0,
      {contact::Stop{(2.0 + phase) * coarse, contact::PlaneAxis::y}, {1e5, impact.normal_damping}, law})};
  return s;
}

/// Of the velocity of departure, m/s, rms over the phases.
double error(SchemeKind kind, double step, const Impact& impact) {
  double sum = 0.0;
  for (int i = 0; i < phases; ++i) {
    const Scene scene = scene_of(impact, std::fmod(golden * i, 1.0));
    StepOptions oracle;
    oracle.scheme = SchemeKind::runge_kutta_54;
    oracle.tolerance = 1e-11;
    const History run = simulate(scene, {kind, step}, duration), right = simulate(scene, oracle, duration);
    sum += (run.v.col(1) - right.v.col(1)).squaredNorm();
  }
  return std::sqrt(sum / phases);
}

/// Mean over three halvings from h on.
double order(SchemeKind kind, double h, const Impact& impact) {
  return std::log2(error(kind, h, impact) / error(kind, h / 8.0, impact)) / 3.0;
}

constexpr double xi = 0.1, damped = 2.0 * xi * 316.23; // N s/m
constexpr double partly = 0.3, all = 2.0; // m/s across: sticks for a part of the impact; slides throughout
constexpr double near_two = 1.7, near_one = 0.75; // what an order of 2 or 1 shows in three halvings, at least

} // namespace

TEST(ImpactOrders, CollocationIsOfOrderTwoWithoutJumps) {
  EXPECT_GT(order(SchemeKind::collocation, coarse, {0.0, 0.3, 20.0, partly}), near_two);
  EXPECT_LT(error(SchemeKind::collocation, coarse, {0.0, 0.3, 20.0, partly}), 3e-4);
  EXPECT_LT(error(SchemeKind::collocation, coarse, {0.0, 0.3, 20.0, all}), 3e-5);
}

// A touch inside a part of the path loads the spring from the touch on; over the whole part errors were 1e-3 to 2e-3.
TEST(ImpactOrders, CollocationLoadsTheTangentialSpringFromTheTouchOn) {
  constexpr double small = 2e-4; // m/s, at w_c h = 0.32
  EXPECT_LT(error(SchemeKind::collocation, coarse, {0.0, 0.3, 0.0, partly}), small);
  EXPECT_LT(error(SchemeKind::collocation, coarse, {damped, 0.3, 20.0, partly}), small);
  EXPECT_LT(error(SchemeKind::collocation, coarse, {damped, 0.3, 20.0, all}), small);
  EXPECT_LT(error(SchemeKind::collocation, coarse, {damped, 0.3, 0.0, partly}), small);
}

TEST(ImpactOrders, WithANormalDamperTheyAreOne) {
  for (const SchemeKind kind : {SchemeKind::collocation, SchemeKind::devogelaere})
    for (const double friction : {0.0, 0.3}) {
      const Impact impact{damped, friction, 20.0, partly};
      const double measured = order(kind, coarse / 4.0, impact);
      EXPECT_GT(measured, near_one);
      EXPECT_LT(measured, near_two);
    }
}

TEST(ImpactOrders, DevogelaereIsOfOrderTwoWithoutJumps) {
  const Impact impact{0.0, 0.3, 20.0, partly};
  EXPECT_GT(order(SchemeKind::devogelaere, coarse / 4.0, impact), near_two);
}

} // namespace impact_orders_test
