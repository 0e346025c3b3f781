// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Linear forces on modes that depend on their motion and on its past, in state-space form:
///     F = K q + C q' + G z,   z' = R z + E q',   z(0) = 0: q(0) has been held for ever
/// Such are the fluidelastic forces of a cross flow. K and C are full and not symmetric; the forces may feed energy into the modes.
#pragma once
#include <Eigen/Core>

namespace fretwork::core {

/// Of n modes of unit modal mass with r states; all empty: no such forces.
struct MotionForces {
  Eigen::MatrixXd stiffness; ///< n x n, 1/s2, K: a force, not a restoring one
  Eigen::MatrixXd damping;   ///< n x n, 1/s, C: C > 0 feeds energy in
  Eigen::MatrixXd input;     ///< n x r, 1/s2, G
  Eigen::MatrixXd rates;     ///< r x r, 1/s, R
  Eigen::MatrixXd output;    ///< r x n, E

  [[nodiscard]] bool empty() const { return stiffness.size() == 0; }
  [[nodiscard]] Eigen::Index states() const { return rates.rows(); }
};

} // namespace fretwork::core
