// SPDX-License-Identifier: GPL-3.0-or-later
// What must not matter: the side of a mirror, the axes, the order of equal modes.
#include "contact/frame.hpp"
#include "contact/profile.hpp"
#include "scenes.hpp"
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

namespace invariance_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;
using contact::Circle;

namespace {

constexpr double one_impact = 1e-9; // round-off grown by one impact
constexpr double mirrored = 1e-12;  // the same arithmetic with other signs

/// A mass with different stiffness along two axes that hits a round hole obliquely, with friction and
/// damping, and leaves it.
Scene oblique_hit() {
  Scene s = mass_point(1.0, Vec3(50.0, 2e3, 1e3), 0.007);
  start(s, 1.0, Vec3(0, 0.9e-3, 0.2e-3), Vec3(0.05, 0.2, 0.15));
  s.contacts = {contact_of(1.0, {Circle{1e-3}, {1e6, 100.0}, {5e5, 200.0, 0.4, 0.3}})};
  return s;
}

const StepOptions schemes[] = {splitting(1e-5), euler(1e-5), collocation(1e-5)};

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

/// The scene must have an impact that opens again, with slip.
void expect_one_impact(const Scene& scene, const StepOptions& options) {
  int closings = 0, openings = 0, slips = 0;
  bool before = false;
  for (const auto& r : trace(scene, options)) {
    closings += r.closed && !before;
    openings += before && !r.closed;
    slips += r.slides;
    before = r.closed;
  }
  EXPECT_EQ(closings, 1);
  EXPECT_EQ(openings, 1);
  EXPECT_GT(slips, 0);
}

} // namespace

TEST(Invariance, FixtureHasOneImpact) {
  for (const StepOptions& options : schemes)
    expect_one_impact(oblique_hit(), options);
}

TEST(Invariance, OfAMirroredSceneIsTheMirroredResult) {
  for (const StepOptions& options : schemes)
    for (const Vec3& mirror : {Vec3(1, -1, 1), Vec3(1, 1, -1), Vec3(-1, 1, 1), Vec3(-1, -1, -1)}) {
      const Scene scene = oblique_hit();
      Scene other = scene;
      other.q0 = mirror.cwiseProduct(scene.q0);
      other.v0 = mirror.cwiseProduct(scene.v0);
      const History a = simulate(scene, options, 1e-3), b = simulate(other, options, 1e-3);
      EXPECT_LT(difference(mirror.asDiagonal() * b.q, a.q), mirrored);
      EXPECT_LT(difference(mirror.asDiagonal() * b.v, a.v), mirrored);
      EXPECT_LT(difference(b.normal, a.normal), mirrored);
    }
}

TEST(Invariance, OfACircleGivenAsAnEllipseIsTheSameMotion) {
  auto all = std::vector<StepOptions>(std::begin(schemes), std::end(schemes));
  all.push_back(energy_conserving(1e-5));
  for (const StepOptions& options : all) {
    const Scene scene = oblique_hit();
    Scene ellipse = scene;
    ellipse.contacts[0].support.obstacle = contact::Ellipse{3e-3, 3e-3, 2e-3};
    const History a = simulate(scene, options, 1e-3), b = simulate(ellipse, options, 1e-3);
    // the energy-conserving scheme has another direction for the mean force of a step, of the same order
    const double same = options.scheme == SchemeKind::energy_conserving ? 1e-4 : one_impact;
    EXPECT_LT(difference(b.q, a.q), same);
    EXPECT_LT(difference(b.v, a.v), same);
    EXPECT_NEAR(b.report.energy.friction / a.report.energy.friction, 1.0, same);
    EXPECT_LT(std::abs(b.report.energy.residual()),
              std::abs(a.report.energy.residual()) + 1e-6 * b.report.energy.scale);
  }
}

TEST(Invariance, OfTurnedLocalAxesIsTheSameMotion) {
  for (const StepOptions& options : schemes)
    for (const double angle : {0.3, 1.0, std::numbers::pi / 2, 4.0}) {
      const Scene scene = oblique_hit();
      Scene turned = scene;
      turned.contacts[0].b = Eigen::AngleAxisd(angle, Vec3::UnitX()).toRotationMatrix() * scene.contacts[0].b;
      const History a = simulate(scene, options, 1e-3), b = simulate(turned, options, 1e-3);
      EXPECT_LT(difference(b.q, a.q), one_impact);
      EXPECT_LT(difference(b.v, a.v), one_impact);
      EXPECT_LT(difference(b.normal, a.normal), one_impact);
      EXPECT_NEAR(b.report.energy.friction / a.report.energy.friction, 1.0, one_impact);
    }
}

