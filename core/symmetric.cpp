// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/symmetric.hpp"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cassert>

namespace fretwork::core {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Eigenpairs symmetric_eigenpairs(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorXd symmetric_eigenvalues(const MatrixXd& a) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

std::optional<Eigenpairs> symmetric_eigenpairs(const MatrixXd& a, const MatrixXd& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(a, b);
  if (solver.info() != Eigen::Success)
    return std::nullopt;
  return Eigenpairs{solver.eigenvalues(), solver.eigenvectors()};
}

Cholesky::Cholesky(const MatrixXd& a) : lower_(a) {
  positive_definite_ = Eigen::LLT<Eigen::Ref<MatrixXd>>(lower_).info() == Eigen::Success;
}

VectorXd Cholesky::solve(const VectorXd& b) const {
  assert(positive_definite_);
  const auto lower = lower_.triangularView<Eigen::Lower>();
  VectorXd x = b;
  lower.solveInPlace(x);
  lower.transpose().solveInPlace(x);
  return x;
}

void Cholesky::orthonormalise(MatrixXd& x) const {
  assert(positive_definite_);
  lower_.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(x);
}

} // namespace fretwork::core
