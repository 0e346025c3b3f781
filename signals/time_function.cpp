// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals/time_function.hpp"
#include "core/error.hpp"
#include "signals/prescribed_motion.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <deque>
#include <fftw3.h>
#include <fmt/format.h>
#include <numbers>
#include <optional>
#include <random>

namespace fretwork::signals {
namespace {

/// Samples per period of the highest frequency: cubic Hermite interpolation between them errs by (2 pi /
/// 32)^4 / 384 = 4e-6.
constexpr double samples_per_period = 32.0;
constexpr double two_pi = 2.0 * std::numbers::pi;

/// Of a random signal: a gigabyte. An hour up to 500 Hz.
constexpr double most_samples = 0x1p26;
/// T_b in periods of the upper end of a band: lines resolve a thousandth of it.
constexpr double periods_of_block = 1024.0;
/// Of a block: fewer are no random signal. Fades smear an end of the band over two of them.
constexpr double fewest_lines = 32.0;
constexpr std::size_t fades_of_block = 8; ///< T_b/C
/// Of motions: T_b in periods of the lower end of a band, and that end of a band from 0.
constexpr double slow_periods_of_block = 64.0, lowest_of_motion = 1.0 / 256.0;
/// Of the upper end, at least in the rise from rest: cubics through its samples leave next to no velocity.
constexpr double periods_of_start = 8.0;
/// Signals reach so many durations: the last steps stand for times beyond the end.
constexpr double covered = 1.05;

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

/// A weight of a block and its derivatives by the number of the sample.
struct Weight {
  double value = 1.0, first = 0.0, second = 0.0, third = 0.0;
};

/// Of the part x of a rise from 0 to 1 over so many samples: sin(pi x/2), value and slope.
Weight quarter_sine(double x, double samples) {
  const double half_pi = 0.5 * std::numbers::pi;
  return {std::sin(half_pi * x), half_pi / samples * std::cos(half_pi * x)};
}

/// sin(g), g = pi/2 S(x).
Weight smooth_rise(double x, double samples) {
  const double half_pi = 0.5 * std::numbers::pi, rest = 1.0 - x;
  const double g = half_pi * x * x * x * (10.0 + x * (6.0 * x - 15.0)),
               g1 = half_pi * 30.0 * x * x * rest * rest / samples,
               g2 = half_pi * 60.0 * x * rest * (rest - x) / (samples * samples),
               g3 = half_pi * 60.0 * (1.0 - 6.0 * x * rest) / (samples * samples * samples);
  const double s = std::sin(g), c = std::cos(g);
  return {s, g1 * c, g2 * c - g1 * g1 * s, (g3 - g1 * g1 * g1) * c - 3.0 * g1 * g2 * s};
}

/// Hz, of the band that a signal has.
double lower_end(const Random& random) {
  return random.of_motion && random.low == 0.0 ? lowest_of_motion * random.high : random.low;
}

/// The blocks of a random signal (time_function.hpp).
class RandomBlocks {
public:
  explicit RandomBlocks(const Random& random)
      : random_(random), low_(lower_end(random)),
        period_(std::max({periods_of_block / random.high, fewest_lines / (random.high - low_),
                          random.of_motion ? slow_periods_of_block / low_ : 0.0})),
        size_(fast_length(samples_per_period * random.high * period_)) {}

  /// Samples of a block.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Samples a second.
  [[nodiscard]] double per_step() const { return static_cast<double>(size_) / period_; }

  /// Values and slopes times the step, interleaved, from t = 0 on.
  [[nodiscard]] std::vector<double> samples(std::size_t count) const {
    std::mt19937_64 generator(random_.seed);
    std::vector<double> out(2 * count, 0.0);
    thread_local std::vector<double> block, displacement; // their pages are not asked for again
    const std::size_t fade = size_ / fades_of_block, hop = size_ - fade;
    for (std::size_t number = 0; number * hop < count + fade; ++number) {
      const std::vector<std::complex<double>> lines = draw(generator);
      fill(lines, block);
      if (random_.of_motion)
        fill(integrated_twice(lines), displacement);
      for (std::size_t u = 0; u < size_; ++u) {
        const std::size_t shifted = number * hop + u; // sample + fade
        if (shifted < fade || shifted - fade >= count)
          continue;
        const Weight w = weight_at(number, u);
        double* to = out.data() + 2 * (shifted - fade);
        const double* x = block.data() + 2 * u;
        to[0] += w.value * x[0];
        to[1] += w.value * x[1] + w.first * x[0];
        if (!random_.of_motion)
          continue;
        const double* y = displacement.data() + 2 * u; // the second and third derivative of w y
        to[0] += 2.0 * w.first * y[1] + w.second * y[0];
        to[1] += 2.0 * w.first * x[0] + 3.0 * w.second * y[1] + w.third * y[0];
      }
    }
    return out;
  }

private:
  using Lines = std::vector<std::complex<double>>; ///< of the band

