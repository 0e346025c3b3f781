// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Records of steps written by hand.
#pragma once
#include "kernels/kernels.hpp"
#include "transient/run.hpp"
#include <algorithm>
#include <vector>

namespace fretwork::tests {

/// Contacts that rest at the centres of holes of 1 m, of 1 N/m.
inline std::vector<transient::ContactPoint> centred(std::size_t count) {
  return std::vector<transient::ContactPoint>(
      count, {"", {contact::Circle{1.0}, {1.0}, {}}, core::Vec3::Zero(), {}});
}

/// Feeds an observer with steps; contacts without a state are open.
class HandMade {
public:
  HandMade(transient::Observer& observer, std::size_t contacts, double step)
      : observer_(observer), states_(contacts), uy_(8, 0.0), uz_(8, 0.0), q_(8, 0.0) {
    record_.step = step;
    record_.contacts = static_cast<int>(contacts);
    record_.q = q_.data();
    record_.uy = uy_.data();
    record_.uz = uz_.data();
    record_.states = states_;
  }
  /// Length of the steps that follow.
  void step_length(double step) { record_.step = step; }
  transient::ContactState& contact(std::size_t c) { return states_[c]; }
  double& y(std::size_t c) { return uy_[c]; }
  double& z(std::size_t c) { return uz_[c]; }
  kernels::Array& q() { return q_; }
  /// At the end of the steps that follow.
  transient::Energy& energy() { return record_.energy; }
  /// One step; contacts with a normal force are active. The states are opened again.
  void step() {
    opened_ = active_;
    active_.clear();
    for (std::size_t c = 0; c < states_.size(); ++c)
      if (states_[c].normal_force > 0.0) {
        active_.push_back(static_cast<int>(c));
        if (!in_full_)
          states_[c].act_throughout(std::find(opened_.begin(), opened_.end(), static_cast<int>(c)) ==
                                    opened_.end());
      }
    std::erase_if(opened_, [&](int c) { return states_[static_cast<std::size_t>(c)].normal_force > 0.0; });
    record_.active = active_;
    record_.opened = opened_;
    record_.time = end_ + 0.5 * record_.step;
    end_ += record_.step;
    observer_.step(record_);
    for (auto& state : states_)
      state = {};
    in_full_ = false;
  }
  /// The next step has states in full.
  bool& in_full(std::size_t) { return in_full_; }
  /// Open steps, contact 0 having left at a speed before the first.
  void open(int steps, double leaving = 0.0) {
    for (int i = 0; i < steps; ++i) {
      if (i == 0 && leaving != 0.0)
        states_[0].departure = leaving;
      step();
    }
  }
  /// Steps with a normal force on contact 0, `approach` being the speed before the first.
  void closed(int steps, double force, double approach = 0.0) {
    for (int i = 0; i < steps; ++i) {
      states_[0].normal_force = force;
      states_[0].approach = i == 0 ? approach : 99.0; // only the first counts
      step();
    }
  }

private:
  transient::Observer& observer_;
  transient::Record record_;
  std::vector<transient::ContactState> states_;
  kernels::Array uy_, uz_, q_;
  std::vector<int> active_, opened_;
  bool in_full_ = false;
  double end_ = 0.0; ///< s: of the last step
};

} // namespace fretwork::tests
