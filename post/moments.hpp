// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Mean, standard deviation and extremes of a signal, seen sample by sample.
#pragma once
#include <cstdint>

namespace fretwork::post {

struct Moments {
  double mean = 0.0, std = 0.0, min = 0.0, max = 0.0;
};

/// Sums about the first sample, so that a small motion about a large mean keeps its digits.
class Accumulator {
public:
  void add(double value) {
    if (count_ == 0)
      first_ = min_ = max_ = value;
    const double d = value - first_;
    sum_ += d;
    squares_ += d * d;
    min_ = value < min_ ? value : min_;
    max_ = value > max_ ? value : max_;
    ++count_;
  }
  /// All zero before the first sample.
  [[nodiscard]] Moments moments() const;

private:
  double first_ = 0.0, sum_ = 0.0, squares_ = 0.0, min_ = 0.0, max_ = 0.0;
  std::int64_t count_ = 0;
};

} // namespace fretwork::post
