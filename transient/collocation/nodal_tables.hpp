// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How the contacts move at the nodes 0, 1/2, 1 of a step, and how they answer forces at the nodes 1/2 and 1:
///     W = B diag(response of each mode) B^T
/// for displacements and velocities, made once for a step.
#pragma once
#include "transient/collocation/nodal_contact.hpp"
#include "transient/contacts/packed_contacts.hpp"
#include "vibration/polynomial_flow.hpp"

namespace fretwork::transient {

/// Displacements and velocities of all contacts at the nodes, lanes of PackedContacts.
struct NodalMotion {
  explicit NodalMotion(const PackedContacts& contacts);
  // Without contacts these are empty and have no element to point at.
  [[nodiscard]] double* u(int node) { return node == 0 ? start.data() : ends.data() + (node - 1) * stride; }
  [[nodiscard]] double* v(int node) {
    return node == 0 ? start.data() + stride : ends.data() + (node + 1) * stride;
  }
  void visit(core::StateArchive& state) { state(start, ends); }
  std::size_t stride;
  kernels::Array start; ///< u, v at node 0
  kernels::Array ends;  ///< u at 1/2, u at 1, v at 1/2, v at 1
};

/// What contacts need of a step of length h, made once.
class NodalTables {
public:
  NodalTables(const PackedContacts& contacts, const vibration::PolynomialFlow& flow, double h);
  /// What unit forces of a contact at `node` along y, z, x do to NodalMotion::ends, 3 columns one after the other.
  [[nodiscard]] const double* columns(int contact, int node) const {
    return &columns_[static_cast<std::size_t>(2 * contact + node - 1) * 3 * length];
  }
  /// What its own forces at the nodes 1/2 and 1 do to a contact, in the directions of these nodes.
  template <int D> [[nodiscard]] Answer<D> answer(int contact, const ContactNode* nodes) const;
  double step;        ///< s
  std::size_t length; ///< of a column
  std::vector<SpringTable> springs;
  std::vector<JumpScales> scales;

private:
  std::size_t width_, stride_; ///< of PackedContacts
  kernels::Array columns_;
};

} // namespace fretwork::transient
