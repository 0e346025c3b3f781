// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes.hpp"
#include <Eigen/LU>
#include <array>
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
  Eigen::VectorXd normal_load = Eigen::VectorXd::Zero(modes), tangential_load = normal_load;
  for (int c = 0; c < 3; ++c) {
    ContactPoint point;
    point.name = "c" + std::to_string(c);
    point.support = {obstacles[c], {stiffness}, friction};
    point.b = Eigen::MatrixXd::Zero(3, modes);
    for (int i = 0; i < modes; ++i) {
      point.b(1, i) = along_y[c][i];
      point.b(2, i) = along_z[c][i];
    }
    normal_load += pressure * point.b.row(1).transpose();
    tangential_load += 40.0 * (point.b.row(1) + point.b.row(2)).transpose();
    s.contacts.push_back(point);
  }
  s.loads = {{Constant{1.0}, normal_load}, {Harmonic{1.0, 31.0}, tangential_load}};
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

// One after the other, once an interval, each with what the others are expected to do: of order 2 as each alone. Where in a step an impact falls scatters the errors
// of one load by ten: rms over some.
TEST(CoupledContacts, AreOfOrderTwo) {
  constexpr std::array loads{90.0, 110.0, 130.0, 150.0, 170.0, 190.0};
  for (const double mu : {0.0, 0.3}) {
    const contact::FrictionLaw friction =
        mu > 0.0 ? contact::FrictionLaw{3e5, 60.0, mu, mu} : contact::FrictionLaw{};
    double coarse = 0.0, fine = 0.0;
    for (const double load : loads) {
      const Scene scene = coupled(load, friction);
      const Eigen::MatrixXd exact = exact_of(scene);
      coarse = std::hypot(coarse, error(scene, exact, 4e-4));
      fine = std::hypot(fine, error(scene, exact, 1e-4));
    }
    const double count = std::sqrt(1.0 * loads.size());
    EXPECT_LT(coarse / count, mu > 0.0 ? 4e-3 : 1.5e-3) << mu;
    EXPECT_LT(fine / count, mu > 0.0 ? 2e-4 : 4e-5) << mu;
    EXPECT_GT(std::log2(coarse / fine) / 2.0, 1.5) << mu;
  }
}

