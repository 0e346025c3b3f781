// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a truncated basis lacks of the static flexibility between points that are loaded.
///
///     exact    F = P^T G P                            G the static solution (fem/petsc_static.hpp), P unit loads, one a column
///     basis    F_m = sum over elastic modes of (P^T phi)(P^T phi)^T / omega^2
///     missing  R = F - F_m                            the share of the modes left out: symmetric, >= 0
/// (R. MacNeal, A hybrid method of component mode synthesis, Computers and Structures 1 (1971) 581; S. Rubin, AIAA Journal 13 (1975) 995).
/// omega^2 has the motion inside the beams (fem/inner_motion.hpp), statics have not: where modes stretch or twist beams, F_m may be above F by
/// as much as that changes omega^2. R is what F_m lacks all the same, so that both together are F, but for what is negative, which is cut.
/// Round-off of F and of the modes makes eigenvalues of R that are small and of either sign. They are judged direction by direction,
/// as those of S R S with S_ii = F_ii^-1/2, which have no unit: what is below `negligible_share` is cut to 0.
#pragma once
#include "modal/basis.hpp"

namespace fretwork::modal {

/// Share of a direction's static flexibility that is round-off: static solutions are good to 1e-12, shapes of modes to about 1e-9.
constexpr double negligible_share = 1e-8;

/// F_m, m/N.
/// @param loads  6 * basis.nodes.size() rows, one load a column
[[nodiscard]] Eigen::MatrixXd flexibility_of(const Basis& basis, const Eigen::MatrixXd& loads);

/// P^T q for unit modal coordinates divided by omega^2, k x n: how the loaded points move under unit modal forces; 0 for rigid modes.
[[nodiscard]] Eigen::MatrixXd static_gain(const Basis& basis, const Eigen::MatrixXd& loads);

/// By how much F_m may be above what it would be with u^T K u in place of omega^2, which is never above F.
/// @param change  n, shares of omega^2: fem::largest_inner_change of each mode
[[nodiscard]] Eigen::MatrixXd inner_flexibility(const Basis& basis, const Eigen::MatrixXd& loads,
                                                const Eigen::VectorXd& change);

/// R, m/N, symmetric, no eigenvalue negative.
/// @param inner  inner_flexibility, or zeros
/// @throws core::ComputationError where R + inner has an eigenvalue below -1e-4 of F: modes and static solution are not of one structure,
///         or spoilt by round-off
[[nodiscard]] Eigen::MatrixXd missing_flexibility(const Eigen::MatrixXd& exact, const Eigen::MatrixXd& basis,
                                                  const Eigen::MatrixXd& inner);

} // namespace fretwork::modal
