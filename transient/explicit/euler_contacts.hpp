// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contacts of the semi-implicit Euler scheme: forces at an instant, and the memory between steps of one length.
///     F_N = normal_force(p, p'),   F_T = evaluate(memory at the last commit, dx, v_t)
/// with dx the tangential displacement since the last commit.
#pragma once
#include "transient/contacts/friction_memories.hpp"

namespace fretwork::transient {

class EulerContacts {
public:
  /// @param contacts  must live longer   @param step  s, between commits
  EulerContacts(const PackedContacts& contacts, double step);

  /// The contacts stand here; nothing is loaded.
  void start(const ContactMotion& motion) { position_ = motion.u; }
  /// Forces of all contacts at the displacements and velocities of `motion`, at any state, as often as a scheme needs. The memory is read only.
  /// @param trial  overwritten. No allocation.
  void evaluate(ContactMotion& motion, ContactTrial& trial) const;
  /// Accepts the step of a trial, whose motion is `motion` (FrictionMemories::commit).
  ContactLosses commit(const ContactMotion& motion, ContactTrial& trial);
  [[nodiscard]] const FrictionMemories& memory() const { return memory_; }

  void visit(core::StateArchive& state) { state(memory_, position_); }

private:
  /// @param closed  share of the step: whether a contact without damper sticks is decided by a spring that follows the node from the touch on
  void add_friction(const ContactMotion& motion, int c, double closed, ContactState& state) const;

  const PackedContacts& contacts_;
  double step_; ///< s
  std::vector<contact::FrictionTable> tables_;
  FrictionMemories memory_;
  kernels::Array position_; ///< displacements at the last commit, in lanes, m
};

} // namespace fretwork::transient
