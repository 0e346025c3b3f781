// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/time_function.hpp"
#include "core/error.hpp"
#include "transient/prescribed_motion.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <fftw3.h>
#include <fmt/format.h>
#include <numbers>
#include <optional>
#include <random>

namespace fretwork::transient {
namespace {

/// Samples per period of the highest frequency: cubic Hermite interpolation between them errs by (2 pi /
/// 32)^4 / 384 = 4e-6.
constexpr double samples_per_period = 32.0;
constexpr double two_pi = 2.0 * std::numbers::pi;

/// Of a random signal: a gigabyte. An hour up to 500 Hz.
constexpr std::size_t most_samples = std::size_t{1} << 26;

/// Two standard normal numbers by Box and Muller from the 53 upper bits of the generator:
/// std::normal_distribution differs between libraries.
std::complex<double> normal_pair(std::mt19937_64& generator) {
  const auto uniform = [&] { return (static_cast<double>(generator() >> 11) + 0.5) * 0x1p-53; };
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  const double angle = two_pi * uniform();
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// The smallest length >= least that transforms fast: 2^a times 1, 9/8, 5/4 or 3/2.
std::size_t fast_length(double least) {
  for (std::size_t power = 8;; power *= 2)
    for (const std::size_t eighths : {8, 9, 10, 12})
      if (const std::size_t n = power / 8 * eighths; static_cast<double>(n) >= least)
        return n;
}

/// Complex transforms of one length in place, x_j = sum over k of z_k exp(i 2 pi k j / n).
class Synthesis {
public:
  explicit Synthesis(std::size_t n, double* values)
      : n_(n), plan_(fftw_plan_dft_1d(static_cast<int>(n), complex(values), complex(values), FFTW_BACKWARD,
                                      FFTW_ESTIMATE | FFTW_UNALIGNED)) {}
  Synthesis(const Synthesis&) = delete;
  Synthesis& operator=(const Synthesis&) = delete;
  ~Synthesis() { fftw_destroy_plan(plan_); }

  [[nodiscard]] std::size_t size() const { return n_; }
  void operator()(double* values) const { fftw_execute_dft(plan_, complex(values), complex(values)); }

private:
  static fftw_complex* complex(double* values) { return reinterpret_cast<fftw_complex*>(values); }
  std::size_t n_;
  fftw_plan plan_;
};

/// Transforms n complex values, whose real parts and imaginary parts follow each other.
void transform(std::size_t n, std::vector<double>& values) {
  // The plan of the last length stays: its tables take longer than the transform, and the signals of a run are mostly of one length.
  thread_local std::optional<Synthesis> synthesis;
  if (!synthesis || synthesis->size() != n)
    synthesis.emplace(n, values.data());
  (*synthesis)(values.data());
}

/// The same function as one of all kinds.
TimeFunction widened(const decltype(Integral::function)& function) {
  return std::visit([](const auto& f) -> TimeFunction { return f; }, function);
}

} // namespace

Signal::Signal(const TimeFunction& function, double duration) : function_(function) {
  if (const auto* integral = std::get_if<Integral>(&function))
    motion_ = std::make_shared<const MotionSignal>(
        PrescribedMotion{widened(integral->function), integral->at_start}, duration);
  const auto* random = std::get_if<Random>(&function);
  if (!random)
    return;
  // Lines at multiples of 1/period; at least 8 of them in the band, so that a run shorter than the band's
  // memory is still Gaussian.
  const double period = std::max(1.05 * duration, 8.0 / (random->high - random->low));
  auto first = static_cast<std::size_t>(std::ceil(random->low * period));
  const auto last = static_cast<std::size_t>(std::floor(random->high * period));
  first = std::max<std::size_t>(first, 1); // zero mean
  const std::size_t n = fast_length(samples_per_period * random->high * period);
  if (n > most_samples)
    throw core::Error(fmt::format("a random signal up to {:.4g} Hz over {:.4g} s needs {} samples, more than "
                                  "{}; lower the upper end of its "
                                  "band, or shorten the run",
                                  random->high, duration, n, most_samples));
  // The signal x = sum over lines of Re(c exp(i w t)) and its slope x' make one complex signal x + i x', which one transform gives
  // interleaved: x' has the lines i w c, so that z_k = c (1 - w)/2 and z_(n-k) = conj(c) (1 + w)/2; w times the grid's step.
  std::mt19937_64 generator(random->seed);
  const double scale = random->rms / std::sqrt(static_cast<double>(last - first + 1));
  samples_.assign(2 * (n + 1), 0.0); // value, slope, value, slope ...
  for (std::size_t k = first; k <= last; ++k) {
    const std::complex<double> c = scale * normal_pair(generator);
    const double w = two_pi * static_cast<double>(k) / static_cast<double>(n);
    samples_[2 * k] = 0.5 * (1.0 - w) * c.real();
    samples_[2 * k + 1] = 0.5 * (1.0 - w) * c.imag();
    samples_[2 * (n - k)] = 0.5 * (1.0 + w) * c.real();
    samples_[2 * (n - k) + 1] = -0.5 * (1.0 + w) * c.imag();
  }
  transform(n, samples_);
  std::copy_n(samples_.begin(), 2, samples_.end() - 2);
  const double grid_step = period / static_cast<double>(n);
  grid_ = {grid_step, 1.0 / grid_step, static_cast<std::ptrdiff_t>(n)};
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
    double operator()(const Random&) const { return self.at(self.grid_.place(time)); }
    double operator()(const Integral&) const { return (*self.motion_)(time).velocity; }
  };
  return std::visit(Visitor{time, *this}, function_);
}

double Signal::over_step(double time, double h, Window window) const {
  if (const auto* table = std::get_if<Table>(&function_)) {
    const auto begin = table->time.begin(), end = table->time.end();
    const double shorter = h * (1.0 - 1e-9); // intervals of h are not short, whatever their round-off
    for (auto after = std::max(std::lower_bound(begin, end, window.from), begin + 1);
         after < end && *(after - 1) <= window.to; ++after)
      if (*after - *(after - 1) < shorter)
        return mean(*table, window.from, window.to);
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
  if (const auto* integral = std::get_if<Integral>(&function))
    return highest_frequency(widened(integral->function));
  return 0.0;
}

} // namespace fretwork::transient
