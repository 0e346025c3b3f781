// SPDX-License-Identifier: GPL-3.0-or-later
// Static equilibrium with contacts: closed forms, what has no equilibrium, and runs that start there.
#include "equilibria.hpp"
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace static_start_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::PlaneAxis;
using Eigen::VectorXd;

namespace {

/// Bending of a clamped beam with two planes of `modes` modes each, its contact and load at the tip.
struct Cantilever {
  // E = 1e10, a solid circle of radius 0.1, rho = 1e6, L = 1
  static constexpr double bending = 1e10 * std::numbers::pi * 1e-4 / 4.0,
                          line_mass = 1e6 * std::numbers::pi * 1e-2;
  static double beta(int i) {
    constexpr std::array<double, 3> first = {1.87510407, 4.69409113, 7.85475744};
    return i < 3 ? first[static_cast<std::size_t>(i)] : (i + 0.5) * std::numbers::pi;
  }
  /// Tip along y and z; every mode of unit mass has 2/sqrt(m L) at the tip.
  static Scene scene(int modes, double tip_force, const contact::Support& support, const Vec3& rest) {
    Scene out;
    const double tip = 2.0 / std::sqrt(line_mass);
    out.system.stiffness.resize(2 * modes);
    ContactPoint point{"tip", support, rest, Eigen::MatrixXd::Zero(3, 2 * modes)};
    for (int i = 0; i < modes; ++i) {
      out.system.stiffness(2 * i) = out.system.stiffness(2 * i + 1) =
          std::pow(beta(i), 4) * bending / line_mass;
      point.b(1, 2 * i) = point.b(2, 2 * i + 1) = tip * (i % 2 == 0 ? 1.0 : -1.0);
    }
    out.system.damping = VectorXd::Zero(2 * modes);
    out.q0 = out.v0 = VectorXd::Zero(2 * modes);
    out.loads = {{Constant{tip_force}, point.b.row(1)}};
    out.contacts = {point};
    out.duration = 1.0;
    return out;
  }
  static double flexibility(const Scene& scene) {
    return (scene.contacts[0].b.row(1).transpose().array().square() / scene.system.stiffness.array()).sum();
  }
};

} // namespace

TEST(StaticStart, OfAnOscillatorOnAStop) {
  constexpr double m = 2.0, k = 300.0, stiffness = 5e4, gap = 1e-3, force = 4.0;
  Scene scene = mass_point(m, Vec3(k, k, k), 1.0);
  scene.contacts = {contact_of(m, spring_at(contact::Stop{gap, PlaneAxis::y}, stiffness))};
  scene.loads = {force_on(m, Vec3(0, force, 0), Constant{1.0})};
  const Equilibrium e = found(scene);
  const double u = (force + stiffness * gap) / (k + stiffness);
  EXPECT_NEAR(e.q(1) / std::sqrt(m), u, round_off * u);
  EXPECT_NEAR(e.normal_force(0), stiffness * (u - gap), round_off * force);
  scene.loads = {force_on(m, Vec3(0, -force, 0), Constant{1.0})};
  EXPECT_NEAR(found(scene).q(1) / std::sqrt(m), -force / k, round_off);
  EXPECT_EQ(found(scene).normal_force(0), 0.0);
}

TEST(StaticStart, OfACantileverOnItsStopHasTheFlexibilityOfItsBasis) {
  constexpr double stiffness = 1e8, gap = 1e-4, force = 1000.0;
  for (const int modes : {1, 5, 20}) {
    const Scene scene =
        Cantilever::scene(modes, force, spring_at(contact::Stop{gap, PlaneAxis::y}, stiffness), Vec3::Zero());
    const double c = Cantilever::flexibility(scene);
    EXPECT_NEAR(found(scene).normal_force(0), (force * c - gap) / (1.0 / stiffness + c), round_off * force);
  }
  // the beam's own flexibility L^3/3EI, from which 5 modes differ by 1e-4
  const Scene scene =
      Cantilever::scene(5, force, spring_at(contact::Stop{gap, PlaneAxis::y}, stiffness), Vec3::Zero());
  constexpr double beam = 746.785, truncation = 0.1;
  EXPECT_NEAR(static_equilibrium(scene).normal_force(0), beam, truncation);
}

