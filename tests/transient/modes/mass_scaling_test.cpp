// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/recorder.hpp"
#include "scenes.hpp"
#include "transient/modes/mass_scaling.hpp"
#include "transient/scene/scheme_limits.hpp"
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace mass_scaling_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

constexpr double round_off = 1e-12;

/// A node on a soft mode (100 rad/s) and a stiff one (2e4) that give way to a stop together, and a stiff mode that the stop does not move.
/// Their own frequency with the stop: 1000 rad/s of the soft mode and about 1.4e3 of both.
Scene two_modes_on_a_stop(double duration) {
  Scene scene;
  scene.system.stiffness = Eigen::Vector3d(1e4, 4e8, 4e8);
  scene.system.damping = Eigen::Vector3d(2.0, 200.0, 200.0);
  ContactPoint stop{
      "stop", {contact::Circle{1e-3}, {1e6, 50.0}, {}}, Vec3::Zero(), Eigen::MatrixXd::Zero(3, 3)};
  stop.b.row(1) << 1.0, 1.0, 0.0;
  scene.contacts = {stop};
  scene.q0 = scene.v0 = Eigen::Vector3d::Zero();
  scene.v0(0) = 0.5;
  scene.duration = duration;
  return scene;
}

/// Largest force and impulse of the first contact.
struct Peak final : Observer {
  double force = 0.0, impulse = 0.0;
  std::array<Observer*, 1> list{this};
  void step(const Record& record) override {
    force = std::max(force, record.states[0].normal_force);
    impulse += record.step * record.states[0].normal_force;
  }
  void visit(core::StateArchive&) override {}
};

/// The stiff mode, record by record.
struct Moving final : Observer {
  std::vector<std::pair<double, double>> seen;
  std::array<Observer*, 1> list{this};
  void step(const Record& record) override { seen.emplace_back(record.time, record.q[1]); }
  void visit(core::StateArchive&) override {}
};

} // namespace

TEST(MassScaling, ScalesTheFastModesThatContactsMove) {
  const Scene scene = two_modes_on_a_stop(1.0);
  const Eigen::VectorXd masses = scaled_masses(scene, 5e3);
  EXPECT_EQ(masses(0), 1.0);
  EXPECT_NEAR(masses(1), 16.0, round_off); // (2e4/5e3)^2
  EXPECT_EQ(masses(2), 1.0) << "no contact moves it";
  EXPECT_TRUE((scaled_masses(scene, 0.0).array() == 1.0).all());
}

TEST(MassScaling, KeepsFlexibilityAndEnergyAndMovesWithTheFrequencyAsked) {
  Scene scene = two_modes_on_a_stop(1.0);
  scene.loads = {{Constant{1.0}, Eigen::Vector3d(1.0, 3.0, 2.0)}};
  scene.q0 << 1.0, 2.0, 3.0;
  scene.system.damping_matrix = Eigen::Matrix3d{{2, 1, 0}, {1, 200, 4}, {0, 4, 200}};
  const Eigen::Vector3d masses(1.0, 16.0, 1.0), s = masses.cwiseSqrt().cwiseInverse();
  const Scene p = with_masses(scene, masses);
  EXPECT_NEAR(std::sqrt(p.system.stiffness(1)), 5e3, 1e-8);
  // b K^-1 b^T, b K^-1 f and b q0 are those of q
  const Eigen::MatrixXd by_contact = p.contacts[0].b * p.system.stiffness.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd before = scene.contacts[0].b * scene.system.stiffness.cwiseInverse().asDiagonal();
  EXPECT_TRUE((by_contact * p.contacts[0].b.transpose())
                  .isApprox(before * scene.contacts[0].b.transpose(), round_off));
  EXPECT_TRUE((by_contact * p.loads[0].modal_force).isApprox(before * scene.loads[0].modal_force, round_off));
  EXPECT_TRUE((s.asDiagonal() * p.q0).isApprox(scene.q0, round_off));
  EXPECT_TRUE((p.system.damping_matrix)
                  .isApprox(s.asDiagonal() * scene.system.damping_matrix * s.asDiagonal(), round_off));
  EXPECT_NEAR(p.system.stiffness.dot(p.q0.cwiseAbs2()), scene.system.stiffness.dot(scene.q0.cwiseAbs2()),
              1e-3);
}

