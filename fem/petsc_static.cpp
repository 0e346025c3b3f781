// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/petsc_static.hpp"
#include "core/error.hpp"
#include "core/petsc.hpp"
#include "core/pivoted_columns.hpp"
#include "fem/fields.hpp"
#include "fem/rigid_motions.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::fem {
namespace {

/// A correction below this share of the solution is round-off of the displacements themselves.
constexpr double round_off = 1e-13;
/// Corrections fall by the share of digits that the factor has: one that does not halve has reached round-off.
constexpr double falling = 0.5;
/// Where the last correction is larger than this share the factor has no digits: K is singular to working precision.
constexpr double useless = 1e-3;
constexpr int most_corrections = 20;
/// Work of a force in a rigid motion below this share of the sizes of both is round-off of the stiffnesses that make the force.
constexpr double balanced = 1e-9;

/// Owns a vector.
struct Vector {
  Vec handle = nullptr;
  ~Vector() { VecDestroy(&handle); }
};

/// Of the free dofs to all of the structure's.
Eigen::MatrixXd on_nodes(const Structure& structure, const Eigen::MatrixXd& equations) {
  Eigen::MatrixXd fields =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(structure.equation.size()), equations.cols());
  for (std::size_t i = 0; i < structure.equation.size(); ++i)
    if (structure.equation[i] >= 0)
      fields.row(static_cast<Eigen::Index>(i)) = equations.row(structure.equation[i]);
  return fields;
}

/// Largest over the columns of |part|/|whole|, |u|^2 = u.D.u: no unit to choose between lengths and angles.
double largest_share(const Eigen::VectorXd& scale, const Eigen::MatrixXd& part,
                     const Eigen::MatrixXd& whole) {
  double largest = 0.0;
  for (Eigen::Index j = 0; j < whole.cols(); ++j) {
    const double size = scale.dot(whole.col(j).cwiseAbs2());
    const double share = size > 0.0 ? std::sqrt(scale.dot(part.col(j).cwiseAbs2()) / size) : 0.0;
    if (!(share <= largest)) // a NaN stays
      largest = share;
  }
  return largest;
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

bool pushes(const Eigen::VectorXd& force, const Eigen::VectorXd& motion, const Eigen::VectorXd& scale) {
  const double sizes = std::sqrt((force.array().square() / scale.array()).sum() *
                                 (motion.array().square() * scale.array()).sum());
  return std::abs(force.dot(motion)) > balanced * sizes;
}

} // namespace

Eigen::VectorXd scale_of(const Model& model, const Structure& structure) {
  const Eigen::VectorXd diagonal = stiffness_diagonal(model, structure);
  const double stiffest = diagonal.maxCoeff() > 0.0 ? diagonal.maxCoeff() : 1.0;
  return (diagonal.array() > 0.0).select(diagonal, stiffest);
}

std::vector<PetscInt> equations_to_hold(const Structure& structure, const Eigen::MatrixXd& rigid,
                                        const Eigen::VectorXd& scale) {
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(rigid.cols(), structure.equations);
  for (std::size_t i = 0; i < structure.equation.size(); ++i)
    if (const Index e = structure.equation[i]; e >= 0) {
      const auto row = static_cast<Eigen::Index>(i);
      motion.col(e) += std::sqrt(scale(row)) * rigid.row(row).transpose();
    }
  const Eigen::VectorXi farthest = core::pivoted_columns(motion).order;
  std::vector<PetscInt> out;
  for (Eigen::Index k = 0; k < rigid.cols(); ++k)
    out.push_back(static_cast<PetscInt>(farthest(k)));
  return out;
}

void hold(Mat stiffness, const std::vector<PetscInt>& equations) {
  PetscInt first = 0, end = 0;
  FW_PETSC(MatGetOwnershipRange(stiffness, &first, &end));
  std::vector<PetscInt> mine;
  for (const PetscInt e : equations)
    if (first <= e && e < end)
      mine.push_back(e);
  FW_PETSC(
      MatZeroRowsColumns(stiffness, static_cast<PetscInt>(mine.size()), mine.data(), 1.0, nullptr, nullptr));
}

