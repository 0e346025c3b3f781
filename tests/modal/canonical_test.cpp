// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/symmetric.hpp"
#include "modal/canonical.hpp"
#include <gtest/gtest.h>
#include <random>

namespace canonical_test {

using namespace fretwork;
using core::Vec3;

namespace {

constexpr double round_off = 1e-14; // of a few rotations of values of order 1

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return value(generator); });
}

Eigen::MatrixXd random_rotation(Eigen::Index n, unsigned seed) {
  return core::symmetric_eigenpairs(random_matrix(n, n, seed)).vectors;
}

std::vector<Vec3> line_of_nodes(int count) {
  std::vector<Vec3> nodes;
  for (int i = 0; i < count; ++i)
    nodes.emplace_back(0.1 * i, 0.0, 0.0);
  return nodes;
}

} // namespace

TEST(CanonicalForm, DependsOnTheSpaceOnly) {
  const auto nodes = line_of_nodes(12);
  const Eigen::MatrixXd space = random_matrix(72, 5, 1);
  Eigen::MatrixXd first = space;
  modal::canonicalise(first, nodes);
  for (unsigned seed = 2; seed < 12; ++seed) {
    Eigen::MatrixXd other = space * random_rotation(5, seed);
    modal::canonicalise(other, nodes);
    EXPECT_LT((other - first).cwiseAbs().maxCoeff(), round_off) << "seed " << seed;
  }
}

TEST(CanonicalForm, IsARotationOfTheColumns) {
  Eigen::MatrixXd space = random_matrix(72, 4, 3);
  core::Cholesky(space.transpose() * space).orthonormalise(space);
  Eigen::MatrixXd turned = space;
  modal::canonicalise(turned, line_of_nodes(12));
  EXPECT_LT((turned.transpose() * turned - Eigen::MatrixXd::Identity(4, 4)).cwiseAbs().maxCoeff(), round_off);
  EXPECT_LT((space * (space.transpose() * turned) - turned).cwiseAbs().maxCoeff(), round_off);
}

TEST(CanonicalForm, SeparatesTheTwoPlanesOfATube) {
  const auto nodes = line_of_nodes(11);
  Eigen::MatrixXd planes = Eigen::MatrixXd::Zero(66, 2);
  for (int i = 0; i < 11; ++i) {
    planes(6 * i + 1, 0) = -std::sin(0.3 * i);
    planes(6 * i + 2, 1) = -std::sin(0.3 * i);
  }
  Eigen::MatrixXd mixed = planes * random_rotation(2, 5);
  modal::canonicalise(mixed, nodes);
  EXPECT_LT((mixed + planes).cwiseAbs().maxCoeff(), round_off); // y first, both turned to positive
}

TEST(CanonicalForm, FixesTheSignOfASingleMode) {
  const auto nodes = line_of_nodes(12);
  const Eigen::MatrixXd mode = random_matrix(72, 1, 7);
  Eigen::MatrixXd plus = mode, minus = -mode;
  modal::canonicalise(plus, nodes);
  modal::canonicalise(minus, nodes);
  EXPECT_EQ(plus, minus);
}

TEST(CanonicalForm, UsesRotationsWhereNothingTranslates) {
  Eigen::MatrixXd torsion = Eigen::MatrixXd::Zero(66, 1);
  for (int i = 0; i < 11; ++i) {
    torsion(6 * i + 3, 0) = -std::sin(0.3 * i);
    torsion(6 * i + 1, 0) = (i % 2 ? 1e-12 : -1e-12); // round-off must not decide
  }
  modal::canonicalise(torsion, line_of_nodes(11));
  EXPECT_GT(torsion(6 * 5 + 3, 0), 0.0);
}

TEST(CanonicalForm, DoesNotTurnOnASymmetricTie) {
  const auto nodes = line_of_nodes(3); // equal amplitudes at both ends: the weight of the position decides
  Eigen::MatrixXd tie = Eigen::MatrixXd::Zero(18, 1);
  tie(1, 0) = 1.0;
  tie(13, 0) = -1.0 - 1e-15;
  Eigen::MatrixXd other = -tie;
  other(1, 0) *= 1.0 + 4e-15;
  modal::canonicalise(tie, nodes);
  modal::canonicalise(other, nodes);
  EXPECT_LT((tie - other).cwiseAbs().maxCoeff(), round_off);
}

TEST(CanonicalForm, OfASingleNodeHasNoLengthToUse) {
  Eigen::MatrixXd rigid = random_rotation(6, 9);
  modal::canonicalise(rigid, {Vec3(1, 2, 3)});
  EXPECT_LT((rigid - Eigen::MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff(), round_off);
}

TEST(ClusterEnds, SplitAtGapsAndKeepRigidModesTogether) {
  Eigen::VectorXd lambda(7);
  lambda << 0.0, 0.0, 1.0, 1.0 + 1e-9, 2.0, 2.0 + 1e-6, 3.0;
  EXPECT_EQ(modal::cluster_ends(lambda, 2), (std::vector<Eigen::Index>{2, 4, 5, 6, 7}));
  EXPECT_EQ(modal::cluster_ends(lambda.tail(5), 0), (std::vector<Eigen::Index>{2, 3, 4, 5}));
  EXPECT_TRUE(modal::cluster_ends(Eigen::VectorXd(0), 0).empty());
}

} // namespace canonical_test
