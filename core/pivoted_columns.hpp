// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Householder's decomposition A P = Q R with column pivots: each column of A P is the one farthest from the span of those before it. Its
/// templates are large: they are compiled here once.
#pragma once
#include <Eigen/Core>

namespace fretwork::core {

struct PivotedColumns {
  Eigen::MatrixXd q; ///< orthogonal, as many rows as A has
  Eigen::VectorXd
      pivots; ///< diagonal of R, of falling magnitude: each the distance of a column from those before it
  Eigen::VectorXi order; ///< column k of A P is column order(k) of A
};

[[nodiscard]] PivotedColumns pivoted_columns(const Eigen::MatrixXd& a);

} // namespace fretwork::core
