// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Static modes: what the modes lack of the static displacements under loads, added to the basis.
///
///     V = G P - Phi Omega^-2 Phi^T P        G the static solution (fem/petsc_static.hpp), P unit loads; M-orthogonal to all modes Phi
///     V^T K V = V^T P = R                   the missing flexibility (static_flexibility.hpp)
/// (R. MacNeal, Computers and Structures 1 (1971) 581; S. Rubin, AIAA Journal 13 (1975) 995: residual attachment modes.)
/// With S_ii = R_ii^-1/2 and S R S = Q Lambda Q^T the columns of X = V S Q Lambda^-1/2 have X^T K X = 1; X^T M X = Y mu Y^T gives the
/// static modes Psi = X Y mu^-1/2 with omega^2 = 1/mu: M-orthonormal, K diagonal, and, being orthogonal to Phi, above its highest mode.
/// Phi stays as it is. The basis then gives the exact static displacement of the loaded points under any load, for G P is in its span; as
/// nearly as Phi are modes: on the pinned span of bench/span to 1e-10 with 500 elements, 1e-6 with 2000.
///
/// omega^2 of Phi has the motion inside the beams (fem/inner_motion.hpp), statics have not: where Phi stretches or twists beams the static
/// displacement is off by the share that this changed.
///
/// Left out: a load of which the modes have all but `negligible_share` of the flexibility (R_ii / (G P)_ii), and combinations of loads with
/// Lambda below `dependent_share` of the largest: points that are nearly one give way nearly as one, and what is left of their difference is
/// fast and stiff.
#pragma once
#include "fem/model.hpp"
#include "modal/basis.hpp"

namespace fretwork::modal {

/// Share of the missing flexibility of all combinations of loads, each load scaled to 1, below which one is left out.
constexpr double dependent_share = 1e-6;

/// Adds the static modes of the loads to a basis without any. Damping is that of dampers only, as solve_modes leaves it: apply_damping is
/// to follow.
/// @param loads          6 * structure.nodes.size() rows, one a column
/// @param displacements  G P, as many rows and columns
/// @throws core::Error where a load moves parts without mass only, beside the modes
void add_static_modes(const fem::Model& model, const fem::Structure& structure, const Eigen::MatrixXd& loads,
                      const Eigen::MatrixXd& displacements, Basis& basis);

} // namespace fretwork::modal
