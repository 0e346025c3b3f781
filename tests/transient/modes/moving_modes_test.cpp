// SPDX-License-Identifier: GPL-3.0-or-later
// Modes that nothing moves are left out, and the others move as if these were there.
#include "scenes.hpp"
#include "transient/modes/moving_modes.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace moving_modes_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using namespace fretwork::vibration;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Modes = std::vector<Index>;

namespace {

constexpr double before_chaos =
    1e-9; // of the largest: round-off of sums in another order, grown by some impacts

/// The scene with modes of 40 Hz among its own that nothing moves: they get the numbers `at`.
Scene with_still_modes(const Scene& scene, const Modes& at) {
  const Index n = scene.system.size() + static_cast<Index>(at.size());
  Modes kept;
  for (Index i = 0; i < n; ++i)
    if (std::find(at.begin(), at.end(), i) == at.end())
      kept.push_back(i);
  Scene out = scene;
  const auto spread = [&](const VectorXd& values, double still) {
    VectorXd all = VectorXd::Constant(n, still);
    all(kept) = values;
    return all;
  };
  out.system.stiffness = spread(scene.system.stiffness, 6.3e4);
  out.system.damping = spread(scene.system.damping, 5.0);
  for (Load& load : out.loads)
    load.modal_force = spread(load.modal_force, 0.0);
  for (ContactPoint& point : out.contacts) {
    const MatrixXd b = point.b;
    point.b = MatrixXd::Zero(3, n);
    point.b(Eigen::all, kept) = b;
  }
  out.q0 = spread(scene.q0, 0.0);
  out.v0 = spread(scene.v0, 0.0);
  return out;
}

/// Four modes without contacts, loads or motion.
Scene still(double duration) {
  Scene scene;
  scene.system.stiffness = VectorXd::Constant(4, 1e4);
  scene.system.damping = scene.q0 = scene.v0 = VectorXd::Zero(4);
  scene.duration = duration;
  return scene;
}

} // namespace

TEST(MovingModes, AreThoseOfContactsLoadsAndInitialState) {
  Scene scene = still(1.0);
  EXPECT_EQ(moving_modes(scene), Modes{});
  scene.q0(3) = 1e-300;
  EXPECT_EQ(moving_modes(scene), Modes{3});
  scene.v0(0) = -1e-300;
  EXPECT_EQ(moving_modes(scene), (Modes{0, 3}));
  scene.loads.push_back({Constant{0.0}, VectorXd::Unit(4, 1)});
  EXPECT_EQ(moving_modes(scene), (Modes{0, 1, 3}));
  ContactPoint point;
  point.b = MatrixXd::Zero(3, 4);
  point.b(0, 2) = 1e-300; // friction would act along x_loc
  scene.contacts.push_back(point);
  EXPECT_EQ(moving_modes(scene), (Modes{0, 1, 2, 3}));
}

TEST(MovingModes, AreThoseThatDampingCouplesToThem) {
  Scene scene = still(1.0);
  scene.system.damping_matrix = MatrixXd::Identity(4, 4);
  scene.system.damping_matrix(3, 1) = scene.system.damping_matrix(1, 3) = 0.1;
  scene.system.damping_matrix(0, 1) = scene.system.damping_matrix(1, 0) = 0.1;
  scene.v0(3) = 1.0;
  EXPECT_EQ(moving_modes(scene), (Modes{0, 1, 3}));
  const Scene reduced = with_modes(scene, moving_modes(scene));
  EXPECT_EQ(reduced.system.damping_matrix, scene.system.damping_matrix({0, 1, 3}, {0, 1, 3}));
}

TEST(MovingModes, MoveWithTheSameBytesWhereTheSumsRunInTheSameOrder) {
  // 11 modes and 5 that stay: they fill the lanes up to 16 as padding does
  const Scene moving = rattling(5, 11, 0.5), whole = with_still_modes(moving, {11, 12, 13, 14, 15});
  const Scene reduced = with_modes(whole, moving_modes(whole));
  ASSERT_EQ(reduced.system.size(), 11);
  for (const StepOptions& options : {splitting(1e-4), collocation(1e-4), euler(2e-5)}) {
    const History a = simulate(whole, options, 1e-3), b = simulate(reduced, options, 1e-3);
    EXPECT_EQ(a.q.topRows(11), b.q);
    EXPECT_EQ(a.v.topRows(11), b.v);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_TRUE(a.q.bottomRows(5).isZero(0.0));
    EXPECT_TRUE(a.v.bottomRows(5).isZero(0.0));
    EXPECT_EQ(a.report.energy.modal_damping, b.report.energy.modal_damping);
    EXPECT_EQ(a.report.energy.friction, b.report.energy.friction);
    EXPECT_GT(a.report.energy.friction, 0.0);
  }
}

TEST(MovingModes, MoveAlikeInAnyOrder) {
  const Scene moving = rattling(3, 9, 0.05), whole = with_still_modes(moving, {0, 4, 5});
  const Modes modes = moving_modes(whole);
  ASSERT_EQ(modes, (Modes{1, 2, 3, 6, 7, 8, 9, 10, 11}));
  for (const StepOptions& options : {splitting(5e-5), energy_conserving(5e-5)}) {
    const History a = simulate(whole, options, 1e-3), b = simulate(with_modes(whole, modes), options, 1e-3);
    EXPECT_LT((a.q(modes, Eigen::all) - b.q).norm(), before_chaos * b.q.norm());
    EXPECT_GT(b.normal.maxCoeff(), 0.0);
  }
}

TEST(MovingModes, MayBeNone) {
  const Scene none = with_modes(still(1.0), {});
  ASSERT_EQ(none.system.size(), 0);
  for (const SchemeKind scheme :
       {SchemeKind::splitting, SchemeKind::collocation, SchemeKind::euler, SchemeKind::energy_conserving,
        SchemeKind::devogelaere, SchemeKind::runge_kutta_54}) {
    const History run = simulate(none, {scheme, 1e-3}, 0.1);
    EXPECT_EQ(run.report.outcome, Outcome::done) << name_of(scheme);
    EXPECT_EQ(run.time.size(), 11);
    EXPECT_EQ(run.report.energy.stored, 0.0);
  }
}

} // namespace moving_modes_test
