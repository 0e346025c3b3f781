// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Random forces by their full spectral matrix G(f), N^2/Hz, one-sided in Hz, Hermitian, positive semidefinite:
///     G_ij df = E[F_i conj F_j] of the lines F_i exp(2 pi i f t), of which the force is the real part sum;
///     G_12 = |G_12| exp(+2 pi i f tau): force 2 is force 1 delayed by tau.
/// Modal cross-spectrum Phi G Phi^T. Lines of a draw: F = sqrt(df) H e, e independent, H the Hermitian root of G (H H = G): it is unique, so
/// that forces do not depend on the choice of eigenvectors. Eigenvalues between -1e-8 trace and 0 are round-off and become 0.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace fretwork::flow {

struct MatrixLoad {
  std::string name; ///< in messages
  std::uint32_t id =
      0; ///< its random numbers go by it: as TurbulentZone::id, and different from those of zones
  std::function<Eigen::MatrixXcd(double f)> spectrum; ///< G at a frequency, Hz: forces x forces
  Eigen::MatrixXd shapes; ///< modes x forces: displacement of the mode along each force
};

/// Modal cross-spectrum at a frequency, Hz: modes x modes.
/// @throws core::Error  a matrix of another size, one that is not Hermitian to 1e-8
[[nodiscard]] Eigen::MatrixXcd cross_spectrum(const MatrixLoad& load, double f);

/// H at a frequency, Hz.
/// @throws core::Error  as cross_spectrum; an eigenvalue below -1e-8 trace
[[nodiscard]] Eigen::MatrixXcd hermitian_root(const MatrixLoad& load, double f);

/// A spectral matrix by rows: linear between them, which keeps it positive semidefinite, 0 outside.
class SpectralMatrixTable {
public:
  /// @param f  Hz, ascending, at least two   @param matrices  as many, of one size
  /// @throws core::Error
  SpectralMatrixTable(std::vector<double> f, std::vector<Eigen::MatrixXcd> matrices);
  [[nodiscard]] Eigen::MatrixXcd operator()(double f) const;

private:
  std::vector<double> f_;
  std::vector<Eigen::MatrixXcd> matrices_;
};

} // namespace fretwork::flow
