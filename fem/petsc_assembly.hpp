// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// K and M of a structure as PETSc matrices over its free dofs, and their factors.
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
  PetscMatrix stiffness,
      mass; ///< AIJ, symmetric, structure.equations square, of one pattern: that of both, diagonal
            ///< included
};

/// Collective over `comm`: rows are distributed in equal blocks, each rank assembles the elements of its
/// rows.
[[nodiscard]] SystemMatrices assemble(MPI_Comm comm, const Model& model, const Structure& structure);

/// How a structure's matrices are factorised on one rank: each the fastest for its kind.
enum class Elimination {
  chain,  ///< PETSc's own factor, nodes in their order: what fills least
  tree,   ///< the same by nested dissection: branches, few loops
  network ///< MUMPS, whose dense fronts pay where there are thousands of loops (a factor at 1e5 dofs 0.5
          ///< instead of 7 s); on chains its solves would take ten times as long
};
[[nodiscard]] Elimination elimination_of(const Model& model, const Structure& structure);

/// PETSc's names of the package and of the ordering; on several ranks always MUMPS.
struct Factoriser {
  MatSolverType package;
  MatOrderingType ordering;
};
[[nodiscard]] Factoriser factoriser(MPI_Comm comm, Elimination elimination);

/// L D L^T of a symmetric matrix. Collective.
/// @throws core::ComputationError where a pivot vanishes
[[nodiscard]] PetscMatrix factorise(Mat matrix, Elimination elimination);

} // namespace fretwork::fem
