// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The static displacement of a structure: K u = f on its free dofs.
///
/// Rigid motions R (rigid_motions.hpp: K R = 0, R^T M R = 1) leave u open. Forces that push none of them, R^T f = 0, are balanced: u is
/// found with as many dofs held as there are motions, whose reactions are then 0, so that it does not matter which; the part that is open
/// is taken away, R^T M u = 0. The dofs are chosen as the pivots of a QR of (D^(1/2) R)^T with D the diagonal of K, which has no unit to
/// choose and keeps the stiffness as well conditioned as its motions allow. Forces push a motion r, and have no static solution, where
///     |f.r| > 1e-9 (f.D^-1.f)^(1/2) (r.D.r)^(1/2).
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>

namespace fretwork::fem {

/// Serial; needs PETSc.
/// @param force  6 values a model node
/// @return 6 values a model node, zero outside the structure and at restrained dofs; without part of rigid motions
/// @throws core::Error if the force pushes a rigid motion,
///         core::ComputationError if K is singular to working precision
[[nodiscard]] Eigen::VectorXd static_solution(const Model& model, const Structure& structure,
                                              const Eigen::VectorXd& force);

} // namespace fretwork::fem
