// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that stick under dampers of any speed, as those of a rod in its grids: nodes between two pressed stops each, modes to any frequency.
#include "scenes.hpp"
#include "transient/splitting/splitting.hpp"
#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace sticking_contacts_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;

namespace {

constexpr double overlap = 1e-3; // m: far above the motion

class Draw {
public:
  explicit Draw(unsigned seed) : generator_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / static_cast<double>(std::mt19937::max());
  }
  double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

private:
  std::mt19937 generator_;
};

/// At rest but for the velocities of its modes. @param damper_rate, normal_rate  of contacts, over the frequency of the highest mode
Scene held_between_stops(unsigned seed, double damper_rate, double normal_rate = 0.0,
                         bool hunt_crossley = false) {
  Draw draw(seed);
  const int nodes = 1 + static_cast<int>(draw.uniform(0.0, 6.0)),
            each = static_cast<int>(draw.uniform(8.0, 24.0)), modes = 3 * each;
  Scene scene;
  scene.system.stiffness.resize(modes);
  const double highest = draw.logarithmic(500.0, 6000.0); // rad/s
  const bool bends = draw.uniform(0.0, 1.0) < 0.6;
  for (int i = 0; i < modes; ++i) {
    const double share = (1.0 + i / 3) / each;
    scene.system.stiffness(i) = std::pow(highest * (bends ? share * share : share) + 1.0, 2);
  }
  scene.system.damping = 0.01 * scene.system.stiffness.cwiseSqrt();
  const double middle = draw.uniform(0.1, 0.9), spread = draw.logarithmic(0.01, 1.0),
               contact_frequency = highest * draw.logarithmic(0.1, 1.0);
  double mobility = 0.0;
  for (int node = 0; node < nodes; ++node) {
    const double x = std::fmod(middle + spread * draw.uniform(0.0, 1.0), 1.0);
    ContactPoint point;
    point.support.obstacle = contact::Stop{0.0, contact::PlaneAxis::y};
    point.rest = {0.0, overlap, 0.0};
    point.b = Eigen::MatrixXd::Zero(3, modes);
    for (int i = 0; i < modes; ++i)
      point.b((i + 1) % 3, i) = std::sin((1 + i / 3) * std::numbers::pi * x);
    mobility = std::max(mobility, point.b.row(1).squaredNorm());
    scene.contacts.push_back(point);
    point.b.bottomRows(2) *= -1.0;
    scene.contacts.push_back(point);
  }
  const double normal = 0.5 * contact_frequency * contact_frequency / mobility,
               tangential = normal * draw.logarithmic(0.05, 1.0),
               damping = 0.5 * normal_rate * highest / mobility;
  contact::NormalLaw law{normal, damping};
  if (hunt_crossley)
    law = {normal, 0.0, damping / (normal * overlap)};
  for (ContactPoint& point : scene.contacts)
    point.support = {
        point.support.obstacle, law, {tangential, 0.5 * damper_rate * highest / mobility, 10.0, 10.0}};
  scene.q0 = Eigen::VectorXd::Zero(modes);
  scene.v0 = Eigen::VectorXd::NullaryExpr(
      modes, [&] { return 1e-5 * highest / std::sqrt(modes) * draw.uniform(-1.0, 1.0); });
  scene.duration = 6000.0 / highest; // so that it is not the fewest steps of a run that are taken
  return scene;
}

/// Of the energy that the modes begin with.
double growth(const Scene& scene) {
  StepOptions options;
  options.scheme = SchemeKind::splitting;
  const Report report = run(scene, choose_step(scene, options), {}, nullptr, {});
  const double pressed = static_cast<double>(scene.contacts.size()) *
                         scene.contacts.front().support.normal.spring_energy(overlap);
  return (report.energy.stored - pressed) / (0.5 * scene.v0.squaredNorm());
}

