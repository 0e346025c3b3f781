// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A contact at a node of a step of collocation, and its friction spring over half a step.
#pragma once
#include "contact/support.hpp"
#include <array>

namespace fretwork::transient {

/// What the path of a contact inside a step adds at a node to its laws there (inner_path.hpp).
struct InnerForce {
  double y = 0.0, z = 0.0, x = 0.0; ///< N, on the node beside `normal` and `friction`, along the local axes
  contact::Vec2 stuck, relaxed;     ///< N, of T in stick, and in slip and open
  bool followed = false;            ///< the contact has such a path
  bool slides = false;              ///< at its end at the node
};

/// One contact at one node.
struct ContactNode {
  contact::ContactAxes axes;
  double penetration = 0.0;       ///< m
  double rate = 0.0;              ///< p', m/s
  double across = 0.0;            ///< velocity along t, m/s
  double curvature = 0.0;         ///< of the obstacle, 1/m
  double normal = 0.0;            ///< F_N, N
  contact::Vec2 slip;             ///< tangential velocity in the directions of friction, m/s
  contact::Vec2 friction, spring; ///< F and T, N
  contact::ContactAxes face;      ///< where the contact was closed last; none: never
  double approach = 0.0;          ///< m/s, p' of the node before where that was open
  double loaded = 0.0;            ///< |T| where the contact was closed last, N
  bool slides = false;
  InnerForce inner;
};

/// Of the laws on the node, along the local axes y, z, x, N.
[[nodiscard]] inline std::array<double, 3> force_of_laws(const ContactNode& n) {
  return {n.axes.y(n.normal, n.friction.t), n.axes.z(n.normal, n.friction.t), n.friction.x};
}

/// Coefficients of a friction spring over the half steps before the nodes 1/2 and 1.
struct SpringTable {
  static constexpr int parts = 8;                 ///< of a half step (inner_path.hpp)
  double keep = 0.0;                              ///< e^-x
  double keep_part = 0.0;                         ///< over a part
  double part_by_last = 0.0, part_by_force = 0.0; ///< of F, linear over a part, at its begin and end
  double by_slip[2][3];                           ///< -K_T h a_jl, N s/m
  double by_force[2][3];                          ///< b_jl
};
[[nodiscard]] SpringTable spring_table(const contact::FrictionLaw& law, double h);
/// Of a share of a part.
[[nodiscard]] SpringTable part_of(const SpringTable& table, double share);

/// Scales of the jumps that are filled (nodal_contact.hpp).
struct JumpScales {
  double rho[2];   ///< N/m, at the nodes 1/2 and 1; 0: not filled
  double rho_slip; ///< N s/m
};

} // namespace fretwork::transient
