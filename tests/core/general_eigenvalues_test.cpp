// SPDX-License-Identifier: GPL-3.0-or-later
// Eigenvalues of matrices whose unknowns are of very different sizes.
#include "core/general_eigenvalues.hpp"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace fretwork::core {
namespace {

/// [0 I; -K -C + coupling] of modes up to w = 1e5 1/s, alike in two directions.
Eigen::MatrixXd tube(Eigen::Index modes) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * modes, 2 * modes);
  a.topRightCorner(modes, modes).setIdentity();
  for (Eigen::Index j = 0; j < modes; ++j) {
    const double order = static_cast<double>(j / 2 + 1), w = 240.0 * order * order;
    a(modes + j, j) = -w * w;
    a(modes + j, modes + j) = -0.02 * w;
    a(modes + j, modes + (j ^ 1)) = j % 2 == 0 ? 0.5 : -0.5;
  }
  return a;
}

/// Modes in two directions under a force with one lag along the middle half of a tube, which sees some of the lag's directions to round-off only.
Eigen::MatrixXd tube_with_lags(Eigen::Index modes) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * modes, 3 * modes);
  for (Eigen::Index j = 0; j < modes; ++j) {
    const double order = static_cast<double>(j / 2 + 1), w = 5.0 * order * order;
    a(j, modes + j) = w;
    a(modes + j, j) = -w;
    a(modes + j, modes + j) = -0.02 * w;
    a(2 * modes + j, modes + j) = 5.0;
    a(2 * modes + j, 2 * modes + j) = -60.0;
    for (Eigen::Index k = 0; k < modes; ++k) {
      const auto integral = [](Eigen::Index wave) { // of cos(wave pi s) from 1/4 to 3/4
        const double b = std::numbers::pi * static_cast<double>(wave);
        return wave == 0 ? 0.5 : (std::sin(0.75 * b) - std::sin(0.25 * b)) / b;
      };
      const double direction = j % 2 == k % 2 ? 1.0 : j % 2 == 0 ? -0.3 : 0.3;
      a(modes + j, 2 * modes + k) =
          direction * 50.0 * (integral(std::abs(j / 2 - k / 2)) - integral(j / 2 + k / 2 + 2));
    }
  }
  return a;
}

constexpr double digits = 1e-10; // of the largest entry, after some 1e2 operations on each

} // namespace

TEST(GeneralEigenvalues, AreFoundOfModesOfVeryDifferentFrequencies) {
  for (const Eigen::Index modes : {8, 10, 20, 40}) {
    const Eigen::MatrixXd a = tube(modes);
    const Eigen::VectorXcd values = general_eigenvalues(a);
    EXPECT_NEAR(values.sum().real() / a.trace(), 1.0, digits) << modes;
    const Diagonalised d = diagonalised(a);
    const Eigen::MatrixXcd again = d.vectors * d.values.asDiagonal() * d.inverse;
    EXPECT_LT((again - a).cwiseAbs().maxCoeff(), digits * a.cwiseAbs().maxCoeff()) << modes;
    for (Eigen::Index k = 0; k < 2 * modes; ++k)
      EXPECT_NEAR(d.vectors.col(k).norm(), 1.0, digits);
  }
}

/// A pair whose imaginary part is round-off has two real vectors.
TEST(GeneralEigenvalues, HaveVectorsThatCanBeInverted) {
  for (const Eigen::Index modes : {48, 52, 56, 60, 64}) { // some have such a pair
    const Eigen::MatrixXd a = tube_with_lags(modes);
    const Diagonalised d = diagonalised(a);
    EXPECT_LT(d.condition, 1e6) << modes;
    const Eigen::MatrixXcd again = d.vectors * d.values.asDiagonal() * d.inverse;
    EXPECT_LT((again - a).cwiseAbs().maxCoeff(), digits * a.cwiseAbs().maxCoeff()) << modes;
    for (Eigen::Index k = 0; k < d.values.size(); ++k)
      EXPECT_EQ(d.values(k).imag() == 0.0, d.vectors.col(k).imag().isZero(0.0)) << modes << " " << k;
  }
}

TEST(GeneralEigenvalues, AreThoseOfTheMatrixWhateverTheUnits) {
  const Eigen::Matrix3d a{{1.0, 2e-9, 0.0}, {3e9, 2.0, 1e-7}, {0.0, 4e7, 3.0}},
      plain{{1, 2, 0}, {3, 2, 1}, {0, 4, 3}};
  Eigen::VectorXd found = general_eigenvalues(a).real(), expected = general_eigenvalues(plain).real();
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), digits);
}

} // namespace fretwork::core
