// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Least and largest values of signals that move between their samples: with ten samples a period of the highest mode, the largest sample
/// is up to 5 % lower than the crest that lies between two. Where three samples are equally spaced in time and the middle one is the least or
/// the largest, the extreme is that of the parabola through them, b - (c - a)^2/8/(a - 2 b + c), which is within 0.4 % then and exceeds no
/// sample by more than an eighth of c - a. Elsewhere, it is that of the samples.
#pragma once
#include "core/state_archive.hpp"
#include <cstddef>
#include <vector>

namespace fretwork::post {

class Extremes {
public:
  explicit Extremes(std::size_t signals) : min_(signals), max_(signals), before_(signals), last_(signals) {}
  /// @param values  one a signal   @param time  s, of the sample, not before that of the last one
  void watch(const double* values, double time);
  /// 0 before the first sample.
  [[nodiscard]] double min(std::size_t signal) const { return min_[signal]; }
  [[nodiscard]] double max(std::size_t signal) const { return max_[signal]; }
  void visit(core::StateArchive& state) { state(min_, max_, before_, last_, time_, spacing_, samples_); }

private:
  std::vector<double> min_, max_;
  std::vector<double> before_, last_; ///< the last two samples
  double time_ = 0.0, spacing_ = 0.0; ///< s, of the last one, and of both
  int samples_ = 0;                   ///< up to 2
};

} // namespace fretwork::post