// A rigid bar that turns about an end which rests close to a stop, while the other end hits one: the impact pushes the first end into its stop within
// a step, where the path under the forces before it stays open. It closes where it touches, and the energy is kept.
TEST(CoupledContacts, CloseWhereOthersPushThemIn) {
  constexpr double mass = 60.0, inertia = mass / 3.0; // of a length of 2 m
  Scene s;
  s.duration = 0.5;
  s.system.stiffness = s.system.damping = Eigen::Vector2d::Zero();
  s.q0 = Eigen::Vector2d::Zero();
  s.v0 = Eigen::Vector2d(0.5 * std::sqrt(mass), 0.5 * std::sqrt(inertia));
  for (const double x : {-1.0, 1.0}) {
    ContactPoint point;
    point.name = x < 0.0 ? "rests" : "hits";
    point.support.obstacle = contact::Stop{x < 0.0 ? 1e-4 : 1e-7, contact::PlaneAxis::y};
    point.support.normal = {1e5};
    point.b = Eigen::MatrixXd::Zero(3, 2);
    point.b.row(1) << 1.0 / std::sqrt(mass), x / std::sqrt(inertia);
    s.contacts.push_back(point);
  }
  const double longest = 1.4 / choose_step(s, splitting()).contact_frequency;
  const Eigen::MatrixXd exact = exact_of(s);
  for (const double shift : {1.0, 0.93, 0.86, 0.77}) { // other places of the touch in a step
    const History run = simulate(s, splitting(longest * shift), every);
    EXPECT_LT(run.report.residual_relative, 2e-3) << shift;
    EXPECT_LT((run.q - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff(), 2e-3) << shift;
  }
}

namespace {

/// So many equal contacts, each moved by the others by `share` of what it moves itself, held between stops by a bound that nothing reaches.
Scene equal_contacts(int count, double share, double stiffness_n, const contact::FrictionLaw& friction) {
  Scene s;
  s.duration = 0.2;
  const Eigen::MatrixXd w =
      (1.0 - share) * Eigen::MatrixXd::Identity(count, count) + share * Eigen::MatrixXd::Ones(count, count);
  const Eigen::MatrixXd b = w.llt().matrixL();
  const Eigen::Index n = 2 * count; // modes along y, along z
  s.system.stiffness = Eigen::VectorXd::Constant(n, 100.0);
  s.system.damping = Eigen::VectorXd::Zero(n);
  s.q0 = s.v0 = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd normal_load = Eigen::VectorXd::Zero(n), tangential_load = normal_load;
  for (int c = 0; c < count; ++c) {
    ContactPoint point;
    point.name = "c" + std::to_string(c);
    point.support = {contact::Stop{0.0, contact::PlaneAxis::y}, {stiffness_n}, friction};
    point.b = Eigen::MatrixXd::Zero(3, n);
    point.b.row(1).head(count) = b.row(c);
    point.b.row(2).tail(count) = b.row(c);
    normal_load += 100.0 * point.b.row(1).transpose();
    tangential_load += (c % 2 ? 10.0 : 30.0) * point.b.row(2).transpose();
    s.contacts.push_back(point);
  }
  s.loads = {{Constant{1.0}, normal_load}, {Harmonic{1.0, 20.0}, tangential_load}};
  return s;
}

double rate_of(int count, double share) { return 1.0 + (count - 1) * share; } // the largest eigenvalue of W

} // namespace

// One after the other, once an interval, contacts that depend on each other by more than a tenth would diverge: they act again.
TEST(CoupledContacts, AreStableWithDampersOfAnySize) {
  constexpr double k = 1e5, step = 1e-3;
  for (const int count : {2, 3, 6})
    for (const double share : {0.3, 0.6, 0.9})
      for (const double rate : {1.0, 6.3, 60.0}) { // r_t h
        const double damping = rate / (step * rate_of(count, share));
        const Scene scene = equal_contacts(count, share, k / rate_of(count, share), {k, damping, 50.0, 50.0});
        const History run = simulate(scene, splitting(step), every);
        const Energy& energy = run.report.energy;
        const auto name = testing::Message() << count << ' ' << share << ' ' << rate;
        EXPECT_EQ(run.report.outcome, Outcome::done) << name;
        EXPECT_LT(run.along_t.cwiseAbs().maxCoeff(), 100.0) << name;
        EXPECT_LT(std::abs(energy.residual()), 0.05 * energy.scale) << name;
        EXPECT_GT(energy.contact_damping, -1e-3 * energy.scale) << name;
      }
}

// Hunt and Crossley's damper grows with the penetration: what a contact answers the others does too.
TEST(CoupledContacts, GainNoEnergyByDissipation) {
  constexpr double step = 1e-4, pressed = 100.0; // N
  for (const int count : {2, 6})
    for (const double share : {0.6, 0.9})
      for (const double rate : {3.0, 20.0, 100.0}) { // d F W h, of all where they are pressed
        const double mobility = rate_of(count, share), k = 0.09 / (step * step * mobility);
        Scene scene = equal_contacts(count, share, k, {});
        for (ContactPoint& point : scene.contacts)
          point.support.normal.dissipation = rate / (pressed * mobility * step);
        const History run = simulate(scene, splitting(step), every);
        const Energy& energy = run.report.energy;
        const auto name = testing::Message() << count << ' ' << share << ' ' << rate;
        EXPECT_LT(std::abs(energy.residual()), 1e-5 * energy.scale) << name; // 1e-3 where it is left out
      }
}

TEST(CoupledContacts, AreStableAtAnyStep) {
  constexpr double step = 1e-3;
  for (const int count : {2, 6})
    for (const double share : {0.3, 0.9})
      for (const double resolution : {1.0, 2.0, 6.0}) { // w_c h
        const double k = resolution * resolution / (step * step * rate_of(count, share));
        const Scene scene = equal_contacts(count, share, k, {});
        const History run = simulate(scene, splitting(step), every);
        const auto name = testing::Message() << count << ' ' << share << ' ' << resolution;
        EXPECT_EQ(run.report.outcome, Outcome::done) << name;
        EXPECT_LT(run.normal.maxCoeff(), 1000.0) << name;
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
