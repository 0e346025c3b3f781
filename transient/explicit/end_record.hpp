// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The record of schemes whose records stand at the ends of their steps. It is prepared when the step has been made and published when the
/// run comes to it: by then the step that follows is made too. Forces are those at the end of the step, on the step's branch of the laws;
/// works, tangential displacement and `slides` are of the step. What a contact's slider and dampers took in the step in which it opened is
/// handed out with its next force. A scheme with a continuous extension has records inside its steps too, which stand for parts of them.
#pragma once
#include "transient/explicit/motion_rates.hpp"

namespace fretwork::transient {

class EndRecord {
public:
  explicit EndRecord(const MotionRates& rates);
  EndRecord(const EndRecord&) = delete;
  EndRecord& operator=(const EndRecord&) = delete;

  /// The state y at `time`, for which the rates have been evaluated last; regimes are those that follow. No allocation.
  void prepare(const MotionRates& rates, const double* y, double time);
  /// The same of a part of a step, `length` s about `time`: what slides has slid by its velocity at `time`.
  /// @param until  the state at the end of the part: works are those up to it
  void prepare_part(const MotionRates& rates, const double* y, double time, double length,
                    const double* until);
  /// Shows what has been prepared. No allocation.
  void publish();
  /// @param step  s, the length of time the record stands for: half of the steps on both sides
  void stand_for(double step) { record_.step = step; }
  [[nodiscard]] const Record& record() const { return record_; }
  void visit(core::StateArchive& state) { state(next_, shown_, record_.time, record_.step, past_, first_); }

private:
  struct Sheet {
    explicit Sheet(const MotionRates& rates)
        : q(static_cast<std::size_t>(rates.modes()), 0.0), u(rates.motion().u.size(), 0.0),
          trial(rates.contacts().count) {}
    double time = 0.0;
    Energy energy;
    kernels::Array q, u;
    ContactTrial trial;
    void visit(core::StateArchive& state) { state(time, energy, q, u, trial); }
  };
  struct Past {
    double friction = 0.0, damper = 0.0;                 ///< J, works up to the last record
    double carried_friction = 0.0, carried_damper = 0.0; ///< J, of the step in which the contact opened
    double entry = 0.0;                                  ///< m/s, rate of the penetration where it closed
    bool entered = false;                                ///< at the last record
  };
  void prepare_all(const MotionRates& rates, const double* y, double time, const double* until);
  void prepare_contact(const MotionRates& rates, const double* until, int c, bool was_active);

  const PackedContacts& contacts_;
  Sheet next_, shown_;
  Record record_;
  std::vector<Past> past_;
  bool first_ = true;
};

} // namespace fretwork::transient
