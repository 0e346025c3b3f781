// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the contacts of the scheme that keeps the energy remember from step to step: the tangential springs and which contacts were closed.
/// It changes in `commit` only, once for every step that is accepted. A memory is kept in components along x_loc and t = n x x_loc, so it turns
/// with the normal. On the opposite face (n.n0 < 0) it is lost. The spring of an open contact dies out with C_T/K_T and is forgotten
/// when round-off is left of it.
#pragma once
#include "transient/conserving/conserving_friction.hpp"
#include "transient/contacts/contact_memory.hpp"

namespace fretwork::transient {

/// A contact with a force in a step: what its memory needs.
struct ContactPart {
  int contact;
  ClosedPart closed;
  double stiffness, damping; ///< N/m, N s/m: of its normal force at the end of the step
  double end_penetration;    ///< m, < 0: open
};

class ConservingMemory {
public:
  /// @param contacts  must live longer
  explicit ConservingMemory(const PackedContacts& contacts);

  /// What contact c remembers for a surface of normal n: nothing of the opposite face.
  [[nodiscard]] contact::FrictionMemory at(int c, double ny, double nz) const;
  /// Energy of all tangential springs, J.
  [[nodiscard]] double spring_energy() const { return springs_; }

  /// Accepts a step of h seconds: advances the memories of the contacts with a force, lets those of the others die out, fills the friction and damper
  /// work and the sliding paths of the states, and the contacts that have opened. No allocation.
  /// @param parts  of the contacts with a force   @param end  motion at the end of the step
  ContactLosses commit(double h, const std::vector<ContactPart>& parts, const ContactMotion& end,
                       ContactTrial& trial);
  void visit(core::StateArchive& state) { state(entries_, remembering_, closed_, springs_); }

private:
  struct Entry {
    contact::FrictionMemory friction;
    double ny = 0.0, nz = 0.0; ///< normal at the last step with a force
    double left = 0.0; ///< share of the spring's force left since the contact opened; 0: nothing remembered
  };
  void close(double h, const ContactPart& part, const ContactMotion& end, ContactState& state,
             ContactLosses& losses);
  void relax(double h, int c, ContactLosses& losses);
  void forget(int c, ContactLosses& losses);

  const PackedContacts& contacts_;
  std::vector<Entry> entries_;
  std::vector<int> remembering_; ///< contacts with left > 0
  std::vector<int> closed_;      ///< with a force at the last commit
  double springs_ = 0.0;
};

} // namespace fretwork::transient