TEST(StaticStart, BetweenTwoStopsThatBothOverlap) {
  constexpr double m = 1.0, k = 100.0, left = 2e3, right = 6e3, overlap_left = 1e-3, overlap_right = 4e-3;
  Scene scene = mass_point(m, Vec3(k, k, k), 1.0);
  scene.contacts = {contact_of(m, spring_at(contact::Stop{-overlap_right, PlaneAxis::y}, right)),
                    contact_of(m, spring_at(contact::FacingPlanes{overlap_left, PlaneAxis::y, 1.0}, left))};
  const double u = (left * overlap_left - right * overlap_right) / (k + left + right);
  const Equilibrium e = found(scene);
  EXPECT_NEAR(e.q(1), u, round_off * std::abs(u));
  EXPECT_NEAR(e.normal_force(0), right * (overlap_right + u), round_off * right * overlap_right);
  EXPECT_NEAR(e.normal_force(1), left * (overlap_left - u), round_off * right * overlap_right);
}

TEST(StaticStart, PressesForEverThroughALargeOverlap) {
  Scene scene = mass_point(1.0, Vec3(50.0, 0.0, 0.0), 1.0);
  ContactPoint point = contact_of(1.0, spring_at(contact::Stop{0.0, PlaneAxis::z}, 20.0), Vec3(0, 0, 0.5));
  point.b.row(2).setZero(); // no mode moves it along the normal
  scene.contacts = {point};
  EXPECT_NEAR(found(scene).normal_force(0), 10.0, round_off);
}

TEST(StaticStart, OfATubeThatHangsInAHoleLiesBelowAtAnyAngle) {
  constexpr double m = 3.0, stiffness = 1e6, weight = 30.0;
  for (const double gap : {0.0, 2e-4, 0.1})
    for (int k = 0; k < 12; ++k) {
      const double angle = 0.1 + 2.0 * std::numbers::pi * k / 12;
      const Vec3 down(0, std::cos(angle), std::sin(angle));
      Scene scene = mass_point(m, Vec3(10.0, 0.0, 0.0), 1.0); // rigid: only the hole holds it
      scene.contacts = {
          contact_of(m, spring_at(contact::Circle{gap}, stiffness), Vec3(0, 0.4 * gap, -0.3 * gap))};
      scene.loads = {force_on(m, weight * down, Constant{1.0})};
      const Equilibrium e = found(scene);
      EXPECT_NEAR(e.normal_force(0), weight, round_off * weight);
      const Vec3 place = scene.contacts[0].rest + scene.contacts[0].b * e.q;
      EXPECT_LT((place - (gap + weight / stiffness) * down).norm(), round_off * (gap + 1e-3))
          << gap << " " << angle;
    }
}

TEST(StaticStart, OfAStackOfLooseBodiesCarriesTheWeightAbove) {
  constexpr int bodies = 30;
  Scene scene;
  scene.system.stiffness = scene.system.damping = scene.q0 = scene.v0 = VectorXd::Zero(bodies);
  scene.duration = 1.0;
  VectorXd weight(bodies);
  for (int i = 0; i < bodies; ++i)
    weight(i) = 1.0 + 0.1 * i;
  scene.loads = {{Constant{-1.0}, weight}};
  for (int i = 0; i < bodies;
       ++i) { // body i stands on i - 1, the first on the ground; gaps and overlaps between them
    ContactPoint point{"joint", spring_at(contact::FacingPlanes{0.01, PlaneAxis::y, 1.0}, 1e5 * (1 + i % 3)),
                       Vec3(0, 0.01 + 1e-4 * (i % 5 - 2), 0), Eigen::MatrixXd::Zero(3, bodies)};
    point.b(1, i) = 1.0;
    if (i > 0)
      point.b(1, i - 1) = -1.0;
    scene.contacts.push_back(point);
  }
  const Equilibrium e = found(scene);
  for (int i = 0; i < bodies; ++i)
    EXPECT_NEAR(e.normal_force(i), weight.tail(bodies - i).sum(), round_off * weight.sum()) << i;
}

TEST(StaticStart, OfAPreloadedStackBetweenWallsHasOneForceThrough) {
  constexpr int bodies = 8;
  constexpr double stiffness = 1e6, overlap = 1e-4; // of every joint
  Scene scene;
  scene.system.stiffness = scene.system.damping = scene.q0 = scene.v0 = VectorXd::Zero(bodies);
  scene.duration = 1.0;
  for (int i = 0; i <= bodies; ++i) {
    ContactPoint point{"joint",
                       spring_at(contact::FacingPlanes{0.02, PlaneAxis::z, 1.0}, stiffness * (1 + i)),
                       Vec3(0, 0, 0.02 - overlap * (i == 0)), Eigen::MatrixXd::Zero(3, bodies)};
    if (i < bodies)
      point.b(2, i) = 1.0;
    if (i > 0)
      point.b(2, i - 1) = -1.0;
    scene.contacts.push_back(point);
  }
  double flexibility = 0.0;
  for (int i = 0; i <= bodies; ++i)
    flexibility += 1.0 / (stiffness * (1 + i));
  const Equilibrium e = found(scene);
  for (int i = 0; i <= bodies; ++i)
    EXPECT_NEAR(e.normal_force(i), overlap / flexibility, 1e3 * round_off)
        << i; // of penetrations of 1e-5 m at 2e-2 m
}

