// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Least and largest values of signals that move between their samples: with ten samples a period of the highest mode, the largest sample
/// is up to 5 % lower than the crest that lies between two. Where three samples stand for equal lengths of time and the middle one is the
/// least or the largest, the extreme is that of the parabola through them, b - (c - a)^2/8/(a - 2 b + c), which is within 0.4 % then and
/// exceeds no sample by more than an eighth of c - a.
#pragma once
#include "core/state_archive.hpp"
#include <cstddef>
#include <vector>

namespace fretwork::post {

class Extremes {
public:
  explicit Extremes(std::size_t signals)
      : least_(signals), most_(signals), before_(signals), last_(signals) {}
  /// @param values  one a signal   @param step  s, the length of time that they stand for, > 0
  void watch(const double* values, double step);
  /// 0 before the first sample.
  [[nodiscard]] double least(std::size_t signal) const { return least_[signal]; }
  [[nodiscard]] double most(std::size_t signal) const { return most_[signal]; }
  void visit(core::StateArchive& state) { state(least_, most_, before_, last_, step_, equal_); }

private:
  std::vector<double> least_, most_;
  std::vector<double> before_, last_; ///< the last two samples
  double step_ = 0.0;                 ///< s, of the last one
  int equal_ = 0;                     ///< samples of that step in a row, up to 2; 0: none at all
};

} // namespace fretwork::post
