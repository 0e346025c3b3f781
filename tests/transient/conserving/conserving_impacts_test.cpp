// SPDX-License-Identifier: GPL-3.0-or-later
// The scheme that keeps the energy against closed forms and an integrator of another kind: normal dampers of any rate, friction with C_T from
// 0 on, its order through impacts.
#include "contact/restitution.hpp"
#include "single_mass.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace conserving_impacts_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

constexpr double stiffness = 1e6, mass = 1.0, contact_frequency = 1e3;

/// Speed after an impact over the speed before, the largest over places of the touch in a step.
double rebound(double damping, double angle) {
  constexpr int phases = 7;
  constexpr double duration = 0.3; // the touch is at 0.02 s
  const double h = duration / std::ceil(duration * contact_frequency / angle);
  double largest = 0.0;
  for (int k = 0; k < phases; ++k) {
    Scene s = mass_point(mass, Vec3::Zero(), duration);
    start(s, mass, Vec3::Zero(), Vec3(0, 1, 0));
    s.contacts = {contact_of(
        mass, {contact::Stop{0.02 + h * k / phases, contact::PlaneAxis::y}, {stiffness, damping}, {}})};
    const History run = simulate(s, energy_conserving(h), duration);
    largest = std::max(largest, -run.v(1, run.v.cols() - 1));
  }
  return largest;
}

/// The figures that both have, by name.
std::vector<std::pair<const char*, double>> differences(const MassFigures& found, const MassFigures& wanted) {
  const auto relative = [](double a, double b) { return std::abs(a - b) / b; };
  return {{"work rate", relative(found.work_rate, wanted.work_rate)},
          {"friction power", relative(found.friction_power, wanted.friction_power)},
          {"mean normal force", relative(found.normal_mean, wanted.normal_mean)},
          {"rms normal force", relative(found.normal_rms, wanted.normal_rms)},
          {"rms tangential force", relative(found.tangential_rms, wanted.tangential_rms)}};
}

/// At step 0: its error is of the first order.
MassFigures reference(const SingleMass& m, double step) {
  MassFigures fine = integrate(m, step);
  const MassFigures coarse = integrate(m, 2.0 * step);
  fine.work_rate += fine.work_rate - coarse.work_rate;
  fine.friction_power += fine.friction_power - coarse.friction_power;
  fine.normal_mean += fine.normal_mean - coarse.normal_mean;
  fine.normal_rms += fine.normal_rms - coarse.normal_rms;
  fine.tangential_rms += fine.tangential_rms - coarse.tangential_rms;
  return fine;
}

double contact_frequency_of(const SingleMass& m) { return std::sqrt(m.normal.stiffness / m.mass); }

MassFigures run_of(const SingleMass& m, double angle) {
  return figures_of(
      simulate(scene_of(m), energy_conserving(angle / contact_frequency_of(m)), m.duration).statistics[0]);
}

} // namespace

TEST(EnergyConserving, LeavesNoReboundToALargeNormalDamperAtAnyStep) {
  for (const double damping : {1e7, 1e9}) {
    EXPECT_LT(rebound(damping, 0.01), 1e-4);
    EXPECT_LT(rebound(damping, 0.3), 0.015);
    EXPECT_LT(rebound(damping, 1.0), 0.12);
  }
}

TEST(EnergyConserving, ComesBackWithTheRestitutionOfItsDamper) {
  for (const double e : {0.001, 0.02, 0.3, 0.86}) {
    const double damping = contact::damping_of_restitution(e, stiffness, mass);
    EXPECT_NEAR(rebound(damping, 0.3), e, 0.02) << e;
    EXPECT_NEAR(rebound(damping, 0.03), e, 5e-4) << e;
  }
}

TEST(Impacts, WithOverdampedContactsComeBackWithTheirRestitutionAtTheAutomaticStep) {
  constexpr double duration = 10.0, e = 0.001, of_the_speed = 0.005; // r_n h = 2 governs
  for (const auto scheme : {SchemeKind::splitting, SchemeKind::collocation, SchemeKind::energy_conserving}) {
    Scene s = mass_point(mass, Vec3::Zero(), duration);
    start(s, mass, Vec3::Zero(), Vec3(0, 1, 0));
    s.contacts = {contact_of(mass, {contact::Stop{0.02, contact::PlaneAxis::y},
                                    {stiffness, contact::damping_of_restitution(e, stiffness, mass)},
                                    {}})};
    const History run = simulate(s, {scheme, {}}, duration);
    EXPECT_TRUE(run.choice.warnings.empty());
    EXPECT_NEAR(-run.v(1, run.v.cols() - 1), e, of_the_speed) << name_of(scheme);
  }
}

