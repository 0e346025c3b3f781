// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/frame.hpp"
#include "core/error.hpp"
#include "uniform.hpp"
#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace frame_test {

using namespace fretwork;
using contact::Frame;
using contact::frame_from_y;
using contact::nautical_frame;
using core::Vec3;

namespace {

constexpr double round_off = 1e-15;    // a few operations on numbers of size 1
constexpr double trigonometry = 1e-14; // sines and cosines of angles of a few radians, composed

void expect_frame(const Frame& frame, const Vec3& x, const Vec3& y, const Vec3& z) {
  EXPECT_LT((frame.x - x).norm(), round_off);
  EXPECT_LT((frame.y - y).norm(), round_off);
  EXPECT_LT((frame.z - z).norm(), round_off);
}

void expect_right_handed(const Frame& frame) {
  const Eigen::Matrix3d r = frame.rotation();
  EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), trigonometry);
  EXPECT_NEAR(r.determinant(), 1.0, trigonometry);
}

} // namespace

TEST(NauticalFrame, OfTheGlobalAxesIsThatOfTheReference) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  expect_frame(nautical_frame(x, 0.0), x, y, z);
  expect_frame(nautical_frame(y, 0.0), y, -x, z);
  expect_frame(nautical_frame(z, 0.0), z, y, -x);
  expect_frame(nautical_frame(-x, 0.0), -x, -y, z);
  expect_frame(nautical_frame(-z, 0.0), -z, y, x);
}

TEST(NauticalFrame, OfAnObliqueAxisHasItsYHorizontal) {
  tests::Uniform uniform(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 axis(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    const Frame frame = nautical_frame(axis, 0.0);
    EXPECT_LT((frame.x - axis.normalized()).norm(), round_off);
    EXPECT_EQ(frame.y.z(), 0.0);
    EXPECT_GT(frame.z.z(), 0.0);
    expect_right_handed(frame);
  }
}

TEST(NauticalFrame, TurnsAboutItsAxisByTheAngle) {
  tests::Uniform uniform(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 axis = Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
    const double angle = uniform(-7.0, 7.0);
    const Frame straight = nautical_frame(axis, 0.0), turned = nautical_frame(axis, angle);
    const Eigen::AngleAxisd turn(angle, axis);
    EXPECT_LT((turned.y - turn * straight.y).norm(), trigonometry);
    EXPECT_LT((turned.z - turn * straight.z).norm(), trigonometry);
    expect_right_handed(turned);
  }
}

TEST(NauticalFrame, IsTheTurnByItsThreeAngles) {
  // about Z by alpha, about the new y by beta, about x_loc by the angle; each axis and an oblique one
  const double degree = std::numbers::pi / 180.0;
  const Vec3 oblique(1.0, 2.0, -1.0);
  for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ()), oblique})
    for (const double angle : {0.0, 30.0 * degree, -135.0 * degree}) {
      const Vec3 n = axis.normalized();
      const Eigen::AngleAxisd alpha(std::atan2(n.y(), n.x()), Vec3::UnitZ()),
          beta(-std::asin(n.z()), Vec3::UnitY()), spin(angle, Vec3::UnitX());
      const Eigen::Matrix3d turned = (alpha * beta * spin).toRotationMatrix();
      EXPECT_LT((nautical_frame(axis, angle).rotation() - turned.transpose()).norm(), trigonometry);
    }
}

TEST(NauticalFrame, GivesPlacesAgainstAnObstacleThatIsShifted) {
  // a node at 0.3 along y_loc and 0.4 along z_loc of an oblique frame, about a centre shifted by 0.1 and 0.2
  const Vec3 axis(1.0, 2.0, -1.0), origin(5.0, -3.0, 2.0), offset(0.0, 0.1, 0.2);
  const double alpha = std::atan2(2.0, 1.0), beta = std::asin(1.0 / std::sqrt(6.0)), angle = 0.7;
  const Vec3 y(-std::sin(alpha), std::cos(alpha), 0.0),
      z(std::cos(alpha) * std::sin(beta), std::sin(alpha) * std::sin(beta), std::cos(beta));
  const Vec3 node = origin + 9.0 * axis + 0.3 * y + 0.4 * z;
  const Vec3 local = nautical_frame(axis, angle).rotation() * (node - origin) - offset;
  constexpr double of_coordinates = 1e-13; // of places of some 10 m
  EXPECT_NEAR(local.y(), 0.3 * std::cos(angle) + 0.4 * std::sin(angle) - 0.1, of_coordinates);
  EXPECT_NEAR(local.z(), 0.4 * std::cos(angle) - 0.3 * std::sin(angle) - 0.2, of_coordinates);
  EXPECT_NEAR(local.x(), 9.0 * std::sqrt(6.0), of_coordinates);
}

TEST(NauticalFrame, DoesNotDependOnTheLengthOfTheAxis) {
  const Vec3 axis(0.3, -0.7, 0.2);
  const Frame a = nautical_frame(axis, 0.4), b = nautical_frame(1024.0 * axis, 0.4);
  EXPECT_EQ(a.rotation(), b.rotation());
}

TEST(NauticalFrame, CountsTinyComponentsAsZero) {
  // without the rule this axis would give alpha = 45 degrees
  const Frame frame = nautical_frame(Vec3(1e-9, 1e-9, 2.0), 0.0);
  expect_frame(frame, Vec3::UnitZ(), Vec3::UnitY(), -Vec3::UnitX());
  // and a component that is meant is kept
  EXPECT_GT(nautical_frame(Vec3(1e-6, 0.0, 1.0), 0.0).x.x(), 0.9e-6);
}

TEST(FrameFromY, KeepsTheGivenDirectionInItsXYPlane) {
  tests::Uniform uniform(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3 axis(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)),
        y(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    const Frame frame = frame_from_y(axis, y);
    expect_right_handed(frame);
    EXPECT_NEAR(frame.z.dot(y), 0.0, trigonometry);
    EXPECT_GT(frame.y.dot(y), 0.0);
    EXPECT_LT((frame.x - axis.normalized()).norm(), round_off);
  }
}

TEST(FrameFromY, RefusesAVectorAlongTheAxis) {
  const Vec3 axis(1.0, 2.0, -1.0);
  for (const Vec3& y : {Vec3(2.0 * axis), Vec3(-axis), Vec3(0.0, 0.0, 0.0)})
    try {
      (void)frame_from_y(axis, y);
      ADD_FAILURE() << "no error";
    } catch (const core::Error& error) {
      EXPECT_STREQ(error.what(), "y_axis is along the axis of the contact; give a vector across it");
    }
}

} // namespace frame_test
