// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Short forms for tests of modes.
#pragma once
#include "modal/slepc_modes.hpp"

namespace fretwork::tests {

inline modal::Basis solve(const fem::Model& model, int count, MPI_Comm comm = MPI_COMM_SELF) {
  return modal::solve_modes(comm, model, fem::structures(model).at(0), {count, std::nullopt});
}

inline modal::Basis solve_up_to(const fem::Model& model, double hertz, MPI_Comm comm = MPI_COMM_SELF) {
  return modal::solve_modes(comm, model, fem::structures(model).at(0), {std::nullopt, hertz});
}

} // namespace fretwork::tests
