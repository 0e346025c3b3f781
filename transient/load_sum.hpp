// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The loads of a scene as one modal force: loads that follow the same function of time are added before the
/// run.
#pragma once
#include "transient/grid_sine.hpp"
#include "transient/kernels.hpp"
#include "transient/scene.hpp"
#include <optional>

namespace fretwork::transient {

class LoadSum {
public:
  /// @param step  s: the force at a time stands for a step about it, so that what a table does inside a step keeps its impulse
  LoadSum(const std::vector<Load>& loads, Eigen::Index modes, double duration, double step);
  [[nodiscard]] bool empty() const { return signals_.empty(); }
  /// True where the force never changes.
  [[nodiscard]] bool constant() const { return constant_; }
  /// Modal force of the step about a time, at the start of the half step after it, padded. No allocation.
  void at(double time, double* force);
  /// Modal force at a time that stands for another window, padded. No allocation.
  void at(double time, Signal::Window window, double* force);
  /// Modal force at an instant, padded. No allocation.
  void instant(double time, double* force);

private:
  /// The force at a time by the values of the signals, those that are not random as value(k) has them.
  template <class Value> void combine(double time, const Value& value, double* force);

  int padded_modes_;
  double step_;
  bool constant_ = true;
  std::vector<Signal> signals_;
  std::vector<std::optional<GridSine>> sines_; ///< of the harmonic ones, on half steps
  kernels::Array shapes_, values_;
};

} // namespace fretwork::transient
