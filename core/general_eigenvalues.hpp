// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Eigenvalues and eigenvectors of a dense matrix without symmetry, compiled once (core/symmetric.hpp).
#pragma once
#include <Eigen/Core>

namespace fretwork::core {

/// In no order, with multiplicity. @throws core::ComputationError where the iterations fail
[[nodiscard]] Eigen::VectorXcd general_eigenvalues(const Eigen::MatrixXd& a);

/// A = V diag(values) V^-1; a value with positive imaginary part is followed by its conjugate.
struct Diagonalised {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors, inverse; ///< V, columns of length 1; V^-1
  double condition; ///< |V| |V^-1| in the norm of column sums; infinite or not a number: A has no such form
};

/// @throws core::ComputationError where the iterations fail
[[nodiscard]] Diagonalised diagonalised(const Eigen::MatrixXd& a);

} // namespace fretwork::core
