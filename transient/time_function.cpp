// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/time_function.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <fftw3.h>
#include <fmt/format.h>
#include <memory>
#include <numbers>
#include <random>

namespace fretwork::transient {
namespace {

/// Samples per period of the highest frequency: cubic Hermite interpolation between them errs by (2 pi /
/// 32)^4 / 384 = 4e-6.
constexpr double samples_per_period = 32.0;
constexpr double two_pi = 2.0 * std::numbers::pi;

/// Of a random signal: a gigabyte. An hour up to 500 Hz.
constexpr std::size_t most_samples = std::size_t{1} << 26;

struct FftwFree {
  void operator()(void* p) const { fftw_free(p); }
};

/// Two standard normal numbers by Box and Muller from the 53 upper bits of the generator:
/// std::normal_distribution differs between libraries.
std::complex<double> normal_pair(std::mt19937_64& generator) {
  const auto uniform = [&] { return (static_cast<double>(generator() >> 11) + 0.5) * 0x1p-53; };
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  const double angle = two_pi * uniform();
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Real inverse transforms of one length: x_j = sum over k of Re(c_k exp(i 2 pi k j / n)), c_k given for k <= n/2.
class Synthesis {
public:
  explicit Synthesis(std::size_t n)
      : n_(n), in_(static_cast<fftw_complex*>(fftw_malloc(sizeof(fftw_complex) * (n / 2 + 1)))),
        out_(static_cast<double*>(fftw_malloc(sizeof(double) * n))),
        plan_(fftw_plan_dft_c2r_1d(static_cast<int>(n), in_.get(), out_.get(), FFTW_ESTIMATE)) {}
  Synthesis(const Synthesis&) = delete;
  Synthesis& operator=(const Synthesis&) = delete;
  ~Synthesis() { fftw_destroy_plan(plan_); }

  /// n values, overwritten by the next call.
  const double* operator()(const std::vector<std::complex<double>>& lines) {
    for (std::size_t k = 0; k <= n_ / 2; ++k) {
      const std::complex<double> value = k < lines.size() ? 0.5 * lines[k] : 0.0; // c2r adds the conjugate
      in_.get()[k][0] = value.real();
      in_.get()[k][1] = value.imag();
    }
    fftw_execute(plan_);
    return out_.get();
  }

private:
  std::size_t n_;
  std::unique_ptr<fftw_complex, FftwFree> in_;
  std::unique_ptr<double, FftwFree> out_;
  fftw_plan plan_;
};

} // namespace

Signal::Signal(const TimeFunction& function, double duration) : function_(function) {
  const auto* random = std::get_if<Random>(&function);
  if (!random)
    return;
  // Lines at multiples of 1/period; at least 8 of them in the band, so that a run shorter than the band's
  // memory is still Gaussian.
  const double period = std::max(1.05 * duration, 8.0 / (random->high - random->low));
  auto first = static_cast<std::size_t>(std::ceil(random->low * period));
  const auto last = static_cast<std::size_t>(std::floor(random->high * period));
  first = std::max<std::size_t>(first, 1); // zero mean
  std::size_t n = 2;                       // a power of two: fast, and the same plan everywhere
  while (static_cast<double>(n) < samples_per_period * random->high * period)
    n *= 2;
  if (n > most_samples)
    throw core::Error(fmt::format("a random signal up to {:.4g} Hz over {:.4g} s needs {} samples, more than "
                                  "{}; lower the upper end of its "
                                  "band, or shorten the run",
                                  random->high, duration, n, most_samples));
  std::mt19937_64 generator(random->seed);
  std::vector<std::complex<double>> lines(last + 1), slopes(last + 1);
  const double scale = random->rms / std::sqrt(static_cast<double>(last - first + 1));
  for (std::size_t k = first; k <= last; ++k) {
    lines[k] = scale * normal_pair(generator);
    slopes[k] = lines[k] * std::complex<double>(0.0, two_pi * static_cast<double>(k) / period);
  }
  grid_step_ = period / static_cast<double>(n);
  samples_.resize(2 * (n + 1)); // value, slope, value, slope ...
  Synthesis synthesis(n);
  const auto store = [&](std::size_t which, const std::vector<std::complex<double>>& spectrum,
                         double scale_by) {
    const double* x = synthesis(spectrum);
    for (std::size_t j = 0; j <= n; ++j)
      samples_[2 * j + which] = x[j % n] * scale_by;
  };
  store(0, lines, 1.0);
  store(1, slopes, grid_step_);
}

double Signal::operator()(double time) const {
  struct Visitor {
    double time;
    const Signal& self;
    double operator()(const Constant& f) const { return f.value; }
    double operator()(const Harmonic& f) const {
      return f.amplitude * std::sin(two_pi * f.frequency * time + f.phase);
    }
    double operator()(const Table& f) const {
      const auto after =
          std::upper_bound(f.time.begin(), f.time.end(), time); // the first point later than `time`
      if (after == f.time.begin())
        return f.value.front();
      if (after == f.time.end())
        return f.value.back();
      const auto i = static_cast<std::size_t>(after - f.time.begin());
      const double share = (time - f.time[i - 1]) / (f.time[i] - f.time[i - 1]);
      return f.value[i - 1] + share * (f.value[i] - f.value[i - 1]);
    }
    double operator()(const Random&) const {
      const double position = time / self.grid_step_;
      const auto last = self.samples_.size() / 2 - 2;
      const auto j = std::min(static_cast<std::size_t>(std::max(0.0, position)), last);
      const double s = position - static_cast<double>(j);
      const double* p = &self.samples_[2 * j]; // value, slope, next value, next slope
      const double difference = p[2] - p[0];
      return p[0] +
             s * (p[1] + s * (3.0 * difference - 2.0 * p[1] - p[3] + s * (p[1] + p[3] - 2.0 * difference)));
    }
  };
  return std::visit(Visitor{time, *this}, function_);
}

double Signal::over_step(double time, double h) const {
  if (const auto* table = std::get_if<Table>(&function_)) {
    const double from = time - 0.5 * h, to = time + 0.5 * h;
    const auto first = std::upper_bound(table->time.begin(), table->time.end(), from);
    if (table->time.end() - first > 1 && *(first + 1) < to)
      return mean(*table, from, to);
  }
  return (*this)(time);
}

double Signal::mean(const Table& table, double from, double to) const {
  // trapezia between `from`, the table's points inside, and `to`; at a jump the value before it ends one and the value after starts the next
  const auto& t = table.time;
  auto i = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), from) - t.begin());
  double sum = 0.0, last_time = from, last_value = (*this)(from);
  for (; i < t.size() && t[i] < to; ++i) {
    sum += 0.5 * (last_value + table.value[i]) * (t[i] - last_time);
    last_time = t[i];
    last_value = table.value[i];
  }
  const bool ends_at_jump = i + 1 < t.size() && t[i] == to && t[i + 1] == to;
  sum += 0.5 * (last_value + (ends_at_jump ? table.value[i] : (*this)(to))) * (to - last_time);
  return sum / (to - from);
}

double highest_frequency(const TimeFunction& function) {
  if (const auto* harmonic = std::get_if<Harmonic>(&function))
    return harmonic->frequency;
  if (const auto* random = std::get_if<Random>(&function))
    return random->high;
  return 0.0;
}

} // namespace fretwork::transient
