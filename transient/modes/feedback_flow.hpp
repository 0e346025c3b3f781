// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of all modes under forces that depend on their motion: blocks of modes and states that neither these forces nor a damping
/// matrix couple to each other move apart (feedback_block.hpp).
#pragma once
#include "transient/modes/feedback_block.hpp"
#include <vector>

namespace fretwork::transient {

class FeedbackFlow {
public:
  /// Without forces of motion there are no blocks, and no mode is coupled.
  FeedbackFlow(const System& system, double step);

  [[nodiscard]] bool empty() const { return blocks_.empty(); }
  [[nodiscard]] bool couples(Eigen::Index mode) const {
    return !blocks_.empty() && coupled_[static_cast<std::size_t>(mode)];
  }
  [[nodiscard]] Eigen::Index states() const { return states_; }

  using Works = FeedbackBlock::Works;
  /// As FeedbackBlock::advance, of all blocks. No allocation.
  Works advance(double* q, double* v, double* z, const double* load0, const double* load1, const double* mean,
                const double* slope);
  /// As FeedbackBlock::inside. No allocation.
  void inside(double t, const double* q, const double* v, const double* z, const double* f0,
              const double* slope, double* q_at, double* v_at);
  /// Adds the forces of motion where `inside` was last. No allocation.
  void add_forces(double* force) const;

private:
  Eigen::Index states_ = 0;
  std::vector<char> coupled_;
  std::vector<FeedbackBlock> blocks_;
};

} // namespace fretwork::transient
