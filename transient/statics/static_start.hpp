// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Static equilibrium of a scene under its loads at t = 0, contacts included: where a run may start.
///
///     K q = F(0) + sum over contacts of B^T n F_N(p),   p = -gap(rest + B q),   F_N(p) = K_N p for p > 0, else 0
/// Nothing moves: dampers give no force, tangential springs are unloaded, and F(0) are mean forces: random loads, whose mean is 0, are no part of it, nor is the inertia of a base or of
/// supports that accelerate at t = 0 (Load::inertial), which begins with the run. It is a minimum of the energy
///     E(q) = q.K.q/2 - F.q + sum of K_N <p>^2/2,
/// with, kappa being how the normal turns (contact::curvature: dn = kappa t (t.du), t = n x x_loc),
///     E'' = K + sum over closed contacts of B^T (K_N n n^T - kappa F_N t t^T) B.
/// Planes and round holes make E convex: every minimum has the same energy. A hole that is not convex and two round
/// bodies side by side (kappa > 0) do not: the minimum found is one that the motion downhill from q = 0 reaches, in
/// steps that are small against the obstacle; a point of equilibrium where E'' has a negative direction (two round
/// bodies on top of each other) is left, because any disturbance would.
///
/// Rigid motions (omega = 0) are held by contacts alone. One without load that meets no contact stays where it is;
/// one that the loads push and that nothing stops has no equilibrium.
///
/// Method: Newton's with E'' + lambda D, lambda as in a trust region (Levenberg and Marquardt; Nocedal and Wright,
/// Numerical Optimization, 2nd ed., sections 3.4 and 10.3), in the coordinates D^(1/2) q with D the elastic stiffness of a mode,
/// for a rigid mode what the contacts would give it. In them E'' is the unit matrix and a matrix of low rank, so
/// that stiff modes and stiff contacts cost no digits. Modes are few: dense, n^3/3 operations an iteration.
#pragma once
#include "transient/scene/scene.hpp"

namespace fretwork::transient {

enum class Balance {
  found,
  not_held,     ///< the loads push a motion that nothing stops
  not_converged ///< no equilibrium to the tolerance, after the largest number of iterations
};

struct Equilibrium {
  Balance balance = Balance::found;
  Eigen::VectorXd q;            ///< n: modal displacements, of use only where found
  Eigen::VectorXd normal_force; ///< N, >= 0, contact by contact
  int iterations = 0;
  double residual = 0.0;  ///< of the equations, relative to the forces in them, both as |.| = sqrt(f.D^-1.f)
  Eigen::VectorXd motion; ///< not_held: the modal direction of the motion, |motion| = 1; else empty
};

/// @return found: residual below 1e-12, or as small as the round-off of the penetrations allows. Deterministic.
[[nodiscard]] Equilibrium static_equilibrium(const Scene& scene);

} // namespace fretwork::transient
