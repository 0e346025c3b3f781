// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Functions of time that loads and base motions follow.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

namespace fretwork::transient {

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

/// Band-limited Gaussian noise of zero mean: a flat spectrum between two frequencies. The realisation is
/// fixed by the seed, the band and the duration of the run.
struct Random {
  double rms;       ///< of the ensemble
  double low, high; ///< Hz, 0 <= low < high
  std::uint64_t seed = 1;
  bool operator==(const Random&) const = default;
};

/// at_start + the integral of a function from 0 to t: the velocity of what moves with that acceleration.
struct Integral {
  std::variant<Constant, Harmonic, Table, Random> function;
  double at_start = 0;
  bool operator==(const Integral&) const = default;
};

using TimeFunction = std::variant<Constant, Harmonic, Table, Random, Integral>;

/// Highest frequency to be resolved, Hz: 0 for constants and tables.
[[nodiscard]] double highest_frequency(const TimeFunction& function);

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
  /// Value that stands for a window of steps of length h: that at `time`, but where an interval of a table that is
  /// shorter (a jump: 0) meets the window the mean over the window: windows side by side keep the impulse. No allocation.
  [[nodiscard]] double over_step(double time, double h, Window window) const;
  /// The same for the window of h about `time`; at the start of the run for its half within the run.
  [[nodiscard]] double over_step(double time, double h) const;

  /// Of a random signal: values and slopes times grid_step(), interleaved, of the cubic pieces from t = 0. Else empty.
  [[nodiscard]] std::span<const double> samples() const { return samples_; }
  [[nodiscard]] double grid_step() const { return grid_step_; }

  /// True where the value never changes.
  [[nodiscard]] bool is_constant() const { return std::holds_alternative<Constant>(function_); }

private:
  [[nodiscard]] double mean(const Table& table, double from, double to) const;

  TimeFunction function_;
  std::shared_ptr<const MotionSignal> motion_; ///< of an integral: what moves with that velocity
  double grid_step_ = 0, per_grid_step_ = 0;   ///< s, spacing of the samples of a random signal; 1/s
  std::vector<double>
      samples_; ///< value and slope times grid_step, interleaved: cubic Hermite between samples
};

} // namespace fretwork::transient