/// Three masses in a row on a spring, the middle one between two pressed stops on which it sticks by fast dampers; it starts with a velocity that makes it slip.
Scene row_held_in_its_middle() {
  const Eigen::Vector3d masses{0.3587, 0.05764, 0.4003}; // kg
  const Eigen::Matrix3d springs{{0.1618e6, 0.1780e6, 0.2103e6},
                                {1.171e6, 3.083e6, 3.164e6},
                                {79.34e6, 58.33e6, 148.4e6}}; // N/m along x y z: to the ground, first, second
  const Eigen::Vector3d velocity{1.56e-4, 3.64e-4, 5.20e-4};  // m/s
  const double pressed = 2.053e-6;                            // m
  Scene scene;
  scene.system.stiffness.resize(9);
  scene.v0.resize(9);
  ContactPoint point;
  point.support = {
      contact::Stop{0.0, contact::PlaneAxis::y}, {0.8796e6, 0.0}, {6.067e4, 6809.0, 0.9355, 0.9355}};
  point.rest = {0.0, pressed, 0.0};
  point.b = Eigen::MatrixXd::Zero(3, 9);
  const Eigen::Vector3d root = masses.cwiseSqrt().cwiseInverse();
  for (int axis = 0; axis < 3; ++axis) {
    const double ground = springs(0, axis), first = springs(1, axis), second = springs(2, axis);
    const Eigen::Matrix3d stiffness{
        {ground + first, -first, 0.0}, {-first, first + second, -second}, {0.0, -second, second}};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(root.asDiagonal() * stiffness *
                                                               root.asDiagonal());
    scene.system.stiffness.segment(3 * axis, 3) = modes.eigenvalues();
    const Eigen::RowVector3d of_middle = root(1) * modes.eigenvectors().row(1);
    point.b.block(axis, 3 * axis, 1, 3) = of_middle;
    scene.v0.segment(3 * axis, 3) = masses(1) * velocity(axis) * of_middle.transpose();
  }
  scene.contacts.push_back(point);
  point.b.bottomRows(2) *= -1.0;
  scene.contacts.push_back(point);
  scene.system.damping = 2e-4 * scene.system.stiffness.cwiseSqrt();
  scene.q0 = Eigen::VectorXd::Zero(9);
  scene.duration = 0.9;
  return scene;
}

constexpr int axial = 8, modes_of_rod = 9; ///< the last mode moves it along its axis
constexpr double along_axis = 0.03; ///< kg^-1/2, its shape there: of a mass a thousand times that of bending
constexpr double speed = 1e-3;      ///< m kg^1/2/s, at the start

/// A rod between pairs of pressed stops at five places, whose friction acts along its axis alone; it starts along it. @param damping  C_T, N s/m
Scene rod_stuck_along_its_axis(double stiffness, double damping) {
  Scene scene;
  scene.system.stiffness.resize(modes_of_rod);
  for (int i = 0; i < axial; ++i)
    scene.system.stiffness(i) = std::pow(100.0 * (1 + i / 2) * (1 + i / 2), 2);
  scene.system.stiffness(axial) = std::pow(700.0, 2);
  scene.system.damping = Eigen::VectorXd::Zero(modes_of_rod);
  for (const double x : {0.13, 0.31, 0.48, 0.66, 0.87}) {
    ContactPoint point;
    point.support = {contact::Stop{0.0, contact::PlaneAxis::y}, {2e5}, {stiffness, damping, 10.0, 10.0}};
    point.support.friction.along = {1.0, 0.0};
    point.rest = {0.0, overlap, 0.0};
    point.b = Eigen::MatrixXd::Zero(3, modes_of_rod);
    for (int i = 0; i < axial; ++i)
      point.b(1 + i % 2, i) = std::sin((1 + i / 2) * std::numbers::pi * x);
    point.b(0, axial) = along_axis;
    scene.contacts.push_back(point);
    point.b.bottomRows(2) *= -1.0;
    scene.contacts.push_back(point);
  }
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(modes_of_rod);
  scene.v0(axial) = speed; // springs are slack at the start
  scene.duration = 3.0;
  return scene;
}

} // namespace

