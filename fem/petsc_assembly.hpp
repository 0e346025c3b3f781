// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// K, M and C of a structure as PETSc matrices over its free dofs.
#pragma once
#include "fem/model.hpp"
#include <petscmat.h>

namespace fretwork::fem {

/// Owns one PETSc object; move only. Raw handle by get().
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
  PetscMatrix stiffness, mass; ///< AIJ, symmetric, structure.equations square
  PetscMatrix damping;         ///< of the dampers; null where there are none
};

/// Collective over `comm`: rows are distributed in equal blocks, each rank assembles the elements of its rows.
[[nodiscard]] SystemMatrices assemble(MPI_Comm comm, const Model& model, const Structure& structure);

/// Static displacement of a structure under `force` (6 values a model node): K u = f on the free dofs, serial.
/// @return 6 values a model node, zero outside the structure and at restrained dofs
/// @throws core::ComputationError if the structure is not held (K is singular)
[[nodiscard]] Eigen::VectorXd static_solution(const Model& model, const Structure& structure, const Eigen::VectorXd& force);

} // namespace fretwork::fem
