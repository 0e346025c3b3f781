// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/step_response.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace step_response_test {

using namespace fretwork;
using namespace fretwork::transient;

namespace {

constexpr double h = 1e-3; // s

/// A contact on modes with these frequencies times h, of these shares at its node along y.
Scene on_modes(const Eigen::VectorXd& wh, const Eigen::RowVectorXd& shares) {
  Scene scene;
  scene.system.stiffness = (wh / h).cwiseAbs2();
  scene.system.damping = Eigen::VectorXd::Zero(wh.size());
  ContactPoint point{"stop",
                     {contact::Stop{0.0, contact::PlaneAxis::y}, {1e4}, {}},
                     core::Vec3::Zero(),
                     Eigen::MatrixXd::Zero(3, wh.size())};
  point.b.row(1) = shares;
  scene.contacts = {point};
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(wh.size());
  scene.duration = 1.0;
  return scene;
}

ImpulseResponse own_response(const Scene& scene) {
  LinearFlow modes(scene, h, {1});
  return step_response(scene, ContactBlocks(scene), 2, modes, h).at(0).at(0);
}

/// Over a step under a constant force: its displacement, over that of a free mass of 1 kg; its velocity, likewise.
struct Moved {
  double displacement, velocity;
};
Moved moved(const ImpulseResponse& g) { return {g.over(h)(0, 0), g.w(0, 0) - h * h / 6.0 * g.v(0, 0)}; }

} // namespace

TEST(StepResponse, HasDisplacementAndVelocityOfTheModes) {
  for (const double x : {0.7, 1.2, 1.75, 2.5, 2.9}) {
    const Moved m =
        moved(own_response(on_modes(Eigen::VectorXd::Constant(1, x), Eigen::RowVectorXd::Ones(1))));
    EXPECT_NEAR(m.displacement, 2.0 * (1.0 - std::cos(x)) / (x * x), 1e-10) << x;
    EXPECT_NEAR(m.velocity, std::sin(x) / x, 1e-10) << x;
  }
  // of two the sum, by the squares of their shares
  const Moved both = moved(own_response(on_modes(Eigen::Vector2d(0.8, 1.6), Eigen::RowVector2d(2.0, 3.0))));
  EXPECT_NEAR(both.velocity, 4.0 * std::sin(0.8) / 0.8 + 9.0 * std::sin(1.6) / 1.6, 1e-9);
}

TEST(StepResponse, HoldsNothingBackOfSlowModesNorOfThoseThatNoStepFollows) {
  for (const double x : {0.0, 0.08, 3.1, 8.0}) {
    const ImpulseResponse g =
        own_response(on_modes(Eigen::VectorXd::Constant(1, x), Eigen::RowVectorXd::Ones(1)));
    EXPECT_EQ(g.v.largest(), 0.0) << x;
    EXPECT_NEAR(g.w(0, 0), x > 0.0 ? 2.0 * (1.0 - std::cos(x)) / (x * x) : 1.0, 1e-10) << x;
  }
}

// Whether their damping couples the modes or a force of motion does.
TEST(StepResponse, IsThatOfCoupledModes) {
  Scene scene = on_modes(Eigen::Vector2d(0.9, 1.5), Eigen::RowVector2d(1.0, 0.5));
  const Eigen::Matrix2d damping = 1.0 / h * Eigen::Matrix2d{{0.3, 0.1}, {0.1, 0.2}};
  Scene by_motion = scene;
  scene.system.damping_matrix = damping;
  const Moved m = moved(own_response(scene));
  // in 20 000 steps of the midpoint rule
  constexpr int steps = 20000;
  constexpr double dt = h / steps;
  Eigen::Vector2d q = Eigen::Vector2d::Zero(), v = q;
  const Eigen::Vector2d force(1.0, 0.5);
  const auto acceleration = [&](const Eigen::Vector2d& at, const Eigen::Vector2d& rate) -> Eigen::Vector2d {
    return force - scene.system.stiffness.cwiseProduct(at) - damping * rate;
  };
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector2d q_half = q + 0.5 * dt * v, v_half = v + 0.5 * dt * acceleration(q, v);
    q += dt * v_half;
    v += dt * acceleration(q_half, v_half);
  }
  EXPECT_NEAR(m.displacement, 2.0 / (h * h) * force.dot(q), 1e-7);
  EXPECT_NEAR(m.velocity, force.dot(v) / h, 1e-7);
  core::MotionForces& law = by_motion.system.motion;
  law.stiffness = Eigen::Matrix2d::Zero();
  law.damping = -damping; // of the force on the modes
  law.input = Eigen::MatrixXd::Zero(2, 0);
  law.output = Eigen::MatrixXd::Zero(0, 2);
  const Moved same = moved(own_response(by_motion));
  EXPECT_NEAR(same.displacement, m.displacement, 1e-9);
  EXPECT_NEAR(same.velocity, m.velocity, 1e-9);
}

} // namespace step_response_test