TEST(StaticStart, InTheCornerOfAHole) {
  std::vector<contact::PolarPoint> square;
  for (int k = 0; k < 4; ++k)
    square.push_back({(0.25 + 0.5 * k) * std::numbers::pi, std::sqrt(2.0) * 1e-3});
  constexpr double stiffness = 1e6, force = 20.0;
  for (const double angle :
       {0.3, 0.25 * std::numbers::pi, 1.2}) { // between the normals of the two facets: the corner holds it
    Scene scene = mass_point(1.0, Vec3(5.0, 0.0, 0.0), 1.0);
    scene.contacts = {contact_of(1.0, spring_at(contact::Profile(square), stiffness))};
    const Vec3 direction(0, std::cos(angle), std::sin(angle));
    scene.loads = {force_on(1.0, force * direction, Constant{1.0})};
    const Equilibrium e = found(scene);
    EXPECT_NEAR(e.normal_force(0), force, round_off * force);
    EXPECT_LT((e.q - Vec3(0, 1e-3, 1e-3) - force / stiffness * direction).norm(), round_off) << angle;
  }
}

// Round a corner between two faces the normal turns within a penetration: Newton's steps pass it, from face to face.
TEST(StaticStart, RoundTheCornersOfPolygons) {
  std::vector<contact::PolarPoint> polygon;
  constexpr int corners = 320, modes = 6, supports = 5, scenes = 60;
  constexpr double radius = 2e-4, stiffness = 1e6;
  for (int k = 0; k < corners; ++k)
    polygon.push_back({(k + 0.5) * 2.0 * std::numbers::pi / corners, radius});
  std::mt19937 engine(1);
  const auto uniform = [&engine](double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) / 4294967296.0;
  };
  for (int i = 0; i < scenes; ++i) {
    Scene scene = mass_point(1.0, Vec3::Zero(), 1.0);
    for (Eigen::VectorXd* x : {&scene.system.stiffness, &scene.system.damping, &scene.q0, &scene.v0})
      x->setZero(modes);
    for (int j = 0; j < modes; ++j)
      scene.system.stiffness(j) = std::pow(10.0, uniform(0.0, 4.0));
    Eigen::VectorXd load(modes);
    for (int j = 0; j < modes; ++j)
      load(j) = uniform(-5.0, 5.0);
    scene.loads = {{Constant{1.0}, load}};
    for (int c = 0; c < supports; ++c) {
      ContactPoint point = contact_of(1.0, spring_at(contact::Profile(polygon), stiffness));
      point.b.resize(3, modes);
      for (double& b : point.b.reshaped())
        b = uniform(-1.0, 1.0);
      point.rest = Vec3(0.0, uniform(-radius, radius), uniform(-radius, radius));
      scene.contacts.push_back(point);
    }
    const Equilibrium e = static_equilibrium(scene);
    EXPECT_EQ(e.balance, Balance::found) << i << ": " << e.residual << " after " << e.iterations;
  }
}

TEST(StaticStart, TakesLoadsAtTheStart) {
  Scene scene = mass_point(1.0, Vec3(2.0, 4.0, 8.0), 1.0);
  scene.loads = {force_on(1.0, Vec3(1, 0, 0), Harmonic{3.0, 5.0, 0.5}),
                 force_on(1.0, Vec3(0, 1, 0), Table{{0.0, 1.0}, {7.0, 9.0}}),
                 force_on(1.0, Vec3(0, 1, 1), Constant{-2.0})};
  EXPECT_LT((found(scene).q - Vec3(1.5 * std::sin(0.5), 1.25, -0.25)).norm(), round_off);
}

TEST(StaticStart, TurnsWithTheFrameOfItsHole) {
  Scene scene = Cantilever::scene(6, 1000.0, spring_at(contact::Circle{1e-4}, 1e8), Vec3(0, 3e-5, -6e-5));
  scene.loads.push_back({Constant{400.0}, scene.contacts[0].b.row(2)});
  const Equilibrium straight = found(scene);
  const double angle = 0.7;
  Eigen::Matrix3d turn;
  turn << 1, 0, 0, 0, std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle);
  scene.contacts[0].b = (turn * scene.contacts[0].b).eval();
  scene.contacts[0].rest = (turn * scene.contacts[0].rest).eval();
  const Equilibrium turned = found(scene);
  EXPECT_LT((straight.q - turned.q).norm(), round_off * straight.q.norm());
  EXPECT_NEAR(straight.normal_force(0), turned.normal_force(0), round_off * 1000.0);
  EXPECT_GT(straight.normal_force(0), 100.0);
}

