// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One form for the modes of equal frequency.
///
/// An eigensolver may return any orthonormal basis of the modes that share a frequency (the two planes of a
/// tube, equal tubes), and any sign of a single mode; its last digits decide. The canonical form depends on
/// the spanned space only. Repeat for the columns j of a cluster: over all nodes X and directions d take the
/// row with the largest
///     c_d w(X) sum over the columns left of phi(X, d)^2
/// (the sum does not change under rotations of the columns; c = 1, 0.9, 0.8 for x, y, z and w(X), linear and
/// without symmetry, settle what symmetry leaves equal); turn the columns left so that this row is (r > 0, 0,
/// 0 ...); go on with the others. So the planes of a straight tube along x come out as pure y, then pure z.
/// Rotations serve where nothing translates.
#pragma once
#include "core/types.hpp"
#include <Eigen/Core>
#include <vector>

namespace fretwork::modal {

/// Relative difference of neighbours in lambda = omega^2 up to which modes are one cluster. Round-off of two
/// equal eigenvalues is 1e-13 (fine meshes: 1e-9); modes as near as this differ by one cycle in 2e7: no
/// transient tells them apart.
inline constexpr double cluster_gap = 1e-7;

/// End (one past the last) of each cluster of ascending lambda; the first `rigid` ones are a cluster.
[[nodiscard]] std::vector<Eigen::Index> cluster_ends(const Eigen::VectorXd& lambda, Eigen::Index rigid);

/// Turns the columns (one cluster; 6 rows a node) to canonical form.
/// @param nodes position of each node, m
void canonicalise(Eigen::Ref<Eigen::MatrixXd> shapes, const std::vector<core::Vec3>& nodes);

/// Turns every cluster of modes to canonical form; its modes share their mean lambda.
/// @param lambda  ascending
/// @param rigid   so many first ones are motions without strain
void canonicalise_clusters(Eigen::MatrixXd& shapes, Eigen::VectorXd& lambda, Eigen::Index rigid,
                           const std::vector<core::Vec3>& nodes);

} // namespace fretwork::modal
