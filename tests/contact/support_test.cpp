// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/support.hpp"
#include <gtest/gtest.h>

namespace support_test {

using namespace fretwork::contact;

TEST(FrictionDirections, AreTangentsAlongWhichTheLawLetsItAct) {
  using Directions = std::array<bool, 3>; // x y z
  const PlanePair plane{0.1, PlaneAxis::y};
  EXPECT_EQ(friction_directions(plane, {1.0, 1.0}), (Directions{true, false, true}));
  EXPECT_EQ(friction_directions(plane, {1.0, 0.0}), (Directions{true, false, false}));
  EXPECT_EQ(friction_directions(plane, {0.0, 1.0}), (Directions{false, false, true}));
  EXPECT_EQ(friction_directions(Stop{0.1, PlaneAxis::z}, {0.0, 1.0}), (Directions{false, true, false}));
  EXPECT_EQ(friction_directions(Circle{0.1}, {0.0, 1.0}), (Directions{false, true, true}));
  EXPECT_EQ(friction_directions(Circle{0.1}, {1.0, 0.0}), (Directions{true, false, false}));
}

} // namespace support_test
