// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Power spectra of sampled signals by averaged, overlapping segments with a Hann window, one-sided in Hz:
///     X_s(f_k) = sum_j h_j (x_j - mean of the segment) exp(-2 pi i j k/n),   f_k = k/(n dt)
///     G_xy(f_k) = 2 dt/(K sum h^2) sum_s X_s conj Y_s   (half of it at f = 0 and at 1/2dt),   h_j = sin^2(pi j/n)
/// so that the sum of G_xx df is the variance. Segments of n samples overlap by half.
/// Confidence band of G_xx: nu G/chi2_nu, with nu = 2 K/(1 + 2 (K - 1)/K / 36) degrees of freedom; 1/36 is the square of the correlation of Hann
/// windows half a segment apart. It holds where the spectrum is smooth over 4/(n dt) and the signal Gaussian.
/// Source: P. Welch, IEEE Trans. Audio Electroacoustics 15 (1967) 70-73.
#pragma once
#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace fretwork::flow {

struct PowerSpectrum {
  std::vector<double> frequency; ///< Hz: 0 to 1/2dt
  std::vector<double> density;   ///< unit^2/Hz
  std::size_t segments = 0;      ///< K
  double degrees = 0.0;          ///< nu
  double
      lower = 0.0,
      upper =
          0.0; ///< the true spectrum lies between lower and upper times the density with the probability asked for
};

struct CrossPowerSpectrum {
  std::vector<double> frequency;        ///< Hz
  std::vector<double> xx, yy;           ///< unit^2/Hz
  std::vector<std::complex<double>> xy; ///< E[X conj Y]
  std::size_t segments = 0;
  /// |G_xy|^2/(G_xx G_yy) at a frequency; 0 where a density is 0. It is too large by (1 - coherence)^2 over half the degrees of freedom.
  [[nodiscard]] double coherence(std::size_t k) const;
};

/// The spectra of signals whose samples come one after the other. Constant memory; nothing is allocated by `add` but what FFTW's transform does.
class WelchEstimate {
public:
  /// @param signals  that are sampled together, >= 1   @param step  s, between samples, > 0
  /// @param segment  n, samples, even, >= 8
  /// @throws core::Error
  WelchEstimate(std::size_t signals, double step, std::size_t segment);
  WelchEstimate(WelchEstimate&&) noexcept;
  WelchEstimate& operator=(WelchEstimate&&) noexcept;
  ~WelchEstimate();

  /// One sample of each signal.
  void add(std::span<const double> values);
  /// Segments so far.
  [[nodiscard]] std::size_t segments() const;
  /// Of one signal.  @param confidence  between 0 and 1
  /// @throws core::Error  no segment is full yet
  [[nodiscard]] PowerSpectrum spectrum(std::size_t signal, double confidence = 0.95) const;
  /// Of two signals, which may be the same. The same errors.
  [[nodiscard]] CrossPowerSpectrum cross(std::size_t x, std::size_t y) const;

private:
  class Segments;
  std::unique_ptr<Segments> segments_;
};

/// Of a whole series.  @param resolution  Hz, > 0: n = 1/(resolution step), at least 8 samples; the series holds one segment at least
[[nodiscard]] PowerSpectrum welch(std::span<const double> series, double step, double resolution,
                                  double confidence = 0.95);

/// x that a chi-square variable of `degrees` of freedom stays below with the probability p.
/// @param degrees  > 0, <= 1e6   @param p  between 0 and 1
[[nodiscard]] double chi_square_quantile(double degrees, double p);

} // namespace fretwork::flow
