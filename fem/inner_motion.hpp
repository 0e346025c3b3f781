// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Frequencies with the motion inside the beams that their nodes do not show, in traction and torsion.
///
/// Inside a beam its inertia lambda m u answers with a motion b(s) c along and about the axis, both ends held
/// (InnerMotion of flexible_beam.hpp; on a straight uniform beam the middle node of a quadratic bar). With the static answer
/// c = lambda stiffness^-1 coupling u to the load of a mode u, u^T K u = lambda u^T M u,
///     lambda' = (u^T K u + sum of c^T stiffness c) / (u^T M u + sum of [2 c^T coupling u + c^T mass c - |strain_mass u|^2]).
/// It is the Rayleigh quotient of the motion u + b c with its whole mass: the mean of consistent and lumped mass,
/// which gives good displacements of nodes, has no part in it. The error of a Rayleigh quotient is the square of
/// that of the motion, which is of order 2 with b c whatever joins the beams: lambda' is of order 4 also at lumped
/// masses, springs, corners, and changes of section and of the element length. Uniform bars between ends that are free or
/// held: (k h)^4/1440 of a frequency, from above, as in bending; elsewhere of either sign, for a displacement of nodes
/// of mode 2 may contain some of mode 1. What bends only keeps its frequency.
/// Limits: two modes nearer to each other than their corrections may each contain some of the other, and keep an error
/// of order 2. A mode that lambda' would change by more than 5 % (some four to eight elements a wave) keeps lambda: the mesh does
/// not resolve it, and its share of the static flexibility, u u^T / lambda, is exact with lambda only.
/// Source: quadratic bars, e.g. Bathe, Finite Element Procedures, section 5.3; quotients, Strang and Fix, An Analysis
/// of the Finite Element Method, chapter 6.
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>

namespace fretwork::fem {

struct InnerQuotients {
  Eigen::VectorXd lambda; ///< lambda' of each field, 0 where lambda is; lambda where it is not resolved
  Eigen::VectorXd
      refused; ///< |lambda' / lambda - 1| where it is not resolved: an estimate of its error; else 0
};

/// @param fields  modes over the structure, one a column, u^T M u = 1 @param lambda  u^T K u, rad2/s2
[[nodiscard]] InnerQuotients with_inner_motion(const Model& model, const Structure& structure,
                                               const Eigen::MatrixXd& fields, const Eigen::VectorXd& lambda);

/// tau, s2: the largest m L^2/(12 EA) or rho Ip L^2/(12 GJ) of the beams (of the ends and the middle of changing sections).
[[nodiscard]] double inner_motion_scale(const Model& model, const Structure& structure);

/// What |lambda' / lambda - 1| is at most, of lambda or of lambda' (on arcs and changing sections: to first order). With
/// x = tau lambda, the sums of c^T coupling u and of |strain_mass u|^2 are at most x: shares of the kinetic and of the
/// strain energy.
[[nodiscard]] double largest_inner_change(double scale, double lambda);
/// The same for each mode of a structure, of omega, rad/s.
[[nodiscard]] Eigen::VectorXd largest_inner_changes(const Model& model, const Structure& structure,
                                                    const Eigen::VectorXd& omega);

} // namespace fretwork::fem
