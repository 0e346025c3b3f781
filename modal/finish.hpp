// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// From eigenvectors to a Basis: frequencies from strain energies, canonical clusters, orthonormality,
/// residuals, error of the mesh, participation, dampers.
#pragma once
#include "fem/model.hpp"
#include "modal/basis.hpp"
#include "modal/dense_modes.hpp"
#include <limits>

namespace fretwork::modal {

/// What to keep of the modes, canonical form made before the cut.
struct Cut {
  Eigen::Index count = std::numeric_limits<Eigen::Index>::max();
  double omega = std::numeric_limits<double>::infinity(); ///< rad/s
  bool whole_groups = false; ///< keeps also those whose frequency is that of the last
};

/// lambda of a mode is its Rayleigh quotient with the strain energy (not K u): on a fine mesh this regains
/// the digits that the round-off of K takes from the eigensolver. Modes of a cluster share their mean lambda and get
/// their canonical form. Then omega^2 is that with the motion inside the beams (fem/inner_motion.hpp), by which modes
/// are put in order and cut; those that are equal in it share its mean.
/// `complete`: all that are given are kept.
/// @param rigid M-orthonormal motions without strain, @param pairs elastic modes, clusters complete
/// @throws core::ComputationError where round-off makes the solver's lambda differ from the Rayleigh quotient
/// by per cents
[[nodiscard]] Basis finish(const fem::Model& model, const fem::Structure& structure,
                           const Eigen::MatrixXd& rigid, const Pairs& pairs, const Cut& cut);

/// Sets all that follows from shapes and omega: residuals, error of the mesh, participation, moving mass, orthogonality, damping 0,
/// dampers.
/// @param basis  nodes, shapes and omega set
/// @param lambda x^T K x of the shapes, which residuals are made with
void describe(const fem::Model& model, const fem::Structure& structure, const Eigen::VectorXd& lambda,
              Basis& basis);

/// Phi^T C Phi of the dampers, 1/s; empty where there are none.
[[nodiscard]] Eigen::MatrixXd projected_dampers(const fem::Model& model, const fem::Structure& structure,
                                                const Basis& basis);

} // namespace fretwork::modal
