// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Fields over a whole model (6 values a node) or over a structure (6 values for each of structure.nodes, in
/// that order; one field a column), made element by element without a matrix, restrained dofs included.
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>
#include <span>

namespace fretwork::fem {

/// M u over all dofs, restrained ones included (base motion and gravity need their columns). Shapes 6 *
/// nodes.
[[nodiscard]] Eigen::VectorXd mass_times(const Model& model, const Eigen::VectorXd& field);

/// K u over all dofs, restrained ones included: the reactions of a displacement field.
[[nodiscard]] Eigen::VectorXd stiffness_times(const Model& model, const Eigen::VectorXd& field);

/// The same two for fields over a structure.
[[nodiscard]] Eigen::MatrixXd mass_times(const Model& model, const Structure& structure,
                                         const Eigen::MatrixXd& fields);
[[nodiscard]] Eigen::MatrixXd stiffness_times(const Model& model, const Structure& structure,
                                              const Eigen::MatrixXd& fields);

/// Forces over a structure on its equations (structure.equations rows): those on dofs that are tied add up,
/// those on restrained dofs are left out.
[[nodiscard]] Eigen::MatrixXd forces_on_equations(const Structure& structure, const Eigen::MatrixXd& forces);

/// u^T K u of each field over a structure, J, from strains and spring elongations: for smooth fields on a
/// fine mesh far more accurate than the product with K u.
[[nodiscard]] Eigen::VectorXd twice_strain_energy(const Model& model, const Structure& structure,
                                                  const Eigen::MatrixXd& fields);

/// The diagonal of K over a structure (6 values a node, restrained dofs included).
[[nodiscard]] Eigen::VectorXd stiffness_diagonal(const Model& model, const Structure& structure);

/// A rigid translation: `direction` at the three translations of every node.
[[nodiscard]] Eigen::VectorXd translation_field(const Model& model, const Vec3& direction);

/// The full force (N), or moment (N m), at each of the nodes.
[[nodiscard]] Eigen::VectorXd point_forces(const Model& model, std::span<const Index> nodes,
                                           const Vec3& value, bool moment);

/// Consistent nodal forces and moments of a uniform line force (N/m of their axes, global direction) on the
/// beams.
/// @param beams numbers in model.beams
[[nodiscard]] Eigen::VectorXd line_forces(const Model& model, std::span<const Index> beams,
                                          const Vec3& force_per_length);

} // namespace fretwork::fem
