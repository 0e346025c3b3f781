// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace fretwork::tests {

using namespace transient;

namespace {

constexpr double mass = 1.0, stiffness = 1e5, radius = 1e-3,
                 pressure = 100.0; // pressed in by the radius of its hole
const double contact_frequency = std::sqrt(stiffness / mass);

/// A mass pressed against its hole that a harmonic force rocks, for 20 s: it slides most of the time.
Scene rocking() {
  Scene scene = mass_point(mass, Vec3::Zero(), 20.0);
  scene.contacts = {contact_of(mass, {contact::Circle{radius}, {stiffness}, {stiffness, 1500.0, 0.3, 0.3}})};
  scene.loads = {force_on(mass, {0.0, pressure, 0.0}, Constant{1.0}),
                 force_on(mass, {0.0, 0.0, 0.9 * pressure}, Harmonic{1.0, 23.0})};
  start(scene, mass, {0.0, 2.0 * radius, 0.0}, Vec3::Zero());
  return scene;
}

/// What the ledger misses, of the work of friction.
double missed(double resolution) {
  const Energy energy = simulate(rocking(), splitting(resolution / contact_frequency), 1.0).report.energy;
  return std::abs(energy.residual()) / energy.friction;
}

} // namespace

// Paths by the velocity at the actions alone miss (h^2/6) F_N/(m r) = (w_c h)^2/6 of the work: 1e-2 and 6.7e-5.
TEST(SlidingPaths, BalanceTheEnergyOfATubeThatRocksInItsHole) {
  EXPECT_LT(missed(0.25), 1e-3);
  EXPECT_LT(missed(0.02), 3e-6);
}

} // namespace fretwork::tests
