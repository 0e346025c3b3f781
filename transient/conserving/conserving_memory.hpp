// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the contacts of the scheme that keeps the energy remember from step to step (transient/contacts/friction_memories.hpp). It changes in
/// `commit` only, once for every step that is accepted.
#pragma once
#include "transient/conserving/conserving_friction.hpp"
#include "transient/contacts/friction_memories.hpp"

namespace fretwork::transient {

/// A contact with a force in a step: what its memory needs.
struct ContactPart {
  int contact;
  ClosedPart closed;
  double end_penetration; ///< m, < 0: open
};

class ConservingMemory {
public:
  /// @param contacts  must live longer
  explicit ConservingMemory(const PackedContacts& contacts) : contacts_(contacts), friction_(contacts) {}

  [[nodiscard]] const FrictionMemories& friction() const { return friction_; }

  /// Accepts a step of h seconds: advances the memories of the contacts with a force, lets those of the others die out, fills the friction and damper
  /// work and the sliding paths of the states, and the contacts that have opened. No allocation.
  /// @param parts  of the contacts with a force   @param end  motion at the end of the step
  ContactLosses commit(double h, const std::vector<ContactPart>& parts, const ContactMotion& end,
                       ContactTrial& trial);
  void visit(core::StateArchive& state) { state(friction_); }

private:
  void close(double h, const ContactPart& part, const ContactMotion& end, ContactState& state,
             ContactLosses& losses);

  const PackedContacts& contacts_;
  FrictionMemories friction_;
};

} // namespace fretwork::transient
