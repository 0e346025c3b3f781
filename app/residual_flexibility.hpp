// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Residual flexibility in series with the contacts of a scene (static_modes = "auto").
///
/// It is worth having where the missing flexibility times the stiffness of the contact exceeds 1e-3: by that share the contact is too
/// stiff, and the force of an impact too high by half of it (it goes with the square root), 1/20 of the usual accuracy of 1 %.
/// Where one contact of a scene needs it, all have theirs: they share it.
#pragma once
#include "app/build_scene.hpp"
#include "app/contact_flexibility.hpp"

namespace fretwork::app {

/// Missing flexibility times stiffness from which on it is taken.
constexpr double worth_having = 1e-3;

/// Missing flexibility times stiffness, K_N along normals, K_T along tangents: the largest of a contact's local axes.
/// @param k  number of the contact in `flexibility`
[[nodiscard]] double missing_times_stiffness(const ContactFlexibility& flexibility, std::size_t k,
                                             const contact::Support& support);

/// Sets `lacking` and, as the study says, gives the scene Scene::residual and ContactPoint::under_loads where they are worth having.
/// @param flexibility  of the contacts of the scene, whole
/// @param loads  those of the scene, with their names
/// @throws core::Error for a load that jumps and moves contacts beside the modes
void take_residual_flexibility(const study::Study& study, const ContactFlexibility& flexibility,
                               const std::vector<Fields::Load>& loads, BuiltScene& built);

/// What was done about it, or what should be where impacts are wrong by a percent; empty where there is nothing to tell.
[[nodiscard]] std::string flexibility_note(const study::Study& study, const std::vector<BuiltScene>& scenes);

/// Turbulence acts on the modes alone. Warns where what they lack of its displacement, were it as slow as statics and the contact open,
/// makes the rms motion of a contact low by more than a percent.
void judge_turbulence(const std::vector<BuiltScene>& scenes,
                      const std::vector<ContactFlexibility>& flexibilities, results::RunResults& out);

} // namespace fretwork::app
