// SPDX-License-Identifier: GPL-3.0-or-later
// Modal forces given by samples: what schemes and the step rule make of them.
#include "scenes.hpp"
#include "signals/sampled_forces.hpp"
#include "transient/modes/mass_scaling.hpp"
#include "transient/modes/moving_modes.hpp"
#include "transient/scene_rates.hpp"
#include "transient/statics/static_start.hpp"
#include "vibration/load_sum.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace fretwork::transient::sampled_loads_test {
namespace {

using namespace signals;
using namespace vibration;
using tests::sampled_sines;
using tests::SineSamples;
constexpr double round_off = 1e-14;

TEST(SampledLoad, AddsToOtherLoadsAndIsSharedByAllThatReadIt) {
  const SampledLoad load = sampled_sines({1.0, 0.0}, 0.01);
  LoadSum sum({{Constant{2.0}, Eigen::Vector2d(1, 3)}}, 2, 1.0, 1e-3, {load}),
      alone({}, 2, 1.0, 1e-3, {load});
  EXPECT_FALSE(sum.constant());
  EXPECT_FALSE(alone.empty());
  kernels::Array f(kernels::padded(2)), g(f);
  sum.instant(0.123, f.data());
  alone.instant(0.123, g.data());
  EXPECT_NEAR(f[0], 2.0 + g[0], round_off);
  EXPECT_EQ(f[1], 6.0);
  EXPECT_EQ(g[1], 0.0);
  EXPECT_NE(g[0], 0.0);
}

TEST(SampledLoad, ActsOnTheModesThatAreKept) {
  Scene scene = tests::mass_point(1.0, core::Vec3(1e4, 2e4, 3e4), 1.0);
  scene.sampled_loads = {sampled_sines({1.0, 0.0, 2.0}, 0.01)};
  EXPECT_EQ(moving_modes(scene), (std::vector<Eigen::Index>{0, 2}));
  const Scene kept = with_modes(scene, {2});
  double f = 0.0;
  SampledForce(kept.sampled_loads[0]).add(0.4, &f);
  EXPECT_NEAR(f, SineSamples::value(2.0, 0.4), 1e-12);
  const Scene heavier =
      with_masses(scene, Eigen::Vector3d(1.0, 1.0, 4.0)); // modal forces in the unit of a mode of mass 1
  double all[3] = {};
  SampledForce(heavier.sampled_loads[0]).add(0.4, all);
  EXPECT_NEAR(all[2], 0.5 * f, 1e-12);
  EXPECT_EQ(heavier.sampled_loads[0].rms(2), 1.0);
}

TEST(SampledLoad, IsSeenByTheStepRuleAndByNoStaticStart) {
  Scene scene = tests::mass_point(1.0, core::Vec3(1e4, 2e4, 3e4), 1.0);
  scene.sampled_loads = {sampled_sines({1.0, 1.0, 1.0}, 0.01)};
  scene.sampled_loads[0].highest = 123.0;
  EXPECT_EQ(rates_of(scene).excitation, 123.0);
  const Equilibrium e = static_equilibrium(scene);
  EXPECT_EQ(e.balance, Balance::found);
  EXPECT_TRUE(e.q.isZero(0.0));
  scene.sampled_loads[0].scale.setZero();
  EXPECT_EQ(rates_of(scene).excitation, 0.0);
}

TEST(SampledLoad, DrivesEverySchemeAlike) {
  // a mass on springs without contacts: against the motion by the exact flow at a tenth of the step
  constexpr double mass = 1.0;
  const auto end_of = [&](SchemeKind kind, double step) {
    Scene scene = tests::mass_point(mass, core::Vec3(400.0, 900.0, 1600.0), 1.0);
    scene.system.damping = Eigen::Vector3d(0.4, 0.6, 0.8);
    scene.sampled_loads = {sampled_sines({1.0, 2.0, 3.0}, 2e-3)};
    StepOptions options;
    options.scheme = kind;
    options.step = step;
    return Eigen::VectorXd(tests::simulate(scene, options, 0.1).q.rightCols(1));
  };
  const Eigen::VectorXd exact = end_of(SchemeKind::splitting, 1e-5);
  EXPECT_GT(exact.norm(), 1e-3);
  constexpr double of_step = 2e-3; // (w h)^2 of the fastest motion, with room for the schemes of order 2
  for (const SchemeKind kind : {SchemeKind::splitting, SchemeKind::collocation, SchemeKind::energy_conserving,
                                SchemeKind::devogelaere, SchemeKind::runge_kutta_54})
    EXPECT_LT((end_of(kind, 5e-4) - exact).norm(), of_step * exact.norm()) << static_cast<int>(kind);
}

/// Noise whose points are closer than a millionth of the run, on a mass beside an obstacle that it never meets: its motion at steps of the points.
TEST(Records, DriveModesAsTheyAreHoweverCloseTheirPoints) {
  constexpr double interval = 2e-5, duration = 25.0, w = 1000.0, mass = 2.0;
  Table noise;
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int k = 0; interval * k <= duration; ++k) {
    noise.time.push_back(interval * k);
    noise.value.push_back(normal(random));
  }
  Scene scene = tests::mass_point(mass, core::Vec3(w * w * mass, 0.25 * w * w * mass, 4.0), duration);
  scene.system.damping = Eigen::Vector3d(20.0, 20.0, 1.0);
  scene.contacts = {tests::contact_of(mass, {contact::Circle{10.0}, {10.0}, {}})};
  scene.loads = {tests::force_on(mass, core::Vec3(1.0, 1.0, 0.0), noise)};
  const auto deviations = [&](const StepOptions& options) {
    const Eigen::MatrixXd q = tests::simulate(scene, options, 0.5e-3).q;
    return Eigen::VectorXd((q.rowwise().squaredNorm() / static_cast<double>(q.cols())).cwiseSqrt());
  };
  const Eigen::VectorXd exact = deviations(tests::splitting(interval));
  for (const SchemeKind kind : {SchemeKind::splitting, SchemeKind::collocation}) {
    StepOptions automatic;
    automatic.scheme = kind;
    const Eigen::VectorXd found = deviations(automatic);
    for (const int mode : {0, 1})
      EXPECT_NEAR(found(mode), exact(mode), 0.01 * exact(mode)) << name_of(kind) << " " << mode;
  }
  EXPECT_GT(choose_step(scene, tests::splitting()).step, 10.0 * interval);
}

} // namespace
} // namespace fretwork::transient::sampled_loads_test
