// SPDX-License-Identifier: GPL-3.0-or-later
// One structure over all ranks; and what must be the same on every rank.
#include "../fem/model_builder.hpp"
#include "core/mpi.hpp"
#include "solve.hpp"
#include <gtest/gtest.h>

namespace distributed_modes_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

/// A plate-like frame of beams between n x m nodes, clamped along one side.
fem::Model frame(int n, int m) {
  ModelBuilder b;
  const Index p = b.property({{2e11, 0.3, 8000.0}, fem::pipe_section(0.05, 0.004)});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const Index node = b.node({0.5 * i, 0.4 * j, 0.02 * ((i * j) % 3)});
      if (j == 0)
        b.fix(node, all);
      if (j > 0)
        b.model.beams.push_back({node - 1, node, p});
      if (i > 0)
        b.model.beams.push_back({node - m, node, p});
    }
  return b.model;
}

bool same_on_all_ranks(Eigen::MatrixXd values) {
  const Eigen::MatrixXd mine = values;
  core::broadcast(MPI_COMM_WORLD, 0, values);
  return mine == values;
}

} // namespace

TEST(DistributedModes, HaveTheFrequenciesOfASerialSolve) {
  const auto model = frame(60, 56); // 2e4 dofs
  const auto serial = solve(model, 20), shared = solve(model, 20, MPI_COMM_WORLD);
  ASSERT_EQ(shared.size(), 20);
  EXPECT_EQ(shared.distributed, core::size(MPI_COMM_WORLD) > 1);
  for (Eigen::Index i = 0; i < 20; ++i)
    EXPECT_NEAR(shared.omega[i] / serial.omega[i], 1.0, 1e-8);
  EXPECT_LT(shared.orthogonality, 1e-12);
  EXPECT_TRUE(same_on_all_ranks(shared.shapes));
  EXPECT_TRUE(same_on_all_ranks(shared.omega));
  EXPECT_TRUE(same_on_all_ranks(shared.residuals));
}

TEST(DistributedModes, OfAFreeFrameHaveSixExactRigidMotions) {
  auto model = frame(12, 10);
  std::fill(model.fixed.begin(), model.fixed.end(), std::uint8_t{0});
  const auto serial = solve(model, 16), shared = solve(model, 16, MPI_COMM_WORLD);
  for (Eigen::Index i = 0; i < 6; ++i)
    EXPECT_EQ(shared.omega[i], 0.0);
  for (Eigen::Index i = 6; i < 16; ++i)
    EXPECT_NEAR(shared.omega[i] / serial.omega[i], 1.0, 1e-8);
}

TEST(DistributedModes, OfASmallStructureAreSolvedOnOneRank) {
  const auto model = frame(3, 4);
  const auto shared = solve(model, 10, MPI_COMM_WORLD), serial = solve(model, 10);
  EXPECT_FALSE(shared.distributed);
  EXPECT_EQ(shared.shapes, serial.shapes);
  EXPECT_TRUE(same_on_all_ranks(shared.shapes));
}

TEST(DistributedModes, UpToAFrequencyAreThoseOfASerialSolve) {
  const auto model = frame(20, 12);
  const auto serial = solve(model, 12);
  const double limit = 0.5 * (serial.omega[9] + serial.omega[10]) / (2 * std::numbers::pi);
  EXPECT_EQ(solve_up_to(model, limit, MPI_COMM_WORLD).size(), 10);
}

TEST(SerialModes, AreTheSameBytesOnEveryRank) {
  const auto basis = solve(frame(20, 12), 15);
  EXPECT_TRUE(same_on_all_ranks(basis.shapes));
  EXPECT_TRUE(same_on_all_ranks(basis.omega));
}

} // namespace distributed_modes_test
