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
  /// @param contacts  with rows over the numbers of a force; must live longer   @param bends  whether modes are fast enough for them
  StepForces(const PackedContacts& contacts, bool bends);

  /// Takes the forces of these contacts. No allocation.   @param found  overwritten by those of the step without their bends; null: only those held are wanted
  void assemble(const CoupledContacts& coupled, const std::vector<int>& contacts,
                vibration::ModalForce* found);
  /// Whether any force found bends within the step; modal forces of the bends (StepForce), only where there are any.
  [[nodiscard]] bool any_bend() const { return any_bend_; }
  [[nodiscard]] const std::array<kernels::Array, 2>& bends() const { return bends_; }
  /// Whether any force is held.
  [[nodiscard]] bool any_held() const { return any_held_; }
  /// Modal force of those held, padded; only where there are any.
  [[nodiscard]] const kernels::Array& held() const { return held_; }
  void visit(core::StateArchive& state) { state(held_, any_held_); }

private:
  using Factors = std::array<double, 5>; ///< N, of held, mean, slope, bends
  void add(int c, int component, const Factors& of);

  int components_;
  bool takes_bends_;
  RowScatter rows_;
  std::array<std::vector<double>, 5> factors_;
  kernels::Array held_;
  std::array<kernels::Array, 2> bends_;
  bool any_held_ = false, any_slope_ = false, any_bend_ = false;
};

} // namespace fretwork::transient
