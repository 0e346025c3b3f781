// SPDX-License-Identifier: GPL-3.0-or-later
// Static modes: what the modes lack of static displacements, M-orthonormal to them and to each other.
#include "../fem/expect_error.hpp"
#include "../fem/model_builder.hpp"
#include "core/error.hpp"
#include "fem/fields.hpp"
#include "fem/petsc_static.hpp"
#include "modal/damping.hpp"
#include "modal/static_flexibility.hpp"
#include "modal/static_modes.hpp"
#include "solve.hpp"
#include <gtest/gtest.h>

namespace static_modes_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

constexpr double all_modes = 1e9;     // Hz
constexpr double orthonormal = 1e-12; ///< round-off of sums over some hundred dofs
constexpr double diagonal =
    1e-9; ///< of K, beside the geometric mean of two omega^2: round-off of the highest
constexpr double static_solution = 1e-9; ///< of a direction's flexibility
constexpr double by_a_plane = 1e-9;      ///< relative difference of the frequencies of two equal planes
constexpr int elements = 24, nodes = elements + 1;

/// A tube along x, held as given at its first node.
struct Tube {
  ModelBuilder b;
  fem::Structure part;

  explicit Tube(unsigned restraints) {
    const auto line = b.line({0, 0, 0}, {1, 0, 0}, elements, b.property(tube_property()));
    b.fix(line.front(), restraints);
    part = fem::structures(b.model).at(0);
  }
  [[nodiscard]] Eigen::MatrixXd solved(const Eigen::MatrixXd& forces) const {
    return fem::StaticSolver(b.model, part).solve(forces);
  }
  [[nodiscard]] modal::Basis with_static_modes(const modal::Basis& basis,
                                               const Eigen::MatrixXd& forces) const {
    modal::Basis out = basis;
    modal::add_static_modes(b.model, part, forces, solved(forces), out);
    return out;
  }
};

/// Unit forces, one a column: at node `at[k]` along dof `along[k]`.
Eigen::MatrixXd unit_forces(std::vector<int> at, std::vector<int> along) {
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(6 * nodes, static_cast<Eigen::Index>(at.size()));
  for (std::size_t k = 0; k < at.size(); ++k)
    forces(6 * at[k] + along[k], static_cast<Eigen::Index>(k)) = 1.0;
  return forces;
}

/// Transverse, coupled, in both planes.
Eigen::MatrixXd three_points() { return unit_forces({8, 9, 20, 20}, {1, 1, 1, 2}); }

} // namespace

TEST(StaticModes, AreOrthonormalToTheModesAndDiagonalInBothMatrices) {
  for (const unsigned restraints : {unsigned{all}, 0u, unsigned{ux | uy | uz | rx | ry}}) {
    const Tube tube(restraints);
    const modal::Basis before = solve(tube.b.model, 12);
    const modal::Basis basis = tube.with_static_modes(before, three_points());
    ASSERT_EQ(basis.static_modes, 4) << restraints;
    ASSERT_EQ(basis.true_modes(), 12);
    EXPECT_EQ(basis.shapes.leftCols(12), before.shapes) << "the true modes stay as they are";
    EXPECT_EQ(basis.omega.head(12), before.omega);
    const Eigen::MatrixXd mass =
        basis.shapes.transpose() * fem::mass_times(tube.b.model, tube.part, basis.shapes);
    EXPECT_LT((mass - Eigen::MatrixXd::Identity(16, 16)).cwiseAbs().maxCoeff(), orthonormal) << restraints;
    EXPECT_LT(basis.orthogonality, orthonormal);
    const Eigen::MatrixXd stiffness =
        basis.shapes.transpose() * fem::stiffness_times(tube.b.model, tube.part, basis.shapes);
    const Eigen::VectorXd energy = fem::twice_strain_energy(tube.b.model, tube.part, basis.shapes);
    EXPECT_LT((energy.tail(4) - basis.omega.tail(4).cwiseAbs2()).cwiseAbs().maxCoeff(),
              diagonal * energy(15)); // of true modes omega^2 has the motion inside the beams too
    const double highest = basis.omega(15);
    for (Eigen::Index i = 0; i < 16; ++i)
      for (Eigen::Index j = 0; j < 16; ++j) {
        const double expected = i == j ? energy(i) : 0.0;
        EXPECT_LT(std::abs(stiffness(i, j) - expected), diagonal * highest * highest) << i << " " << j;
      }
    for (Eigen::Index i = 1; i < 16; ++i)
      EXPECT_GE(basis.omega(i), basis.omega(i - 1));
  }
}

