// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// K and M of a structure as PETSc matrices over its free dofs, and its static solution.
#pragma once
#include "fem/model.hpp"
#include <petscmat.h>

namespace fretwork::fem {

/// Owns one PETSc matrix; move only. Raw handle by get().
class PetscMatrix {
public:
  PetscMatrix() = default;
  explicit PetscMatrix(Mat handle) : handle_(handle) {}
  PetscMatrix(PetscMatrix&& other) noexcept : handle_(other.handle_) { other.handle_ = nullptr; }
  PetscMatrix& operator=(PetscMatrix&& other) noexcept;
  ~PetscMatrix();
  [[nodiscard]] Mat get() const { return handle_; }

private:
  Mat handle_ = nullptr;
};

struct SystemMatrices {
  PetscMatrix stiffness, mass; ///< AIJ, symmetric, structure.equations square, of one pattern
};

/// Collective over `comm`: rows are distributed in equal blocks, each rank assembles the elements of its
/// rows.
[[nodiscard]] SystemMatrices assemble(MPI_Comm comm, const Model& model, const Structure& structure);

/// L D L^T of a symmetric matrix: PETSc's own on one rank (`chain`: nodes eliminated in their order,
/// otherwise by nested dissection), MUMPS on several. Collective.
/// @throws core::ComputationError where a pivot vanishes
[[nodiscard]] PetscMatrix factorise(Mat matrix, bool chain);

/// Static displacement of a structure under `force` (6 values a model node): K u = f on the free dofs,
/// serial.
/// @return 6 values a model node, zero outside the structure and at restrained dofs
/// @throws core::Error if the structure is not held (a motion that strains nothing), core::ComputationError
/// if K is singular to
///         working precision
[[nodiscard]] Eigen::VectorXd static_solution(const Model& model, const Structure& structure,
                                              const Eigen::VectorXd& force);

} // namespace fretwork::fem
