// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// static_modes = "all": the static modes of all directions in which contacts load the structures (modal/static_modes.hpp).
#pragma once
#include "app/build_contacts.hpp"
#include "modal/basis.hpp"
#include <mpi.h>

namespace fretwork::app {

/// Collective; needs PETSc. Adds them to the modes of every structure that contacts load, damped as the study says; structures are shared
/// out over ranks. The same bytes on every rank and for any number of ranks.
/// @throws core::ComputationError where a structure's stiffness is singular to working precision, core::Error where a motion without strain
///         moves no mass
void add_static_modes(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                      const std::vector<fem::Structure>& structures, const std::vector<PlacedContact>& placed,
                      std::vector<modal::Basis>& bases);

/// How many there are, and where.
[[nodiscard]] std::string static_modes_note(const study::Study& study,
                                            const std::vector<modal::Basis>& bases);

} // namespace fretwork::app
