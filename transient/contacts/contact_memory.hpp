// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the contacts of a scheme with steps of one length remember: their friction (friction_memories.hpp) and where they stood. It changes in
/// `commit` only, once for every step that is accepted.
#pragma once
#include "transient/contacts/friction_memories.hpp"

namespace fretwork::transient {

class ContactMemory {
public:
  /// @param contacts  must live longer   @param step  s, between commits
  ContactMemory(const PackedContacts& contacts, double step);

  /// The contacts stand here; nothing is loaded.
  void start(const ContactMotion& motion) { position_ = motion.u; }

  [[nodiscard]] const FrictionMemories& friction() const { return friction_; }
  [[nodiscard]] const contact::FrictionTable& table(int c) const {
    return tables_[static_cast<std::size_t>(c)];
  }
  /// Displacements at the last commit, in lanes, m.
  [[nodiscard]] const kernels::Array& position() const { return position_; }

  /// Accepts a step: advances the memories of the closed contacts, lets those of the others die out, fills the friction and damper work
  /// and the sliding paths of the states, and the contacts that have opened. `motion` is that of the trial. No allocation.
  ContactLosses commit(const ContactMotion& motion, ContactTrial& trial);

  void visit(core::StateArchive& state) { state(friction_, position_); }

private:
  const PackedContacts& contacts_;
  std::vector<contact::FrictionTable> tables_;
  FrictionMemories friction_;
  kernels::Array position_;
};

} // namespace fretwork::transient
