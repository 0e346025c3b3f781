// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Loads as one modal force: loads that follow the same function of time are added before the
/// run.
#pragma once
#include "kernels/kernels.hpp"
#include "vibration/system.hpp"

namespace fretwork::vibration {

class LoadSum {
public:
  /// Whether corner() is asked for: records then have their polygons, 8 bytes a step.
  enum class Corners { unused, used };
  /// @param step  s: the force at a time stands for a step about it, so that what a table does inside a step keeps its impulse
  /// @param sampled  are added at the time itself, whatever the step: samples are far closer than the periods that carry their power
  LoadSum(const std::vector<Load>& loads, Eigen::Index modes, double duration, double step,
          const std::vector<signals::SampledLoad>& sampled = {}, Corners corners = Corners::unused);
  LoadSum(const ForcedSystem& forced, double step, Corners corners = Corners::unused)
      : LoadSum(forced.loads, forced.system.size(), forced.duration, step, forced.sampled_loads, corners) {}
  [[nodiscard]] bool empty() const { return signals_.empty() && sampled_.empty(); }
  /// True where the force never changes.
  [[nodiscard]] bool constant() const { return constant_; }
  /// Modal force of the step about a time, at the start of the half step after it, padded. No allocation.
  void at(double time, double* force);
  /// Modal force at a corner of the polygon, with corners `length` apart, that has the amplitudes of the loads: it is above that of straight lines
  /// between their values, by (w length)^2/12 for what moves with w. Of records whose points are closer than a step (signals/record.hpp) the nearest polygon with corners
  /// a step apart, of other tables as `at`. Padded. No allocation.
  /// @param time  s, a multiple of the step   @param length  s, of one step or, beside loads without tables, of several
  void corner(double time, double length, double* force);
  /// Modal force at a time that stands for another window, padded. No allocation.
  void at(double time, signals::Signal::Window window, double* force);
  /// Modal force at an instant, padded. No allocation.
  void instant(double time, double* force);
  /// The same without padding: what observers see.
  void observe(double time, double* force);

private:
  /// The force at a time by the values of the signals: those that are not random as value(k) has them, the others at place(grid).
  template <class Value, class Place>
  void combine(double time, const Place& place, const Value& value, double* force);
  /// A corner's height by the value there, of corners so far apart: above 1 of harmonic ones.
  [[nodiscard]] double above(std::size_t signal, double length) const;

  Eigen::Index modes_;
  int padded_modes_;
  double step_;
  bool constant_ = true;
  std::vector<signals::Signal> signals_;
  std::vector<std::vector<double>> polygons_; ///< of `signals_`: corners a step apart of records; empty: none
  std::vector<double> half_rates_;            ///< rad/s: half of those of harmonic ones, else 0
  std::vector<double> above_;                 ///< of corners a step apart
  kernels::Array shapes_, values_, observed_;
  std::vector<signals::SampledForce> sampled_;
};

} // namespace fretwork::vibration