// A force that depends on the motion damps a mode by its frequency: none is moved.
TEST(MassScaling, LeavesModesUnderForcesOfMotion) {
  Scene scene = two_modes_on_a_stop(1.0);
  EXPECT_TRUE(may_scale(scene, 5e3, 0.01));
  core::MotionForces& law = scene.system.motion;
  law.stiffness = Eigen::Matrix3d::Zero();
  law.damping = 1e-3 * Eigen::Matrix3d::Identity();
  law.input = Eigen::MatrixXd::Zero(3, 0);
  law.output = Eigen::MatrixXd::Zero(0, 3);
  ASSERT_FALSE(law.empty());
  EXPECT_FALSE(may_scale(scene, 5e3, 0.01));
}

// The force of an impact without rebound begins with a jump, which moves all modes.
TEST(MassScaling, LeavesModesBesideFastNormalDampers) {
  Scene scene = two_modes_on_a_stop(100.0); // the step is that of the contact
  const StepChoice without = choose_step(scene, splitting());
  ASSERT_EQ(without.scaled, 1);
  scene.contacts[0].support.normal.damping = 100.0 * without.contact_frequency;
  const StepChoice fast = choose_step(scene, splitting());
  EXPECT_EQ(fast.scaled, 0);
  EXPECT_LE(fast.highest_mode * fast.step, limits_of(SchemeKind::splitting).highest_mode.largest);
  EXPECT_GT(fast.normal_damper_rate * without.step, scaled_up_to_damper);
}

TEST(MassScaling, GivesTheImpactOfTheExactModes) {
  Scene scene = two_modes_on_a_stop(6e-3); // one impact
  scene.contacts[0].b(1, 1) = 3.0;         // w_c = 3162 rad/s with the stiff mode
  StepChoice scaled = choose_step(scene, splitting());
  scaled.step = 0.45 / scaled.contact_frequency;
  scaled.steps = static_cast<std::int64_t>(scene.duration / scaled.step);
  const double resonance = std::numbers::pi / scaled.step;
  scene.system.stiffness(1) = resonance * resonance;
  scaled.fastest = limits_of(SchemeKind::splitting).highest_mode.largest / scaled.step;
  Peak exact, with;
  (void)run(scene, choose_step(scene, splitting(1e-7)), exact.list, nullptr, {});
  const Report report = run(scene, scaled, with.list, nullptr, {});
  EXPECT_NEAR(with.force / exact.force, 1.0, 0.02);
  EXPECT_NEAR(with.impulse / exact.impulse, 1.0, 0.005);
  EXPECT_LT(report.residual_relative, 1e-2);
}

TEST(MassScaling, KeepsClearOfTheResonance) {
  Scene scene = two_modes_on_a_stop(2.0);
  scene.contacts[0].support.normal.damping = 0.0;
  scene.system.damping.setZero();
  scene.contacts[0].b(1, 1) = 3.0;
  StepChoice choice = choose_step(scene, splitting());
  choice.step = 0.2 / choice.contact_frequency;
  choice.fastest = 0.0;
  choice.steps = static_cast<std::int64_t>(scene.duration / choice.step);
  const double near_a_period = 6.2 / choice.step; // where a kick meets its own answer
  scene.system.stiffness(1) = near_a_period * near_a_period;
  const double plain = run(scene, choice, {}, nullptr, {}).residual_relative;
  choice.fastest = limits_of(SchemeKind::splitting).highest_mode.largest / choice.step;
  const double scaled = run(scene, choice, {}, nullptr, {}).residual_relative;
  EXPECT_LT(scaled, 0.01);
  EXPECT_GT(plain, 1.5 * scaled);
}

TEST(MassScaling, ShowsDisplacementsAndAccelerationsOfTheModes) {
  Scene scene = two_modes_on_a_stop(5e-3); // which it does not reach
  scene.system.damping.setZero();
  scene.v0.setZero();
  scene.q0(1) = 1e-4;
  scene.loads = {{Constant{1.0}, Eigen::Vector3d(0.0, 8e3, 0.0)}}; // bends the stiff mode by 2e-5
  StepChoice choice = choose_step(scene, splitting(2.5e-4));
  choice.fastest = 1e4; // rad/s, half of its frequency: a mass of 4
  const OutputGrid grid = output_grid(scene.duration, 1e-5);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, 3);
  rows(0, 1) = 1.0;
  post::Recorder recorder(scene, {{"stiff", rows}}, grid, scaled_masses(scene, choice.fastest));
  Moving moving;
  (void)run(scene, choice, moving.list, &recorder, grid);
  const post::TimeSeries series = std::move(recorder).series();
  const auto& node = series.nodes[0];
  for (Eigen::Index j = 0; j < series.time.size(); ++j) {
    const double angle = 1e4 * series.time(j);
    EXPECT_NEAR(node.displacement(j, 0), 2e-5 + 8e-5 * std::cos(angle), round_off);
    EXPECT_NEAR(node.velocity(j, 0), -0.8 * std::sin(angle), 1e4 * round_off);
    EXPECT_NEAR(node.acceleration(j, 0), -8e3 * std::cos(angle), 1e8 * round_off);
  }
  for (const auto& [time, q] : moving.seen)
    EXPECT_NEAR(q, 2e-5 + 8e-5 * std::cos(1e4 * time), round_off);
}

