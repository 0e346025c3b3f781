// SPDX-License-Identifier: GPL-3.0-or-later
// A static equilibrium with contacts is a minimum of the energy: found by another method too, left where it is none.
#include "equilibria.hpp"
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace static_minimum_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using namespace fretwork::vibration;
using contact::PlaneAxis;
using Eigen::VectorXd;

namespace {

/// Sum of the modal forces at q, from their definition.
VectorXd unbalanced(const Scene& scene, const VectorXd& q) {
  VectorXd force = -scene.system.stiffness.cwiseProduct(q);
  for (const Load& load : scene.loads)
    force += Signal(load.function, scene.duration)(0.0) * load.modal_force;
  for (const ContactPoint& point : scene.contacts) {
    const Vec3 u = point.rest + point.b * q;
    const auto at = contact::locate(point.support.obstacle, u.y(), u.z());
    if (at.gap < 0.0)
      force -= point.support.normal.stiffness * at.gap *
               (at.ny * point.b.row(1) + at.nz * point.b.row(2)).transpose();
  }
  return force;
}

double energy_of(const Scene& scene, const VectorXd& q) {
  double sum = 0.5 * q.dot(scene.system.stiffness.cwiseProduct(q));
  for (const Load& load : scene.loads)
    sum -= Signal(load.function, scene.duration)(0.0) * load.modal_force.dot(q);
  for (const ContactPoint& point : scene.contacts) {
    const Vec3 u = point.rest + point.b * q;
    const double gap = contact::locate(point.support.obstacle, u.y(), u.z()).gap;
    sum += gap < 0.0 ? 0.5 * point.support.normal.stiffness * gap * gap : 0.0;
  }
  return sum;
}

} // namespace

TEST(StaticStart, LeavesAPlaceWhereItWouldNotStay) {
  constexpr double stiffness = 1e5, distance = 0.02, force = 10.0;
  const auto on_top =
      [&](double lateral) { // a round body pressed on another along y, free to roll off along z
        Scene scene = mass_point(1.0, Vec3(5.0, 1.0, lateral), 1.0);
        scene.contacts = {
            contact_of(1.0, spring_at(contact::RoundPair{distance}, stiffness), Vec3(0, distance, 0))};
        scene.loads = {force_on(1.0, Vec3(0, -force, 0), Constant{1.0})};
        return scene;
      };
  constexpr double critical = force / distance; // F_N / r, to the penetration F/K
  EXPECT_EQ(found(on_top(1.1 * critical)).q(2), 0.0);
  const Scene scene = on_top(0.8 * critical);
  const VectorXd top = Vec3(0, -force / (stiffness + 1.0), 0);
  EXPECT_LT(unbalanced(scene, top).norm(), round_off * force); // an equilibrium too
  const Equilibrium e = found(scene); // it rolls off and hangs on its spring of 1 N/m along y
  EXPECT_LT((e.q - Vec3(0, -force, 0)).norm(), round_off * force);
  EXPECT_EQ(e.normal_force(0), 0.0);
  EXPECT_LT(energy_of(scene, e.q), energy_of(scene, top));
}

TEST(StaticStart, SlipsOffTheTipsOfAStar) {
  std::vector<contact::PolarPoint> star;
  for (int k = 0; k < 10; ++k)
    star.push_back({0.2 * std::numbers::pi * k, k % 2 == 0 ? 1e-3 : 3e-3});
  constexpr double stiffness = 1e6, force = 20.0;
  for (int k = 0; k < 24; ++k) { // even k: towards a tip or along the middle of an arm
    const double angle = std::numbers::pi * k / 10.0;
    Scene scene = mass_point(1.0, Vec3(5.0, 0.0, 0.0), 1.0);
    scene.contacts = {contact_of(1.0, spring_at(contact::Profile(star), stiffness))};
    scene.loads = {force_on(1.0, force * Vec3(0, std::cos(angle), std::sin(angle)), Constant{1.0})};
    const Equilibrium e = found(scene);
    EXPECT_NEAR(e.normal_force(0), force, round_off * force) << angle;
    EXPECT_LT(unbalanced(scene, e.q).norm(), round_off * force) << angle;
    EXPECT_GT(e.q.norm(), 2.5e-3) << angle; // out in an arm, not on a tip
  }
}

