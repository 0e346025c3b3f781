// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Decompositions of dense symmetric matrices. Their templates are large: they are compiled here once, not in every file that needs one.
/// Of each matrix the lower triangle is read.
#pragma once
#include <Eigen/Core>
#include <optional>

namespace fretwork::core {

struct Eigenpairs {
  Eigen::VectorXd values;  ///< ascending
  Eigen::MatrixXd vectors; ///< one column each
};

/// A v = lambda v, v^T v = 1.
[[nodiscard]] Eigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& a);

[[nodiscard]] Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);

/// A v = lambda B v, v^T B v = 1, B positive definite; nothing where the iterations fail, as they do on what an indefinite B leaves.
[[nodiscard]] std::optional<Eigenpairs> symmetric_eigenpairs(const Eigen::MatrixXd& a,
                                                             const Eigen::MatrixXd& b);

/// A = L L^T.
class Cholesky {
public:
  explicit Cholesky(const Eigen::MatrixXd& a);

  /// Where it is not, nothing can be solved.
  [[nodiscard]] bool is_positive_definite() const { return positive_definite_; }

  /// A^-1 b
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  /// X <- X L^-T: columns whose Gram matrix is A become orthonormal, in order.
  void orthonormalise(Eigen::MatrixXd& x) const;

private:
  Eigen::MatrixXd lower_; ///< above the diagonal not L
  bool positive_definite_ = false;
};

} // namespace fretwork::core
