// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Supports that move by themselves, s_k(t) along d_k. The displacement in space is
///     u = sum of psi_k s_k + Phi q
/// with psi_k the static displacement of the structure when support k is moved by 1 m and all others are held. What is left for the
/// modes is driven by the inertia of that,
///     m q'' + c q' + k q = Phi^T F - sum of Phi^T M psi_k s_k'',
/// (Clough and Penzien, Dynamics of Structures, 2nd ed. 1993, section 26-2) and damped as motion from the static one: modal damping takes
/// nothing of psi s'. Dampers take it: one that psi_k stretches by e adds the forces of c e s_k' at its ends. Few modes do: the static
/// part is exact.
/// A structure that spins, slides or is a mechanism with all supports held is moved as well: a motion r that strains nothing has K r = 0 at
/// every dof, moved supports included, and is not pushed by them, r.K.psi = 0. Of psi it has no part, r.M.psi = 0: it starts at rest.
#pragma once
#include "app/build_model.hpp"
#include "signals/prescribed_motion.hpp"

namespace fretwork::app {

[[nodiscard]] signals::PrescribedMotion prescribed(const study::SupportMotion& motion);
[[nodiscard]] signals::PrescribedMotion prescribed(const study::BaseMotion& motion);

/// What a support motion does by 1 m, 6 values a node of the model.
struct MovedSupport {
  std::string name;        ///< of the entry, for messages
  Eigen::VectorXd imposed; ///< displacement of restrained dofs, 0 elsewhere
  Eigen::VectorXd ground;  ///< displacement of the ground of springs and dampers, at free dofs, 0 elsewhere
  Eigen::VectorXd force;   ///< N, of grounded springs whose ground moves, on free dofs
};
/// At each node of the group and along each axis that the direction has, the restraint moves or, where the node is free, the ground of
/// its springs and dampers.
/// @throws core::Error where a node has neither along an axis
[[nodiscard]] std::vector<MovedSupport> moved_supports(const study::Study& study, const mesh::LineMesh& mesh,
                                                       const fem::Model& model);

/// What a support motion gives to a structure, 6 values a node of the model.
struct SupportFields {
  Eigen::VectorXd shape;   ///< psi
  Eigen::VectorXd dampers; ///< N for 1 m/s of the support: forces of the dampers on what follows psi
  Eigen::VectorXd ground;  ///< displacement of the ground of springs and dampers
};
/// Of each support motion. Serial; needs PETSc.
/// @throws core::ComputationError naming the entry, where a stiffness is singular to working precision
[[nodiscard]] std::vector<SupportFields> support_fields(const std::vector<MovedSupport>& supports,
                                                        const fem::Model& model,
                                                        const std::vector<fem::Structure>& structures);

} // namespace fretwork::app
