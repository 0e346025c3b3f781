// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Supports that move by themselves, s_k(t) along d_k. The displacement in space is
///     u = sum of psi_k s_k + Phi q
/// with psi_k the static displacement of the structure when support k is moved by 1 m and all others are held. What is left for the
/// modes is driven by the inertia of that,
///     m q'' + c q' + k q = Phi^T F - sum of Phi^T M psi_k s_k'',
/// (Clough and Penzien, Dynamics of Structures, 2nd ed. 1993, section 26-2) and damped as motion from the static one: dampers and modal
/// damping take nothing of psi s'. Few modes do: the static part is exact.
#pragma once
#include "app/build_model.hpp"
#include "transient/prescribed_motion.hpp"

namespace fretwork::app {

[[nodiscard]] transient::PrescribedMotion prescribed(const study::SupportMotion& motion);

/// What a support motion does by 1 m, 6 values a node of the model.
struct MovedSupport {
  Eigen::VectorXd imposed; ///< displacement of restrained dofs, 0 elsewhere
  Eigen::VectorXd force;   ///< N, of grounded springs whose ground moves, on free dofs
};
/// At each node of the group and along each axis that the direction has, the restraint moves or, where the node is free, the ground of
/// its springs.
/// @throws core::Error where a node has neither along an axis
[[nodiscard]] std::vector<MovedSupport> moved_supports(const study::Study& study, const mesh::LineMesh& mesh,
                                                       const fem::Model& model);

/// psi of each support motion, 6 values a node of the model. Serial; needs PETSc.
/// @throws core::Error where a structure is not held when all supports are
[[nodiscard]] std::vector<Eigen::VectorXd> support_shapes(const std::vector<MovedSupport>& supports,
                                                          const fem::Model& model,
                                                          const std::vector<fem::Structure>& structures);

} // namespace fretwork::app
