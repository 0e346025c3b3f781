// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Loads as one modal force: loads that follow the same function of time are added before the
/// run.
#pragma once
#include "kernels/kernels.hpp"
#include "vibration/system.hpp"
#include <array>

namespace fretwork::vibration {

class LoadSum {
public:
  /// What records are in in_step(): their values, or their polygons, 8 bytes a step.
  enum class Records { by_value, by_polygon };
  /// @param step  s: the force at a time stands for a step about it, so that what a table does inside a step keeps its impulse
  /// @param sampled  are added at the time itself, whatever the step: samples are far closer than the periods that carry their power
  LoadSum(const std::vector<Load>& loads, Eigen::Index modes, double duration, double step,
          const std::vector<signals::SampledLoad>& sampled = {}, Records records = Records::by_value);
  LoadSum(const ForcedSystem& forced, double step, Records records = Records::by_value)
      : LoadSum(forced.loads, forced.system.size(), forced.duration, step, forced.sampled_loads, records) {}
  [[nodiscard]] bool empty() const { return signals_.empty() && sampled_.empty(); }
  /// True where the force never changes.
  [[nodiscard]] bool constant() const { return constant_; }
  /// Whether any is no straight line within a step of in_step().
  [[nodiscard]] bool bends() const { return bends_; }
  /// Modal force of the step about a time, at the start of the half step after it, padded. No allocation.
  void at(double time, double* force);
  /// Modal forces in a step: the straight line from load0 to load1 that has their mean and first moment, and the bend b of b (3 x^2 - 1)/2 on it, x from -1 to 1
  /// (signals::InStep). Of records whose points are closer than a step (signals/record.hpp) the nearest polygon with corners a step apart, of sampled loads the line
  /// between their values at both ends: neither bends. Padded. No allocation.
  /// @param start, end  s, one step apart or, beside loads without tables, several   @param bend  null: not asked for
  void in_step(double start, double end, double* load0, double* load1, double* bend);
  /// Modal force at a time that stands for another window, padded. No allocation.
  void at(double time, signals::Signal::Window window, double* force);
  /// Modal force at an instant, padded. No allocation.
  void instant(double time, double* force);
  /// The same without padding: what observers see.
  void observe(double time, double* force);

private:
  /// Hands out all signals: random ones, which in a study mostly share one grid, with their places on it at these times.
  template <std::size_t Count, class OfRandom, class OfOther>
  void each(const std::array<double, Count>& times, const OfRandom& of_random, const OfOther& of_other) const;
  /// The force at a time by the values of the signals, those that are not random as value(k) has them.
  template <class Value> void combine(double time, const Value& value, double* force);
  [[nodiscard]] signals::InStep in_step(std::size_t signal, double start, double end) const;
  /// Of all signals, by a value for each.
  void sum(const kernels::Array& values, double* force) const;
  /// Adds the sampled loads at a time.
  void add_sampled(double time, double* force);

  Eigen::Index modes_;
  int padded_modes_;
  double step_;
  bool constant_ = true, bends_ = false;
  std::vector<signals::Signal> signals_;
  std::vector<std::vector<double>> polygons_; ///< of `signals_`: corners a step apart of records; empty: none
  kernels::Array shapes_, values_, observed_;
  kernels::Array first_, last_, bend_; ///< of `signals_` in a step: the line at both ends, the bend
  std::vector<signals::SampledForce> sampled_;
  kernels::Array sampled_at_end_; ///< their forces at a time: the start of the step that follows
  double sampled_time_ = -1.0;    ///< s
};

} // namespace fretwork::vibration
