// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contact forces of a step at its nodes 1/2 and 1, all contacts together, implicit: with f_0 known,
///     u_j = u_j^free + sum_k Wq_jk f_k,   v_j = v_j^free + sum_k Wv_jk f_k,   f_j = laws(u_j, v_j, springs),   j, k = 1/2, 1
/// W: nodal_tables.hpp. Only contacts take part that were closed at the node 0 or penetrate at another one, in the motion without
/// new forces or in that of the forces found (tested again until none is left out). Block Gauss-Seidel: one Newton step of one contact
/// at a time, all lanes answer (swept_contact.hpp). Changes that do not settle within some sweeps are halved (an iteration that goes to
/// and fro between two branches); what does not settle then is a failure, and the caller takes a smaller step. Contacts that change
/// their branch inside the step have their paths there followed (inner_path.hpp), twice: first along the motion without what these add,
/// then along the one with it.
#pragma once
#include "transient/collocation/swept_contact.hpp"

namespace fretwork::transient {

class NodalSolver {
public:
  /// @param contacts  must live longer
  explicit NodalSolver(const PackedContacts& contacts);
  NodalSolver(const NodalSolver&) = delete;
  NodalSolver& operator=(const NodalSolver&) = delete;

  /// Sets the nodes at the start of a run: nothing is loaded. `motion.start` is known.
  void start(NodalMotion& motion);
  /// Nodes 1/2 and 1 from node 0, and `motion.ends` with their forces. Returns whether the equations were solved; node 0 is left as it
  /// was in any case. No allocation.
  [[nodiscard]] bool solve(const NodalTables& tables, NodalMotion& motion);
  /// Node 1 becomes node 0.
  void accept();

  /// The three nodes of a contact.
  [[nodiscard]] const ContactNode* nodes(int contact) const { return swept_[contact].node; }
  /// Contacts with a force at one of the nodes of the step or with a loaded spring.
  [[nodiscard]] const std::vector<int>& alive() const { return alive_; }
  /// Losses of a contact that has an inner path, else null.
  [[nodiscard]] const PathLoss* inner_losses(int contact) const {
    const SweptContact& swept = swept_[contact];
    return swept.takes_part && swept.has_path ? swept.losses.data() : nullptr;
  }
  /// target += B^T f at a node of the step: of the laws, and of what inner paths add.
  void add_forces(int node, double* target) { add_forces(node, true, target); }
  /// Some contact has an inner path: the quadratic of the step then does not end in the forces of the laws.
  [[nodiscard]] bool has_inner_paths() const { return inner_paths_; }
  /// target += B^T f of the laws alone.
  void add_law_forces(int node, double* target) { add_forces(node, false, target); }
  /// Power of the forces of a node on velocities in lanes (empty: 0), W.
  [[nodiscard]] double power(int node, const kernels::Array& velocity) const;
  /// Energy of all springs at a node, J.
  [[nodiscard]] double spring_energy(int node) const;
  void visit(core::StateArchive& state) {
    for (SweptContact& swept : swept_)
      state(swept);
    state(alive_, inner_paths_);
  }

private:
  /// The largest changes of the last two sweeps, relative to the forces.
  struct Changes {
    bool known = false;
    double largest = 0.0, last = 0.0; ///< last: 0 at the first sweep
    [[nodiscard]] bool within(double tolerance) const;
  };
  bool admit(const NodalTables& tables, NodalMotion& motion);
  [[nodiscard]] bool settle_all(const NodalTables& tables, NodalMotion& motion, double tolerance);
  bool follow_paths(NodalMotion& motion);
  [[nodiscard]] bool settle(NodalMotion& motion, double tolerance);
  void add_forces(int node, bool inner, double* target);
  void finish(const NodalTables& tables, NodalMotion& motion);
  void leave(SweptContact& contact, const NodalTables& tables);

  const PackedContacts& contacts_;
  std::vector<SweptContact> swept_;   ///< all contacts
  std::vector<SweptContact*> active_; ///< those that take part in the step
  std::vector<int> alive_;
  std::vector<const double*> row_;
  std::vector<double> factor_;
  bool inner_paths_ = false;
  Changes changes_;
};

} // namespace fretwork::transient
