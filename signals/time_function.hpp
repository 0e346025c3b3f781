// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Functions of time that loads and base motions follow.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

namespace fretwork::signals {

struct Constant {
  double value;
  bool operator==(const Constant&) const = default;
};

/// amplitude * sin(2 pi frequency t + phase)
struct Harmonic {
  double amplitude;
  double frequency; ///< Hz, > 0
  double phase = 0; ///< rad
  bool operator==(const Harmonic&) const = default;
};

/// Linear between the points, constant outside; two points of equal time make a jump (the second value holds
/// from there).
struct Table {
  std::vector<double> time;  ///< s, not decreasing, at least one
  std::vector<double> value; ///< as many
  bool operator==(const Table&) const = default;
};

/// Band-limited Gaussian noise of zero mean: a flat spectrum between two frequencies. The realisation is fixed by the seed and the band: a
/// run begins like every longer one.
///
/// A periodic series of the run's length would change with the duration. So the signal is a sequence of independent blocks of a period T_b that
/// the band alone gives, each faded into the next over C = T_b/8, with hop H = T_b - C:
///     x(t) = sum over b of w(t - b H + C) x_b(t - b H + C),   x_b(t) = Re sum over lines of c_n exp(2 pi i n t/T_b)
///     w(u) = sin(pi u/2C) on [0, C], 1 up to H, cos(pi (u - H)/2C) up to T_b
/// The squares of the weights add up to 1: the signal is Gaussian with the same variance at every instant. Fades smear the ends of the
/// band by 2/T_b. T_b is 1024 periods of the upper end of the band, and has 32 lines in it at least.
///
/// Fades leave such a signal a little power below its band, to 0 Hz, and its double integral walks away. The acceleration of a motion is
/// therefore the second derivative of a displacement made of blocks with the lines -c_n/w_n^2, faded by weights of three derivatives,
///     w(u) = sin(pi/2 S(u/C)),   S(x) = 10 x^3 - 15 x^4 + 6 x^5,
/// from rest at 0 over one period of the lower end of the band, and 8 of the upper end. T_b is then 64 periods of the lower end at least, so that fades change the
/// variance of a line by 2 % at most. A displacement with frequencies down to 0 has no variance: a band from 0 begins at its 256th part.
struct Random {
  double rms;       ///< of the ensemble
  double low, high; ///< Hz, 0 <= low < high
  std::uint64_t seed = 1;
  bool of_motion = false; ///< the acceleration of a motion that stays about its place
  bool operator==(const Random&) const = default;
};

/// s, in which the acceleration of a motion rises from rest.
[[nodiscard]] double rise_time(const Random& motion);

/// at_start + the integral of a function from 0 to t: the velocity of what moves with that acceleration.
struct Integral {
  std::variant<Constant, Harmonic, Table, Random> function;
  double at_start = 0;
  bool operator==(const Integral&) const = default;
};

using TimeFunction = std::variant<Constant, Harmonic, Table, Random, Integral>;

/// Value that a load has in the static equilibrium a run starts from: at t = 0, of a random signal its mean, 0.
[[nodiscard]] double static_value(const TimeFunction& function, double duration);

/// Highest frequency to be resolved, Hz: 0 for constants and tables.
[[nodiscard]] double highest_frequency(const TimeFunction& function);

/// The samples of a random signal: equal intervals from t = 0, cubic Hermite pieces on them.
struct SampleGrid {
  double step = 0.0, per_step = 0.0; ///< s; 1/s
  std::ptrdiff_t intervals = 0;
  bool operator==(const SampleGrid&) const = default;

  /// A time on the grid, the same for all signals on it: value = of the interval's start + next * what the end's value is above it +
  /// slope * slope there + next_slope * slope at the end, slopes times `step`.
  struct Place {
    std::ptrdiff_t interval;
    double next, slope, next_slope;
  };
  [[nodiscard]] Place place(double time) const {
    const double position = time * per_step;
    const auto interval = std::min(static_cast<std::ptrdiff_t>(std::max(0.0, position)), intervals - 1);
    const double s = position - static_cast<double>(interval), rest = 1.0 - s;
    return {interval, s * s * (3.0 - 2.0 * s), s * rest * rest, -s * s * rest};
  }
};

/// A function over a step by Legendre's polynomials: mean + slope x + bend (3 x^2 - 1)/2, x from -1 to 1, with its mean, first and second moment.
struct InStep {
  double mean = 0.0, slope = 0.0, bend = 0.0;
};

/// Lobatto's rule of four points over a step: its mean, slope and bend are exact to degree 5, 4 and 3. T: what is known at each of its points.
template <class T> using LobattoPoints = std::array<T, 4>;
inline constexpr double root_5 = 2.2360679774997897;
/// Of a step, s.
[[nodiscard]] inline LobattoPoints<double> lobatto_times(double from, double to) {
  const double middle = 0.5 * (from + to), inner = 0.5 * (to - from) / root_5;
  return {from, middle - inner, middle + inner, to};
}

class MotionSignal;

/// A time function made ready for a run of `duration` seconds: values at any instant of it.
class Signal {
public:
  Signal(const TimeFunction& function, double duration);

  /// Value at `time` (from the right at a jump). No allocation.
  [[nodiscard]] double operator()(double time) const;

  /// Span of time that a value stands for, s.
  struct Window {
    double from, to;
  };
  /// Of h about `time`; at the start of the run its half within the run.
  [[nodiscard]] static Window window(double time, double h) {
    return {std::max(0.0, time - 0.5 * h), time + 0.5 * h};
  }
  /// Value that stands for a window of steps of length h: that at `time`, but where an interval of a table that is
  /// shorter (a jump: 0) meets the window the mean over the window: windows side by side keep the impulse. No allocation.
  [[nodiscard]] double over_step(double time, double h, Window window) const;

  /// Over a step: a table exactly, jumps inside of it too; others by Lobatto's rule. No allocation.
  [[nodiscard]] InStep in_step(double from, double to) const;
  /// Of a random signal, at Lobatto's points of the step on its grid. No allocation.
  [[nodiscard]] InStep in_step(const LobattoPoints<SampleGrid::Place>& places) const {
    return by_lobatto({at(places[0]), at(places[1]), at(places[2]), at(places[3])});
  }

  /// Of a random signal: values and slopes times the grid's step, interleaved. Else empty.
  [[nodiscard]] std::span<const double> samples() const { return samples_; }
  [[nodiscard]] const SampleGrid& grid() const { return grid_; }
  [[nodiscard]] double grid_step() const { return grid_.step; }
  [[nodiscard]] bool is_random() const { return shared_ != nullptr; }
  /// Of a random signal, at a place on its grid. No allocation.
  [[nodiscard]] double at(const SampleGrid::Place& place) const {
    const double* p = samples_.data() + 2 * place.interval;
    return p[0] + place.next * (p[2] - p[0]) + place.slope * p[1] + place.next_slope * p[3];
  }

  /// True where the value never changes.
  [[nodiscard]] bool is_constant() const { return std::holds_alternative<Constant>(function_); }

private:
  [[nodiscard]] InStep in_step(const Table& table, double from, double to) const;
  [[nodiscard]] static InStep by_lobatto(const LobattoPoints<double>& values);

  TimeFunction function_;
  std::shared_ptr<const MotionSignal> motion_; ///< of an integral: what moves with that velocity
  SampleGrid grid_;
  std::shared_ptr<const std::vector<double>> shared_; ///< by signals of the same function
  std::span<const double> samples_;                   ///< these
};

} // namespace fretwork::signals
