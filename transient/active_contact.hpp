// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One contact in the sweeps of a step of collocation (nodal_solver.hpp): its forces tried at the nodes 1/2 and 1, and Newton steps of them.
#pragma once
#include "transient/inner_path.hpp"
#include "transient/nodal_tables.hpp"

namespace fretwork::transient {

/// Where a contact stands in the lanes of a run, and its nodes.
struct ContactPlace {
  ContactPlace(const PackedContacts& contacts, int contact, ContactNode* nodes);
  int contact;
  bool in_plane;
  std::size_t y, z, x;   ///< lanes
  double rest_y, rest_z; ///< m
  const contact::Support* support;
  ContactNode* node; ///< three
};
/// Kinematics at the node 0.
void meet_start(const ContactPlace& place, NodalMotion& motion);
/// Kinematics at the nodes 1/2 and 1.
void meet_ends(const ContactPlace& place, NodalMotion& motion);

/// A contact that takes part in a step. Whatever changes its forces, the motion of all has to answer.
struct ActiveContact {
  ActiveContact(const ContactPlace& of, const NodalTables& of_step) : place(&of), tables(&of_step) {}

  using Forces = double[2][3]; ///< at the nodes 1/2 and 1 along y, z, x, N
  const ContactPlace* place;
  const NodalTables* tables;
  Forces force{};           ///< tried
  Forces path_change;       ///< of what its path adds
  int branches = -1;        ///< of the laws when `inverse` was made
  double last_change = 0.0; ///< N, 0: none yet
  double inverse[36];       ///< of the Newton steps
};
/// The motion answers a change of the forces.
void add_response(const ActiveContact& active, const ActiveContact::Forces& change, NodalMotion& motion);
/// A share of a Newton step, and its answer. The matrix is kept while the laws stay in their branches and the changes fall by `falling`. Returns
/// the largest change of the forces relative to them, infinite where there is none.
[[nodiscard]] double improve(ActiveContact& active, NodalMotion& motion, double share);
/// The laws at the motion, with the forces tried.
void evaluate(const ActiveContact& active, NodalMotion& motion);
/// The laws, and what the path inside the step adds (ContactNode::inner): `path_change` is what is new of it, for which there is no answer yet.
/// Returns what is lost on the path up to the nodes 1/2 and 1.
std::array<PathLoss, 2> follow_path(ActiveContact& active, NodalMotion& motion);

/// The ratio of the changes of two sweeps foretells the next ones, and a kept matrix is good, where they fall clearly.
inline constexpr double falling = 0.3;

} // namespace fretwork::transient
