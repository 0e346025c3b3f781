// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the modes lack of the static deflection under the loads of a study.
///
/// Of a load with the nodal forces f the exact work is f^T G f, that of the modes f^T F_m f (modal/static_flexibility.hpp). Both are of all
/// structures that the load acts on; of a free structure in the frame that moves along. Across a tube few modes have nearly all of it;
/// along it, where the lowest mode that stretches it lies far up, they may lack most.
#pragma once
#include "app/build_fields.hpp"
#include "modal/basis.hpp"
#include <mpi.h>

namespace fretwork::app {

/// Loads that are looked at: each costs a static solution.
constexpr std::size_t most_loads = 100;

/// Share of the deflection that a load may lack before it is warned about.
constexpr double much_deflection = 0.05;

/// Collective; needs PETSc. Adds a warning of those [[loads]] that lack more than `much_deflection`, with the largest share; none where none does,
/// and where a static solution fails.
/// @param fields  of the study: its loads come first
void warn_of_load_flexibility(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                              const std::vector<fem::Structure>& structures,
                              const std::vector<modal::Basis>& bases, Fields& fields);

} // namespace fretwork::app
