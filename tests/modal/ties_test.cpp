// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/model_builder.hpp"
#include "solve.hpp"
#include <gtest/gtest.h>

namespace ties_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

/// Of frequencies from two numberings of the same equations: round-off of K, some of which strain energies take back.
constexpr double same = 1e-10;
/// Of components tied, relative to the largest: sums in another order.
constexpr double equal = 1e-12;
constexpr double in_balance = 1e-6; ///< residual of K x - lambda M x, as without ties

/// A tube with a bend, clamped at its ends, cut in the middle of its second leg; nodes `elements` apart are tied.
fem::Model cut_tube(int elements, unsigned tied) {
  ModelBuilder b;
  const Index p = b.property(tube_property());
  const auto first = b.line({0, 0, 0}, {1, 0, 0}, elements, p);
  const auto second = b.line_from(first.back(), {1, 0.5, 0.3}, elements, p);
  const auto third = b.line({1, 0.5, 0.3}, {1, 1, 0.6}, elements, p);
  b.fix(first.front(), all);
  b.fix(third.back(), all);
  b.model.ties.push_back({third.front(), second.back(), static_cast<std::uint8_t>(tied)});
  return b.model;
}

fem::Model whole_tube(int elements) {
  ModelBuilder b;
  const Index p = b.property(tube_property());
  const auto first = b.line({0, 0, 0}, {1, 0, 0}, elements, p);
  b.fix(first.front(), all);
  b.fix(b.line_from(first.back(), {1, 1, 0.6}, 2 * elements, p).back(), all);
  return b.model;
}

} // namespace

TEST(TiedModes, OfATubeTiedInAllComponentsAreThoseOfTheWholeTube) {
  for (const int elements : {6, 40}) { // a dense solve, and a Krylov one
    const auto cut = solve(cut_tube(elements, all), 12), whole = solve(whole_tube(elements), 12);
    EXPECT_LT((cut.omega.cwiseQuotient(whole.omega).array() - 1.0).abs().maxCoeff(), same);
    EXPECT_LT(cut.residuals.maxCoeff(), in_balance);
  }
}

TEST(TiedModes, KeepTheirTiesOnAnyNumberOfRanks) {
  constexpr int elements = 40;
  const auto model = cut_tube(elements, ux | uy | uz | rx);
  const auto here = solve(model, 12), shared = solve(model, 12, MPI_COMM_WORLD);
  EXPECT_LT((here.omega.cwiseQuotient(shared.omega).array() - 1.0).abs().maxCoeff(), same);
  for (const auto* basis : {&here, &shared}) {
    const Eigen::Index a = Eigen::Index{2 * elements} * 6, b = a + 6;
    const auto jump = (basis->shapes.middleRows(a, 6) - basis->shapes.middleRows(b, 6)).cwiseAbs().eval();
    EXPECT_LT(jump.topRows(4).maxCoeff(), equal * basis->shapes.cwiseAbs().maxCoeff());
    EXPECT_GT(jump.bottomRows(2).maxCoeff(), 0.1); // free to turn about the others
    EXPECT_LT(basis->residuals.maxCoeff(), in_balance);
  }
}

TEST(TiedModes, OfATubeOnABallAreRigidAndElastic) {
  auto model = cut_tube(8, ux | uy | uz);
  model.fixed.back() = 0;
  const auto basis = solve(model, 9);
  EXPECT_EQ((basis.omega.array() == 0.0).count(), 3);
  EXPECT_GT(basis.omega[3], 1.0);
}

} // namespace ties_test
