// SPDX-License-Identifier: GPL-3.0-or-later
// Effective modal masses: what a shaking base moves in each mode.
#include "../fem/model_builder.hpp"
#include "core/symmetric.hpp"
#include "fem/node_blocks.hpp"
#include "solve.hpp"
#include <gtest/gtest.h>

namespace effective_mass_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

constexpr double all_modes = 1e9; // Hz

Vec3 sum_of_effective_masses(const modal::Basis& basis) {
  return basis.participation.colwise().squaredNorm().transpose();
}

ModelBuilder tube_with_body() {
  ModelBuilder b;
  fem::BeamProperty p = tube_property();
  p.added_mass = 0.5; // across the tube only
  const auto nodes = b.line({0, 0, 0}, {0, 0, 2}, 12, b.property(p));
  b.model.masses.push_back({nodes[5], 3.0, Vec3(0.1, 0.1, 0.2), Vec3(0.02, 0.0, 0.03)});
  return b;
}

} // namespace

TEST(EffectiveMass, OfAllModesOfAFreeStructureIsItsMass) {
  const auto model = tube_with_body().model;
  const auto basis = solve_up_to(model, all_modes);
  const auto& p = model.properties[0];
  const double along = 2.0 * p.material.density * p.section.area + 3.0;
  const Vec3 mass(along + 1.0, along + 1.0, along);
  EXPECT_LT((sum_of_effective_masses(basis) - mass).cwiseAbs().maxCoeff(), 1e-10 * along);
  EXPECT_LT((basis.moving_mass - mass).cwiseAbs().maxCoeff(), 1e-12 * along);
}

TEST(EffectiveMass, OfAllModesOfAHeldStructureIsTheMassThatItsFreeDofsReach) {
  auto b = tube_with_body();
  b.fix(0, all);
  b.fix(12, ux | uy);
  const auto part = fem::structures(b.model).at(0);
  const auto basis = solve_up_to(b.model, all_modes);
  ASSERT_EQ(basis.size(), part.equations);
  // M of the free dofs, and its product with a translation of all dofs
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(part.equations, part.equations),
                  moved = Eigen::MatrixXd::Zero(part.equations, 3);
  const auto blocks = fem::node_blocks(b.model, part, 0, 13);
  for (std::size_t i = 0; i < 13; ++i)
    for (std::size_t k = blocks.start[i]; k < blocks.start[i + 1]; ++k)
      for (int d = 0; d < 6; ++d)
        for (int e = 0; e < 6; ++e) {
          const Index row = part.equation[6 * i + static_cast<std::size_t>(d)];
          const Index column = part.equation[static_cast<std::size_t>(6 * blocks.column[k] + e)];
          if (row >= 0 && column >= 0)
            mass(row, column) = blocks.mass[k](d, e);
          if (row >= 0 && e < 3)
            moved(row, e) += blocks.mass[k](d, e);
        }
  const core::Cholesky factor(mass);
  Vec3 reached;
  for (int e = 0; e < 3; ++e)
    reached(e) = moved.col(e).dot(factor.solve(moved.col(e)));
  const Vec3 sum = sum_of_effective_masses(basis);
  EXPECT_LT((sum - reached).cwiseAbs().maxCoeff(), 1e-9 * reached.maxCoeff());
  EXPECT_LT(sum.x(), basis.moving_mass.x());
}

// The first mode of a cantilever: 61.3 % of its mass (Blevins, Formulas for Natural Frequency and Mode Shape).
TEST(EffectiveMass, OfACantileverIsThePublishedShare) {
  ModelBuilder b;
  b.line({0, 0, 0}, {1, 0, 0}, 40, b.property(tube_property()));
  b.fix(0, all);
  const auto basis = solve(b.model, 4);
  EXPECT_NEAR(std::pow(basis.participation(0, 1), 2) / basis.moving_mass.y(), 0.6131, 1e-4);
  EXPECT_NEAR(std::pow(basis.participation(2, 1), 2) / basis.moving_mass.y(), 0.1883, 1e-4);
  EXPECT_NEAR(basis.participation(0, 0), 0.0, 1e-9);
}

} // namespace effective_mass_test
