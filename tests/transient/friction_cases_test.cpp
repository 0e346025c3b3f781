// SPDX-License-Identifier: GPL-3.0-or-later
// Friction with closed solutions: Coulomb decay, shaking table, stopping block, forced oscillator.
#include "scenes.hpp"
#include <gtest/gtest.h>
#include <numbers>

namespace friction_cases_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::FrictionLaw;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double asked = 1e-3;
constexpr double last_asked =
    5e-3; // of the smallest extremum of the decay, where the spring of the contact shows

FrictionLaw with_automatic_damping(double stiffness, double mode_stiffness, double mu) {
  return {stiffness, contact::automatic_tangential_damping(stiffness, mode_stiffness, 1.0, 0.0), mu, mu};
}

/// A1: m = 1 on k = 1e4 along the 45 degree line of x_loc and y_loc, F_N = 10, mu = 0.1.
Scene coulomb_decay() {
  Scene s = mass_point(1.0, Vec3(1e4, 1e4, 0), 5.0 * pi / 100.0);
  start(s, 1.0, Vec3(1, 1, 0) * 0.85e-3 / std::sqrt(2.0), Vec3::Zero());
  s.contacts = {pressed(1.0, 10.0, with_automatic_damping(4e5, 1e4, 0.1))};
  return s;
}

void check_decay(const StepOptions& options) {
  const History run = simulate(coulomb_decay(), options, pi / 100.0);
  const double extrema[] = {-4.5961941e-4, 3.1819805e-4, -1.7677670e-4, 3.5355339e-5};
  for (int n = 0; n < 4; ++n)
    for (int axis = 0; axis < 2; ++axis)
      EXPECT_NEAR(run.q(axis, n + 1) / extrema[n], 1.0, n < 3 ? asked : last_asked) << "extremum " << n + 1;
  EXPECT_NEAR(run.q(0, 5) / run.q(0, 4), 1.0, 0.1); // it sticks: what the contact's spring takes of 1e4/4e5
  EXPECT_EQ(run.statistics[0].contact_time_ratio, 1.0);
}

/// A3: a block on a table that shakes at 1 Hz with acceleration `a`.
Scene shaking_table(double a) {
  Scene s = mass_point(1.0, Vec3(3e-5, 3e-5, 0), 12.0);
  s.contacts = {pressed(1.0, 10.0, with_automatic_damping(9e6, 3e-5, 0.1))};
  s.loads = {force_on(1.0, Vec3(0, -a, 0), Harmonic{1.0, 1.0, 0.0})};
  return s;
}

class FrictionCases : public testing::TestWithParam<Candidate> {};

} // namespace

TEST_P(FrictionCases, DecayLosesTwiceTheBoundOverTheStiffnessPerHalfPeriod) {
  check_decay(GetParam().options(2e-6));
}

TEST_P(FrictionCases, ShakingTableSlidesWithTheWorkRateOfItsClosedForm) {
  const History run = simulate(shaking_table(1.5), GetParam().options(2e-5), 12.0, 4.0);
  EXPECT_NEAR(run.statistics[0].work_rate / 0.40906245, 1.0, asked);
  EXPECT_NEAR(run.statistics[0].friction_power / 0.040906245, 1.0, asked);
}

TEST_P(FrictionCases, ShakingTableBelowTheBoundSticks) {
  const History run = simulate(shaking_table(0.99), GetParam().options(2e-5), 12.0, 4.0);
  EXPECT_EQ(run.statistics[0].work_rate, 0.0);
  const bool integrates =
      GetParam().kind == SchemeKind::devogelaere || GetParam().kind == SchemeKind::runge_kutta_54;
  const double round_off = integrates ? 1e-20 : 0.0; // W, of the sliders
  EXPECT_NEAR(run.statistics[0].friction_power, 0.0, round_off);
}