namespace {

/// Elastic modes and a few rigid ones that contacts hold, against planes and holes, some overlapping.
Scene random_scene(unsigned seed, int modes, int contacts) {
  std::mt19937 draw(seed);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(draw()) / 4294967296.0;
  };
  Scene scene;
  scene.system.stiffness = VectorXd::NullaryExpr(modes, [&] { return number(10.0, 1000.0); });
  scene.system.stiffness(0) = 0.0;
  scene.system.damping = scene.q0 = scene.v0 = VectorXd::Zero(modes);
  scene.duration = 1.0;
  for (int c = 0; c < contacts; ++c) {
    const double gap = number(0.0, 0.05);
    const std::array<contact::Obstacle, 5> obstacles = {
        contact::Circle{gap}, contact::PlanePair{gap, PlaneAxis::y}, contact::Stop{gap, PlaneAxis::z},
        contact::PlanePair{gap, PlaneAxis::z}, contact::FacingPlanes{gap, PlaneAxis::y, -1.0}};
    ContactPoint point{"contact",
                       spring_at(obstacles[static_cast<std::size_t>(c) % 5], number(100.0, 5000.0)),
                       Vec3(0, number(-0.1, 0.1), number(-0.1, 0.1)), Eigen::MatrixXd::Zero(3, modes)};
    point.b = point.b.unaryExpr([&](double) { return number(-1.0, 1.0); });
    scene.contacts.push_back(point);
  }
  scene.loads = {{Constant{1.0}, VectorXd::NullaryExpr(modes, [&] { return number(-10.0, 10.0); })}};
  return scene;
}

/// Descent along the gradient with Nesterov's momentum, restarted where it climbs: nothing of Newton's method.
VectorXd descend(const Scene& scene) {
  double steepest = scene.system.stiffness.maxCoeff();
  for (const ContactPoint& point : scene.contacts)
    steepest += point.support.normal.stiffness * point.b.bottomRows<2>().squaredNorm();
  VectorXd x = VectorXd::Zero(scene.system.size()), y = x;
  double t = 1.0;
  for (int k = 0; k < 200000; ++k) {
    const VectorXd force = unbalanced(scene, y), next = y + force / steepest;
    if (force.dot(next - x) < 0.0)
      t = 1.0;
    const double after = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * t * t));
    y = next + (t - 1.0) / after * (next - x);
    t = after;
    if ((next - x).norm() < 1e-15 * (1.0 + next.norm()) && k > 100)
      break;
    x = next;
  }
  return x;
}

} // namespace

TEST(StaticStart, OfRandomScenesIsTheMinimumAnotherMethodFinds) {
  constexpr double of_descent =
      1e-7; // what a gradient method reaches in these iterations, relative to the displacements
  int closed = 0;
  for (unsigned seed = 1; seed <= 25; ++seed) {
    const Scene scene = random_scene(seed, 8, 6);
    const Equilibrium e = found(scene);
    const VectorXd q = descend(scene);
    EXPECT_LT((e.q - q).norm(), of_descent * (1.0 + q.norm())) << seed;
    EXPECT_LT(unbalanced(scene, e.q).norm(), round_off * scene.loads[0].modal_force.norm()) << seed;
    closed += static_cast<int>((e.normal_force.array() > 0.0).count());
  }
  EXPECT_GT(closed, 50);
}

TEST(StaticStart, OfManyModesAndContactsIsFoundToRoundOff) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Scene scene = random_scene(seed, 150, 100);
    const Equilibrium e = found(scene);
    EXPECT_LT(e.iterations, 60) << seed; // changes of contact status, not a crawl
    EXPECT_EQ((e.q - static_equilibrium(scene).q).norm(), 0.0);
  }
}

} // namespace static_minimum_test
