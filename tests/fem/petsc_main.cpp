// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that need MPI and PETSc.
#include "core/mpi.hpp"
#include "core/petsc.hpp"
#include <gtest/gtest.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const fretwork::core::MpiSession mpi(argc, argv);
  const fretwork::core::PetscSession petsc(MPI_COMM_WORLD);
  return RUN_ALL_TESTS();
}
