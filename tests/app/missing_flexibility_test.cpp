// SPDX-License-Identifier: GPL-3.0-or-later
// What modes lack at a contact, where its forces can act.
#include "app/missing_flexibility.hpp"
#include <gtest/gtest.h>

namespace missing_flexibility_test {

using namespace fretwork;

TEST(MissingFlexibility, CountsWhereForcesOfTheContactCanAct) {
  app::ContactFlexibility flexibility;
  flexibility.missing = Eigen::Vector3d(3e-6, 1e-6, 5e-6).asDiagonal(); // along x y z
  contact::Support bar;
  bar.obstacle = contact::PlanePair{1e-4, contact::PlaneAxis::y};
  bar.normal.stiffness = 1e5;
  const auto missing = [&] { return app::missing_times_stiffness(flexibility, 0, bar); };
  EXPECT_DOUBLE_EQ(missing(), 0.1); // nothing along x and z without friction
  bar.friction = {4e5, 0.0, 0.3, 0.3};
  EXPECT_DOUBLE_EQ(missing(), 2.0);
  bar.friction.along = {1.0, 0.0};
  EXPECT_DOUBLE_EQ(missing(), 1.2);
  bar.friction.along = {0.0, 1.0};
  EXPECT_DOUBLE_EQ(missing(), 2.0);
  flexibility.missing(2, 2) = 0.0;
  EXPECT_DOUBLE_EQ(missing(), 0.1); // the normal of a plane takes no friction
}

} // namespace missing_flexibility_test
