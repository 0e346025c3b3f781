// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that give way beside the modes along a smooth path, with every law: of order 2, the limit of stiff modes, in balance.
#include "core/symmetric.hpp"
#include "scenes.hpp"
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace flexible_paths_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;

namespace {

/// Along all directions.
const Eigen::Matrix3d flexibility =
    5e-4 * (Eigen::Matrix3d() << 1.0, 0.3, -0.2, 0.3, 1.2, 0.4, -0.2, 0.4, 0.9).finished();

constexpr int outputs = 37;

/// The scene whose residual flexibility is in modes of frequency w, R = b b^T/w^2; they follow up to 2 zeta w_motion/w. One contact.
Scene with_stiff_modes(Scene scene, double w, double zeta) {
  const Eigen::Index n = scene.system.size();
  const auto [values, vectors] = core::symmetric_eigenpairs(scene.residual);
  for (Eigen::VectorXd* x : {&scene.system.stiffness, &scene.system.damping, &scene.q0, &scene.v0}) {
    x->conservativeResize(n + 3);
    x->tail(3).setZero();
  }
  scene.system.stiffness.tail(3).setConstant(w * w);
  scene.system.damping.tail(3).setConstant(2.0 * zeta * w);
  scene.contacts[0].b.conservativeResize(3, n + 3);
  scene.contacts[0].b.rightCols(3) = w * vectors * values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
  for (Load& load : scene.loads) {
    load.modal_force.conservativeResize(n + 3);
    load.modal_force.tail(3).setZero();
  }
  scene.residual.resize(0, 0);
  return scene;
}

struct Motion {
  Eigen::MatrixXd q, v, force;
};
Motion motion(const Scene& scene, const StepOptions& options) {
  const History run = simulate(scene, options, scene.duration / outputs);
  Motion out{run.q.topRows(4).rightCols(outputs), run.v.topRows(4).rightCols(outputs),
             Eigen::MatrixXd(3, outputs)};
  out.force << run.normal.rightCols(outputs), run.along_x.rightCols(outputs), run.along_t.rightCols(outputs);
  return out;
}
std::array<double, 3> apart(const Motion& a, const Motion& b) {
  return {(a.q - b.q).cwiseAbs().maxCoeff() / b.q.cwiseAbs().maxCoeff(),
          (a.v - b.v).cwiseAbs().maxCoeff() / b.v.cwiseAbs().maxCoeff(),
          (a.force - b.force).cwiseAbs().maxCoeff() / b.force.cwiseAbs().maxCoeff()};
}

struct Law {
  const char* name;
  contact::NormalLaw normal;
  contact::FrictionLaw friction;
  Vec3 velocity;
};
constexpr auto reference = contact::FrictionMemoryKind::reference;
const Law laws[] = {
    {"spring", {1000.0}, {}, {0.05, 0.1, 0.05}},
    {"damper", {1000.0, 10.0}, {}, {0.0, 0.0, 0.0}},
    {"hunt_crossley", {1000.0, 0.0, 0.3}, {}, {0.05, 0.1, 0.05}},
    {"stick", {1000.0}, {800.0, 0.0, 20.0, 20.0}, {0.05, 0.1, 0.05}},
    {"damped stick", {1000.0, 5.0}, {800.0, 5.0, 20.0, 20.0}, {0.0, 0.0, 0.0}},
    {"slip", {1000.0}, {800.0, 20.0, 0.1, 0.1}, {1.5, 2.0, 0.0}},
    {"reference stick", {1000.0}, {800.0, 0.0, 20.0, 20.0, reference}, {0.05, 0.1, 0.05}},
    {"reference slip", {1000.0}, {800.0, 20.0, 0.1, 0.1, reference}, {1.5, 2.0, 0.0}},
};

/// The force on the node of the path in equilibrium at t = 0.
Vec3 pressed_at_start(double stiffness) {
  Vec3 force = Vec3::Zero();
  for (int i = 0; i < 100; ++i) { // contracts by R F/radius
    const Vec3 x = Vec3(0.0, 0.0, 1.05) + flexibility * force;
    const Vec3 n = -Vec3(0.0, x.y(), x.z()).normalized();
    const double give = n.dot(flexibility * n);
    force = stiffness / (1.0 + stiffness * give) * (std::hypot(x.y(), x.z()) - 1.0 + give * n.dot(force)) * n;
  }
  return force;
}

} // namespace

TEST(FlexibleContacts, KeepOrderTwo) {
  for (const Law& law : laws) {
    Scene s = pressed_on_a_circle(law.normal, 1.0, law.friction, law.velocity);
    s.residual = flexibility;
    const Motion finest = motion(s, splitting(s.duration / 16384.0));
    const auto coarse = apart(motion(s, splitting(s.duration / 256.0)), finest),
               fine = apart(motion(s, splitting(s.duration / 2048.0)), finest);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GT(std::log2(coarse[i] / fine[i]) / 3.0, 1.8)
          << law.name << " " << i << " " << coarse[i] << " " << fine[i];
      EXPECT_LT(fine[i], 1e-3) << law.name << " " << i;
    }
  }
}

