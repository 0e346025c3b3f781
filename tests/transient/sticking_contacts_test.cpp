// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that stick under dampers of any speed, as those of a rod in its grids: nodes between two pressed stops each, modes to any frequency.
#include "scenes.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace sticking_contacts_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;

namespace {

constexpr double overlap = 1e-3; // m: far above the motion

class Draw {
public:
  explicit Draw(unsigned seed) : generator_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / static_cast<double>(std::mt19937::max());
  }
  double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

private:
  std::mt19937 generator_;
};

/// At rest but for the velocities of its modes. @param damper_rate, normal_rate  of contacts, over the frequency of the highest mode
Scene held_between_stops(unsigned seed, double damper_rate, double normal_rate = 0.0,
                         bool hunt_crossley = false) {
  Draw draw(seed);
  const int nodes = 1 + static_cast<int>(draw.uniform(0.0, 6.0)),
            each = static_cast<int>(draw.uniform(8.0, 24.0)), modes = 3 * each;
  Scene scene;
  scene.system.stiffness.resize(modes);
  const double highest = draw.logarithmic(500.0, 6000.0); // rad/s
  const bool bends = draw.uniform(0.0, 1.0) < 0.6;
  for (int i = 0; i < modes; ++i) {
    const double share = (1.0 + i / 3) / each;
    scene.system.stiffness(i) = std::pow(highest * (bends ? share * share : share) + 1.0, 2);
  }
  scene.system.damping = 0.01 * scene.system.stiffness.cwiseSqrt();
  const double middle = draw.uniform(0.1, 0.9), spread = draw.logarithmic(0.01, 1.0),
               contact_frequency = highest * draw.logarithmic(0.1, 1.0);
  double mobility = 0.0;
  for (int node = 0; node < nodes; ++node) {
    const double x = std::fmod(middle + spread * draw.uniform(0.0, 1.0), 1.0);
    ContactPoint point;
    point.support.obstacle = contact::Stop{0.0, contact::PlaneAxis::y};
    point.rest = {0.0, overlap, 0.0};
    point.b = Eigen::MatrixXd::Zero(3, modes);
    for (int i = 0; i < modes; ++i)
      point.b((i + 1) % 3, i) = std::sin((1 + i / 3) * std::numbers::pi * x);
    mobility = std::max(mobility, point.b.row(1).squaredNorm());
    scene.contacts.push_back(point);
    point.b.bottomRows(2) *= -1.0;
    scene.contacts.push_back(point);
  }
  const double normal = 0.5 * contact_frequency * contact_frequency / mobility,
               tangential = normal * draw.logarithmic(0.05, 1.0),
               damping = 0.5 * normal_rate * highest / mobility;
  contact::NormalLaw law{normal, damping};
  if (hunt_crossley)
    law = {normal, 0.0, damping / (normal * overlap)};
  for (ContactPoint& point : scene.contacts)
    point.support = {
        point.support.obstacle, law, {tangential, 0.5 * damper_rate * highest / mobility, 10.0, 10.0}};
  scene.q0 = Eigen::VectorXd::Zero(modes);
  scene.v0 = Eigen::VectorXd::NullaryExpr(
      modes, [&] { return 1e-5 * highest / std::sqrt(modes) * draw.uniform(-1.0, 1.0); });
  scene.duration = 6000.0 / highest; // so that it is not the fewest steps of a run that are taken
  return scene;
}

/// Of the energy that the modes begin with.
double growth(const Scene& scene) {
  StepOptions options;
  options.scheme = SchemeKind::splitting;
  const Report report = run(scene, choose_step(scene, options), {}, nullptr, {});
  const double pressed = static_cast<double>(scene.contacts.size()) *
                         scene.contacts.front().support.normal.spring_energy(overlap);
  return (report.energy.stored - pressed) / (0.5 * scene.v0.squaredNorm());
}

} // namespace

TEST(StickingContacts, LoseEnergyAtTheAutomaticStep) {
  for (unsigned seed = 0; seed < 10; ++seed)
    for (const double damper_rate : {0.3, 3.0, 30.0, 150.0})
      EXPECT_LT(growth(held_between_stops(seed, damper_rate)), 1.0) << seed << " " << damper_rate;
}

TEST(PressedContacts, LoseEnergyAtTheAutomaticStepBesideNormalDampers) {
  for (unsigned seed = 0; seed < 8; ++seed)
    for (const double normal_rate : {0.3, 3.0, 15.0})
      for (const double damper_rate : {0.0, 30.0})
        EXPECT_LT(growth(held_between_stops(seed, damper_rate, normal_rate)), 1.0)
            << seed << " " << normal_rate << " " << damper_rate;
  EXPECT_LT(growth(held_between_stops(8, 150.0, 3.0)), 1.0); // 64 intervals a step, twelve contacts
}

TEST(PressedContacts, LoseEnergyAtTheAutomaticStepBesideHuntAndCrossleysDampers) {
  for (unsigned seed = 0; seed < 8; ++seed)
    for (const double normal_rate : {0.3, 3.0, 15.0})
      EXPECT_LT(growth(held_between_stops(seed, 0.0, normal_rate, true)), 1.0) << seed << " " << normal_rate;
}

} // namespace sticking_contacts_test
