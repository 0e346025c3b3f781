// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Cross-spectrum of the modal forces of turbulence, N^2/Hz (times the square of the shapes' unit), one-sided in Hz:
///
///     G_ij(f) = sum over zones and axes of w int int phi_i(s) phi_j(s') G(s, s', f) ds ds'
///             = sum over zones and axes of sum_kl a_ik a_jl r_kl,   a_ik = sqrt(w G(s_k,f)) phi_i(s_k) ds_k
///
/// r_kl = exp(-|s_k - s_l|/lambda) is the correlation of a Markov sequence, r_kl = r_k+1 ... r_l: with the running sums
///     b_jk = r_k b_j,k-1 + a_jk      G = A B^T + B A^T - A A^T
/// modes x patches operations for B in place of modes x patches^2. Error of order ds^2, (ds/lambda)^2/6 of a power
/// spectrum at most (patches.hpp).
#pragma once
#include "flow/patches.hpp"
#include <Eigen/Core>
#include <vector>

namespace fretwork::flow {

/// Loads that count: all, or those of patches at which f lies in the range of the spectrum.
enum class Part { all, covered };

class CrossSpectrum {
public:
  /// @throws core::Error  no zone, or one that check refuses
  explicit CrossSpectrum(const std::vector<TurbulentZone>& zones, Part part = Part::all);

  [[nodiscard]] Eigen::Index modes() const { return modes_; }
  /// modes x modes, symmetric, positive semidefinite.  @param f  Hz
  [[nodiscard]] Eigen::MatrixXd operator()(double f) const;
  /// Frequencies at which slopes jump, Hz, ascending; none of zones whose spectra differ from patch to patch.
  [[nodiscard]] std::vector<double> breaks() const;

private:
  friend class CrossSpectrumTable;
  struct Zone {
    ZoneSpectra spectra;
    Eigen::VectorXd ds, r;             ///< widths, m; r_k, 0 of the first patch
    std::vector<Eigen::MatrixXd> axes; ///< sqrt(w) phi ds, modes x patches
    Eigen::MatrixXd unit;              ///< of separable spectra: G for g = 1; else empty
  };
  /// sqrt(G) of all patches.
  [[nodiscard]] Eigen::VectorXd amplitudes(const Zone& zone, double f) const;
  /// Of one zone that is not separable.
  [[nodiscard]] Eigen::MatrixXd sum(const Zone& zone, const Eigen::VectorXd& amplitudes) const;
  /// g(f) of a separable zone.
  [[nodiscard]] double common(const Zone& zone, double f) const;

  Eigen::Index modes_ = 0;
  Part part_;
  std::vector<Zone> zones_;
};

/// The same by interpolation, for thousands of frequencies: in each zone G_ij(f) = g(f) R_ij(f), g = sum_k G(s_k,f) ds_k exact, R linear in
/// ln f between 24 values an octave. R is constant, and the result exact, where V, rho, D, a and nu are constant in a zone, or with
/// zone_mean; else it errs by up to 2e-3 where the slopes of patches jump.
class CrossSpectrumTable {
public:
  /// @param low, high  Hz, 0 < low < high   @throws core::Error  ends that are not so
  CrossSpectrumTable(CrossSpectrum exact, double low, double high);
  /// @param f  Hz, held at the ends of the table for R   @param g  modes x modes
  void operator()(double f, Eigen::MatrixXd& g) const;

private:
  CrossSpectrum exact_;
  double first_, step_ = 1.0;                       ///< of ln f
  std::vector<std::vector<Eigen::MatrixXd>> ratio_; ///< R of each zone; empty of separable ones
};

} // namespace fretwork::flow
