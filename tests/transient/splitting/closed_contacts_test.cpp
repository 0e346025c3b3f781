// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that never open, on one mode without damping: what splitting damps their vibration by.
#include "scenes.hpp"
#include <cmath>
#include <numbers>

namespace closed_contacts_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;
using contact::PlaneAxis;
using contact::Stop;

namespace {

constexpr double step = 1e-3;          // s
constexpr int steps = 600, some = 100; // means over some
constexpr double pressed = 10.0;       // N

enum class Contact { normal, sticking, two_of_one_node };

struct Vibration {
  Scene scene;
  double frequency; ///< rad/s
  double rest;      ///< m kg^1/2
};

/// @param contact  w_c h, w_t h   @param mode  frequency of the mode over w_c
Vibration closed(Contact kind, double contact, double mode) {
  const double closed = contact / step, own = mode * closed, frequency = std::hypot(closed, own);
  const bool sticks = kind == Contact::sticking;
  Vibration out{{}, frequency, sticks ? 0.0 : pressed / (frequency * frequency)};
  Scene& scene = out.scene;
  scene.system.stiffness = Eigen::VectorXd::Constant(1, own * own);
  scene.system.damping = Eigen::VectorXd::Zero(1);
  const int count = kind == Contact::two_of_one_node ? 2 : 1;
  for (int c = 0; c < count; ++c) {
    ContactPoint point{"stop",
                       {Stop{0.0, PlaneAxis::z}, {closed * closed / count}, {}},
                       Vec3::Zero(),
                       Eigen::MatrixXd::Zero(3, 1)};
    point.b(sticks ? 0 : 2, 0) = 1.0;
    if (sticks) {
      constexpr double stiffness = 1e4; // N/m
      point.support = {point.support.obstacle, {stiffness}, {closed * closed, 0.0, 0.5, 0.5}};
      point.rest.z() = pressed / stiffness;
    }
    scene.contacts.push_back(point);
  }
  if (!sticks)
    scene.loads = {{signals::Constant{pressed}, Eigen::VectorXd::Ones(1)}};
  scene.q0 = Eigen::VectorXd::Constant(1, out.rest);
  scene.v0 = Eigen::VectorXd::Constant(1, 0.25 * pressed * frequency / (closed * closed));
  scene.duration = steps * step;
  return out;
}

/// As a damping ratio: what the vibration loses.
double damping_ratio(const Vibration& of, int parts) {
  StepChoice choice = choose_step(of.scene, splitting(step));
  choice.parts = parts;
  const History run = simulate_with(of.scene, choice, step);
  const auto energy = [&](Eigen::Index from) {
    const Eigen::ArrayXd q = run.q.row(0).segment(from, some).array() - of.rest,
                         v = run.v.row(0).segment(from, some).array();
    return (v.square() + of.frequency * of.frequency * q.square()).sum();
  };
  const Eigen::Index last = run.q.cols() - some;
  return std::log(energy(0) / energy(last)) / (2.0 * of.frequency * (run.time(last) - run.time(0)));
}

} // namespace

TEST(ClosedContacts, AreHardlyDamped) {
  struct Case {
    double contact, mode;
    int parts;
    double most;
  };
  for (const Case& of : {Case{0.875, 0.1, 1, 1e-5}, Case{0.875, 0.3, 1, 2e-6}, Case{0.875, 0.6, 1, 3e-6},
                         Case{1.75, 0.1, 2, 1e-6}, Case{1.75, 0.3, 2, 1e-5}, Case{1.75, 0.6, 2, 1.2e-4},
                         Case{3.0, 0.1, 3, 3e-6}, Case{3.0, 0.3, 3, 1.5e-4}}) {
    SCOPED_TRACE(testing::Message() << of.contact << " " << of.mode << " " << of.parts);
    const double normal = damping_ratio(closed(Contact::normal, of.contact, of.mode), of.parts);
    EXPECT_NEAR(normal, 0.5 * of.most, 0.5 * of.most + 1e-7);
    EXPECT_NEAR(damping_ratio(closed(Contact::sticking, of.contact, of.mode), of.parts), normal, 1e-7);
    // the residual of their iteration
    EXPECT_NEAR(damping_ratio(closed(Contact::two_of_one_node, of.contact, of.mode), of.parts), normal,
                1e-5 + 0.05 * of.most);
  }
}

} // namespace closed_contacts_test
