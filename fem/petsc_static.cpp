// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/petsc_static.hpp"
#include "core/error.hpp"
#include "core/petsc.hpp"
#include "fem/fields.hpp"
#include "fem/petsc_assembly.hpp"
#include "fem/rigid_motions.hpp"
#include <Eigen/QR>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::fem {
namespace {

/// Work of a force in a rigid motion below this share of the sizes of both is round-off of the stiffnesses that make the force.
constexpr double balanced = 1e-9;

/// Owns a vector.
struct Vector {
  Vec handle = nullptr;
  ~Vector() { VecDestroy(&handle); }
};

Eigen::VectorXd solve(Mat matrix, Mat factor, const Eigen::VectorXd& right) {
  Vector b, x;
  FW_PETSC(MatCreateVecs(matrix, &x.handle, &b.handle));
  PetscScalar* values = nullptr;
  FW_PETSC(VecGetArray(b.handle, &values));
  Eigen::Map<Eigen::VectorXd>(values, right.size()) = right;
  FW_PETSC(VecRestoreArray(b.handle, &values));
  FW_PETSC(MatSolve(factor, b.handle, x.handle));
  const PetscScalar* result = nullptr;
  FW_PETSC(VecGetArrayRead(x.handle, &result));
  Eigen::VectorXd solution = Eigen::Map<const Eigen::VectorXd>(result, right.size());
  FW_PETSC(VecRestoreArrayRead(x.handle, &result));
  return solution;
}

Eigen::VectorXd diagonal_of(Mat matrix) {
  Vector diagonal;
  FW_PETSC(MatCreateVecs(matrix, nullptr, &diagonal.handle));
  FW_PETSC(MatGetDiagonal(matrix, diagonal.handle));
  PetscInt size = 0;
  FW_PETSC(VecGetLocalSize(diagonal.handle, &size));
  const PetscScalar* values = nullptr;
  FW_PETSC(VecGetArrayRead(diagonal.handle, &values));
  Eigen::VectorXd out = Eigen::Map<const Eigen::VectorXd>(values, size);
  FW_PETSC(VecRestoreArrayRead(diagonal.handle, &values));
  return out;
}

/// Equations to hold so that no rigid motion is left: the pivots of the QR of (D^(1/2) R)^T.
/// @param scale  D over the structure
std::vector<PetscInt> held_equations(const Structure& structure, const Eigen::MatrixXd& rigid,
                                     const Eigen::VectorXd& scale) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(rigid.cols(), structure.equations);
  for (std::size_t i = 0; i < structure.equation.size(); ++i)
    if (const Index e = structure.equation[i]; e >= 0)
      rows.col(e) = std::sqrt(scale(static_cast<Eigen::Index>(i))) *
                    rigid.row(static_cast<Eigen::Index>(i)).transpose();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows);
  const auto& order = qr.colsPermutation().indices();
  return {order.data(), order.data() + rigid.cols()};
}

/// D: the diagonal of K over the structure; dofs that nothing stiffens take the largest.
Eigen::VectorXd scale_of(const Model& model, const Structure& structure) {
  const Eigen::VectorXd diagonal = stiffness_diagonal(model, structure);
  return (diagonal.array() > 0.0).select(diagonal, diagonal.maxCoeff());
}

/// The rows of a structure of a field over the model, and back.
Eigen::VectorXd part_of(const Structure& structure, const Eigen::VectorXd& field) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(structure.equation.size()));
  for (std::size_t i = 0; i < structure.nodes.size(); ++i)
    out.segment<6>(static_cast<Eigen::Index>(6 * i)) =
        field.segment<6>(Eigen::Index{structure.nodes[i]} * dofs_per_node);
  return out;
}
Eigen::VectorXd over_model(const Model& model, const Structure& structure, const Eigen::VectorXd& part) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.nodes.size()) * dofs_per_node);
  for (std::size_t i = 0; i < structure.nodes.size(); ++i)
    out.segment<6>(Eigen::Index{structure.nodes[i]} * dofs_per_node) =
        part.segment<6>(static_cast<Eigen::Index>(6 * i));
  return out;
}

/// Values of the equations at the dofs of the structure, 0 at restrained ones.
Eigen::VectorXd at_dofs(const Structure& structure, const Eigen::VectorXd& values) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(structure.equation.size()));
  for (std::size_t i = 0; i < structure.equation.size(); ++i)
    if (structure.equation[i] >= 0)
      out(static_cast<Eigen::Index>(i)) = values(structure.equation[i]);
  return out;
}

bool pushes(const Eigen::VectorXd& force, const Eigen::VectorXd& motion, const Eigen::VectorXd& scale) {
  const double sizes = std::sqrt((force.array().square() / scale.array()).sum() *
                                 (motion.array().square() * scale.array()).sum());
  return std::abs(force.dot(motion)) > balanced * sizes;
}

} // namespace

Eigen::VectorXd static_solution(const Model& model, const Structure& structure,
                                const Eigen::VectorXd& force) {
  const std::string what = "static solution of the structure that starts at node " +
                           place(model.nodes[static_cast<std::size_t>(structure.nodes.front())]);
  if (structure.equations == 0)
    return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.nodes.size()) * dofs_per_node);
  const Eigen::MatrixXd rigid = rigid_motions(model, structure);
  const Eigen::VectorXd forces = part_of(structure, force);
  const Eigen::VectorXd scale = scale_of(model, structure);
  for (Eigen::Index j = 0; j < rigid.cols(); ++j)
    if (pushes(forces, rigid.col(j), scale))
      throw core::Error(fmt::format(
          "{}: it is not held: the forces push one of {} motion(s) that strain nothing; restrain them", what,
          rigid.cols()));

  const SystemMatrices system = assemble(PETSC_COMM_SELF, model, structure);
  const Mat stiffness = system.stiffness.get();
  const Eigen::VectorXd diagonal = diagonal_of(stiffness);
  Eigen::VectorXd right = forces_on_equations(structure, forces);
  const std::vector<PetscInt> held = held_equations(structure, rigid, scale);
  for (const PetscInt equation : held)
    right(equation) = 0.0;
  if (!held.empty())
    FW_PETSC(MatZeroRowsColumns(stiffness, static_cast<PetscInt>(held.size()), held.data(),
                                diagonal.maxCoeff(), nullptr, nullptr));
  const PetscMatrix factor = factorise(stiffness, elimination_of(model, structure));
  const Eigen::VectorXd solution = solve(stiffness, factor.get(), right);

  Eigen::VectorXd field = at_dofs(structure, solution);
  // Along a null vector the strain energy is round-off squared of its diagonal scale; the softest mesh that
  // makes sense (thousands of elements) has at least round-off to the power one.
  const double energy = twice_strain_energy(model, structure, field)[0];
  if (!solution.allFinite() ||
      energy < std::numeric_limits<double>::epsilon() * diagonal.dot(solution.cwiseAbs2()))
    throw core::ComputationError(
        what + ": the stiffness is singular to working precision; look for parts that are hardly held, "
               "or mesh more coarsely");
  if (rigid.cols() > 0)
    field -= rigid * (rigid.transpose() * mass_times(model, structure, field));
  return over_model(model, structure, field);
}

} // namespace fretwork::fem
