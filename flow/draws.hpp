// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Random draws of the modal forces of turbulence, as samples at equal steps.
///
/// Blocks. Block b is a periodic series of period T_b by an inverse FFT of its lines f_n = n df, df = 1/T_b:
///     z_1 = e_1, z_k = r_k z_(k-1) + sqrt(1 - r_k^2) e_k,   r_k = exp(-(s_k - s_(k-1))/lambda)
///     Q_i(f_n) = sum_k sqrt(w G(s_k,f_n) df) z_k(f_n) phi_ik ds_k,   x_b(t) = Re sum_n Q_i(f_n) exp(2 pi i f_n t)
/// e_k: line_kernels.hpp, one sequence for each zone, axis, patch and block: they depend on nothing else, so that forces are physically the
/// same for any modal basis, any order of draws and any length of the run. Of spectral matrices Q = Phi sqrt(df) H e.
///
/// A run follows one block after another, each the next one's start covered by its own end: with C = T_b/8, hop H = T_b - C,
///     x(t) = sum_b w(t - b H + C) x_b(t - b H + C),   w = sin(pi u/2C) on [0, C], 1 up to H, cos(pi (u - H)/2C) on [H, T_b]
/// The blocks are independent and the squares of the weights add up to 1 at every instant, so that x is Gaussian with the variance of G
/// at every instant. A run of any duration begins as every longer one, and holds two blocks at a time.
///
/// Spectrum. For two instants in the same fade E[x(t) x(t')] = cos(pi (t - t')/2C) R(t - t'), R the correlation of G; for two
/// instants between fades it is R. So G is exact between fades, and in a fade it is
///     [G(f + 1/4C) + G(f - 1/4C)]/2,   1/4C = 2 df
/// for every G_ij alike: coherence and phase have no other error. Averaged over time (fades last C/H = 1/7 of it)
///     G_drawn = (6/7) G(f) + (1/14) [G(f + 2 df) + G(|f - 2 df|)]
/// which errs by (2/7) G'' df^2: for G ~ f^-3.5, the steepest slope, by 4.5/(f T_b)^2, that is 0.44 % of G at f = 32/T_b and less above.
/// The corners of w add 0.23 S/(T_b^3 f^4) of a variance S at frequencies far below f: 1e-3 of G where S lies at 32/T_b.
/// The end of a block and its start, correlated by its period, meet where the weights of both tend to 0.
/// What T_b has to resolve is G, which is smooth; the damping of modes does not matter, however long they remember: they add up the
/// forces of independent blocks as those of one series. Below 2 df forces are too small (f = 0 carries nothing). The band of the spectra gives T_b (load_band.hpp).
///
/// Samples: 20 periods of f_max and linear between: 0.8 % of the amplitude lost at f_max, 0.1 % at a third of it.
#pragma once
#include "flow/patches.hpp"
#include "flow/spectral_matrix.hpp"
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace fretwork::flow {

struct DrawOptions {
  std::uint32_t seed = 1, draw = 0;
  double f_min = 0.0;               ///< Hz, >= 0: lines below carry nothing
  double f_max = 0.0;               ///< Hz, > f_min: lines above carry nothing (load_band.hpp)
  double block_period = 0.0;        ///< T_b, s, > 0; at least 8 lines up to f_max
  double samples_per_period = 20.0; ///< of f_max, >= 4
  bool phase_only = false; ///< lines of fixed amplitude and random phase: not Gaussian where few lines count
};

class ForceDraw {
public:
  /// @throws core::Error  no load, equal numbers of zones, options out of their range, blocks of more than 2^26 samples
  ForceDraw(const std::vector<TurbulentZone>& zones, const std::vector<MatrixLoad>& matrices,
            const DrawOptions& options);
  ForceDraw(ForceDraw&&) noexcept;
  ForceDraw& operator=(ForceDraw&&) noexcept;
  ~ForceDraw();

  [[nodiscard]] Eigen::Index modes() const;
  /// Between samples, s.
  [[nodiscard]] double step() const;
  /// Samples between the starts of blocks.
  [[nodiscard]] std::int64_t hop() const;

  /// Modal forces at the instants first step, (first + 1) step, ... The same whatever has been asked before; blocks are computed once where
  /// instants do not go back. Nothing is allocated but what FFTW's transform does.
  /// @param first  >= 0   @param forces  modes x samples
  void fill(std::int64_t first, Eigen::Ref<Eigen::MatrixXd> forces);

private:
  class Synthesis;
  std::unique_ptr<Synthesis> synthesis_;
};

/// All samples of a run: modes x (samples up to the first at `duration` or after it).
[[nodiscard]] Eigen::MatrixXd draw_forces(ForceDraw& draw, double duration);

} // namespace fretwork::flow
