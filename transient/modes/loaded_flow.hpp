// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The modes between instants at which contact forces act: their exact flow under loads that are linear in time from one action to the next
/// (oscillator.hpp; coupled_flow.hpp where a damping matrix couples them).
#pragma once
#include "core/state_archive.hpp"
#include "transient/modes/coupled_flow.hpp"
#include "transient/modes/load_sum.hpp"

namespace fretwork::transient {

class LoadedFlow {
public:
  /// At the start of the run, half a step before the first action.
  LoadedFlow(const Scene& scene, double step);

  kernels::Array q, v; ///< after the last flow, padded; an action changes them
  /// Of the last action, or of the start, s.
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] std::int64_t steps() const { return steps_; }
  /// Of the action after so many more steps, s.
  [[nodiscard]] double instant(int further) const {
    return (static_cast<double>(steps_ + further) - 0.5) * h_;
  }
  /// Of q and v, J.
  [[nodiscard]] double energy() const;

  /// To the next action. Returns the work of the loads on the way and twice the energy after it.
  kernels::FlowSums advance();

  /// The free motion at a time after the last action; not padded.
  void state_at(double time, double* q_at, double* v_at);
  /// The loads at a time, not padded.
  void load_at(double time, double* force);

  void visit(core::StateArchive& state) { state(steps_, time_, q, v, f_now_); }

private:
  /// The exact flow to `time`, under the load from `f_now_` to `load`, which is found.
  kernels::FlowSums advance_by(const kernels::FlowTable& table, double time, kernels::Array& q_to,
                               kernels::Array& v_to, kernels::Array& load);

  System system_;
  double h_;
  LoadSum loads_;
  CoupledFlow coupled_;
  kernels::FlowTable first_, full_;
  kernels::Array k_, f_now_, f_next_, slope_;
  std::int64_t steps_ = 0;
  double time_ = 0.0;
};

// Here, as a call of each step takes a fifth of one without contacts.
inline kernels::FlowSums LoadedFlow::advance() {
  const bool first = steps_ == 0;
  time_ = instant(1);
  ++steps_;
  kernels::FlowSums sums = advance_by(first ? first_ : full_, time_, q, v, f_next_);
  if (!coupled_.empty()) {
    sums.work += coupled_.advance(first ? 1 : 0, q.data(), v.data(), f_now_.data(), f_next_.data());
    sums.twice_energy = 2.0 * energy();
  }
  f_now_.swap(f_next_);
  return sums;
}

inline kernels::FlowSums LoadedFlow::advance_by(const kernels::FlowTable& table, double time,
                                                kernels::Array& q_to, kernels::Array& v_to,
                                                kernels::Array& load) {
  const int n = static_cast<int>(q_to.size());
  if (loads_.empty())
    return kernels::flow_free(n, table, q_to.data(), v_to.data());
  if (loads_.constant())
    load = f_now_;
  else
    loads_.at(time, load.data());
  return kernels::flow_loaded(n, table, q_to.data(), v_to.data(), f_now_.data(), load.data());
}

} // namespace fretwork::transient
