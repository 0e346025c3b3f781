// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The modes of one connected structure, plain data: what the transient starts from.
/// Static modes (static_modes.hpp) come last: M-orthonormal and diagonal in K like the others, and above them, but no solutions of
/// K x = lambda M x.
#pragma once
#include "core/types.hpp"
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace fretwork::modal {

/// Mode shapes are M-orthonormal (modal mass 1 in kg, kg m2 ...) and in canonical form (see canonical.hpp),
/// so that neither the number of ranks nor the numbering of nodes shows in them.
struct Basis {
  std::vector<core::Index> nodes; ///< model nodes of the structure, ascending
  Eigen::MatrixXd shapes; ///< (6 * nodes.size()) x n: ux uy uz rx ry rz of each node; 0 at restrained dofs
  Eigen::VectorXd
      omega; ///< n, rad/s, ascending; 0 exactly for rigid-body modes. omega^2 is x^T K x with the motion
             ///< inside the beams (fem/inner_motion.hpp), which shapes do not have
  Eigen::Index static_modes = 0; ///< the last so many are static modes
  Eigen::VectorXd error; ///< n: estimate of what the mesh adds to omega, relative (fem/mesh_error.hpp); 0 of
                         ///< static modes
  Eigen::VectorXd damping;        ///< n, ratio to critical (for a rigid mode: of no effect)
  Eigen::MatrixXd damping_matrix; ///< n x n, 1/s: Phi^T C Phi, all damping included; empty where it is the
                                  ///< diagonal 2 zeta omega
  Eigen::VectorXd
      residuals; ///< n, |K x - lambda M x| / |K x|, lambda = x^T K x (rigid: |K x| over the largest term of the product)
  Eigen::MatrixXd participation; ///< n x 3, sqrt(kg): Phi^T M times a unit translation along x, y, z of all
                                 ///< nodes; its squares are the effective modal masses
  core::Vec3 moving_mass = core::Vec3::Zero(); ///< kg, by direction: what the effective masses of all modes
                                               ///< add up to, but for the share of restrained dofs
  double orthogonality = 0.0;                  ///< max |Phi^T M Phi - I|
  bool splits_group = false; ///< the last mode has others of the same frequency that were not kept
  bool complete = false;     ///< the structure has no more modes
  bool distributed = false;  ///< solved over all ranks

  [[nodiscard]] Eigen::Index size() const { return omega.size(); }
  [[nodiscard]] Eigen::Index true_modes() const { return size() - static_modes; }
  /// Row of `node` in `shapes` (6 rows from there), or -1 where the structure does not have it.
  [[nodiscard]] Eigen::Index row_of(core::Index node) const;
};

/// Number of the structure that has `node`, among `bases`; nothing: none has it, such as a negative number that stands for no node.
[[nodiscard]] std::optional<std::size_t> structure_of(const std::vector<Basis>& bases, core::Index node);

} // namespace fretwork::modal
