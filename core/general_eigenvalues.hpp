// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Eigenvalues of a dense matrix without symmetry, compiled once (core/symmetric.hpp).
#pragma once
#include <Eigen/Core>

namespace fretwork::core {

/// In no order, with multiplicity. @throws core::ComputationError where the iterations fail
[[nodiscard]] Eigen::VectorXcd general_eigenvalues(const Eigen::MatrixXd& a);

} // namespace fretwork::core