TEST(StaticStart, NeedsAHoldForEveryLoad) {
  Scene scene = mass_point(4.0, Vec3(10.0, 0.0, 0.0), 1.0);
  scene.loads = {force_on(4.0, Vec3(0, 3, 4), Constant{1.0})};
  const auto expect_motion = [&](const Vec3& motion) {
    const Equilibrium e = static_equilibrium(scene);
    EXPECT_EQ(e.balance, Balance::not_held);
    ASSERT_EQ(e.motion.size(), 3);
    EXPECT_LT((e.motion - motion).norm(), 1e-6); // the rest is what the motion left behind
  };
  expect_motion(Vec3(0, 0.6, 0.8)); // nothing there
  scene.contacts = {contact_of(4.0, spring_at(contact::Stop{1e-3, PlaneAxis::z}, 1e5))};
  expect_motion(Vec3(0, 1, 0)); // held along z only, no contact along y
  scene.contacts = {contact_of(4.0, spring_at(contact::FacingPlanes{1e-3, PlaneAxis::z, 1.0}, 1e5))};
  scene.loads = {force_on(4.0, Vec3(0, 0, 4), Constant{1.0})};
  expect_motion(Vec3(0, 0, 1)); // a contact on the other side
  scene.contacts = {contact_of(4.0, spring_at(contact::RoundPair{1e-3}, 1e5), Vec3(0, 0, 2e-3))};
  expect_motion(Vec3(0, 0, 1));
}

TEST(StaticStart, LeavesAFreeMotionWithoutLoadWhereItIs) {
  Scene scene = mass_point(1.0, Vec3(10.0, 0.0, 0.0), 1.0);
  scene.contacts = {contact_of(1.0, spring_at(contact::Circle{1e-3}, 1e5), Vec3(0, 2e-4, 0))};
  scene.loads = {force_on(1.0, Vec3(5, 1e-12, 0), Constant{1.0})}; // round-off of a balanced load
  EXPECT_EQ((found(scene).q - Vec3(0.5, 0, 0)).norm(), 0.0);
  scene.contacts[0].rest.y() = 3e-3; // pressed by 2 mm: it gives way until it is free
  const Equilibrium e = found(scene);
  EXPECT_NEAR(e.q(1), -2e-3, round_off);
  EXPECT_LT(e.normal_force(0), 1e-6);
}

namespace {

/// Largest distance from the equilibrium and from its forces over a run that starts there, relative to them.
struct Drift {
  double displacement, force;
};
Drift drift(Scene scene, const StepOptions& options) {
  const Equilibrium e = static_equilibrium(scene);
  scene.q0 = e.q;
  const History run = simulate(scene, options, scene.duration / 200.0);
  const Eigen::MatrixXd& b = scene.contacts[0].b;
  const VectorXd u = b * e.q;
  return {((b * run.q).colwise() - u).colwise().norm().maxCoeff() / u.norm(),
          (run.normal.array() - e.normal_force(0)).abs().maxCoeff() / e.normal_force(0)};
}

/// A clamped beam pressed askew into a hole.
Scene preloaded(int modes) {
  Scene scene =
      Cantilever::scene(modes, 1000.0, spring_at(contact::Circle{1e-4}, 1e8), Vec3(0, 1.5e-4, 2e-4));
  scene.duration = 0.5;
  return scene;
}

} // namespace

TEST(StaticStart, IsWhereEulerStays) {
  const Drift d = drift(preloaded(5), euler(1e-5));
  EXPECT_LT(d.displacement, round_off);
  EXPECT_LT(d.force, round_off);
}

TEST(StaticStart, IsWhereSplittingStaysAtAnyStep) {
  const Scene scene = preloaded(5);
  const double highest = std::sqrt(scene.system.stiffness.maxCoeff());
  constexpr double sweeps = 1e-7; // what they leave, settled to 1e-4 of changes
  for (const double wh : {2.4, 0.8, 0.1}) {
    const Drift d = drift(scene, splitting(wh / highest));
    EXPECT_LT(d.displacement, sweeps) << wh;
    EXPECT_LT(d.force, sweeps) << wh;
  }
}

} // namespace static_start_test
