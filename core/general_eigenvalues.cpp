// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/general_eigenvalues.hpp"
#include "core/error.hpp"
#include <Eigen/Eigenvalues>

namespace fretwork::core {

Eigen::VectorXcd general_eigenvalues(const Eigen::MatrixXd& a) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a, false);
  if (solver.info() != Eigen::Success)
    throw ComputationError("the eigenvalues of a matrix without symmetry did not converge");
  return solver.eigenvalues();
}

} // namespace fretwork::core
