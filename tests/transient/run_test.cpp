// SPDX-License-Identifier: GPL-3.0-or-later
// The run: outputs, independence of who watches, divergence, full damping matrices.
#include "scenes.hpp"
#include <cstring>
#include <gtest/gtest.h>
#include <unsupported/Eigen/MatrixFunctions>

namespace run_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

/// Exact motion of a linear scene under one load that is linear between the points of a table: exponential of
/// the augmented matrix.
Eigen::VectorXd exact(const Scene& scene, const Table& table, const Eigen::VectorXd& shape, double time) {
  const Eigen::Index n = scene.system.size();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2);
  a.block(0, n, n, n).setIdentity();
  a.block(n, 0, n, n) = -scene.system.stiffness.asDiagonal().toDenseMatrix();
  a.block(n, n, n, n) = scene.system.damping_matrix.size() > 0
                            ? Eigen::MatrixXd(-scene.system.damping_matrix)
                            : Eigen::MatrixXd(-scene.system.damping.asDiagonal().toDenseMatrix());
  a.block(n, 2 * n, n, 1) = shape;
  a(2 * n, 2 * n + 1) = 1.0;
  Eigen::VectorXd z(2 * n + 2);
  z << scene.q0, scene.v0, 0.0, 0.0;
  for (std::size_t i = 0; i + 1 < table.time.size() && table.time[i] < time; ++i) {
    const double from = table.time[i], to = std::min(table.time[i + 1], time);
    z(2 * n) = table.value[i];
    z(2 * n + 1) = (table.value[i + 1] - table.value[i]) / (table.time[i + 1] - from);
    z = (a * (to - from)).exp() * z;
  }
  return z.head(2 * n);
}

Scene linear_scene() {
  Scene scene = mass_point(1.0, Vec3(40.0, 900.0, 0.0), 1.0);
  scene.system.damping = Vec3(0.3, 70.0, 2.0); // under- and overdamped, a dragged rigid mode
  start(scene, 1.0, Vec3(0.1, -0.2, 0.3), Vec3(1.0, 0.5, -1.0));
  return scene;
}

struct Totals {
  std::vector<post::ContactSummary> statistics;
  Energy energy;
  double residual;
};

Totals watched(const Scene& scene, const StepOptions& options, Sampler* sampler, const OutputGrid& grid,
               bool more_observers) {
  const StepChoice choice = choose_step(scene, options);
  post::ContactStatistics statistics(scene.contacts, 0.05);
  Trace other(static_cast<std::size_t>(choice.steps));
  Observer* const observers[] = {&statistics, &other};
  const Report report = run(scene, choice, std::span(observers, more_observers ? 2 : 1), sampler, grid);
  return {statistics.summaries(), report.energy, report.residual_relative};
}

struct Silent final : Sampler {
  void visit(core::StateArchive&) override {}
  void state(std::int64_t, double, const double*, const double*) override { ++states; }
  void forces(std::int64_t, double, const double*, std::span<const ContactForce>) override { ++forces_seen; }
  int states = 0, forces_seen = 0;
};

bool same_bytes(const Totals& a, const Totals& b) {
  return a.statistics.size() == b.statistics.size() &&
         std::memcmp(&a.energy, &b.energy, sizeof a.energy) == 0 && a.residual == b.residual &&
         std::memcmp(a.statistics.data(), b.statistics.data(),
                     a.statistics.size() * sizeof(a.statistics[0])) == 0;
}

} // namespace

TEST(DenseOutput, OfSplittingIsExactUnderAConstantLoad) {
  Scene scene = linear_scene();
  const Vec3 shape(2.0, -30.0, 1.0);
  scene.loads = {{Constant{1.5}, shape}};
  const Table table{{0.0, 9.0}, {1.5, 1.5}};
  constexpr double tolerance = 1e-12; // round-off
  const History run = simulate(scene, splitting(0.07), 0.013);
  for (Eigen::Index j = 0; j < run.time.size(); ++j) {
    const Eigen::VectorXd z = exact(scene, table, shape, run.time(j));
    EXPECT_LT((run.q.col(j) - z.head(3)).norm(), tolerance) << run.time(j);
    EXPECT_LT((run.v.col(j) - z.tail(3)).norm(), tolerance) << run.time(j);
  }
}

