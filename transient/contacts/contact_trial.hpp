// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What one evaluation of all contacts gives. It changes nothing that lasts: a scheme may evaluate as often as it likes and hand the
/// trial of the step it accepts to FrictionMemories::commit.
#pragma once
#include "transient/contacts/row_scatter.hpp"
#include "transient/scene/scheme.hpp"

namespace fretwork::transient {

struct ContactTrial {
  explicit ContactTrial(int contacts);
  /// All contacts open. No allocation.
  void clear() {
    if (!active.empty() || !opened.empty())
      open_all();
    pieces.clear();
    springs = cut = 0.0;
  }
  void visit(core::StateArchive& state) { state(states, active, opened, pieces, springs, cut); }

  std::vector<ContactState>
      states; ///< of all contacts; friction_work and the tangential part of damper_work come with the commit
  std::vector<int> active; ///< contacts with a force, by increasing number
  std::vector<int>
      opened; ///< those that had one at the last commit and have none now: known after the commit
  std::vector<ForcePiece> pieces; ///< of the contacts in `active`, where a scheme knows them
  double springs = 0.0;           ///< J, energy of the normal springs
  double cut =
      0.0; ///< J over the step, lost by springs that a damper holds free of force: what the positive part cuts

private:
  void open_all();
};

/// J over a step, >= 0 but for errors of the order of the scheme.
struct ContactLosses {
  double damping =
      0.0; ///< normal and tangential dampers, what the positive part cuts, springs of open contacts
  double friction = 0.0; ///< Coulomb sliders
};

/// Sum over all contacts of the force on the node times a vector given in lanes (empty: 0): a power of velocities, W, a work of displacements, J.
[[nodiscard]] double product(const PackedContacts& contacts, const ContactTrial& trial,
                             const kernels::Array& lanes);

/// Lets a record show these. Arrays of `q`: padded modes; of `u`: displacements in lanes, m; null: not made. All stay in their place until the next record.
inline void show(Record& record, const PackedContacts& contacts, const double* q, const double* u,
                 const ContactTrial& trial) {
  record.q = q;
  record.contacts = contacts.count;
  record.uy = u;
  record.uz = u ? u + contacts.width : nullptr;
  record.states = trial.states;
  record.active = trial.active;
  record.opened = trial.opened;
  record.pieces = trial.pieces;
}

/// The contacts' forces as forces on the modes.
class ContactRows {
public:
  /// @param contacts  must live longer
  explicit ContactRows(const PackedContacts& contacts);
  /// target += B^T f of a trial; padded modes. No allocation.
  void add_to(const ContactTrial& trial, double* target);

private:
  const PackedContacts& contacts_;
  RowScatter rows_;
  std::vector<double> factors_; ///< N, of the rows
};

} // namespace fretwork::transient
