// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Static displacements of a structure under many loads by one factorisation of K.
///
///     held:           K u = f
///     free to move:   K u = f - M R R^T f,  R^T M u = 0    (inertia relief)
/// with R the M-orthonormal motions that strain nothing (rigid_motions.hpp): a load accelerates a free structure, and u is what it
/// strains in the frame that moves along. Both are u = G f with G symmetric, >= 0: the sum of phi phi^T / omega^2 over all elastic modes
/// (R. Craig, A. Kurdila, Fundamentals of Structural Dynamics, 2nd ed. 2006, sections 11.4 and 17.3).
/// As many equations as R has columns are held for the factorisation; nothing pulls at them, because the load is balanced. They are the
/// pivots of a QR of (D^(1/2) R)^T with D the diagonal of K, which has no unit to choose and keeps K as well conditioned as R allows.
/// Round-off of K spoils the solution on fine meshes (as the number of elements to the power 4): it is improved by the forces that its
/// strains leave (fields.hpp), until the corrections are round-off.
#pragma once
#include "fem/petsc_assembly.hpp"
#include <Eigen/Core>
#include <vector>

namespace fretwork::fem {

/// As many equations of a structure as it has rigid motions, so that K without them is as stiff as it can be: the pivots of a QR, see above.
/// @param rigid  R, columns of 6 * structure.nodes.size() rows   @param scale  D, as many rows
[[nodiscard]] std::vector<PetscInt>
equations_to_hold(const Structure& structure, const Eigen::MatrixXd& rigid, const Eigen::VectorXd& scale);
/// Makes them independent of all others. Collective over the matrix's ranks, which all give the same equations.
void hold(Mat stiffness, const std::vector<PetscInt>& equations);
/// D: the diagonal of K; what nothing stiffens moves alone and is held by the largest.
[[nodiscard]] Eigen::VectorXd scale_of(const Model& model, const Structure& structure);

class StaticSolver {
public:
  /// Serial. @param model, structure  must live longer
  /// @throws core::Error where a motion without strain moves no mass, core::ComputationError where a pivot vanishes
  StaticSolver(const Model& model, const Structure& structure);

  /// @param forces  6 * structure.nodes.size() rows, N and N m, one load a column; those on restrained dofs have no effect
  /// @return        m and rad, as many rows and columns; 0 at restrained dofs
  /// @throws core::ComputationError where K is singular to working precision
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& forces) const;
  /// R, columns of 6 * structure.nodes.size() rows.
  [[nodiscard]] const Eigen::MatrixXd& rigid() const { return rigid_; }
  /// D, as many rows; where nothing stiffens a dof the largest.
  [[nodiscard]] const Eigen::VectorXd& scale() const { return scale_; }

private:
  [[nodiscard]] Eigen::MatrixXd solve_once(const Eigen::MatrixXd& right) const;

  const Model& model_;
  const Structure& structure_;
  Eigen::MatrixXd rigid_, momentum_; ///< R and M R, a row for each dof of each node
  std::vector<PetscInt> held_;       ///< equations
  Eigen::VectorXd scale_;
  PetscMatrix factor_;
};

/// The static displacement of a structure under forces that push none of its rigid motions; a motion r is pushed where
///     |f.r| > 1e-9 (f.D^-1.f)^(1/2) (r.D.r)^(1/2).
/// @param force  6 values a model node
/// @return 6 values a model node, zero outside the structure and at restrained dofs; without part of rigid motions
/// @throws core::Error if the force pushes a rigid motion, and as StaticSolver
[[nodiscard]] Eigen::VectorXd static_solution(const Model& model, const Structure& structure,
                                              const Eigen::VectorXd& force);

} // namespace fretwork::fem
