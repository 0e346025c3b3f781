// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The damping of structures held by their contacts that follows from the ratios of modes without contacts.
///
/// A motion held by closed contacts is a sum of those modes, p = Phi y with (omega^2 + sum k b b^T) y = omega_p^2 y, and has
///     zeta_p = y^T diag(2 zeta omega) y / (2 omega_p),
/// less than zeta where all modes have that: the contacts make it stiffer, and its dampers are those of slower modes.
#pragma once
#include "app/build_contacts.hpp"
#include "modal/basis.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// Notes the structure whose lowest held mode lacks most of the ratio of the study, where that is more than a tenth; of damping by the flow, which
/// has a ratio for every mode, what it comes to. Nothing of Rayleigh's damping, which is that of any motion.
/// @param bases  with their damping   @param contacts  active ones
void note_held_damping(const study::Study& study, const fem::Model& model,
                       const std::vector<modal::Basis>& bases, const std::vector<PlacedContact>& contacts,
                       results::RunResults& out);

} // namespace fretwork::app
