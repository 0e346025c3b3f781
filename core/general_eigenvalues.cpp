// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/general_eigenvalues.hpp"
#include "core/error.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <complex>

namespace fretwork::core {

namespace {

/// Sizes d of the unknowns, powers of 2, with which D^-1 A D has rows and columns of like size; A is made that. Without it the iterations may fail
/// where rates of 1/s and their squares stand beside each other. B. Parlett, C. Reinsch, Numer. Math. 13 (1969) 293.
Eigen::VectorXd balance(Eigen::MatrixXd& a) {
  constexpr double worth_it = 0.95; // of the sum of a row and its column
  Eigen::VectorXd d = Eigen::VectorXd::Ones(a.rows());
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      const double own = std::abs(a(i, i)), column = a.col(i).cwiseAbs().sum() - own,
                   row = a.row(i).cwiseAbs().sum() - own;
      if (!(column > 0.0 && row > 0.0) || !std::isfinite(column) || !std::isfinite(row))
        continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (column * factor + row / factor >= worth_it * (column + row))
        continue;
      a.col(i) *= factor;
      a.row(i) /= factor;
      d(i) *= factor;
      goes_on = true;
    }
  }
  return d;
}

Eigen::EigenSolver<Eigen::MatrixXd> solved(const Eigen::MatrixXd& a, bool vectors) {
  Eigen::EigenSolver<Eigen::MatrixXd> solver(a, vectors);
  if (solver.info() != Eigen::Success)
    throw ComputationError("the eigenvalues of a matrix without symmetry did not converge");
  return solver;
}

/// V^-1 by real numbers: x = sum of y v with pairs v, y and their conjugates is sum of 2 Re(y) Re(v) - 2 Im(y) Im(v).
Eigen::MatrixXcd inverse_of_pairs(const Diagonalised& of) {
  using Complex = std::complex<double>;
  const Eigen::Index n = of.values.size();
  Eigen::MatrixXd parts(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    parts.col(k) = of.vectors.col(k).real();
    if (of.values(k).imag() != 0.0) {
      parts.col(k + 1) = of.vectors.col(k).imag();
      ++k;
    }
  }
  const Eigen::MatrixXd inverse = parts.partialPivLu().inverse();
  Eigen::MatrixXcd out(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    out.row(k) = inverse.row(k).cast<Complex>();
    if (of.values(k).imag() != 0.0) {
      out.row(k) =
          0.5 * (inverse.row(k).cast<Complex>() - Complex(0.0, 1.0) * inverse.row(k + 1).cast<Complex>());
      out.row(k + 1) = out.row(k).conjugate();
      ++k;
    }
  }
  return out;
}

double column_sum(const Eigen::MatrixXcd& a) { return a.cwiseAbs().colwise().sum().maxCoeff(); }

} // namespace

Eigen::VectorXcd general_eigenvalues(const Eigen::MatrixXd& a) {
  Eigen::MatrixXd balanced = a;
  (void)balance(balanced);
  return solved(balanced, false).eigenvalues();
}

Diagonalised diagonalised(const Eigen::MatrixXd& a) {
  Eigen::MatrixXd balanced = a;
  const Eigen::VectorXd d = balance(balanced);
  const auto solver = solved(balanced, true);
  Diagonalised out{solver.eigenvalues(), solver.eigenvectors(), {}, 0.0};
  for (Eigen::Index k = 0; k < out.values.size(); ++k)
    if (out.vectors.col(k).imag().isZero(0.0)) // an imaginary part of round-off, and two real vectors
      out.values(k) = out.values(k).real();
  out.inverse = inverse_of_pairs(out) * d.cwiseInverse().asDiagonal();
  out.vectors = (d.asDiagonal() * out.vectors).eval();
  const Eigen::VectorXd lengths = out.vectors.colwise().norm();
  out.vectors = (out.vectors * lengths.cwiseInverse().asDiagonal()).eval();
  out.inverse = (lengths.asDiagonal() * out.inverse).eval();
  out.condition = column_sum(out.vectors) * column_sum(out.inverse);
  return out;
}

} // namespace fretwork::core
