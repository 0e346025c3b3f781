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
  std::optional<int> count;       ///< > 0: so many modes, fewer where the structure has fewer
  std::optional<double> up_to_hz; ///< > 0: all modes up to this frequency (exactly one of the two)
  bool whole_groups = false;      ///< `count` and those whose frequency is that of the last
  int dense_up_to = 200; ///< free dofs: a dense solve of all modes takes tens of milliseconds and asks no
                         ///< question
};

/// Collective over `comm` (MPI_COMM_SELF: one rank solves alone; the Basis is the same on every rank, to the
/// last bit). Lowest modes, mass-normalised and canonical; motions without strain exact with omega = 0;
/// damping zero, damping_matrix the projected dampers (empty without dampers). Small structures, and requests
/// for more than a third of all modes, are solved densely on one rank; the others by Krylov-Schur, and no
/// mode is missing: the count is checked by the inertia of K - s M. Fewer modes come back where the structure
/// has fewer. Without `whole_groups` a `count` that cuts a cluster of equal frequencies keeps the first of its
/// canonical modes.
/// @throws core::Error for a wrong request or a motion with neither stiffness nor mass;
/// core::ComputationError where modes do not converge,
///         stay missing, or are made of round-off
[[nodiscard]] Basis solve_modes(MPI_Comm comm, const fem::Model& model, const fem::Structure& structure,
                                const Wanted& wanted);

/// Collective: the Basis of rank `root` on every rank, all but its list of nodes.
void broadcast(MPI_Comm comm, int root, Basis& basis);

} // namespace fretwork::modal
