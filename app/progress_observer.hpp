// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far the runs of a rank are.
#pragma once
#include "transient/run.hpp"
#include <functional>

namespace fretwork::app {

/// Called now and then with the share of all steps of this rank that are done and the simulated time.
using ProgressCallback = std::function<void(double share, double time)>;

/// Tells the callback now and then how far a run is.
class ProgressObserver final : public transient::ContactObserver {
public:
  /// @param before    share of all steps of this rank that are done before this run   @param share  of the run itself
  /// @param duration  s, of the run
  ProgressObserver(const ProgressCallback& callback, double before, double share, double duration)
      : callback_(callback), before_(before), share_(share), duration_(duration) {}
  void step(const transient::Record& record) override {
    if (++count_ % look_every == 0)
      callback_(before_ + share_ * record.time / duration_, record.time);
  }
  void visit(core::StateArchive&) override {} // it keeps nothing

private:
  static constexpr int look_every = 4096; ///< steps: the clock costs more than a step
  const ProgressCallback& callback_;
  double before_, share_, duration_;
  int count_ = 0;
};

} // namespace fretwork::app
