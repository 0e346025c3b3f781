// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contact forces of a step of the splitting scheme as forces on the modes (numbers of linear_flow.hpp): those held from the last step, under which the modes are predicted, and
/// those found, under which they move.
#pragma once
#include "core/state_archive.hpp"
#include "transient/contacts/row_scatter.hpp"
#include "transient/splitting/coupled_contacts.hpp"
#include "vibration/modal_flow.hpp"
#include <array>

namespace fretwork::transient {

class StepForces {
public:
  /// @param contacts  with rows over the numbers of a force; must live longer
  explicit StepForces(const PackedContacts& contacts);

  /// Takes the forces of these contacts. No allocation.   @param found  overwritten by those of the step; null: only those held are wanted
  void assemble(const CoupledContacts& coupled, const std::vector<int>& contacts,
                vibration::ModalForce* found);
  /// Whether any force is held.
  [[nodiscard]] bool any_held() const { return any_held_; }
  /// Modal force of those held, padded; only where there are any.
  [[nodiscard]] const kernels::Array& held() const { return held_; }
  void visit(core::StateArchive& state) { state(held_, any_held_); }

private:
  void add(int c, int component, double held, double mean, double slope);

  int components_;
  RowScatter rows_;
  std::array<std::vector<double>, 3> factors_; ///< N, held, mean, slope
  kernels::Array held_;
  bool any_held_ = false, any_slope_ = false;
};

} // namespace fretwork::transient
