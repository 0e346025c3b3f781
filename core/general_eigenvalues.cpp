// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/general_eigenvalues.hpp"
#include "core/error.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace fretwork::core {

namespace {

Eigen::EigenSolver<Eigen::MatrixXd> solved(const Eigen::MatrixXd& a, bool vectors) {
  Eigen::EigenSolver<Eigen::MatrixXd> solver(a, vectors);
  if (solver.info() != Eigen::Success)
    throw ComputationError("the eigenvalues of a matrix without symmetry did not converge");
  return solver;
}

double column_sum(const Eigen::MatrixXcd& a) { return a.cwiseAbs().colwise().sum().maxCoeff(); }

} // namespace

Eigen::VectorXcd general_eigenvalues(const Eigen::MatrixXd& a) { return solved(a, false).eigenvalues(); }

Diagonalised diagonalised(const Eigen::MatrixXd& a) {
  const auto solver = solved(a, true);
  Diagonalised out{solver.eigenvalues(), solver.eigenvectors(), {}, 0.0};
  out.inverse = out.vectors.partialPivLu().inverse();
  out.condition = column_sum(out.vectors) * column_sum(out.inverse);
  return out;
}

} // namespace fretwork::core
