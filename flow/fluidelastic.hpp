// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The fluidelastic forces of a law (fluidelastic_law.hpp) on the modes of a tube. With N(s) the shapes along drag and lift, unit modal masses:
///     K_x = int q N^T K N ds,  C_x = int q (D/V) N^T C N ds,  G_i z_i = int q N^T Re(B_i z_i(s)) ds,  z_i' = -d_i (V/D) z_i + N a'
/// V is the part of the gap velocity across the tube, e_D in a bend in its plane where the flow is (independence principle).
///
/// States: y_i' = -d_i r y_i + V^T a' with r = V/D of a few nodes r_l, of which only the directions V count that the force of the node sees: the right
/// singular vectors of int l_l q N^T B_i N ds above 1e-9 of the largest singular value. Where V/D has few values these are the nodes. Else the lag,
/// as a function of x = ln r analytic for |Im x| < pi/2 in every harmonic motion, is interpolated between Chebyshev points in x, l_l(x) being
/// Lagrange's polynomials: so many points that (y + (1 + y^2)^(1/2))^-L < 1e-5, y = pi/(x_max - x_min) (Bernstein's ellipse through the pole).
/// Below a twentieth of the largest V/D, where q is 1/400 of the largest at most, x is that of the twentieth. Thus a constant velocity costs at most one state
/// a mode and lag, a changing one up to 13.
/// Of several tubes N(s) is of all of them, at the same share of their lengths; q, V and D are those of the tube that the force is on. Lags are of
/// each structure's motion, so that tubes which a law does not couple keep states of their own.
/// Source: S. Price, M. Paidoussis, J. Sound and Vibration 97 (1984) 615 for one tube; distribution: virtual work; interpolation: L. Trefethen,
/// Approximation Theory and Approximation Practice (2013), chapter 8.
#pragma once
#include "core/motion_forces.hpp"
#include "flow/fluidelastic_law.hpp"
#include "flow/sampling.hpp"
#include <functional>

namespace fretwork::flow {

/// A tube of a law.
struct TubeOfLaw {
  Sampling sampling; ///< with modal masses of 1; the k-th stations of all tubes are beside each other
  Eigen::Index first =
      0; ///< mode of its structure among those of all; tubes of one structure have the same modes
};

/// Of a law that is not frozen.
/// @param tubes  as many as the law has   @param modes  of all structures: those of which no tube has shapes (static ones) feel nothing
/// @param largest_factor  > 0, by which they may be `scaled`: modes whose reduced velocity V/(f D) stays below 0.3 up to it are not coupled; they feel
///     what the law is at their own frequency, K + sum B i kr/(i kr + d) and C, kr = 2 pi f D/V
/// @throws core::Error where a zone with velocity has no direction of drag
[[nodiscard]] core::MotionForces motion_forces(const std::vector<TubeOfLaw>& tubes,
                                               const FluidelasticLaw& law, Eigen::Index modes,
                                               double largest_factor);

/// The same at `factor` > 0 times all velocities: q goes with its square, the rates of the lags with itself.
[[nodiscard]] core::MotionForces scaled(core::MotionForces forces, double factor);

/// Forces at a factor >= 0 of all velocities.
using ForcesOverFactor = std::function<core::MotionForces(double)>;

/// Of any law: `scaled` ones with lags, those frozen at frequencies (frozen_forces.hpp) at each factor anew, up to `largest_factor`.
/// @throws core::Error as motion_forces; the function what frozen_forces throws
[[nodiscard]] ForcesOverFactor forces_over_factor(const std::vector<TubeOfLaw>& tubes,
                                                  const FluidelasticLaw& law, Eigen::Index modes,
                                                  double largest_factor);

/// A of x' = A x, x = (a, a', z), of modes with stiffness k (1/s2) and damping c (1/s) under such forces.
[[nodiscard]] Eigen::MatrixXd state_matrix(const Eigen::VectorXd& k, const Eigen::VectorXd& c,
                                           const core::MotionForces& forces);

} // namespace fretwork::flow
