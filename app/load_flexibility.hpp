// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the modes lack of the static deflection under the loads of a study.
///
/// Of a load with the nodal forces f the exact work is f^T G f, that of the modes f^T F_m f (modal/static_flexibility.hpp). Both are of all
/// structures that the load acts on. Across a tube few modes have nearly all of it; along it, where the lowest mode that stretches it lies
/// far up, they may lack most.
///
/// A structure that can move rigidly deflects under a load only where its contacts hold it. Its work is that with all contacts closed, as
/// springs of K_N and, with friction, K_T (pinned_model.hpp): with k_i their stiffnesses and b_i = phi^T n_i the modes along their directions,
///     exact    f^T G_c f                                    G_c of the structure on these springs
///     modes    p^T (omega^2 + sum k_i b_i b_i^T)^-1 p,      p = phi^T f
/// each without the rigid motions that no contact holds (inertia relief). A load that accelerates the structure along those and strains it
/// by less than 1e-6 of that, in the frequencies of the modes, lacks nothing: its deflection is round-off.
#pragma once
#include "app/build_contacts.hpp"
#include "app/build_fields.hpp"
#include "modal/basis.hpp"
#include <mpi.h>

namespace fretwork::app {

/// Loads that are looked at: each costs a static solution.
constexpr std::size_t most_loads = 100;

/// Share of the deflection that a load may lack before it is warned about.
constexpr double much_deflection = 0.05;

/// Collective; needs PETSc. Adds a warning of those [[loads]] and [[base_motion]] that lack more than `much_deflection`, with the largest share; none where none does,
/// and where a static solution fails.
/// @param contacts  the active ones   @param fields  of the study
void warn_of_load_flexibility(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                              const std::vector<fem::Structure>& structures,
                              const std::vector<modal::Basis>& bases,
                              const std::vector<PlacedContact>& contacts, Fields& fields);

} // namespace fretwork::app