StaticSolver::StaticSolver(const Model& model, const Structure& structure)
    : model_(model), structure_(structure), rigid_(rigid_motions(model, structure)),
      momentum_(mass_times(model, structure, rigid_)), scale_(scale_of(model, structure)) {
  if (structure.equations == 0)
    return;
  const SystemMatrices system = assemble(PETSC_COMM_SELF, model, structure);
  if (rigid_.cols() > 0) {
    held_ = equations_to_hold(structure, rigid_, scale_);
    hold(system.stiffness.get(), held_);
  }
  factor_ = factorise(system.stiffness.get(), elimination_of(model, structure));
}

Eigen::MatrixXd StaticSolver::solve_once(const Eigen::MatrixXd& right) const {
  Vector b, x;
  FW_PETSC(MatCreateVecs(factor_.get(), &x.handle, &b.handle));
  Eigen::MatrixXd solution(right.rows(), right.cols());
  for (Eigen::Index j = 0; j < right.cols(); ++j) {
    PetscScalar* values = nullptr;
    FW_PETSC(VecGetArray(b.handle, &values));
    Eigen::Map<Eigen::VectorXd>(values, right.rows()) = right.col(j);
    for (const PetscInt e : held_)
      values[e] = 0.0;
    FW_PETSC(VecRestoreArray(b.handle, &values));
    FW_PETSC(MatSolve(factor_.get(), b.handle, x.handle));
    const PetscScalar* result = nullptr;
    FW_PETSC(VecGetArrayRead(x.handle, &result));
    solution.col(j) = Eigen::Map<const Eigen::VectorXd>(result, right.rows());
    FW_PETSC(VecRestoreArrayRead(x.handle, &result));
  }
  return on_nodes(structure_, solution);
}

Eigen::MatrixXd StaticSolver::solve(const Eigen::MatrixXd& forces) const {
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(forces.rows(), forces.cols());
  if (structure_.equations == 0 || forces.cols() == 0)
    return u;
  const Eigen::MatrixXd balanced = forces - momentum_ * (rigid_.transpose() * forces);
  double share = std::numeric_limits<double>::infinity(), before = share;
  for (int k = 0; k < most_corrections && !(share <= round_off) && (k < 2 || share < falling * before); ++k) {
    const Eigen::MatrixXd left = balanced - stiffness_times(model_, structure_, u);
    Eigen::MatrixXd correction = solve_once(forces_on_equations(structure_, left));
    correction -= rigid_ * (momentum_.transpose() * correction);
    u += correction;
    before = share;
    share = largest_share(scale_, correction, u);
  }
  if (!(std::min(share, before) <= useless))
    throw core::ComputationError("static solution of the structure that starts at node " +
                                 place(model_.nodes[static_cast<std::size_t>(structure_.nodes.front())]) +
                                 ": the stiffness is singular to working precision; look for parts that are "
                                 "hardly held, or mesh more coarsely");
  return u;
}

Eigen::VectorXd static_solution(const Model& model, const Structure& structure,
                                const Eigen::VectorXd& force) {
  const StaticSolver solver(model, structure);
  const Eigen::VectorXd forces = part_of(structure, force);
  for (Eigen::Index j = 0; j < solver.rigid().cols(); ++j)
    if (pushes(forces, solver.rigid().col(j), solver.scale()))
      throw core::Error(fmt::format("static solution of the structure that starts at node {}: it is not "
                                    "held: the forces push one of {} "
                                    "motion(s) that strain nothing; restrain them",
                                    place(model.nodes[static_cast<std::size_t>(structure.nodes.front())]),
                                    solver.rigid().cols()));
  return over_model(model, structure, solver.solve(forces));
}

} // namespace fretwork::fem
