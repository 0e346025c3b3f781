// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/uniform.hpp"
#include "transient/splitting/anderson_mixing.hpp"
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace anderson_mixing_test {

using namespace fretwork;
using transient::AndersonMixing;

namespace {

constexpr double solved = 1e-9; // relative, through normal equations

/// Iterations until x = M x + b to `solved`.
int iterations(const Eigen::MatrixXd& m, const Eigen::VectorXd& b, bool mixes) {
  constexpr int most = 200;
  AndersonMixing mixing(b.size());
  mixing.restart(b.size());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
  for (int k = 0; k < most; ++k) {
    const Eigen::VectorXd g = m * x + b;
    if ((g - x).norm() <= solved * g.norm())
      return k;
    if (mixes)
      mixing.next(x, g);
    else
      x = g;
  }
  return most;
}

} // namespace

TEST(AndersonMixing, SolvesAsManyUnknownsAsAnswerEachOtherInAsManyIterations) {
  tests::Uniform uniform(11);
  constexpr Eigen::Index n = 6;
  for (int i = 0; i < 20; ++i) {
    Eigen::MatrixXd m(n, n);
    Eigen::VectorXd b(n);
    for (double& x : m.reshaped())
      x = uniform(-1.0, 1.0);
    for (double& x : b)
      x = uniform(-1.0, 1.0);
    EXPECT_LE(iterations(m, b, true), n + 4) << "spectral radius " << m.eigenvalues().cwiseAbs().maxCoeff();
  }
}

TEST(AndersonMixing, ConvergesWhereTheIterationDoesNot) {
  const Eigen::Vector3d b(1.0, 2.0, 3.0);
  const Eigen::MatrixXd by_turns = Eigen::Vector3d(-1.0, 0.999, -0.5).asDiagonal();
  EXPECT_EQ(iterations(by_turns, b, false), 200);
  EXPECT_LE(iterations(by_turns, b, true), 6);
}

TEST(AndersonMixing, GetsPastAKink) {
  // x = max(0, 2 - 3 x) from far on the flat side; by itself the iteration swings without end
  AndersonMixing mixing(1);
  mixing.restart(1);
  Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 40.0), g(1);
  for (int k = 0; k < 30; ++k) {
    g(0) = std::max(0.0, 2.0 - 3.0 * x(0));
    mixing.next(x, g);
  }
  EXPECT_NEAR(x(0), 0.5, solved);
}

} // namespace anderson_mixing_test
