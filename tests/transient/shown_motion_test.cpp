// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts at rest, which forces at instants keep moving between two of them: what records show is the mean over the step.
#include "post/node_statistics.hpp"
#include "scenes.hpp"
#include "transient/scene_rates.hpp"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace shown_motion_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

// At the actions a mass that a steady load presses stands a = x^2/12 of its way to rest deeper: 4 % at x = 0.7. The mean leaves 3/5 a^2.
TEST(Splitting, ShowsContactsAndNodesWhereTheyRest) {
  constexpr double mass = 2.0, stiffness = 1e6, load = 100.0, gap = 1e-4, resolution = 0.7;
  constexpr double a = resolution * resolution / 12.0, left = 1.2 * 0.6 * a * a, of_damping = 1e-4;
  const double step = resolution * std::sqrt(mass / stiffness), penetration = load / stiffness;
  Scene scene = mass_point(mass, Vec3::Zero(), 2000.0 * step);
  scene.system.damping.setConstant(0.02 * std::sqrt(stiffness / mass));
  scene.contacts = {contact_of(mass, {contact::Stop{gap, contact::PlaneAxis::y}, {stiffness}, {}})};
  scene.loads = {force_on(mass, Vec3(0, load, 0), Constant{1.0})};
  scene.q0.y() = std::sqrt(mass) * (gap + penetration);
  post::ContactStatistics contacts(scene.contacts, 0.5 * scene.duration);
  post::NodeStatistics nodes({scene.contacts[0].b}, 0.5 * scene.duration);
  Observer* const observers[] = {&contacts, &nodes};
  (void)run(scene, choose_step(scene, splitting(step)), observers, nullptr, {});
  EXPECT_NEAR(contacts.summaries()[0].normal_mean, load, of_damping * load);
  EXPECT_NEAR(contacts.summaries()[0].y.mean, gap + penetration, left * penetration);
  EXPECT_NEAR(nodes.summaries()[0].displacement[1].mean, gap + penetration, left * penetration);
}

// Between two actions the heavy contact's force moves the light one by ten times its penetration and back.
TEST(Splitting, LetsALightContactRestBesideAHeavyOne) {
  constexpr double stiffness = 1e6, heavy = 100.0, light = 0.1, of_damping = 0.05;
  struct Last final : Observer {
    void visit(core::StateArchive&) override {}
    void step(const Record& record) override {
      if (++seen <= 6000)
        return;
      const double force = record.states[1].normal_force;
      least = std::min(least, force);
      most = std::max(most, force);
    }
    int seen = 0;
    double least = 1e9, most = 0.0;
  };
  for (const double side : {1.0, -1.0}) // the heavy contact's force moves the light one out or in
    for (const bool in_lanes : {true, false}) {
      Scene scene;
      Eigen::Matrix2d b;
      b << 3.0, 1.0, 2.0 * side, 0.6;
      for (int c = 0; c < 2; ++c) {
        ContactPoint point;
        point.support = {contact::Stop{0.0, contact::PlaneAxis::y}, {stiffness}, {}};
        if (!in_lanes)
          point.support.friction = {1e5, 10.0, 0.3, 0.3, contact::FrictionMemoryKind::reference};
        point.b = Eigen::MatrixXd::Zero(3, 2);
        point.b.row(1) = b.row(c);
        scene.contacts.push_back(point);
      }
      const Eigen::Vector2d forces(heavy, light);
      scene.loads = {{Constant{1.0}, b.transpose() * forces}};
      scene.system.stiffness = scene.v0 = Eigen::Vector2d::Zero();
      scene.q0 = b.inverse() * forces / stiffness;
      scene.duration = 1.0;
      scene.system.damping = Eigen::Vector2d::Zero();
      const double frequency = rates_of(scene).contact_frequency, h = 0.7 / frequency;
      scene.system.damping.setConstant(0.1 * frequency);
      scene.duration = 8000.0 * h;
      Last last;
      Observer* const observers[] = {&last};
      (void)run(scene, choose_step(scene, splitting(h)), observers, nullptr, {});
      EXPECT_NEAR(last.least, light, of_damping * light) << side << " " << in_lanes;
      EXPECT_NEAR(last.most, light, of_damping * light) << side << " " << in_lanes;
    }
}

} // namespace shown_motion_test