TEST(Invariance, OfExchangedModesIsTheSameMotion) {
  for (const StepOptions& options : schemes) {
    Scene scene = oblique_hit();
    scene.system.stiffness(1) = scene.system.stiffness(2); // two equal modes
    Scene exchanged = scene;
    exchanged.contacts[0].b.col(1).swap(exchanged.contacts[0].b.col(2));
    std::swap(exchanged.q0(1), exchanged.q0(2));
    std::swap(exchanged.v0(1), exchanged.v0(2));
    const History a = simulate(scene, options, 1e-3);
    History b = simulate(exchanged, options, 1e-3);
    b.q.row(1).swap(b.q.row(2));
    b.v.row(1).swap(b.v.row(2));
    EXPECT_LT(difference(b.q, a.q), one_impact);
    EXPECT_LT(difference(b.v, a.v), one_impact);
    EXPECT_LT(difference(b.normal, a.normal), one_impact);
  }
}

TEST(Invariance, OfTurnedEqualModesIsTheSameMotion) {
  for (const StepOptions& options : schemes) {
    Scene scene = oblique_hit();
    scene.system.stiffness(1) = scene.system.stiffness(2);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3::UnitX()).toRotationMatrix();
    Scene turned = scene;
    turned.contacts[0].b = scene.contacts[0].b * turn.transpose();
    turned.q0 = turn * scene.q0;
    turned.v0 = turn * scene.v0;
    const History a = simulate(scene, options, 1e-3), b = simulate(turned, options, 1e-3);
    EXPECT_LT(difference(turn.transpose() * b.q, a.q), one_impact);
    EXPECT_LT(difference(b.normal, a.normal), one_impact);
  }
}

namespace {

/// The oblique hit on other obstacles, in axes of space: x_loc, y_loc, z_loc are the axes of the scene turned by `turn`, and so are the
/// shapes of the modes.
Scene hit_in_space(const contact::Obstacle& obstacle, const Vec3& rest, const Eigen::Matrix3d& turn) {
  Scene s = oblique_hit();
  ContactPoint& point = s.contacts[0];
  point.support.obstacle = obstacle;
  const contact::Frame frame = contact::frame_from_y(turn.col(0), turn.col(1));
  point.rest = rest;
  point.b = frame.rotation() * turn * point.b;
  return s;
}

contact::Profile hexagonal_hole(double radius) {
  std::vector<contact::PolarPoint> points;
  for (int i = 0; i < 6; ++i)
    points.push_back({0.2 + i * std::numbers::pi / 3.0, radius});
  return contact::Profile(points);
}

} // namespace

TEST(Invariance, OfASceneTurnedInSpaceIsTheSameMotionForEveryObstacle) {
  using contact::PlaneAxis;
  const std::pair<contact::Obstacle, Vec3> obstacles[] = {
      {Circle{1e-3}, Vec3::Zero()},
      {contact::PlanePair{1e-3, PlaneAxis::y}, Vec3::Zero()},
      {contact::Stop{3e-4, PlaneAxis::z}, Vec3::Zero()},
      {contact::RoundPair{1e-3}, Vec3(0, -2e-3, 0)},
      {contact::FacingPlanes{1e-3, PlaneAxis::y, -1.0}, Vec3(0, -2e-3, 0)},
      {hexagonal_hole(1.2e-3), Vec3::Zero()}};
  const Eigen::Matrix3d turns[] = {
      Eigen::AngleAxisd(0.7, Vec3(1, 2, -0.5).normalized()).toRotationMatrix(),
      Eigen::AngleAxisd(2.5, Vec3(-0.3, 0.1, 1).normalized()).toRotationMatrix(),
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitZ()).toRotationMatrix()};
  for (const StepOptions& options : schemes)
    for (const auto& [obstacle, rest] : obstacles) {
      const Scene scene = hit_in_space(obstacle, rest, Eigen::Matrix3d::Identity());
      expect_one_impact(scene, options);
      const History a = simulate(scene, options, 1e-3);
      for (const Eigen::Matrix3d& turn : turns) {
        const History b = simulate(hit_in_space(obstacle, rest, turn), options, 1e-3);
        EXPECT_LT(difference(b.q, a.q), one_impact);
        EXPECT_LT(difference(b.v, a.v), one_impact);
        EXPECT_LT(difference(b.normal, a.normal), one_impact);
        EXPECT_LT(difference(b.along_t, a.along_t), one_impact);
      }
    }
}

} // namespace invariance_test
