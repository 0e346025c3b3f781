// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/welch.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <fftw3.h>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::flow {
namespace {

using Complex = std::complex<double>;

constexpr double correlation_of_neighbours = 1.0 / 36.0; ///< squared, of Hann windows that overlap by half
constexpr std::size_t fewest_samples = 8;

/// Share of chi-square variables below x: the regularised incomplete gamma function P(a, x/2), a = degrees/2, by its power series.
double chi_square_share(double degrees, double x) {
  const double a = 0.5 * degrees, y = 0.5 * x;
  if (!(y > 0.0))
    return 0.0;
  double term = 1.0 / a, sum = term;
  for (double n = a + 1.0; term > 1e-17 * sum; n += 1.0)
    sum += term *= y / n;
  return std::min(1.0, sum * std::exp(a * std::log(y) - y - std::lgamma(a)));
}

} // namespace

double chi_square_quantile(double degrees, double p) {
  if (!(degrees > 0.0 && degrees <= 1e6) || !(p > 0.0 && p < 1.0))
    throw core::Error(fmt::format(
        "no quantile {:g} of a chi-square variable of {:g} degrees of freedom; give a probability "
        "between 0 and 1, and up to 1e6 degrees of freedom",
        p, degrees));
  double low = 0.0, high = degrees;
  while (chi_square_share(degrees, high) < p)
    high *= 2.0;
  for (double x = 0.5 * (low + high); low < x && x < high; x = 0.5 * (low + high))
    (chi_square_share(degrees, x) < p ? low : high) = x;
  return low;
}

double CrossPowerSpectrum::coherence(std::size_t k) const {
  const double powers = xx[k] * yy[k];
  return powers > 0.0 ? std::norm(xy[k]) / powers : 0.0;
}

class WelchEstimate::Segments {
public:
  Segments(std::size_t signal_count, double step, std::size_t length)
      : signals(signal_count), n(length), dt(step), samples(signals * n), window(n), work(n),
        lines(n / 2 + 1), transforms(signals * lines.size()), sums(signals * signals * lines.size()),
        plan(fftw_plan_dft_r2c_1d(static_cast<int>(n), work.data(),
                                  reinterpret_cast<fftw_complex*>(lines.data()), FFTW_ESTIMATE)) {
    for (std::size_t j = 0; j < n; ++j) {
      const double s = std::sin(std::numbers::pi * static_cast<double>(j) / static_cast<double>(n));
      window[j] = s * s;
      squares += window[j] * window[j];
    }
  }
  ~Segments() { fftw_destroy_plan(plan); }
  Segments(const Segments&) = delete;
  Segments& operator=(const Segments&) = delete;

  void add(std::span<const double> values) {
    for (std::size_t s = 0; s < signals; ++s)
      samples[s * n + filled] = values[s];
    if (++filled < n)
      return;
    close();
    for (std::size_t s = 0; s < signals; ++s)
      std::copy_n(samples.begin() + s * n + n / 2, n / 2, samples.begin() + s * n);
    filled = n / 2;
  }

  /// A segment is full.
  void close() {
    const std::size_t m = lines.size();
    for (std::size_t s = 0; s < signals; ++s) {
      const double* x = samples.data() + s * n;
      double mean = 0.0;
      for (std::size_t j = 0; j < n; ++j)
        mean += x[j] / static_cast<double>(n);
      for (std::size_t j = 0; j < n; ++j)
        work[j] = window[j] * (x[j] - mean);
      fftw_execute(plan);
      std::copy(lines.begin(), lines.end(), transforms.begin() + s * m);
    }
    for (std::size_t x = 0; x < signals; ++x)
      for (std::size_t y = x; y < signals; ++y)
        for (std::size_t k = 0; k < m; ++k)
          sums[(x * signals + y) * m + k] += transforms[x * m + k] * std::conj(transforms[y * m + k]);
    ++count;
  }

