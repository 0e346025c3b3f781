// SPDX-License-Identifier: GPL-3.0-or-later
// What records show of a motion that forces at instants push: its mean over the step.
#include "post/node_statistics.hpp"
#include "scenes.hpp"
#include <cmath>
#include <gtest/gtest.h>

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;

// At the actions a mass that a steady load presses stands a = x^2/12 of its way to rest deeper: 4 % at x = 0.7. The mean leaves 3/5 a^2.
TEST(Splitting, ShowsContactsAndNodesWhereTheyRest) {
  constexpr double mass = 2.0, stiffness = 1e6, load = 100.0, gap = 1e-4, resolution = 0.7;
  constexpr double a = resolution * resolution / 12.0, left = 1.2 * 0.6 * a * a, of_damping = 1e-4;
  for (const double give : {0.0, 1.0}) {
    const double flexibility = give / stiffness, frequency = std::sqrt(stiffness / (1.0 + give) / mass);
    const double step = resolution / frequency, penetration = load / stiffness,
                 node = gap + (1.0 + give) * penetration;
    Scene scene = mass_point(mass, Vec3::Zero(), 2000.0 * step);
    scene.system.damping.setConstant(0.02 * frequency);
    scene.contacts = {contact_of(mass, {contact::Stop{gap, contact::PlaneAxis::y}, {stiffness}, {}})};
    scene.loads = {force_on(mass, Vec3(0, load, 0), Constant{1.0})};
    scene.q0.y() = std::sqrt(mass) * node;
    if (give > 0.0)
      scene.residual = flexibility * Eigen::Matrix3d::Identity();
    post::ContactStatistics contacts(1, 0.5 * scene.duration);
    post::NodeStatistics nodes({scene.contacts[0].b}, 0.5 * scene.duration);
    Observer* const observers[] = {&contacts, &nodes};
    (void)run(scene, choose_step(scene, splitting(step)), observers, nullptr, {});
    EXPECT_NEAR(contacts.summaries()[0].normal_mean, load, of_damping * load) << give;
    EXPECT_NEAR(contacts.summaries()[0].y.mean, gap + penetration, left * (1.0 + give) * penetration) << give;
    EXPECT_NEAR(nodes.summaries()[0].displacement[1].mean, node, left * (1.0 + give) * penetration) << give;
  }
}
