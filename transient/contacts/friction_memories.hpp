// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The tangential springs of all contacts from step to step and which contacts were closed, for schemes whose contacts act over whole steps: they
/// say what a step makes of the spring of a closed contact, all else is here. It changes where a step is accepted only.
///
/// A memory is kept in components along x_loc and t = n x x_loc, so it turns with the normal. On the opposite face it is lost: another
/// surface. The spring of an open contact dies out by contact::open_step and is forgotten when round-off is left of it.
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

class FrictionMemories {
public:
  /// @param contacts  must live longer
  explicit FrictionMemories(const PackedContacts& contacts);

  /// What contact c remembers for a surface of these axes: nothing of the opposite face.
  [[nodiscard]] contact::FrictionMemory at(int c, const contact::ContactAxes& axes) const {
    const Entry& e = entries_[static_cast<std::size_t>(c)];
    return e.axes.opposite(axes) ? contact::FrictionMemory{} : e.friction;
  }
  /// Energy of all springs, J.
  [[nodiscard]] double spring_energy() const { return springs_; }

  /// Contact c with friction is closed in this step. What it remembers; what the opposite face has loaded is lost.
  const contact::FrictionMemory& meet(int c, const contact::ContactAxes& axes, ContactLosses& losses);
  /// What it remembers after the step, in which the energy of its spring has grown by `stored`, J.
  void keep(int c, const contact::ContactAxes& axes, const contact::FrictionMemory& memory, double stored);
  /// The springs of all other contacts die out. @param table  of the law of a contact and the step
  template <class Table> void relax_open(const ContactTrial& trial, Table table, ContactLosses& losses) {
    for (const int c : remembering_)
      if (!acts(trial, c))
        relax(c, table(c), losses);
    std::erase_if(remembering_, [&](int c) { return !(entries_[static_cast<std::size_t>(c)].left > 0.0); });
  }
  /// Whether contact c had a force at the last step.
  [[nodiscard]] bool was_closed(int c) const;
  /// Ends a step: the contacts that have opened are handed to the trial with the speed at which they leave. `end`: motion at its end.
  void end(const ContactMotion& end, ContactTrial& trial);
  void visit(core::StateArchive& state) { state(entries_, remembering_, closed_, springs_); }

private:
  struct Entry {
    contact::FrictionMemory friction;
    contact::ContactAxes axes; ///< at the last step with a force; none: nothing remembered
    double left = 0.0; ///< share of the spring's force left since the contact opened; 0: nothing remembered
  };
  [[nodiscard]] static bool acts(const ContactTrial& trial, int c) {
    return trial.states[static_cast<std::size_t>(c)].normal_force > 0.0;
  }
  void relax(int c, const contact::FrictionTable& table, ContactLosses& losses);
  void forget(int c, ContactLosses& losses);

  const PackedContacts& contacts_;
  std::vector<Entry> entries_;
  std::vector<int> remembering_; ///< contacts with left > 0
  std::vector<int> closed_;      ///< with a force at the last step, by increasing number
  double springs_ = 0.0;
};

} // namespace fretwork::transient