TEST(StaticModes, MoveTheLoadedPointsAsStaticsDoUnderAnyLoad) {
  for (const unsigned restraints : {unsigned{all}, 0u}) {
    const Tube tube(restraints);
    const Eigen::MatrixXd points = three_points(), elsewhere = unit_forces({3, 15, 24}, {1, 2, 5});
    const modal::Basis basis = tube.with_static_modes(solve(tube.b.model, 12), points);
    const Eigen::MatrixXd exact = points.transpose() * tube.solved(points),
                          under_loads = points.transpose() * tube.solved(elsewhere);
    EXPECT_LT((modal::flexibility_of(basis, points) - exact).cwiseAbs().maxCoeff(),
              static_solution * exact.maxCoeff());
    const Eigen::MatrixXd of_basis =
        modal::static_gain(basis, points) * (basis.shapes.transpose() * elsewhere);
    EXPECT_LT((of_basis - under_loads).cwiseAbs().maxCoeff(),
              static_solution * under_loads.cwiseAbs().maxCoeff())
        << restraints;
    EXPECT_GT((modal::flexibility_of(solve(tube.b.model, 12), points) - exact).cwiseAbs().maxCoeff(),
              1e3 * static_solution * exact.maxCoeff())
        << "something is missing without them";
  }
}

TEST(StaticModes, AreNotAddedWhereTheModesLackNothing) {
  const Tube tube(unsigned{all});
  const modal::Basis every = solve_up_to(tube.b.model, all_modes);
  EXPECT_EQ(tube.with_static_modes(every, three_points()).size(), every.size());
  // the clamped node does not move
  const modal::Basis some = solve(tube.b.model, 12);
  EXPECT_EQ(tube.with_static_modes(some, unit_forces({0, 0}, {1, 2})).size(), 12);
  EXPECT_EQ(tube.with_static_modes(some, unit_forces({0, 10}, {1, 1})).static_modes, 1);
}

TEST(StaticModes, AreOneWhereTwoLoadsAreOne) {
  const Tube tube(unsigned{all});
  const modal::Basis some = solve(tube.b.model, 12);
  const modal::Basis once = tube.with_static_modes(some, unit_forces({10}, {1})),
                     twice = tube.with_static_modes(some, unit_forces({10, 10}, {1, 1}));
  EXPECT_EQ(once.static_modes, 1);
  EXPECT_EQ(twice.static_modes, 1);
  EXPECT_NEAR(twice.omega(12), once.omega(12), by_a_plane * once.omega(12));
}

TEST(StaticModes, OfTwoEqualPlanesHaveTheSameFrequencyAndFixedAxes) {
  const Tube tube(unsigned{all});
  const modal::Basis basis = tube.with_static_modes(solve(tube.b.model, 12), unit_forces({10, 10}, {1, 2}));
  ASSERT_EQ(basis.static_modes, 2);
  EXPECT_EQ(basis.omega(12), basis.omega(13));
  const Eigen::Index y = 6 * 10 + 1, z = y + 1;
  for (const Eigen::Index mode : {12, 13}) { // each in one plane
    const double along_y = std::abs(basis.shapes(y, mode)), along_z = std::abs(basis.shapes(z, mode));
    EXPECT_LT(std::min(along_y, along_z), orthonormal * std::max(along_y, along_z));
  }
}

TEST(StaticModes, AreDampedByTheWholeMatrixOfDampers) {
  Tube tube(unsigned{all});
  fem::Spring& damper = tube.b.model.springs.emplace_back();
  damper.node = 14;
  damper.damping[1] = 30.0;
  tube.part = fem::structures(tube.b.model).at(0);
  modal::Basis basis = tube.with_static_modes(solve(tube.b.model, 6), unit_forces({10, 20}, {1, 1}));
  ASSERT_EQ(basis.static_modes, 2);
  const Eigen::VectorXd at = basis.shapes.row(6 * 14 + 1).transpose();
  EXPECT_GT(std::abs(at(7)), 0.0);
  modal::apply_damping(basis, 0.01);
  const Eigen::MatrixXd expected =
      30.0 * at * at.transpose() + Eigen::MatrixXd((0.02 * basis.omega).asDiagonal());
  EXPECT_LT((basis.damping_matrix - expected).cwiseAbs().maxCoeff(), orthonormal * expected.maxCoeff());
}

TEST(StaticModes, NeedMass) {
  ModelBuilder b;
  fem::BeamProperty massless = tube_property();
  massless.material.density = 0.0;
  const auto line = b.line({0, 0, 0}, {0.5, 0, 0}, elements, b.property(tube_property()));
  const auto tip = b.line_from(line.back(), {1.0, 0, 0}, 1, b.property(massless));
  b.fix(line.front(), unsigned{all});
  b.fix(tip.back(), unsigned{ux | uz | rx | ry | rz});
  const fem::Structure part = fem::structures(b.model).at(0);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(6 * (nodes + 1), 1);
  force(6 * nodes + 1, 0) = 1.0;
  modal::Basis basis = solve_up_to(b.model, all_modes);
  expect_error(
      [&] {
        modal::add_static_modes(b.model, part, force, fem::StaticSolver(b.model, part).solve(force), basis);
      },
      {"one of them moves no mass", "leave modes.static_modes out"});
}

} // namespace static_modes_test