TEST(DenseOutput, OfSplittingIsExactUnderALoadLinearBetweenItsSteps) {
  Scene scene = linear_scene();
  const Vec3 shape(2.0, -30.0, 1.0);
  constexpr double h = 0.08; // of the intervals of the table too
  Table table{{0.0}, {1.0}};
  for (int k = 1; k < 15; ++k) {
    table.time.push_back(k * h);
    table.value.push_back((k % 3) - 0.7 * (k % 5));
  }
  scene.loads = {{table, shape}};
  constexpr double tolerance = 1e-12;
  const History run = simulate(scene, splitting(h), 0.013);
  for (Eigen::Index j = 0; j < run.time.size(); ++j) {
    const Eigen::VectorXd z = exact(scene, table, shape, run.time(j));
    EXPECT_LT((run.q.col(j) - z.head(3)).norm(), tolerance) << run.time(j);
    EXPECT_LT((run.v.col(j) - z.tail(3)).norm(), tolerance) << run.time(j);
  }
}

TEST(DenseOutput, StartsAtTheInitialState) {
  for (const StepOptions& options : {splitting(0.01), euler(0.001)}) {
    const Scene scene = linear_scene();
    const History run = simulate(scene, options, 0.1);
    EXPECT_EQ(run.time(0), 0.0);
    EXPECT_EQ((run.q.col(0) - scene.q0).norm(), 0.0);
    EXPECT_EQ((run.v.col(0) - scene.v0).norm(), 0.0);
  }
}

TEST(OutputGrid, HoldsEveryInstantOfTheRunWhateverTheRoundOff) {
  EXPECT_EQ(output_grid(1.0, 0.1).count, 11);
  EXPECT_EQ(output_grid(0.3, 0.1).count, 4); // 0.3 / 0.1 = 2.9999999999999996
  EXPECT_EQ(output_grid(1.0, 0.3).count, 4);
  EXPECT_EQ(output_grid(1.0, 3.0).count, 1);
}

TEST(Run, ServesEveryOutputOnceStateAndForces) {
  const Scene scene = rattling(2, 4, 0.1);
  for (const StepOptions& options : {splitting(1e-3), euler(1e-4)})
    for (const double every : {1e-5, 3.7e-4, 0.01, 0.1}) {
      Silent silent;
      const OutputGrid grid = output_grid(scene.duration, every);
      (void)watched(scene, options, &silent, grid, false);
      EXPECT_EQ(silent.states, grid.count);
      EXPECT_EQ(silent.forces_seen, grid.count);
    }
}

TEST(Run, DoesNotDependOnOutputsNorOnObservers) {
  const Scene scene = rattling(5, 12, 0.3);
  for (const StepOptions& options : {splitting(1e-4), euler(2e-5)}) {
    Silent silent;
    const Totals alone = watched(scene, options, nullptr, {}, false);
    EXPECT_TRUE(same_bytes(alone, watched(scene, options, &silent, output_grid(0.3, 1e-3), false)));
    EXPECT_TRUE(same_bytes(alone, watched(scene, options, &silent, output_grid(0.3, 3.3e-5), true)));
    EXPECT_GT(alone.statistics[0].impacts, 3);
    const Report unseen = run(scene, choose_step(scene, options), {}, nullptr, {}); // no positions of records
    EXPECT_EQ(std::memcmp(&alone.energy, &unseen.energy, sizeof alone.energy), 0);
    EXPECT_EQ(alone.residual, unseen.residual_relative);
  }
}

TEST(Run, ReportsADivergenceAsItsOutcome) {
  Scene scene = mass_point(1.0, Vec3(0, 1e6, 0), 10.0);
  start(scene, 1.0, Vec3(0, 1e-3, 0), Vec3::Zero());
  const History run = simulate(scene, euler(2.1e-3), 0.01); // w_max h = 2.1, limit 2
  EXPECT_EQ(run.report.outcome, Outcome::diverged);
  EXPECT_LT(run.report.end_time, 1.0);
  EXPECT_LT(run.report.counts.steps, run.choice.steps);
  EXPECT_EQ(simulate(scene, euler(1.9e-3), 0.01).report.outcome, Outcome::done);

  Scene contact = mass_point(1.0, Vec3::Zero(), 10.0);
  start(contact, 1.0, Vec3::Zero(), Vec3(0, 0.1, 0));
  contact.contacts = {contact_of(1.0, {contact::PlanePair{0.01, contact::PlaneAxis::y}, {1e6}, {}})};
  EXPECT_EQ(simulate(contact, euler(5e-3), 0.01).report.outcome, Outcome::diverged); // w_c h = 5
  EXPECT_EQ(simulate(contact, splitting(5e-3), 0.01).report.outcome, Outcome::done);
}

TEST(Run, ReportsADivergenceToInfinityToo) {
  Scene scene = mass_point(1.0, Vec3(0, 1e12, 0), 10.0);
  start(scene, 1.0, Vec3(0, 1e200, 0), Vec3::Zero()); // its energy overflows in the first steps
  EXPECT_EQ(simulate(scene, euler(0.1), 0.1).report.outcome, Outcome::diverged);
}

