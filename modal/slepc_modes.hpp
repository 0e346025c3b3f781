// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The lowest modes of a structure by SLEPc.
#pragma once
#include "fem/model.hpp"
#include "modal/basis.hpp"
#include <mpi.h>
#include <optional>

namespace fretwork::modal {

struct Wanted {
  std::optional<int> count;        ///< > 0: so many modes, fewer where the structure has fewer
  std::optional<double> up_to_hz;  ///< > 0: all modes up to this frequency (exactly one of the two)
};

/// Collective over `comm` (MPI_COMM_SELF: one rank solves alone). Lowest modes, mass-normalised and canonical; rigid-body modes exact
/// with omega = 0; damping zero, damping_matrix the projected dampers (empty without dampers).
/// @throws core::ComputationError where fewer modes converge than wanted
[[nodiscard]] Basis solve_modes(MPI_Comm comm, const fem::Model& model, const fem::Structure& structure,
                                const Wanted& wanted);

} // namespace fretwork::modal