  [[nodiscard]] Weight weight_at(std::size_t number, std::size_t u) const {
    const std::size_t fade = size_ / fades_of_block, hop = size_ - fade;
    const auto rise = [this](std::size_t of, std::size_t samples) {
      const auto whole = static_cast<double>(samples);
      return (random_.of_motion ? smooth_rise : quarter_sine)(static_cast<double>(of) / whole, whole);
    };
    if (random_.of_motion && number == 0) {
      const auto start = static_cast<std::size_t>(std::ceil(per_step() * rise_time(random_)));
      if (u < fade + start)
        return rise(u - fade, start);
    }
    if (u < fade)
      return rise(u, fade);
    if (u < hop)
      return {};
    Weight w = rise(size_ - u, fade); // backwards
    w.first = -w.first, w.third = -w.third;
    return w;
  }

  /// Of the band; not 0, so that the mean is.
  [[nodiscard]] std::size_t first_line() const {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(low_ * period_)));
  }
  /// w of a line, times the grid's step.
  [[nodiscard]] double turn(std::size_t line) const {
    return two_pi * static_cast<double>(line) / static_cast<double>(size_);
  }

  /// c of the lines of a block.
  Lines draw(std::mt19937_64& generator) const {
    const auto last = static_cast<std::size_t>(std::floor(random_.high * period_));
    Lines lines(last - first_line() + 1);
    const double scale = random_.rms / std::sqrt(static_cast<double>(lines.size()));
    for (std::complex<double>& c : lines)
      c = scale * normal_pair(generator);
    return lines;
  }
  /// By the number of the sample.
  [[nodiscard]] Lines integrated_twice(Lines lines) const {
    for (std::size_t i = 0; i < lines.size(); ++i)
      lines[i] /= -turn(first_line() + i) * turn(first_line() + i);
    return lines;
  }

  /// One block. The signal x = sum over lines of Re(c exp(i w t)) and its slope x' make one complex signal x + i x', which one transform
  /// gives interleaved: x' has the lines i w c, so that z_k = c (1 - w)/2 and z_(n-k) = conj(c) (1 + w)/2; w times the grid's step.
  void fill(const Lines& lines, std::vector<double>& block) const {
    const std::size_t n = size_;
    block.assign(2 * n, 0.0);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::size_t k = first_line() + i;
      const std::complex<double> c = lines[i];
      const double w = turn(k);
      block[2 * k] = 0.5 * (1.0 - w) * c.real();
      block[2 * k + 1] = 0.5 * (1.0 - w) * c.imag();
      block[2 * (n - k)] = 0.5 * (1.0 + w) * c.real();
      block[2 * (n - k) + 1] = -0.5 * (1.0 + w) * c.imag();
    }
    transform(n, block);
  }

  Random random_;
  double low_;    ///< Hz, of the band
  double period_; ///< T_b, s
  std::size_t size_;
};

using SharedSamples = std::shared_ptr<const std::vector<double>>;

/// The samples of the signals that are in use, and of those made last: a run and its replays share those of their loads, and so do cases of a sweep
/// that do not vary them. The synthesis takes a hundred times as long as a copy.
class RecentSamples {
public:
  [[nodiscard]] SharedSamples get(const Random& random, const RandomBlocks& blocks, std::size_t count) {
    std::erase_if(used_, [](const Entry& entry) { return entry.samples.expired(); });
    for (const Entry& entry : used_) {
      if (!(entry.random == random))
        continue;
      if (SharedSamples samples = entry.samples.lock(); samples && samples->size() == 2 * count) {
        keep(samples);
        return samples;
      }
    }
    auto samples = std::make_shared<const std::vector<double>>(blocks.samples(count));
    used_.push_back({random, samples});
    keep(samples);
    return samples;
  }

private:
  static constexpr std::size_t most = std::size_t{1} << 19; ///< numbers that are kept unused: 4 MB
  struct Entry {
    Random random;
    std::weak_ptr<const std::vector<double>> samples;
  };
  void keep(const SharedSamples& samples) {
    if (samples->size() > most) // a long run: its steps take longer by far
      return;
    size_ -= samples->size() * std::erase(last_, samples);
    for (size_ += samples->size(); size_ > most; last_.pop_front())
      size_ -= last_.front()->size();
    last_.push_back(samples);
  }

