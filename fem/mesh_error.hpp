// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the finite length of the elements adds to the frequencies of modes, estimated from the strong form.
///
/// Bending. The shape u_h of an element does not fulfil the equation of motion inside it: it leaves the load
/// q = lambda m u_h (the fourth derivative of a cubic is zero). Let e be the answer of the element to q with
/// displacement and slope of both ends held. Nodal values converge faster than e (they are exact in statics),
/// so that
///     (lambda_h - lambda) / lambda ~ sum over elements of E / lambda,   E = integral of EI e''^2,
/// for u_h^T M u_h = 1; the ratio to the true error tends to 1 as the mesh is refined. With q = sum of q_k P_k
/// (Legendre, over the element) and l = L / 2 the moment of e is what l^2 q integrated twice leaves orthogonal
/// to linear functions:
///     E = l^5 / EI (2/5 c2^2 + 2/7 c3^2 + 2/9 c4^2 + 2/11 c5^2),
///     c2 = q0/3 - 2 q2/21, c3 = q1/15 - 2 q3/45, c4 = q2/35, c5 = q3/63.
/// A wave of number k has (k L)^4 / 720. An axial force N and rotary inertia add (N - lambda rho I) u_h'' to q. Shear
/// adds the energy of what q integrated once leaves orthogonal to a constant:
///     E += l^3 / (k G A) (2/3 f1^2 + 2/5 f2^2 + 2/7 f3^2 + 2/9 f4^2),
///     f1 = q0 - q2/5, f2 = q1/3 - q3/7, f3 = q2/5, f4 = q3/7.
/// Traction and torsion, of frequencies with inner motion (inner_motion.hpp): that is the answer to the mean of
/// q = lambda m u_h, what is left is the answer to its slope,
///     E = 2 l^3 q1^2 / (45 EA) (1 + 23 (k L)^2 / 42),   k^2 = lambda m / EA, k L at most pi/2,
/// (k L)^4 / 720 + 23 (k L)^6 / 30240 of lambda for a wave along equal elements, two terms of the series, for with two
/// elements a half wave the second is larger than the first. Displacements of nodes too have an error of order 2 where
/// the force along the axis jumps (masses, springs, corners, changes of the element length), of which this does not know:
/// the estimate was 0.4 to 2 times the true error there. Nor does it see what of two modes that are nearer to each other
/// than inner motion changes them is in the other. (For modes that the mesh does not resolve see there.)
/// Limits: an underestimate with fewer than two elements a half wave. An arc counts as a straight beam of its length in
/// the frames of its ends, a beam whose section changes as one that is everywhere as in its middle: an order of
/// magnitude. Chords in place of an arc are not seen. Source: a posteriori estimates by element residuals, Ainsworth and
/// Oden, A Posteriori Error Estimation in Finite Element Analysis, chapter 3.
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>

namespace fretwork::fem {

/// Estimated relative error of omega of each field (half that of lambda), >= 0; 0 where lambda = 0.
/// @param fields  M-orthonormal modes over the structure, one a column, @param lambda rad2/s2
[[nodiscard]] Eigen::VectorXd mesh_error(const Model& model, const Structure& structure,
                                         const Eigen::MatrixXd& fields, const Eigen::VectorXd& lambda);

} // namespace fretwork::fem
