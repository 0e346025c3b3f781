// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a contact does between the nodes 0, 1/2, 1 of a step of collocation in which it closes, opens, begins or ends to slide: its force has
/// kinks there, and the quadratic through its values at the nodes misses h F' of it, which makes such a step one of order 2 with a large error.
///
/// The laws of nodal_contact.hpp are followed along the motion found, in `parts` parts of each half step: p is the cubic of each half step by
/// p and p' at its ends, the tangential velocity the quadratic through the nodes. The forces F(s), s = t/h, leave the quadratic Q(s) by
///     D_0 = int (F - Q) ds,   D_1 = int s (F - Q) ds
/// and the forces 3 (D_0 - D_1) at the node 1/2 and 12 D_1 - 6 D_0 at the node 1, whose quadratic is 0 at the node 0, add just these two
/// moments to it. The spring's force T and whether the contact slides are taken from the path too. The motion answers: the forces at the nodes are found again with these
/// (nodal_solver.hpp). Where a contact closes or opens in a part its force is taken over the share of the part
/// that it is closed for (of C_N it jumps there). Friction begins at the touch: the spring follows the node from there on, and the force over
/// that share is the mean of those at the touch and at the end of the part. Where the static coefficient is above the dynamic one the force falls
/// where the contact breaks loose: the trial over its bound is linear in a part. A node at the end of a path sticks up to the static bound only where the
/// path does.
/// Errors of trajectories through impacts fall to a fifth to a fifteenth, without friction to a fiftieth (doc/benchmarks.md).
#pragma once
#include "transient/collocation/contact_node.hpp"

namespace fretwork::transient {

/// Whether a contact, its laws known at the nodes 0, 1/2, 1, is not in one branch of them all along, or slides with a spring that falls within
/// the step. Never where friction has the memory `reference`, which steps set.
[[nodiscard]] bool changes_inside(const contact::Support& support, const SpringTable& table,
                                  const ContactNode* nodes);

/// What its path inside the step adds at a node.
struct PathForce {
  double normal = 0.0;    ///< N
  contact::Vec2 friction; ///< N
};
/// Its friction there.
struct PathEnd {
  contact::Vec2 spring, stuck; ///< N: T, and what it would be if the contact had stuck over the last part
  bool slides = false;
};
/// What is lost on it from the node 0 on.
struct PathLoss {
  double slider = 0.0, damper = 0.0; ///< J
  double forgotten = 0.0; ///< J, part of `damper`: of springs of the opposite face, which no impact lost
};
struct InnerPath {
  PathForce force[2]; ///< at the nodes 1/2 and 1
  PathEnd end[2];     ///< at them
  PathLoss loss[2];   ///< up to them
};
/// Of a contact with D directions.
/// @param nodes  the three nodes, their kinematics and laws known   @param h  s, the step
template <int D>
[[nodiscard]] InnerPath inner_path(const contact::Support& support, const SpringTable& table,
                                   const ContactNode* nodes, double h);
template <> InnerPath inner_path<2>(const contact::Support&, const SpringTable&, const ContactNode*, double);
template <> InnerPath inner_path<3>(const contact::Support&, const SpringTable&, const ContactNode*, double);

} // namespace fretwork::transient