  std::vector<Entry> used_;
  std::deque<SharedSamples> last_;
  std::size_t size_ = 0; ///< numbers in `last_`
};

/// The same function as one of all kinds.
TimeFunction widened(const decltype(Integral::function)& function) {
  return std::visit([](const auto& f) -> TimeFunction { return f; }, function);
}

/// Of a run that is too long, or of a band that is too narrow for its frequencies.
std::string too_many_samples(const Random& random, const RandomBlocks& blocks, double duration,
                             double needed) {
  if (static_cast<double>(blocks.size()) > most_samples)
    return fmt::format("a random signal from {:.6g} to {:.6g} Hz needs blocks of {:.4g} samples, more than "
                       "{:.4g}; {}",
                       random.low, random.high, static_cast<double>(blocks.size()), most_samples,
                       random.of_motion && random.low < lowest_of_motion * random.high
                           ? "raise the lower end of its band, or lower the upper one"
                           : "widen its band, or lower it");
  return fmt::format(
      "a duration of {:.4g} s is too long for a random signal up to {:.4g} Hz: {:.4g} samples, more than "
      "{:.4g}; give a duration (transient.duration) of {:.2g} s at most, or lower the upper end of its band",
      duration, random.high, needed, most_samples, 0.99 * most_samples / (covered * blocks.per_step()));
}

} // namespace

double rise_time(const Random& motion) {
  return std::max(1.0 / lower_end(motion), periods_of_start / motion.high);
}

Signal::Signal(const TimeFunction& function, double duration) : function_(function) {
  if (const auto* integral = std::get_if<Integral>(&function))
    motion_ = std::make_shared<const MotionSignal>(
        PrescribedMotion{widened(integral->function), integral->at_start}, duration);
  const auto* random = std::get_if<Random>(&function);
  if (!random)
    return;
  const RandomBlocks blocks(*random);
  const double needed =
      std::ceil(covered * duration * blocks.per_step()) + 2.0; // the ends of the first and the last interval
  if (std::max(needed, static_cast<double>(blocks.size())) > most_samples)
    throw core::Error(too_many_samples(*random, blocks, duration, needed));
  const auto intervals = static_cast<std::ptrdiff_t>(needed) - 1;
  thread_local RecentSamples recent;
  shared_ = recent.get(*random, blocks, static_cast<std::size_t>(needed));
  samples_ = *shared_;
  grid_ = {1.0 / blocks.per_step(), blocks.per_step(), intervals};
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
        return in_step(*table, window.from, window.to).mean;
  }
  return (*this)(time);
}

InStep Signal::in_step(double from, double to) const {
  if (const auto* constant = std::get_if<Constant>(&function_))
    return {constant->value, 0.0, 0.0};
  if (const auto* table = std::get_if<Table>(&function_))
    return in_step(*table, from, to);
  LobattoPoints<double> points = lobatto_times(from, to);
  for (double& point : points)
    point = (*this)(point);
  return by_lobatto(points);
}
InStep Signal::by_lobatto(const LobattoPoints<double>& values) {
  const auto [first, before, after, last] = values;
  const double ends = first + last, inside = before + after;
  return {(ends + 5.0 * inside) / 12.0, 0.25 * (last - first + root_5 * (after - before)),
          5.0 / 12.0 * (ends - inside)};
}

/// The lines of a table piece by piece, each by Simpson's rule.
InStep Signal::in_step(const Table& table, double from, double to) const {
  const auto& t = table.time;
  const double middle = 0.5 * (from + to), per_half = 2.0 / (to - from);
  InStep out;
  auto i = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), from) - t.begin());
  double x = -1.0, value = (*this)(from);
  const auto up_to = [&](double end, double value_there) {
    const double share = (end - x) / 12.0; // of the half step, by 6 of Simpson's rule
    const auto add = [&](double weight, double at, double v) {
      out.mean += weight * share * v;
      out.slope += 3.0 * weight * share * at * v;
      out.bend += 2.5 * weight * share * (3.0 * at * at - 1.0) * v;
    };
    add(1.0, x, value);
    add(4.0, 0.5 * (x + end), 0.5 * (value + value_there));
    add(1.0, end, value_there);
    x = end;
    value = value_there;
  };
  for (; i < t.size() && t[i] < to; ++i) // at a jump an interval of no length
    up_to(per_half * (t[i] - middle), table.value[i]);
  const bool row_at_end = i < t.size() && t[i] == to;
  up_to(1.0, row_at_end ? table.value[i] : (*this)(to));
  return out;
}

double static_value(const TimeFunction& function, double duration) {
  return std::holds_alternative<Random>(function) ? 0.0 : Signal(function, duration)(0.0);
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

} // namespace fretwork::signals