TEST_P(FrictionCases, BlockStopsWhereCoulombSaysAndItsSpringDiesOut) {
  // A10: mu g = 1 m/s2, from 0.2 m/s: stops after 0.2 s and 0.02 m
  constexpr double v0 = 0.2, kt = 1e5, bound = 1.0;
  Scene s = mass_point(1.0, Vec3::Zero(), 0.4);
  start(s, 1.0, Vec3::Zero(), Vec3(0.6 * v0, 0.8 * v0, 0));
  s.contacts = {pressed(1.0, 10.0, with_automatic_damping(kt, 0.0, 0.1))};
  const History run = simulate(s, GetParam().options(1e-5), 0.01);
  const auto travel = [&](Eigen::Index j) { return 0.6 * run.q(0, j) + 0.8 * run.q(1, j); };
  const double end = v0 * v0 / 2.0;
  const double spring = bound / kt; // mu F_N / K_T, m
  EXPECT_NEAR(travel(20), end, spring);
  EXPECT_NEAR(travel(40), end - spring, (GetParam().first_order() ? 0.101 : 1e-6) * spring);
  EXPECT_GT(run.v.col(18).norm(), 0.015);
  for (Eigen::Index j = 21; j <= 40; ++j)
    EXPECT_LT(std::abs(travel(j) - travel(40)), spring);
  constexpr double at_rest = 1e-9; // of v0: critically damped for 60 time constants
  EXPECT_LT(run.v.col(40).norm(), at_rest * v0);
}

TEST_P(FrictionCases, OscillatorHasDenHartogsAmplitude) {
  // A9: r = 0.8, F_f/F_0 = 0.4: X k / F_0 = 2.50179
  constexpr double k = 1.0, f0 = 1.0, ratio = 0.4, r = 0.8;
  const double frequency = r / (2.0 * pi), period = 1.0 / frequency;
  Scene s = mass_point(1.0, Vec3(0, k, 0), 60.0 * period);
  s.contacts = {pressed(1.0, ratio * f0 / 0.1, with_automatic_damping(2e4, k, 0.1))};
  s.loads = {force_on(1.0, Vec3(0, f0, 0), Harmonic{1.0, frequency, 0.0})};
  const History run = simulate(s, GetParam().options(2e-4), period / 4000.0);
  const Eigen::Index last = 5 * 4000;
  EXPECT_NEAR(run.q.row(1).tail(last).cwiseAbs().maxCoeff() / 2.50179, 1.0, asked);
}

TEST_P(FrictionCases, DamperTakesItsShareWhereASlideBegins) {
  // C_T = 0: stick x = F/K_T (1 - cos w t) up to mu_s F_N, then a uniform acceleration under mu_d F_N
  constexpr double kt = 1e4, normal = 10.0, mu_s = 0.5, mu_d = 0.2, duration = 0.03;
  const double w = std::sqrt(kt), at_onset = 0.5 * std::pow((mu_s - mu_d) * normal, 2) / kt; // J
  struct Line {
    contact::Vec2 along;
    Vec3 load; ///< its direction
  };
  for (const Line& line : {Line{{1.0, 1.0}, {0.6, 0.8, 0.0}}, Line{{1.0, 0.0}, {1.0, 0.0, 0.0}},
                           Line{{0.0, 1.0}, {0.0, 1.0, 0.0}}})
    for (const double force : {5.6, 5.8, 6.0, 6.2, 6.4}) { // begins to slide anywhere in a step
      Scene s = mass_point(1.0, Vec3::Zero(), duration);
      FrictionLaw law{kt, 0.0, mu_s, mu_d};
      law.along = line.along;
      s.contacts = {pressed(1.0, normal, law)};
      s.loads = {force_on(1.0, force * line.load, Constant{1.0})};
      const double angle = std::acos(1.0 - mu_s * normal / force), left = duration - angle / w;
      const double speed = force / w * std::sin(angle),
                   slid = left * speed + 0.5 * left * left * (force - mu_d * normal),
                   friction = mu_d * normal * (slid + (mu_s - mu_d) * normal / kt);
      const History run = simulate(s, GetParam().options(1e-7), duration);
      const double tolerance = GetParam().tolerance();
      EXPECT_NEAR(run.report.energy.friction, friction, tolerance * friction) << force;
      EXPECT_NEAR(run.report.energy.contact_damping, at_onset, 10.0 * tolerance * at_onset) << force;
      EXPECT_NEAR(run.statistics[0].work_rate * duration, normal * slid, 5.0 * tolerance * normal * slid)
          << force;
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, FrictionCases, testing::ValuesIn(candidates), name_of_candidate);

} // namespace friction_cases_test
