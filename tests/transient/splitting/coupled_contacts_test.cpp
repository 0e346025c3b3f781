// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes.hpp"
#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>

namespace fretwork::tests::coupled_contacts_test {

using namespace signals;
using namespace transient;

namespace {

constexpr double stiffness = 1e6, duration = 0.1, every = 1e-3;
constexpr int modes = 4;

/// Contacts pressed on stops and in a hole that move each other by 0.3 to 0.9 of what they move themselves: w_c is 1.9 times that of one alone.
/// @param pressure  N, by which a harmonic load is exceeded, or not
Scene coupled(double pressure, const contact::FrictionLaw& friction) {
  Scene s;
  s.duration = duration;
  s.system.stiffness = Eigen::Vector4d(1e3, 2e4, 9e4, 4e5);
  s.system.damping = 2.0 * 0.01 * s.system.stiffness.cwiseSqrt();
  s.q0 = s.v0 = Eigen::VectorXd::Zero(modes);
  const contact::Obstacle obstacles[] = {contact::Stop{0.0, contact::PlaneAxis::y}, contact::Circle{1e-4},
                                         contact::Stop{0.0, contact::PlaneAxis::y}};
  const double along_y[][modes] = {{0.5, 0.2, 0.1, 0.0}, {0.4, 0.0, 0.2, 0.1}, {0.45, -0.2, 0.1, 0.1}};
  const double along_z[][modes] = {{0.1, 0.4, 0.0, 0.2}, {0.0, 0.3, 0.1, 0.2}, {0.1, 0.4, 0.1, 0.0}};
  Eigen::VectorXd pressing = Eigen::VectorXd::Zero(modes), rubbing = pressing;
  for (int c = 0; c < 3; ++c) {
    ContactPoint point;
    point.name = "c" + std::to_string(c);
    point.support = {obstacles[c], {stiffness}, friction};
    point.b = Eigen::MatrixXd::Zero(3, modes);
    for (int i = 0; i < modes; ++i) {
      point.b(1, i) = along_y[c][i];
      point.b(2, i) = along_z[c][i];
    }
    pressing += pressure * point.b.row(1).transpose();
    rubbing += 40.0 * (point.b.row(1) + point.b.row(2)).transpose();
    s.contacts.push_back(point);
  }
  s.loads = {{Constant{1.0}, pressing}, {Harmonic{1.0, 31.0}, rubbing}};
  return s;
}

/// Of displacements, relative to the largest.
double error(const Scene& scene, const Eigen::MatrixXd& exact, double step) {
  const History run = simulate(scene, splitting(step), every);
  return (run.q - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

Eigen::MatrixXd exact_of(const Scene& scene) {
  StepOptions options;
  options.scheme = SchemeKind::runge_kutta_54;
  options.tolerance = 1e-11;
  return simulate(scene, options, every).q;
}

} // namespace

// One after the other, once an interval, each with what the others are expected to do: of order 2 as each alone.
TEST(CoupledContacts, AreOfOrderTwo) {
  for (const double mu : {0.0, 0.3}) {
    const contact::FrictionLaw friction =
        mu > 0.0 ? contact::FrictionLaw{3e5, 60.0, mu, mu} : contact::FrictionLaw{};
    const Scene scene = coupled(150.0, friction);
    const Eigen::MatrixXd exact = exact_of(scene);
    const double coarse = error(scene, exact, 4e-4), fine = error(scene, exact, 1e-4);
    EXPECT_LT(coarse, 2e-2) << mu;
    EXPECT_GT(std::log2(coarse / fine) / 2.0, 1.5) << mu;
  }
}

// Dampers that let nothing slip within an interval, in contacts that move each other: stable, and dissipative.
TEST(CoupledContacts, AreStableWithDampersOfAnySize) {
  for (const double damping : {1e3, 1e5, 1e7}) {
    const Scene scene = coupled(150.0, {3e5, damping, 0.8, 0.8});
    const History run = simulate(scene, splitting(4e-4), every);
    EXPECT_EQ(run.report.outcome, Outcome::done) << damping;
    EXPECT_LT(run.q.cwiseAbs().maxCoeff(), 1.0) << damping;
    EXPECT_GE(run.report.energy.friction, 0.0) << damping;
    EXPECT_LT(std::abs(run.report.energy.residual()) / run.report.energy.scale, 2e-2) << damping;
  }
}

// What all contacts hold stays where it is, whatever the step.
TEST(CoupledContacts, RestTogether) {
  Scene scene = coupled(150.0, {3e5, 60.0, 0.3, 0.3});
  scene.loads.pop_back();
  Eigen::MatrixXd stiff = scene.system.stiffness.asDiagonal();
  // equilibrium by iteration: the hole turns its normal
  Eigen::VectorXd q = Eigen::VectorXd::Zero(modes);
  for (int i = 0; i < 200; ++i) {
    Eigen::MatrixXd k = stiff;
    Eigen::VectorXd f = scene.loads[0].modal_force;
    for (const ContactPoint& point : scene.contacts) {
      const Eigen::Vector3d u = point.b * q;
      const contact::Location at = contact::locate(point.support.obstacle, u.y(), u.z());
      const Eigen::RowVectorXd n = at.ny * point.b.row(1) + at.nz * point.b.row(2);
      if (at.gap < 0.0 || i == 0) {
        k += stiffness * n.transpose() * n;
        f += stiffness * (n.dot(q) - at.gap) * n.transpose();
      }
    }
    q = k.partialPivLu().solve(f);
  }
  scene.q0 = q;
  for (const double step : {1e-4, 1e-3}) {
    const History run = simulate(scene, splitting(step), every);
    EXPECT_LT((run.q.colwise() - q).cwiseAbs().maxCoeff() / q.cwiseAbs().maxCoeff(), 1e-6) << step;
  }
}

} // namespace fretwork::tests::coupled_contacts_test
