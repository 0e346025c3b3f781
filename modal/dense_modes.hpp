// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// All modes of a small structure, by a dense solve.
///
/// With R the motions without strain (M-orthonormal) and B = M R, the pencil M - B B^T, K + s B B^T has the
/// elastic modes of K, M unchanged (R^T M x = 0), a definite second matrix, and the eigenvalue theta = 1 /
/// lambda = 0 for R and for what has no mass. Low modes are the largest theta: they keep all their digits.
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>

namespace fretwork::modal {

/// Elastic modes over the free dofs, lambda ascending, each vector with M-norm 1.
struct Pairs {
  Eigen::VectorXd lambda;  ///< rad2/s2
  Eigen::MatrixXd vectors; ///< structure.equations rows
};

/// @param rigid fem::rigid_motions of the structure
/// @throws core::ComputationError where the stiffness is singular to working precision beyond `rigid`
[[nodiscard]] Pairs dense_modes(const fem::Model& model, const fem::Structure& structure,
                                const Eigen::MatrixXd& rigid);

/// Rows of the free dofs of fields over a structure, and back (0 at restrained dofs).
[[nodiscard]] Eigen::MatrixXd free_rows(const fem::Structure& structure, const Eigen::MatrixXd& fields);
[[nodiscard]] Eigen::MatrixXd all_rows(const fem::Structure& structure, const Eigen::MatrixXd& vectors);

} // namespace fretwork::modal