TEST(MassScaling, IsNotForModesThatMoveByThemselves) {
  const double fastest = 5e3;
  const auto allowed = [&](const Scene& scene) { return may_scale(scene, fastest, 0.01); };
  Scene scene = two_modes_on_a_stop(1.0);
  EXPECT_TRUE(allowed(scene));
  scene.v0(1) = 0.01; // (0.01/0.5)^2 = 4e-4 of the energy
  EXPECT_TRUE(allowed(scene));
  scene.v0(1) = 0.02; // 1.6e-3
  EXPECT_FALSE(allowed(scene));
  scene.v0(1) = 0.0;
  scene.q0(1) = 1e-6; // 4e8 (1e-6)^2 = 4e-4 of 0.25
  EXPECT_FALSE(allowed(scene));
  scene.loads = {{Constant{1.0}, Eigen::Vector3d(100.0, 400.0, 0.0)}}; // in which it rests: q = f/k
  EXPECT_TRUE(allowed(scene));
  scene.loads[0].modal_force(1) = 0.0;
  scene.q0(1) = 0.0;
  scene.loads.push_back({Harmonic{1.0, 10.0}, Eigen::Vector3d(1.0, 19.0, 0.0)}); // 361/4e8 of 1/1e4: 0.9 %
  EXPECT_TRUE(allowed(scene));
  scene.loads[1].modal_force(1) = 21.0;
  EXPECT_FALSE(allowed(scene));
  // random loads that start anywhere add up whatever their signs
  scene.loads = {{Random{1.0, 1.0, 10.0, 1}, Eigen::Vector3d(1.0, 19.0, 0.0)},
                 {Random{1.0, 1.0, 10.0, 2}, Eigen::Vector3d(-1.0, -19.0, 0.0)}};
  scene.v0.setZero();
  EXPECT_FALSE(allowed(scene)); // 0.9 % of the energy, 0.1 % allowed
  scene.loads.pop_back();
  scene.loads[0].modal_force(1) = 6.0;
  EXPECT_TRUE(allowed(scene)); // 0.09 %
}

// A preload bends them at the start, and goes on to: a contact that pushes with f bends each mode by f b/k.
TEST(MassScaling, IsForModesThatContactsHoldBent) {
  const double fastest = 5e3, force = 400.0;
  Scene scene = two_modes_on_a_stop(1.0);
  scene.v0.setZero();
  scene.q0 << -force / 1e4, -force / 4e8, 0.0;
  EXPECT_FALSE(may_scale(scene, fastest, 1e-4)) << "nothing holds them";
  const double penetration = force / 1e6;
  scene.contacts[0].rest.y() = 1e-3 + penetration - scene.q0.sum();
  EXPECT_TRUE(may_scale(scene, fastest, 1e-4));
  scene.q0.setZero();
  EXPECT_TRUE(may_scale(scene, fastest, 1e-4)) << "the contact makes it vibrate";
}

TEST(MassScaling, IsNotForModesThatJumpsAndPulsesShake) {
  Scene scene = two_modes_on_a_stop(1.0);
  const auto allowed = [&](const Table& table, double on_stiff) {
    scene.loads = {{table, Eigen::Vector3d(1.0, on_stiff, 0.0)}};
    return may_scale(scene, 5e3, 0.01);
  };
  const auto ramp = [](double rise) { return Table{{0.0, 0.5, 0.5 + rise, 1.0}, {0.0, 0.0, 1.0, 1.0}}; };
  EXPECT_TRUE(allowed(ramp(1.3e-3), 1.0)); // 2 pi/5e3 = 1.257e-3
  EXPECT_FALSE(allowed(ramp(1.2e-3), 1.0));
  EXPECT_FALSE(allowed(ramp(0.0), 1.0));
  EXPECT_FALSE(allowed(Table{{0.0, 0.5, 0.5 + 1e-9, 0.5 + 2e-9, 1.0}, {0.0, 0.0, 1e6, 0.0, 0.0}}, 1.0));
  EXPECT_TRUE(allowed(ramp(0.0), 0.0)) << "which does not act on them";
}

} // namespace mass_scaling_test
