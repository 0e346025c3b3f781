// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_step.hpp"
#include <gtest/gtest.h>

namespace contact_step_test {

using namespace fretwork;
using namespace fretwork::transient;

// A contact that leaves a damped obstacle while the forces of spring and damper, which would pull, stay balanced for good: the time until its force
// returns is estimated again and again, below what the time of the step can resolve. The step ends nevertheless.
TEST(ContactStep, EndsWhereTheForceIsAlwaysAboutToReturn) {
  constexpr double step = 2e-5, stiffness = 1e8, damping = 1700.0, out = 8e-3, penetration = 1e-7;
  Mobility mobility;
  for (int i = 0; i < 3; ++i)
    mobility.add(i, i, 12.0);
  const contact::Support support{contact::Stop{0.0, contact::PlaneAxis::y}, {stiffness, damping}, {}};
  const ContactStep contact(support, {}, mobility, false, step, 6, 1e-3, 1e-2);
  const double side = contact::locate(support.obstacle, penetration, 0.0).gap < 0.0 ? 1.0 : -1.0;
  const double pressing = stiffness * out / damping * (1.0 - 1e-14); // K_N p' = C_N p'' but for round-off
  const double falling = stiffness * pressing / damping;             // and so it stays
  const FreePath path{{side * penetration, 0.0, 0.0},
                      {-side * out, 0.0, 0.0},
                      {side * pressing, 0.0, 0.0},
                      {-side * falling, 0.0, 0.0}};
  ContactAct act;
  contact.make({}, path, {}, act);
  EXPECT_GE(act.state.normal_force, 0.0);
  EXPECT_TRUE(std::isfinite(act.end.y()));
}

} // namespace contact_step_test