  [[nodiscard]] std::vector<Complex> densities(std::size_t x, std::size_t y) const {
    if (count == 0)
      throw core::Error(fmt::format(
          "a power spectrum by segments of {} samples of {:g} s needs one at least, the signal has {}; "
          "ask for a wider resolution or a longer run",
          n, dt, filled));
    const std::size_t m = lines.size(), low = std::min(x, y), high = std::max(x, y);
    std::vector<Complex> out(m);
    for (std::size_t k = 0; k < m; ++k) {
      const double sides = k == 0 || k + 1 == m ? 1.0 : 2.0;
      const Complex value =
          sides * dt / (static_cast<double>(count) * squares) * sums[(low * signals + high) * m + k];
      out[k] = x <= y ? value : std::conj(value);
    }
    return out;
  }
  [[nodiscard]] std::vector<double> power(std::size_t x) const {
    std::vector<double> out;
    for (const Complex& value : densities(x, x))
      out.push_back(value.real());
    return out;
  }
  [[nodiscard]] std::vector<double> frequencies() const {
    std::vector<double> out(lines.size());
    for (std::size_t k = 0; k < out.size(); ++k)
      out[k] = static_cast<double>(k) / (static_cast<double>(n) * dt);
    return out;
  }

  std::size_t signals, n, filled = 0, count = 0;
  double dt, squares = 0.0;
  std::vector<double> samples, window, work;
  std::vector<Complex> lines, transforms, sums;
  fftw_plan plan;
};

WelchEstimate::WelchEstimate(std::size_t signals, double step, std::size_t segment) {
  if (signals == 0)
    throw core::Error("power spectra of no signal; give one at least");
  if (!(step > 0.0) || !std::isfinite(step))
    throw core::Error(fmt::format("a step of {:g} s between samples makes no sense; give one > 0", step));
  if (segment < fewest_samples || segment % 2 != 0 || segment > (std::size_t{1} << 30))
    throw core::Error(
        fmt::format("segments of {} samples make no power spectrum; give an even number from {} to 2^30",
                    segment, fewest_samples));
  segments_ = std::make_unique<Segments>(signals, step, segment);
}
WelchEstimate::WelchEstimate(WelchEstimate&&) noexcept = default;
WelchEstimate& WelchEstimate::operator=(WelchEstimate&&) noexcept = default;
WelchEstimate::~WelchEstimate() = default;

void WelchEstimate::add(std::span<const double> values) {
  assert(values.size() == segments_->signals);
  segments_->add(values);
}

std::size_t WelchEstimate::segments() const { return segments_->count; }

PowerSpectrum WelchEstimate::spectrum(std::size_t signal, double confidence) const {
  assert(signal < segments_->signals);
  PowerSpectrum out{segments_->frequencies(), segments_->power(signal), segments_->count};
  const auto count = static_cast<double>(out.segments);
  out.degrees = 2.0 * count / (1.0 + 2.0 * (count - 1.0) / count * correlation_of_neighbours);
  out.lower = out.degrees / chi_square_quantile(out.degrees, 0.5 * (1.0 + confidence));
  out.upper = out.degrees / chi_square_quantile(out.degrees, 0.5 * (1.0 - confidence));
  return out;
}

CrossPowerSpectrum WelchEstimate::cross(std::size_t x, std::size_t y) const {
  assert(x < segments_->signals && y < segments_->signals);
  return {segments_->frequencies(), segments_->power(x), segments_->power(y), segments_->densities(x, y),
          segments_->count};
}

PowerSpectrum welch(std::span<const double> series, double step, double resolution, double confidence) {
  if (!(resolution > 0.0) || !(resolution * step * fewest_samples <= 1.0 + 1e-9))
    throw core::Error(fmt::format(
        "a resolution of {:g} Hz makes no power spectrum of samples of {:g} s; give one > 0 and at most "
        "{:g} Hz",
        resolution, step, 1.0 / (step * fewest_samples)));
  const auto segment = 2 * static_cast<std::size_t>(std::llround(0.5 / (resolution * step)));
  WelchEstimate estimate(1, step, segment);
  for (const double value : series)
    estimate.add({&value, 1});
  return estimate.spectrum(0, confidence);
}

} // namespace fretwork::flow
