// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Mean and standard deviation of a signal, seen sample by sample; its extremes are those of extremes.hpp. A sample stands for a length of
/// time w, its weight (steps may differ):
///     mean = sum w x / sum w,   std^2 = sum w (x - mean)^2 / sum w
#pragma once

namespace fretwork::post {

struct Moments {
  double mean = 0.0, std = 0.0, min = 0.0, max = 0.0;
};

/// Sums about the first sample, so that a small motion about a large mean keeps its digits.
class Accumulator {
public:
  /// @param weight  > 0
  void add(double value, double weight) {
    if (!(weight_ > 0.0))
      first_ = value;
    const double d = value - first_;
    sum_ += weight * d;
    squares_ += weight * d * d;
    weight_ += weight;
  }
  /// Sums so far of w d and of w d^2, d from the first sample.
  [[nodiscard]] double sum() const { return sum_; }
  [[nodiscard]] double sum_of_squares() const { return squares_; }
  /// 0 before the first sample.
  [[nodiscard]] double mean() const;
  [[nodiscard]] double std() const;

private:
  double first_ = 0.0, sum_ = 0.0, squares_ = 0.0, weight_ = 0.0;
};

} // namespace fretwork::post