TEST(FlexibleContacts, AreTheLimitOfStiffModes) {
  constexpr double w = 1e4, zeta = 0.5, share = 0.02;
  for (const Law& law : laws) {
    const Scene rigid = pressed_on_a_circle(law.normal, 1.0, law.friction, law.velocity);
    Scene flexible = rigid;
    flexible.residual = flexibility;
    Scene stiff = with_stiff_modes(flexible, w, zeta);
    stiff.q0.tail(3) =
        stiff.contacts[0].b.rightCols(3).transpose() * pressed_at_start(law.normal.stiffness) / (w * w);
    const Motion wanted = motion(stiff, energy_conserving(2e-5));
    const auto with = apart(motion(flexible, splitting(5e-5)), wanted),
               without = apart(motion(rigid, splitting(5e-5)), wanted);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GT(without[i], 0.01) << law.name << " " << i;
      EXPECT_LT(with[i], share * without[i]) << law.name << " " << i;
    }
  }
}

TEST(FlexibleContacts, BalanceTheEnergyInOrderTwo) {
  for (const Law& law : laws) {
    Scene s = pressed_on_a_circle(law.normal, 1.0, law.friction, law.velocity);
    s.residual = flexibility;
    const auto residual = [&](double h) {
      return simulate(s, splitting(h), s.duration).report.residual_relative;
    };
    const double coarse = residual(s.duration / 128.0), fine = residual(s.duration / 1024.0);
    const double fall = law.velocity.norm() > 1.0
                            ? 6.0
                            : 30.0; // of 8, of 64: those that slip stick at first, which is a kink
    EXPECT_LT(fine, coarse / fall) << law.name;
    EXPECT_LT(fine, 1e-4) << law.name;
  }
  Scene s = rattling(4, 12, 0.5);
  s.residual = 2e-6 * (Eigen::MatrixXd::Identity(12, 12) + 0.5 * Eigen::MatrixXd::Ones(12, 12));
  const History run = simulate(s, splitting(5e-5), 0.1);
  EXPECT_LT(run.report.residual_relative, 5e-3);
  EXPECT_EQ(run.report.counts.unconverged, 0);
  const StepCounts fine = simulate(s, splitting(1e-5), 0.1).report.counts;
  EXPECT_EQ(fine.unconverged, 0);
}

TEST(FlexibleContacts, TurnWithTheirForcesRoundHoles) {
  // K_N R = 15 and more, shared, along y less than along z; nothing tangential holds the contacts
  Scene s = rattling(4, 12, 0.5);
  for (ContactPoint& point : s.contacts)
    point.support.friction = {};
  const double r = 15.0 / s.contacts.front().support.normal.stiffness;
  Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(12, 12);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 3; ++k)
        shared(3 * i + k, 3 * j + k) = r * (i == j ? 1.5 : 0.5) * (k == 1 ? 0.3 : 1.0);
  s.residual = shared;
  const History run = simulate(s, splitting(5e-5), 0.1);
  EXPECT_GT(run.normal.maxCoeff(), 0.0);
  EXPECT_LT(run.report.residual_relative, 5e-3);
  EXPECT_EQ(run.report.counts.unconverged, 0);
}

TEST(FlexibleContacts, TakeTheNearestPartOfAHoleWithLands) {
  // pressed along lands that protrude with edges; deeper than the contact stands by its flexibility, another land is nearest
  constexpr double stiffness = 1e6, tolerance = 0.03, of_displacements = 0.01;
  std::vector<contact::PolarPoint> lands;
  for (int i = 0; i < 24; ++i) {
    const double angle = 0.01 + i * std::numbers::pi / 12.0;
    lands.push_back({angle, 1e-3 * (1.0 + 0.25 * std::cos(4.0 * angle))});
  }
  for (const double give : {1.0, 5.0})
    for (const contact::FrictionLaw& friction : {contact::FrictionLaw{}, {5e4, 10.0, 0.3, 0.3}}) {
      Scene s = mass_point(1.0, Vec3::Constant(400.0), 0.4);
      s.system.damping.setConstant(400.0);
      s.contacts = {contact_of(1.0, {contact::Profile(lands), {stiffness, 200.0}, friction})};
      s.loads = {force_on(1.0, Vec3(0, 30.0, 0), Harmonic{2.0, 4.0, 1.2}),
                 force_on(1.0, Vec3(0, 0, 30.0), Harmonic{2.0, 4.0, -0.3})};
      s.residual =
          give / stiffness * (Eigen::Matrix3d() << 0.2, 0.0, 0.0, 0.0, 1.0, 0.2, 0.0, 0.2, 0.4).finished();
      constexpr double every = 0.01;
      const History wanted = simulate(with_stiff_modes(s, 2e4, 0.7), energy_conserving(1e-5), every),
                    run = simulate(s, splitting(2e-5), every);
      const double force = wanted.normal.maxCoeff(), size = wanted.q.topRows(3).cwiseAbs().maxCoeff();
      EXPECT_GT(force, 40.0);
      EXPECT_LT((run.normal - wanted.normal).cwiseAbs().maxCoeff(), tolerance * force) << give;
      EXPECT_LT((run.q - wanted.q.topRows(3)).cwiseAbs().maxCoeff(), of_displacements * size) << give;
    }
}

} // namespace flexible_paths_test