TEST(Impacts, AreNotChargedWithSpringsThatTheOppositeFaceForgets) {
  // C_T/K_T is long: a spring is still loaded when the other face is met
  // Of the work of the dampers; the steps in which a contact opens differ by the order 1. Charged, collocation has 1.7e-3 and 1.8e-3 more.
  constexpr double agreed = 1e-3;
  for (const unsigned seed : {1u, 4u}) {
    const SingleMass m = random_mass(seed, 30.0);
    Scene scene = scene_of(m);
    scene.contacts[0].rest = Vec3::Zero();
    scene.contacts[0].support.obstacle = contact::PlanePair{3e-4, contact::PlaneAxis::z};
    const double step = 2e-3 / contact_frequency_of(m);
    const auto damping = [&](SchemeKind scheme) {
      StepOptions options{scheme, step};
      options.tolerance = 1e-10;
      return simulate(scene, options, m.duration).statistics[0].damping_work;
    };
    const double wanted = damping(SchemeKind::energy_conserving);
    for (const auto scheme : {SchemeKind::splitting, SchemeKind::collocation, SchemeKind::devogelaere,
                              SchemeKind::runge_kutta_54})
      EXPECT_NEAR(damping(scheme) / wanted, 1.0, scheme == SchemeKind::splitting ? 3.0 * agreed : agreed)
          << name_of(scheme) << ", seed " << seed; // splitting: intervals of w_c dt = 0.25
  }
}

TEST(EnergyConserving, SlidesInThePlaneByTheLawWithoutTangentialDamper) {
  // work rate 116.771 W by an integrator with located events (three digits more than asked); a spring that turns half as fast: 107.9
  SingleMass m;
  m.stiffness = Vec3(400, 700, 1100);
  m.damping = 2.0 * 0.02 * m.stiffness.cwiseSqrt();
  m.load = {Harmonic{45.0, 4.0, 0.0}, Harmonic{45.0, 8.0, 0.7}, Harmonic{20.0, 9.0, 0.0}};
  m.gap = -1e-3;
  m.normal.stiffness = 1e5;
  m.tangential_stiffness = 2e4;
  m.mu = 0.3;
  m.duration = 2.0;
  EXPECT_NEAR(simulate(scene_of(m), energy_conserving(1e-4), m.duration).statistics[0].work_rate, 116.771,
              0.02);
  EXPECT_NEAR(simulate(scene_of(m), energy_conserving(8e-4), m.duration).statistics[0].work_rate, 116.771,
              1.0);
}

TEST(EnergyConserving, AgreesWithAnotherIntegratorOnRandomMasses) {
  constexpr double agreed = 1e-3, reference_angle = 5e-4;
  for (const double damping : {0.0, 0.02, 0.3})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const SingleMass m = random_mass(seed, damping);
      const MassFigures wanted = reference(m, reference_angle / contact_frequency_of(m)),
                        found = run_of(m, 0.005);
      for (const auto& [name, difference] : differences(found, wanted))
        EXPECT_LT(difference, 1.1 * agreed) << name << ", seed " << seed << ", C_T " << damping;
      EXPECT_EQ(found.impacts, wanted.impacts) << seed;
      // the time in contact counts steps with a force as whole ones: at most one too much an impact
      const double step = 0.005 / contact_frequency_of(m);
      EXPECT_NEAR(found.contact_time_ratio, wanted.contact_time_ratio,
                  (found.impacts + 1) * step / m.duration + agreed * wanted.contact_time_ratio)
          << seed;
    }
}

TEST(EnergyConserving, IsOfOrderTwoThroughImpactsWithDampersAndFriction) {
  // the mean over scenes and figures of their fall over three halvings: errors of single ones change their sign with the step, and those of
  // the rms normal force fall with the power 1.5 where C_N makes it jump at first touch
  for (const double damping : {0.0, 0.1}) {
    double order = 0.0, figures = 0.0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
      const SingleMass m = random_mass(seed, damping);
      const MassFigures wanted = run_of(m, 0.0025); // its limit is the right one: the test above
      const auto coarse = differences(run_of(m, 0.16), wanted), fine = differences(run_of(m, 0.02), wanted);
      for (std::size_t k = 0; k < coarse.size(); ++k, ++figures)
        order += std::log2(coarse[k].second / fine[k].second) / 3.0;
    }
    EXPECT_GT(order / figures, 1.55) << "C_T " << damping;
    EXPECT_LT(order / figures, 2.4) << "C_T " << damping;
  }
}

} // namespace conserving_impacts_test