TEST(Run, OfASceneAtRestIsDone) {
  const Scene scene = mass_point(1.0, Vec3(0, 1.0, 0), 1.0);
  const History run = simulate(scene, splitting(), 0.1);
  EXPECT_EQ(run.report.outcome, Outcome::done);
  EXPECT_EQ(run.report.residual_relative, 0.0);
  EXPECT_EQ(run.q.norm(), 0.0);
}

TEST(Euler, WithAFullDampingMatrixAgreesWithTheMatrixExponentialInOrderOne) {
  Scene scene = linear_scene();
  scene.system.damping_matrix = Eigen::Matrix3d{{3.0, 2.0, -1.0}, {2.0, 5.0, 0.5}, {-1.0, 0.5, 4.0}};
  const Vec3 shape(2.0, -30.0, 1.0);
  const Table table{{0.0, 0.4, 9.0}, {1.0, -1.0, -1.0}};
  scene.loads = {{table, shape}};
  double last = 0.0;
  for (const double h : {1e-3, 5e-4, 2.5e-4, 1.25e-4, 6.25e-5}) {
    const History run = simulate(scene, euler(h), 0.1);
    const Eigen::VectorXd z = exact(scene, table, shape, 1.0);
    const double error = (run.q.col(10) - z.head(3)).norm() / z.head(3).norm() +
                         (run.v.col(10) - z.tail(3)).norm() / z.tail(3).norm();
    if (last > 0.0) {
      EXPECT_NEAR(error / last, 0.5, 0.05);
    }
    last = error;
  }
  constexpr double final_error = 2e-3; // w_max h = 2e-3
  EXPECT_LT(last, final_error);
}

TEST(Euler, WithADiagonalDampingMatrixGivesWhatItsDiagonalGives) {
  Scene diagonal = linear_scene(), full = diagonal;
  full.system.damping_matrix = full.system.damping.asDiagonal();
  const History a = simulate(diagonal, euler(1e-3), 0.1), b = simulate(full, euler(1e-3), 0.1);
  constexpr double round_off = 1e-13;
  EXPECT_LT((a.q - b.q).norm(), round_off);
  EXPECT_LT(std::abs(a.report.energy.modal_damping - b.report.energy.modal_damping),
            1e-2 * a.report.energy.modal_damping);
}

TEST(Run, KeepsTheImpulseOfPulsesShorterThanSteps) {
  constexpr double round_off = 1e-12, mass = 2.0, impulse = 3.0, h = 1e-3, half = 2e-4;
  for (const SchemeKind kind :
       {SchemeKind::splitting, SchemeKind::collocation, SchemeKind::euler, SchemeKind::energy_conserving,
        SchemeKind::devogelaere, SchemeKind::runge_kutta_54})
    for (int phase = 0; phase < 60;
         ++phase) { // among the steps, their ends and middles too; in the first two and later
      const double t = (phase < 40 ? half : 0.02) + h * (phase % 40) / 20.0;
      Scene scene = mass_point(mass, Vec3::Zero(), 0.05);
      scene.loads = {
          force_on(mass, Vec3(0, 1, 0),
                   Table{{0.0, t - half, t, t + half, 0.05}, {0.0, 0.0, impulse / half, 0.0, 0.0}})};
      const History run = simulate(scene, {kind, h}, 1e-3);
      EXPECT_NEAR(run.v(1, 45) / std::sqrt(mass), impulse / mass, round_off) << name_of(kind) << " " << t;
      const bool booked_in_part =
          kind == SchemeKind::euler && t - half < h;            // its first record starts the energy balance
      if (kind != SchemeKind::devogelaere && !booked_in_part) { // which books power at its nodes
        EXPECT_NEAR(run.report.energy.load_work, 0.5 * impulse * impulse / mass, round_off) << name_of(kind);
      }
    }
}

TEST(Run, TakesNoImpulseFromBeforeItsStart) {
  constexpr double round_off = 1e-12, mass = 2.0, impulse = 3.0, h = 1e-3;
  for (const SchemeKind kind :
       {SchemeKind::splitting, SchemeKind::collocation, SchemeKind::euler, SchemeKind::energy_conserving,
        SchemeKind::devogelaere, SchemeKind::runge_kutta_54})
    for (const double length : {1e-6, 0.1 * h, 0.4 * h, 0.8 * h}) {
      Scene scene = mass_point(mass, Vec3::Zero(), 0.05);
      scene.loads = {
          force_on(mass, Vec3(0, 1, 0),
                   Table{{0.0, length, 0.05}, {2.0 * impulse / length, 0.0, 0.0}})}; // constant before
      const History run = simulate(scene, {kind, h}, 1e-3);
      EXPECT_NEAR(run.v(1, 45) / std::sqrt(mass), impulse / mass, round_off)
          << name_of(kind) << " " << length;
    }
}

} // namespace run_test
