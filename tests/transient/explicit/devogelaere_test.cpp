// SPDX-License-Identifier: GPL-3.0-or-later
// The reference's scheme of order 4: where it is stable, coupled dampers, closed forms.
#include "scenes.hpp"
#include <gtest/gtest.h>

namespace devogelaere_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::PlaneAxis;
using contact::Stop;

namespace {

StepOptions devogelaere(std::optional<double> step = {}) { return {SchemeKind::devogelaere, step}; }

/// Largest displacement in the last tenth of 1000 steps of a free oscillator, from 1; rate: of its damper.
double left(double frequency, double rate, double step) {
  Scene s = mass_point(1.0, Vec3(0, frequency * frequency, 0), 1000.0 * step);
  s.system.damping.setConstant(rate);
  start(s, 1.0, Vec3(0, 1.0, 0), Vec3::Zero());
  const History run = simulate(s, devogelaere(step), step);
  return run.report.outcome == Outcome::done ? run.q.row(1).tail(100).cwiseAbs().maxCoeff() : 1e300;
}

} // namespace

TEST(Devogelaere, IsStableUpToItsLimits) {
  EXPECT_LT(left(1.0, 0.0, 2.7), 1.0);
  EXPECT_GT(left(1.0, 0.0, 2.9), 1e6);
  EXPECT_LT(left(0.0, 1.0, 0.58), 1.0 + 1e-9); // moves nowhere: at rest
  EXPECT_LT(left(1.0, 0.02, 2.6), 1.0);
  EXPECT_LT(left(1.0, 0.2, 1.7), 1.0);
  EXPECT_GT(left(1.0, 0.2, 1.9), 1e6);
}

TEST(Devogelaere, TakesADampingMatrix) {
  // two equal modes damped along turned axes: each axis an oscillator of its own
  constexpr double c = 0.8, s = 0.6, fast = 8.0, slow = 1.0;
  Scene turned = mass_point(1.0, Vec3(0, 100.0, 100.0), 1.0), apart = turned;
  apart.system.damping = Vec3(0, fast, slow);
  start(apart, 1.0, Vec3(0, 0.3, -0.2), Vec3(0, 1.0, 2.0));
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.block<2, 2>(1, 1) << c, -s, s, c;
  turned.system.damping_matrix = turn * apart.system.damping.asDiagonal() * turn.transpose();
  turned.q0 = turn * apart.q0;
  turned.v0 = turn * apart.v0;
  const History a = simulate(turned, devogelaere(1e-3), 0.1), b = simulate(apart, devogelaere(1e-3), 0.1);
  constexpr double round_off = 1e-12;
  EXPECT_LT((a.q - turn * b.q).cwiseAbs().maxCoeff(), round_off);
  const History exact = simulate(apart, splitting(1e-3), 0.1); // of free modes
  constexpr double fourth_order = 1e-8;                        // (w h)^4 = 1e-8
  EXPECT_LT((b.q - exact.q).cwiseAbs().maxCoeff(), fourth_order);
}

TEST(Devogelaere, BouncesABallOnAStop) {
  // A4; the path bends where the ball touches: order 2 there
  Scene s = mass_point(1.0, Vec3::Zero(), 1.2);
  start(s, 1.0, Vec3::Zero(), Vec3(0, 1.0, 0));
  s.contacts = {contact_of(1.0, {Stop{2.0, PlaneAxis::y}, {100.0}, {}})};
  s.loads = {force_on(1.0, Vec3(0, 10.0, 0), Constant{1.0})};
  const History run = simulate(s, devogelaere(), 0.1);
  constexpr double asked = 1e-7;
  EXPECT_NEAR(run.q(1, 10), 1.332162981855, asked);
  EXPECT_NEAR(run.q(1, 11), 0.856394405035, asked);
}

TEST(Devogelaere, ItsRuleResolvesDampersWithinItsLimit) {
  Scene s = mass_point(2.0, Vec3::Zero(), 1000.0);
  s.contacts = {contact_of(2.0, {contact::Circle{0.1}, {2.0}, {2.0, 4e3, 0.3, 0.3}})};
  StepOptions options = devogelaere();
  options.accuracy = 0.5; // would take 3.5 of the rate
  EXPECT_LE(choose_step(s, options).step, 0.5 / 2000.0);
  s.contacts[0].support.friction = {1e6, 2.0, 0.3, 0.3}; // K_T/C_T = 5e5 1/s
  EXPECT_LE(choose_step(s, devogelaere()).step, 0.5 / 5e5);
  options.step = 1e-5;
  EXPECT_EQ(choose_step(s, options).warnings.size(), 1u);
}

} // namespace devogelaere_test
