// SPDX-License-Identifier: GPL-3.0-or-later
// Equal frequencies: planes of a tube, equal tubes.
#include "../fem/model_builder.hpp"
#include "solve.hpp"
#include <gtest/gtest.h>

namespace degenerate_modes_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

/// Equal clamped tubes along x, made one structure by dampers: no force couples them.
fem::Model equal_tubes(int tubes, int elements) {
  ModelBuilder b;
  const Index p = b.property(tube_property());
  Index last = -1;
  for (int i = 0; i < tubes; ++i) {
    const auto nodes = b.line({0, 0.1 * i, 0}, {1, 0.1 * i, 0}, elements, p);
    b.fix(nodes.front(), all);
    b.fix(nodes.back(), all);
    if (last >= 0)
      b.model.springs.push_back({last, nodes[1], {}, {0.0, 1e-3}});
    last = nodes[1];
  }
  return b.model;
}

double plane_share(const modal::Basis& basis, Eigen::Index mode, Eigen::Index direction) {
  double share = 0.0, total = 0.0;
  for (Eigen::Index row = 0; row < basis.shapes.rows(); row += 6) {
    share += std::pow(basis.shapes(row + direction, mode), 2);
    total += basis.shapes.col(mode).segment<3>(row).squaredNorm();
  }
  return share / total;
}

} // namespace

TEST(EqualFrequencies, OfATubeComeOutAsPureYThenPureZ) {
  constexpr double pure = 1e-12; // share of energy in the other plane: the square of a small angle
  const auto basis = solve(equal_tubes(1, 60), 8); // all bending
  for (Eigen::Index i = 0; i < 8; ++i) {
    EXPECT_NEAR(plane_share(basis, i, 1 + i % 2), 1.0, pure) << i;
    if (i % 2 == 1) {
      EXPECT_EQ(basis.omega[i], basis.omega[i - 1]);
    }
  }
}

TEST(EqualFrequencies, CutByTheCountKeepTheFirstCanonicalModes) {
  const auto model = equal_tubes(1, 60);
  const auto many = solve(model, 12);
  for (const int count : {1, 3, 5}) {
    const auto few = solve(model, count);
    ASSERT_EQ(few.size(), count);
    EXPECT_LT((few.shapes - many.shapes.leftCols(count)).cwiseAbs().maxCoeff(),
              1e-9 * many.shapes.cwiseAbs().maxCoeff()) // another Krylov space, the same modes
        << count;
  }
}

TEST(EqualFrequencies, OfFiveTubesAreAllFound) {
  const auto single = solve(equal_tubes(1, 40), 6);
  const auto five = solve(equal_tubes(5, 40), 30);
  ASSERT_EQ(five.size(), 30);
  for (Eigen::Index i = 0; i < 30; ++i)
    EXPECT_NEAR(five.omega[i] / single.omega[2 * (i / 10)], 1.0, 1e-10) << i;
  EXPECT_LT(five.orthogonality, 1e-13);
}

// A Krylov space from one vector holds one vector of each eigenvalue; round-off brings in more, but not all
// of forty.
TEST(EqualFrequencies, OfTwentyTubesAreAllFound) {
  const auto single = solve(equal_tubes(1, 40), 4);
  const auto twenty = solve(equal_tubes(20, 40), 60);
  ASSERT_EQ(twenty.size(), 60);
  for (Eigen::Index i = 0; i < 60; ++i)
    EXPECT_NEAR(twenty.omega[i] / single.omega[2 * (i / 40)], 1.0, 1e-10) << i;
}

} // namespace degenerate_modes_test
