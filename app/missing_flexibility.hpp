// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the modes of a scene lack of the static flexibility at its contacts, times their stiffness: by that share a contact is too
/// stiff, and the force of an impact too high by half of it, for it goes with the square root.
#pragma once
#include "app/build_scene.hpp"
#include "app/contact_flexibility.hpp"

namespace fretwork::app {

/// Missing flexibility times stiffness, K_N along normals, K_T where friction can act: the largest of a contact's local axes.
/// @param k  number of the contact in `flexibility`
[[nodiscard]] double missing_times_stiffness(const ContactFlexibility& flexibility, std::size_t k,
                                             const contact::Support& support);

/// Sets `lacking` and `truncated`.   @param flexibility  of the contacts of the scene, whole
void find_missing(const ContactFlexibility& flexibility, BuiltScene& built);

/// Where impacts are wrong by a percent and no warning says so (modal_truncation.hpp); empty elsewhere.
[[nodiscard]] std::string flexibility_note(const std::vector<BuiltScene>& scenes);

} // namespace fretwork::app