TEST(StickingContacts, FollowTheirOscillatorAlongAHeavyAxis) {
  // ten springs and dampers beside each other on one mode: damped as it vibrates, and above the critical damping
  constexpr double stiffness = 2e7;
  const double w2 = std::pow(700.0, 2) + 10.0 * stiffness * along_axis * along_axis;
  constexpr double cases[][2] = {{20.0, 1e-3},
                                 {300.0, 5e-4},
                                 {3e3, 5e-3},
                                 {1e4, 9e-3},
                                 {1e5, 0.031}}; // 10 C_T W, 1/s; bound of the error
  for (const auto& [rate, bound] : cases) {
    const Scene scene = rod_stuck_along_its_axis(stiffness, rate / (10.0 * along_axis * along_axis));
    StepOptions options;
    options.scheme = SchemeKind::splitting;
    const StepChoice choice = choose_step(scene, options);
    const auto scheme =
        make_splitting(scene, choice.step, {.fastest = choice.fastest, .parts = choice.parts});
    Eigen::VectorXd q(modes_of_rod), v(modes_of_rod);
    const std::complex<double> root = std::sqrt(std::complex<double>(0.25 * rate * rate - w2)),
                               fast = -0.5 * rate - root, slow = -0.5 * rate + root;
    double worst = 0.0, largest = 0.0;
    while (scheme->next_time() < scene.duration) {
      const Record& record = scheme->advance();
      const double t = record.time + 0.5 * record.step; // inside it the modes move as under a linear force
      scheme->state_at(t, q.data(), v.data());
      const double exact = speed * ((std::exp(slow * t) - std::exp(fast * t)) / (slow - fast)).real();
      largest = std::max(largest, std::abs(exact));
      worst = std::max(worst, std::abs(q(axial) - exact));
    }
    EXPECT_LT(worst / largest, bound)
        << rate; // the last two 0.085 and 0.17 if they answered as by the mass of bending
  }
}

TEST(StickingContacts, KeepTheEnergyWhereTheyStartToSlipBesideAFastStructure) {
  const Scene scene = row_held_in_its_middle();
  StepOptions options;
  options.scheme = SchemeKind::splitting;
  const StepChoice step = choose_step(scene, options);
  EXPECT_GT(step.damper_rate * step.step, 6.3); // not resolved by an interval
  EXPECT_GT(step.highest_mode * step.step, 1.9);
  const Report report = run(scene, step, {}, nullptr, {});
  EXPECT_GT(report.energy.friction, 0.0);
  EXPECT_NEAR(report.energy.residual(), 0.0, 0.05 * report.energy.dissipated()); // in two intervals 0.3 of it
}

/// Of a structure drawn from a seed, at the automatic step.
class PressedStructure : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, PressedStructure, testing::Range(0U, 8U));

TEST_P(PressedStructure, LosesEnergyWhereItSticksByDampers) {
  for (const double damper_rate : {0.3, 3.0, 30.0, 150.0})
    EXPECT_LT(growth(held_between_stops(GetParam(), damper_rate)), 1.0) << damper_rate;
}

TEST_P(PressedStructure, LosesEnergyBesideNormalDampers) {
  for (const double normal_rate : {0.3, 3.0, 15.0})
    for (const double damper_rate : {0.0, 30.0})
      EXPECT_LT(growth(held_between_stops(GetParam(), damper_rate, normal_rate)), 1.0)
          << normal_rate << " " << damper_rate;
}

TEST_P(PressedStructure, LosesEnergyBesideHuntAndCrossleysDampers) {
  for (const double normal_rate : {0.3, 3.0, 15.0})
    EXPECT_LT(growth(held_between_stops(GetParam(), 0.0, normal_rate, true)), 1.0) << normal_rate;
}

/// Two more, the first of which has twelve contacts, in 64 intervals a step.
class TwelveContacts : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(DamperRates, TwelveContacts, testing::Values(0.3, 3.0, 30.0, 150.0));

TEST_P(TwelveContacts, LoseEnergyInTheMostIntervals) {
  for (const unsigned seed : {8U, 9U})
    EXPECT_LT(growth(held_between_stops(seed, GetParam())), 1.0) << seed;
}

TEST(PressedContacts, LoseEnergyInTheMostIntervalsBesideNormalDampers) {
  EXPECT_LT(growth(held_between_stops(8, 150.0, 3.0)), 1.0);
}

} // namespace sticking_contacts_test
