// SPDX-License-Identifier: GPL-3.0-or-later
// A contact that sticks: its spring is stretched by the displacement of the contact, however many steps ago it stuck.
#include "transient/scene/scheme.hpp"
#include "transient/splitting/splitting.hpp"
#include <Eigen/Core>
#include <gtest/gtest.h>

namespace sticking_test {

using namespace fretwork;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

constexpr double step = 1e-4, stiffness = 1e4;
constexpr int period = 500; ///< steps

/// A soft and a stiff mode (w h = 0.1, 1, 2) move a contact pressed to a stop along z and, for `share`, along x_loc; a steady force and one
/// of 20 Hz push it.
Scene pressed(double stiff, double share) {
  Scene scene;
  scene.system.stiffness = Eigen::Array3d(100.0, 200.0, stiff).square();
  scene.system.damping = 2.0 * 0.02 * Eigen::Array3d(100.0, 200.0, stiff);
  ContactPoint point;
  point.name = "stop";
  point.b = Eigen::MatrixXd::Zero(3, 3);
  point.b.row(0) << 0.0, share, share;
  point.b.row(1) << 1.0, 0.0, 0.0;
  point.b.row(2) << 0.0, 1.0, 1.0;
  point.support.obstacle = contact::Stop{-1e-3, contact::PlaneAxis::y};
  point.support.normal.stiffness = stiffness;
  point.support.friction.mu_static = point.support.friction.mu_dynamic = 0.9;
  point.support.friction.stiffness = stiffness;
  scene.contacts = {point};
  const Eigen::VectorXd along = point.b.row(2);
  scene.loads = {{Constant{0.5}, along}, {Harmonic{0.2, 1.0 / (period * step)}, along}};
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(3);
  scene.q0(0) = -1e-3 * stiffness / (stiffness + 100.0 * 100.0); // pressed at rest
  scene.duration = 20.0;
  return scene;
}

/// Displacement that the spring shows less the contact's own, mean over a period, m.
double misfit(Scheme& scheme) {
  double sum = 0.0;
  for (int i = 0; i < period; ++i) {
    const Record& record = scheme.advance();
    EXPECT_FALSE(record.states[0].slides);
    // normal -y_loc: t = -y x x = z
    sum +=
        record.states[0].friction.t / stiffness + record.states[0].axes.tangent(record.uy[0], record.uz[0]);
  }
  return sum / period;
}

} // namespace

TEST(Sticking, StretchesTheSpringByTheDisplacementForAHundredThousandSteps) {
  constexpr double settled = 1e-5; // of the displacement: what is left of the motion at the start
  for (const double stiff : {1e3, 1e4, 2e4})
    for (const double share : {0.0, 0.5}) { // in lanes and in the tangent plane
      const Scene scene = pressed(stiff, share);
      const auto scheme = make_splitting(scene, step);
      for (int i = 0; i < 40 * period; ++i)
        (void)scheme->advance();
      const double early = misfit(*scheme), displacement = 0.5 / (200.0 * 200.0 + stiffness);
      for (int i = 0; i < 200 * period; ++i)
        (void)scheme->advance();
      EXPECT_NEAR(misfit(*scheme), early, settled * displacement) << stiff << ' ' << share;
      EXPECT_NEAR(early, 0.0, 1e-3 * displacement) << stiff << ' ' << share; // it stuck at z = 0; half steps
    }
}

} // namespace sticking_test
