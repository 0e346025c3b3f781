// SPDX-License-Identifier: GPL-3.0-or-later
// Static displacements under many loads: closed forms of held structures, inertia relief of free ones, digits on fine meshes.
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include "expect_error.hpp"
#include "fem/fields.hpp"
#include "fem/petsc_static.hpp"
#include "fem/rigid_motions.hpp"
#include "model_builder.hpp"

namespace petsc_static_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

constexpr double round_off = 1e-10; ///< of elements whose stiffnesses differ by 1e4

/// Unit forces along y at nodes of the whole model, one a column.
Eigen::MatrixXd forces_at(const ModelBuilder& b, const std::vector<Index>& nodes, int dof = 1) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(b.model.nodes.size()) * 6,
                                              static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    out(nodes[k] * 6 + dof, static_cast<Eigen::Index>(k)) = 1.0;
  return out;
}

double bending_stiffness(const ModelBuilder& b) {
  return b.model.properties[0].material.young_modulus * b.model.properties[0].section.iz;
}

} // namespace

TEST(StaticSolver, GivesAllFlexibilitiesOfACantilever) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, 10, b.property(tube_property()));
  b.fix(nodes.front(), all);
  const auto part = fem::structures(b.model).at(0);
  const std::vector<Index> loaded = {nodes[3], nodes[7], nodes[10]};
  const Eigen::MatrixXd forces = forces_at(b, loaded);
  const Eigen::MatrixXd flexibility = forces.transpose() * fem::StaticSolver(b.model, part).solve(forces);
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j) {
      const double x = 0.1 * loaded[static_cast<std::size_t>(std::min(i, j))],
                   y = 0.1 * loaded[static_cast<std::size_t>(std::max(i, j))];
      const double exact = x * x * (3.0 * y - x) / (6.0 * bending_stiffness(b));
      EXPECT_NEAR(flexibility(i, j) / exact, 1.0, round_off) << i << " " << j;
    }
}

TEST(StaticSolver, KeepsItsDigitsOnAFineMesh) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, 2000, b.property(tube_property()));
  b.fix(nodes.front(), all);
  const auto part = fem::structures(b.model).at(0);
  const Eigen::MatrixXd forces = forces_at(b, {nodes.back()});
  const double tip = (forces.transpose() * fem::StaticSolver(b.model, part).solve(forces))(0, 0);
  constexpr double improved = 1e-9; // the factor alone: 1e-16 times the number of elements to the power 4
  EXPECT_NEAR(tip * 3.0 * bending_stiffness(b), 1.0, improved);
}

// 1 - cos x cosh x = x^4/6 - x^8/2520 + ...: the sum of 1/x^4 over its roots is 1/420, and every mode has 4/m at the end.
TEST(StaticSolver, RelievesAFreeBeamByItsInertia) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {2, 0, 0}, 100, b.property(tube_property()));
  const auto part = fem::structures(b.model).at(0);
  const Eigen::MatrixXd forces = forces_at(b, {nodes.front(), nodes.back()});
  const Eigen::MatrixXd u = fem::StaticSolver(b.model, part).solve(forces);
  constexpr double of_the_mesh = 1e-7; // the deflection is of degree five: order 4
  const double exact = 8.0 / (105.0 * bending_stiffness(b));
  EXPECT_NEAR(u(1, 0) / exact, 1.0, of_the_mesh);
  EXPECT_NEAR(u(6 * nodes.back() + 1, 1) / exact, 1.0, of_the_mesh);
  const Eigen::MatrixXd rigid = fem::rigid_motions(b.model, part);
  EXPECT_LT((rigid.transpose() * fem::mass_times(b.model, part, u)).cwiseAbs().maxCoeff(),
            round_off * u.cwiseAbs().maxCoeff());
}

// Two free masses and the spring between them: each alone moves by the stretch's share, both together by the stretch.
TEST(StaticSolver, OfTwoFreeMassesIsTheirSpring) {
  constexpr double m1 = 2.0, m2 = 3.0, k = 500.0;
  ModelBuilder b;
  const Index one = b.node({0, 0, 0}), two = b.node({0, 1, 0});
  b.fix_everywhere(ux | uz | rx | ry | rz);
  b.model.masses = {{one, m1}, {two, m2}};
  b.model.springs.push_back({one, two, {0, k, 0, 0, 0, 0}, {}});
  const auto part = fem::structures(b.model).at(0);
  const fem::StaticSolver solver(b.model, part);
  const Eigen::MatrixXd alone = forces_at(b, {one});
  const double share = m2 / (m1 + m2);
  EXPECT_NEAR((alone.transpose() * solver.solve(alone))(0, 0) * k, share * share, round_off);
  const Eigen::MatrixXd pair = alone - forces_at(b, {two});
  EXPECT_NEAR((pair.transpose() * solver.solve(pair))(0, 0) * k, 1.0, round_off);
}

TEST(StaticSolver, HoldsWhatNothingStiffens) {
  ModelBuilder b;
  const Index one = b.node({0, 0, 0});
  b.fix(one, rx | ry | rz);
  b.model.masses = {{one, 2.0}};
  const Eigen::MatrixXd force = forces_at(b, {one});
  EXPECT_EQ(fem::StaticSolver(b.model, fem::structures(b.model).at(0)).solve(force).norm(), 0.0);
}

// A pendulum of beams: pressed at the middle it turns, and bends as the beam of the same inertia relief.
TEST(StaticSolver, IsSymmetricForAMechanism) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, 10, b.property(tube_property()));
  b.fix(nodes.front(), ux | uy | uz | rx | ry);
  const auto part = fem::structures(b.model).at(0);
  ASSERT_EQ(fem::rigid_motions(b.model, part).cols(), 1);
  const Eigen::MatrixXd forces = forces_at(b, {nodes[4], nodes[6], nodes[10]});
  const Eigen::MatrixXd f = forces.transpose() * fem::StaticSolver(b.model, part).solve(forces);
  EXPECT_LT((f - f.transpose()).cwiseAbs().maxCoeff(), round_off * f.maxCoeff());
  EXPECT_TRUE(core::Cholesky(f).is_positive_definite());
}

TEST(StaticSolver, IgnoresForcesOnRestraints) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, 4, b.property(tube_property()));
  b.fix(nodes.front(), all);
  const auto part = fem::structures(b.model).at(0);
  const fem::StaticSolver solver(b.model, part);
  EXPECT_EQ(solver.solve(forces_at(b, {nodes.front()})).norm(), 0.0);
  EXPECT_EQ(solver.solve(Eigen::MatrixXd(30, 0)).cols(), 0);
}

namespace {

/// A beam of four elements on springs of N/m and N m/rad at its begin; 1 N at its end moves that.
double moved_on_springs(double k) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, 4, b.property(tube_property()));
  b.model.springs.push_back({nodes.front(), -1, {k, k, k, k, k, k}, {}});
  const auto part = fem::structures(b.model).at(0);
  const Eigen::MatrixXd force = forces_at(b, {nodes.back()});
  return (force.transpose() * fem::StaticSolver(b.model, part).solve(force))(0, 0);
}

} // namespace

TEST(StaticSolver, IsGoodOrRefusesWhatIsHardlyHeld) {
  constexpr double soft = 1e-7; // beside 1e8 N/m along the elements: the factor has no more than a digit
  EXPECT_NEAR(moved_on_springs(soft) * soft, 2.0, round_off);
  EXPECT_THROW((void)moved_on_springs(1e-12), core::ComputationError);
}

} // namespace petsc_static_test
