// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes.hpp"
#include "transient/collocation/swept_contact.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace swept_contact_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;
using namespace fretwork::vibration;

namespace {

constexpr double mass = 2.0, h = 1e-3;

/// A mass that has come into a stop and slides there, at the nodes 1/2 and 1 of a step as far as it would go without new forces.
struct Pressed {
  Scene scene = mass_point(mass, Vec3(0, 4e3, 5e3), 1.0);
  PackedContacts contacts{
      {contact_of(mass, {contact::Stop{1e-3, contact::PlaneAxis::y}, {1e6, 50.0}, {1e6, 100.0, 0.3, 0.3}})},
      3};
  PolynomialFlow flow{scene.system, h};
  NodalTables tables{contacts, flow, h};
  NodalMotion motion{contacts};
  SweptContact swept{contacts, 0};
  Pressed() { begin(); }
  void begin() {
    for (int node = 0; node <= 2; ++node) {
      motion.u(node)[swept.y] = 1e-3 + 1e-4 * (0.5 + 0.5 * node);
      motion.v(node)[swept.y] = 0.1;
      motion.v(node)[swept.z] = 0.5;
    }
    meet_start(swept, motion);
    swept.join(tables);
  }
  /// The change of a whole Newton step.
  double improve() { return transient::improve(swept, motion, 1.0); }
};

} // namespace

TEST(SweptContact, IsSolvedByOneNewtonStepWithinTheBranchesOfItsLaws) {
  Pressed pressed;
  const double first = pressed.improve();
  EXPECT_GT(first, 0.1);
  double change = 1.0;
  for (int i = 0; i < 2; ++i) // the first forces, 0, may be in other branches
    change = pressed.improve();
  EXPECT_LT(change, 1e-12);
  evaluate(pressed.swept, pressed.motion);
  for (int j = 0; j < 2; ++j) {
    const auto force = force_of_laws(pressed.swept.node[j + 1]);
    EXPECT_GT(pressed.swept.node[j + 1].normal, 10.0);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(pressed.swept.force[j][k], force[static_cast<std::size_t>(k)], 1e-10 * std::abs(force[0]));
  }
}

TEST(SweptContact, KeepsItsMatrixFromStepToStep) {
  Pressed pressed;
  for (int i = 0; i < 4; ++i)
    (void)pressed.improve();
  const double force = pressed.swept.force[0][0];
  const double marked = pressed.swept.inverse[0] *= 1.0 + 1e-6;
  pressed.begin();
  EXPECT_EQ(pressed.swept.force[0][0], 0.0);
  (void)pressed.improve();
  EXPECT_EQ(pressed.swept.inverse[0], marked);
  EXPECT_NEAR(pressed.swept.force[0][0], force, 1e-5 * std::abs(force));
}

/// Along x_loc and z_loc, with a damper that relaxes the spring in 1/600 of the step.
TEST(SweptContact, SlidesAgainstItsMotionWhereItBreaksLooseInTheStep) {
  constexpr double press = 100.0, stiffness = 1e6, bound = 0.3 * press;
  for (const double turn : {-1.0, -0.5, 0.5, 1.0}) {
    Pressed pressed;
    pressed.contacts.supports[0].friction = {stiffness, stiffness * h / 600.0, 0.3, 0.3};
    SweptContact& swept = pressed.swept;
    NodalTables tables{pressed.contacts, pressed.flow, h};
    for (int node = 0; node <= 2; ++node) {
      pressed.motion.u(node)[swept.y] = 1e-3 + press / stiffness;
      pressed.motion.v(node)[swept.y] = 0.0;
      pressed.motion.v(node)[swept.z] = 0.3;
      pressed.motion.v(node)[swept.x] = turn * 0.3 * node;
    }
    meet_start(swept, pressed.motion);
    ContactNode& start = swept.node[0];
    start.normal = press;
    start.face = start.axes;
    start.spring = start.friction = {0.0, -0.9 * bound}; // just before it slides
    swept.join(tables);
    for (int path = 0; path < 3; ++path) {
      double change = 1.0;
      for (int i = 0; i < 40 && change > 1e-9; ++i)
        change = pressed.improve();
      EXPECT_LE(change, 1e-9) << turn << " " << path;
      if (path == 2)
        break;
      follow_path(swept, pressed.motion);
      add_response(swept, swept.path_change, pressed.motion);
    }
    evaluate(swept, pressed.motion);
    for (int j = 1; j <= 2; ++j) {
      const ContactNode& node = swept.node[j];
      EXPECT_TRUE(node.slides) << turn << " " << j;
      EXPECT_LT(contact::dot(node.friction, node.slip),
                -0.99 * contact::norm(node.friction) * contact::norm(node.slip))
          << turn << " " << j;
    }
  }
}

TEST(SweptContact, ForgetsAMatrixThatIsNoGood) {
  Pressed pressed;
  for (int i = 0; i < 4; ++i)
    (void)pressed.improve();
  const double force = pressed.swept.force[0][0];
  pressed.swept.inverse[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(std::isfinite(pressed.improve()));
  EXPECT_EQ(pressed.swept.branches, -1);
  EXPECT_LT(pressed.improve(), 1e-9);
  EXPECT_NEAR(pressed.swept.force[0][0], force, 1e-9 * std::abs(force));
}

} // namespace swept_contact_test
