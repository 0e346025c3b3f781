// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the weight along beams would add to their stiffness, which the modes leave out.
///
/// The weight of a beam that hangs or stands makes an axial force N, which stiffens or softens bending by N |u_t'|^2. Only `axial_force`
/// of [[beams]] does so in the modes. N follows from the static displacement under the weight, contacts left out. The modes looked at are those
/// on closed contacts, as springs of K_N and, with friction, K_T (pinned_model.hpp); with d_e the difference of mode i across beam e, from end
/// to end, less its part along the beam, and l_e its length
///     change of omega_i^2 = sum over beams N_e |d_e|^2/l_e,
/// of first order (Rayleigh's quotient). An arc is eight chords between points of its axis, which move by the shapes of the element, each with
/// the N in its middle, by equilibrium with the end b and the weight between. Beams with an axial_force of their own are left out. So are shear forces and moments of the weight: in bends they
/// couple bending out of the plane with torsion, by terms of the same order; in its plane a thin arc has that of N alone.
#pragma once
#include "app/build_contacts.hpp"
#include "modal/basis.hpp"
#include "results/run_results.hpp"
#include "study/study.hpp"
#include <mpi.h>

namespace fretwork::app {

/// Shares of a frequency from which on the weight is noted, and warned about.
constexpr double noted_by_weight = 0.01, warned_by_weight = 0.1;

/// Collective; needs PETSc. Adds a note, or a warning, of the mode whose frequency the weight changes most; nothing without [gravity], and where a static solution fails.
/// @param contacts  the active ones
void note_weight_stiffness(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                           const std::vector<fem::Structure>& structures,
                           const std::vector<modal::Basis>& bases, const std::vector<PlacedContact>& contacts,
                           results::RunResults& out);

} // namespace fretwork::app
