// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One contact in the sweeps of the steps of collocation (nodal_solver.hpp): its forces tried at the nodes 1/2 and 1, and Newton steps of them.
/// Whatever changes its forces, the motion of all contacts has to answer.
#pragma once
#include "transient/collocation/inner_path.hpp"
#include "transient/collocation/nodal_tables.hpp"

namespace fretwork::transient {

struct SweptContact {
  SweptContact(const PackedContacts& contacts, int contact);
  /// Takes part in a step, without forces.
  void join(const NodalTables& of_step);
  /// Of the step that it takes part in.
  [[nodiscard]] const SpringTable& springs() const {
    return tables->springs[static_cast<std::size_t>(contact)];
  }
  void visit(core::StateArchive& state) { state(node, branches, inverse); }

  using Forces = double[2][3]; ///< at the nodes 1/2 and 1 along y, z, x, N
  // where it stands
  int contact;
  bool in_plane;
  std::size_t y, z, x;   ///< lanes
  double rest_y, rest_z; ///< m
  const contact::Support* support;
  ContactNode node[3];
  // in the step
  bool takes_part = false;
  const NodalTables* tables = nullptr;
  Forces force;                   ///< tried
  bool has_path = false;          ///< inside the step (inner_path.hpp)
  Forces path_change;             ///< of what that adds
  std::array<PathLoss, 2> losses; ///< on it, up to the nodes 1/2 and 1
  // its Newton steps: the matrix is kept, from step to step too, while the laws stay in their branches and the changes fall
  int branches = -1;        ///< of the laws when it was made, -1: none
  double last_change = 0.0; ///< N, 0: none in this step yet
  double inverse[6 * 6]{};  ///< by columns; with two directions the first 4 x 4
};

/// Kinematics at the node 0.
void meet_start(SweptContact& contact, NodalMotion& motion);
/// Kinematics at the nodes 1/2 and 1.
void meet_ends(SweptContact& contact, NodalMotion& motion);
/// The motion answers a change of the forces.
void add_response(const SweptContact& contact, const SweptContact::Forces& change, NodalMotion& motion);
/// A share of a Newton step, and the answer. Returns the largest change of the forces relative to them, infinite where there is none.
[[nodiscard]] double improve(SweptContact& contact, NodalMotion& motion, double share);
/// The laws at the motion, with the forces tried.
void evaluate(SweptContact& contact, NodalMotion& motion);
/// The laws, and what the path inside the step adds to them (ContactNode::inner): `path_change` is what is new of it, without an answer yet.
void follow_path(SweptContact& contact, NodalMotion& motion);

/// The ratio of the changes of two sweeps foretells the next ones, and a kept matrix is good, where they fall clearly.
inline constexpr double falling = 0.3;

} // namespace fretwork::transient
