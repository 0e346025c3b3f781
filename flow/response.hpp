// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Response of linear modes to random forces by their spectra, without a transient.
///
///     Z_i(w) = M_i (w_i^2 - w^2 + 2 i xi_i w_i w),   S_ij(f) = G_ij(f)/(Z_i conj Z_j),   w = 2 pi f
///     L_k = int w^k phi^T Re S(f) phi df,   k = 0, 1, 2, 4:   variances of displacement L_0, velocity L_2, acceleration L_4
/// phi: displacement of the modes at a point along an axis. Cross terms of modes are included.
///
/// Integrals: Gauss's rule of ten points on panels not wider than 0.6 times the distance, in the complex plane, to the nearest pole
/// f_i (+-sqrt(1 - xi^2) + i xi): round a peak the mean step is 0.06 xi f, and the error is below 1e-9. The ends of panels are at the frequencies
/// at which the slope of G jumps, where these are given.
///
/// Up-crossings of 0 a second: sqrt(L_2/L_0)/2pi. Irregularity: L_2/sqrt(L_0 L_4), 1 for a narrow band. Largest value in the time T that is
/// not exceeded with the probability p (E. Vanmarcke, J. Appl. Mech. 42 (1975) 215; form of Code_Aster v17, POST_DYNA_ALEA):
///     N = T sqrt(L_2/L_0)/(-2 pi ln p),   d = sqrt(1 - L_1^2/(L_0 L_2)),   u = sqrt(L_0) sqrt(2 ln{2 N [1 - exp(-d^1.2 sqrt(pi ln 2N))]})
#pragma once
#include "flow/cross_spectrum.hpp"
#include "flow/spectral_matrix.hpp"
#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace fretwork::flow {

/// Modal masses, rad/s and damping ratios, one a mode. Shapes of the load and of the points have the same normalisation.
struct LinearModes {
  Eigen::VectorXd mass;    ///< > 0
  Eigen::VectorXd omega;   ///< >= 0; 0 only where the range of frequencies begins above 0
  Eigen::VectorXd damping; ///< > 0 and below 1 where omega > 0
};

/// Modal cross-spectrum of the forces as a function of frequency.
struct LoadSpectrum {
  std::function<void(double f, Eigen::MatrixXd& g)> real;      ///< Re G, modes x modes
  std::function<void(double f, Eigen::MatrixXd& g)> imaginary; ///< Im G; empty where it is 0
  std::vector<double> breaks;                                  ///< Hz, at which slopes or values jump
};
/// Of zones of turbulence between two frequencies, Hz (cross_spectrum.hpp: CrossSpectrumTable).
[[nodiscard]] LoadSpectrum load_spectrum(const std::vector<TurbulentZone>& zones, double low, double high,
                                         Part part = Part::all);
/// Of a full spectral matrix.
[[nodiscard]] LoadSpectrum load_spectrum(const MatrixLoad& load, std::vector<double> breaks = {});

/// Spectral moments of one displacement, m^2 and powers of rad/s.
struct SpectralMoments {
  double L0 = 0.0, L1 = 0.0, L2 = 0.0, L4 = 0.0;

  [[nodiscard]] double rms() const;          ///< m
  [[nodiscard]] double rms_velocity() const; ///< m/s
  [[nodiscard]] double up_crossings() const; ///< 1/s; 0 of no motion
  [[nodiscard]] double irregularity() const; ///< 0 of no motion
  /// m; nothing where fewer than one up-crossing is expected, for which the formula does not hold.
  /// @param duration  s, > 0   @param probability  between 0 and 1
  [[nodiscard]] std::optional<double> maximum(double duration, double probability) const;
};

class LinearResponse {
public:
  /// @param low, high  Hz, 0 <= low < high
  /// @throws core::Error  modes or ends that are out of range
  LinearResponse(const LinearModes& modes, const LoadSpectrum& load, double low, double high);

  /// int w^k Re S df for k = 0, 1, 2, 4: the modal coordinates' covariance (k = 0) and that of their velocities (k = 2). modes x modes, symmetric.
  [[nodiscard]] const Eigen::MatrixXd& moment(int k) const;
  /// At a point along an axis.  @param shape  displacement of the modes
  [[nodiscard]] SpectralMoments at(const Eigen::VectorXd& shape) const;
  /// At many.  @param shapes  points x modes
  [[nodiscard]] std::vector<SpectralMoments> at_points(const Eigen::MatrixXd& shapes) const;
  /// Frequencies at which the integrand was evaluated.
  [[nodiscard]] std::size_t evaluations() const { return evaluations_; }

private:
  std::array<Eigen::MatrixXd, 4> moments_;
  std::size_t evaluations_ = 0;
};

/// Share of the variance of displacements that comes from loads outside the range of their spectra, between 0 and 1; 0 of points at rest.
/// @param shapes  points x modes
[[nodiscard]] Eigen::VectorXd share_outside(const LinearModes& modes, const std::vector<TurbulentZone>& zones,
                                            double low, double high, const Eigen::MatrixXd& shapes);

} // namespace fretwork::flow
