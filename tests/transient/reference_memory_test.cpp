// SPDX-License-Identifier: GPL-3.0-or-later
// friction_memory = "reference" where its law has one limit: a mass that stays pressed on a plane, at rest or sliding.
#include "scenes.hpp"
#include <gtest/gtest.h>

namespace reference_memory_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

/// Pressed with 60 N -+ 20 N, driven along x_loc and y_loc by two harmonic forces above the bound.
Scene driven_on_a_plane(double stiffness, double damping, contact::Vec2 along) {
  Scene s = mass_point(1.0, Vec3(400.0, 700.0, 1100.0), 0.5);
  for (int i = 0; i < 3; ++i)
    s.system.damping(i) = 0.02 * std::sqrt(s.system.stiffness(i));
  start(s, 1.0, Vec3::Zero(), Vec3(0.2, 0.1, 0.0));
  const contact::FrictionLaw law{stiffness, damping, 0.3, 0.3, contact::FrictionMemoryKind::reference, along};
  s.contacts = {contact_of(1.0, {contact::Stop{0.0, contact::PlaneAxis::z}, {1e5}, law}, {0, 0, 1e-3})};
  s.loads = {force_on(1.0, Vec3(1.0, 0.4, 0.0).normalized(), Harmonic{35.0, 7.0, 0.2}),
             force_on(1.0, Vec3(-0.3, 1.0, 0.0).normalized(), Harmonic{30.0, 12.3, 1.0}),
             force_on(1.0, Vec3(0, 0, 1), Harmonic{20.0, 19.0, 0.5}),
             force_on(1.0, Vec3(0, 0, 1), Constant{60.0})};
  return s;
}

History at_step(const Scene& scene, SchemeKind kind, double step) {
  StepOptions options;
  options.scheme = kind;
  options.step = step;
  return simulate(scene, options, 0.1);
}

constexpr double order_one = 2e-3; // relative, of collocation at 4e-4 s beside Devogelaere's scheme at 2e-5 s

} // namespace

TEST(ReferenceMemory, DissipatesAllTheSlidingOfAContact) {
  // the spring is set in a slip, without work: the slider moves with the node. 10.995 W, all schemes at fine steps
  const Scene scene = driven_on_a_plane(3e3, 20.0, {1.0, 1.0});
  constexpr double right = 10.995, digits = 1e-3; // W
  const History fine = at_step(scene, SchemeKind::devogelaere, 2e-5);
  EXPECT_NEAR(fine.statistics[0].friction_power, right, digits);
  const History run = at_step(scene, SchemeKind::collocation, 4e-4);
  EXPECT_NEAR(run.statistics[0].friction_power, right, order_one * right);
  EXPECT_NEAR(run.statistics[0].friction_power, 0.3 * run.statistics[0].work_rate, order_one * right);
  EXPECT_GT(run.report.energy.contact_damping, 0.0);
}

TEST(ReferenceMemory, ActsAlongOneDirectionWithoutADamper) {
  // collocation had no equation for the force across
  const Scene scene = driven_on_a_plane(3e5, 0.0, {1.0, 0.0});
  const History run = at_step(scene, SchemeKind::collocation, 1e-4);
  ASSERT_EQ(run.report.outcome, Outcome::done);
  const auto fine = at_step(scene, SchemeKind::devogelaere, 2e-5).statistics[0];
  EXPECT_NEAR(run.statistics[0].work_rate, fine.work_rate, order_one * fine.work_rate);
  EXPECT_NEAR(run.statistics[0].friction_power, fine.friction_power, order_one * fine.friction_power);
}

TEST(ReferenceMemory, SlidesInEveryStageOfTheAdaptiveScheme) {
  // a spring that was set to the bound is no more than at the bound in the next step's first stage
  StepOptions options;
  options.scheme = SchemeKind::runge_kutta_54;
  options.tolerance = 1e-7;
  const auto run = simulate(driven_on_a_plane(3e3, 0.0, {1.0, 0.0}), options, 0.1).statistics[0];
  constexpr double ends = 1e-2; // of slides, which fall inside steps
  EXPECT_NEAR(run.friction_power, 0.3 * run.work_rate, ends * run.friction_power);
}

} // namespace reference_memory_test
