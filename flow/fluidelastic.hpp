// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The fluidelastic forces of a law (fluidelastic_law.hpp) on the modes of a tube. With N(s) the shapes along drag and lift, unit modal masses:
///     K_x = int q N^T K N ds,  C_x = int q (D/V) N^T C N ds,  G_i z_i = int q N^T Re(B_i z_i(s)) ds,  z_i' = -d_i (V/D) z_i + N a'
/// V is the part of the gap velocity across the tube, e_D in a bend in its plane where the flow is (independence principle).
///
/// States: stations of equal V/D share theirs. There z_i(s) = N(s) y_i with y_i' = -d_i (V/D) y_i + a', of which only the directions count
/// that N and B_i see: the eigenvectors of int |B_i N|^2 ds above 1e-12 of the largest. A velocity that is constant over a zone thus costs at most
/// one state a mode and lag, one that changes costs up to two a station and lag.
/// Source: S. Price, M. Paidoussis, J. Sound and Vibration 97 (1984) 615 for one tube; distribution: virtual work.
#pragma once
#include "core/motion_forces.hpp"
#include "flow/fluidelastic_law.hpp"
#include "flow/sampling.hpp"

namespace fretwork::flow {

/// @param sampling  with modal masses of 1   @param modes  n >= sampling.modes(): the modes that follow (static ones) feel nothing
/// @param factor  > 0, times all velocities
/// @throws core::Error where a zone with velocity has no direction of drag
[[nodiscard]] core::MotionForces motion_forces(const Sampling& sampling, const FluidelasticLaw& law,
                                               Eigen::Index modes, double factor = 1.0);

/// A of x' = A x, x = (a, a', z), of modes with stiffness k (1/s2) and damping c (1/s) under such forces.
[[nodiscard]] Eigen::MatrixXd state_matrix(const Eigen::VectorXd& k, const Eigen::VectorXd& c,
                                           const core::MotionForces& forces);

} // namespace fretwork::flow
