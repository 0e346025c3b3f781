// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/spectral_matrix.hpp"
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::flow {
namespace {

constexpr double hermitian_error =
    1e-8; ///< of eigenvalues against the trace, of the Hermitian part against the largest entry

Eigen::MatrixXcd checked(const MatrixLoad& load, double f) {
  if (!load.spectrum)
    throw core::Error(fmt::format("random load '{}' has no spectral matrix; give one", load.name));
  Eigen::MatrixXcd g = load.spectrum(f);
  if (g.rows() != load.shapes.cols() || g.cols() != load.shapes.cols())
    throw core::Error(
        fmt::format("random load '{}': its spectral matrix at {:g} Hz is {} x {}, its forces are {}; give a "
                    "row and a column for each force",
                    load.name, f, g.rows(), g.cols(), load.shapes.cols()));
  if (!g.allFinite() || (g - g.adjoint()).cwiseAbs().maxCoeff() > hermitian_error * g.cwiseAbs().maxCoeff())
    throw core::Error(
        fmt::format("random load '{}': its spectral matrix at {:g} Hz is not Hermitian; give G_ji = conj "
                    "G_ij",
                    load.name, f));
  return g;
}

} // namespace

Eigen::MatrixXcd cross_spectrum(const MatrixLoad& load, double f) {
  return load.shapes * checked(load, f) * load.shapes.transpose();
}

Eigen::MatrixXcd hermitian_root(const MatrixLoad& load, double f) {
  const Eigen::MatrixXcd g = checked(load, f);
  const Eigen::Index n = g.rows();
  // A + i B acts on real and imaginary parts as [A -B; B A], symmetric, each eigenvalue twice; its root has the same form
  Eigen::MatrixXd real(2 * n, 2 * n);
  real << g.real(), -g.imag(), g.imag(), g.real();
  core::Eigenpairs pairs = core::symmetric_eigenpairs(real);
  const double least = -hermitian_error * g.real().trace();
  if (pairs.values[0] < least)
    throw core::Error(
        fmt::format("random load '{}': its spectral matrix at {:g} Hz has the eigenvalue {:g}, that of no "
                    "force; give a matrix without negative eigenvalues",
                    load.name, f, pairs.values[0]));
  const Eigen::VectorXd roots = pairs.values.cwiseMax(0.0).cwiseSqrt();
  const Eigen::MatrixXd root = pairs.vectors * roots.asDiagonal() * pairs.vectors.transpose();
  Eigen::MatrixXcd h(n, n);
  h.real() = root.topLeftCorner(n, n);
  h.imag() = root.bottomLeftCorner(n, n);
  return h;
}

SpectralMatrixTable::SpectralMatrixTable(std::vector<double> f, std::vector<Eigen::MatrixXcd> matrices)
    : f_(std::move(f)), matrices_(std::move(matrices)) {
  if (f_.size() < 2 || f_.size() != matrices_.size())
    throw core::Error(fmt::format(
        "a table of spectral matrices has {} frequencies and {} matrices; give as many of both, at "
        "least two",
        f_.size(), matrices_.size()));
  for (std::size_t i = 1; i < f_.size(); ++i) {
    if (!(f_[i] > f_[i - 1]))
      throw core::Error(fmt::format("frequencies of spectral matrices are to ascend; {:g} Hz follows {:g} Hz",
                                    f_[i], f_[i - 1]));
    if (matrices_[i].rows() != matrices_[0].rows() || matrices_[i].cols() != matrices_[0].cols())
      throw core::Error(fmt::format(
          "the spectral matrix at {:g} Hz is {} x {}, that at {:g} Hz {} x {}; give all the same size", f_[i],
          matrices_[i].rows(), matrices_[i].cols(), f_[0], matrices_[0].rows(), matrices_[0].cols()));
  }
}

Eigen::MatrixXcd SpectralMatrixTable::operator()(double f) const {
  if (!(f >= f_.front() && f <= f_.back()))
    return Eigen::MatrixXcd::Zero(matrices_[0].rows(), matrices_[0].cols());
  const auto after = std::min(std::upper_bound(f_.begin(), f_.end(), f), f_.end() - 1);
  const auto i = static_cast<std::size_t>(after - f_.begin());
  const double share = (f - f_[i - 1]) / (f_[i] - f_[i - 1]);
  return (1.0 - share) * matrices_[i - 1] + share * matrices_[i];
}

} // namespace fretwork::flow
