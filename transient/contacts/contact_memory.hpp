// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the contacts of a scene remember from step to step: the tangential springs, where the contacts stood and which were closed. It
/// changes in `commit` only, once for every step that is accepted.
///
/// A memory is kept in components along x_loc and t = n x x_loc, so it turns with the normal. A normal on the other side of the last
/// one (n.n0 < 0: the opposite face) is another surface: what the last face has loaded is lost. The spring of an open contact dies out
/// by contact::open_step and is forgotten when round-off is left of it.
#pragma once
#include "transient/contacts/contact_motion.hpp"
#include "transient/contacts/contact_trial.hpp"

namespace fretwork::transient {

/// J over a step, >= 0 but for errors of the order of the scheme.
struct ContactLosses {
  double damping =
      0.0; ///< normal and tangential dampers, what the positive part cuts, springs of open contacts
  double friction = 0.0; ///< Coulomb sliders
};

class ContactMemory {
public:
  /// @param contacts  must live longer   @param step  s, between commits
  ContactMemory(const PackedContacts& contacts, double step);

  /// Another time between commits, s. No allocation.
  void set_step(double step);
  /// The contacts stand here; nothing is loaded.
  void start(const ContactMotion& motion) { position_ = motion.u; }

  /// What contact c remembers for a surface of normal n: nothing of the opposite face.
  [[nodiscard]] contact::FrictionMemory at(int c, double ny, double nz) const {
    const Entry& e = entries_[c];
    return opposite(e, ny, nz) ? contact::FrictionMemory{} : e.friction;
  }
  /// Friction at the last commit if contact c was closed then on the same surface, otherwise 0, N.
  [[nodiscard]] contact::Vec2 last_force(int c, double ny, double nz) const {
    const Entry& e = entries_[c];
    return e.left == 1.0 && !opposite(e, ny, nz) ? e.force : contact::Vec2{};
  }
  [[nodiscard]] const contact::FrictionTable& table(int c) const { return entries_[c].table; }
  /// With a force at the last commit, by increasing number.
  [[nodiscard]] const std::vector<int>& closed() const { return closed_; }
  /// Displacements at the last commit, in lanes, m.
  [[nodiscard]] const kernels::Array& position() const { return position_; }
  /// Energy of all tangential springs, J.
  [[nodiscard]] double spring_energy() const { return springs_; }

  /// Accepts a step: advances the memories of the closed contacts, lets those of the others die out, fills the friction and damper work
  /// and the sliding paths of the states, and the contacts that have opened. `motion` is that of the trial. No allocation.
  ContactLosses commit(const ContactMotion& motion, ContactTrial& trial);

  void visit(core::StateArchive& state) { state(entries_, remembering_, closed_, position_, springs_); }

private:
  struct Entry {
    contact::FrictionMemory friction;
    contact::Vec2 force;       ///< N, of the commit that left this
    double ny = 0.0, nz = 0.0; ///< normal then
    double left = 0.0; ///< share of the spring's force left since the contact opened; 0: nothing remembered
    contact::FrictionTable table{};
  };
  [[nodiscard]] static bool opposite(const Entry& e, double ny, double nz) {
    return e.left > 0.0 && e.ny * ny + e.nz * nz < 0.0;
  }
  void commit_each(ContactTrial& trial, ContactLosses& losses);
  void close(int c, ContactState& state, ContactLosses& losses);
  void relax(int c, ContactLosses& losses);
  void forget(int c, ContactLosses& losses);

  const PackedContacts& contacts_;
  std::vector<Entry> entries_;
  std::vector<int> remembering_; ///< contacts with left > 0
  std::vector<int> closed_;      ///< with a force at the last commit
  kernels::Array position_;
  double springs_ = 0.0;
};

} // namespace fretwork::transient
