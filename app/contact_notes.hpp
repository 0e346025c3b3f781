// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a user should know of the contacts before the run: overlaps at the start, and the values of laws that
/// the program found.
#pragma once
#include "app/build_scene.hpp"

namespace fretwork::app {

/// One line an entry of the study, however many points it has: first the overlaps, with the force that presses
/// at t = 0 (of the final initial state, speeds included), then the values found.
[[nodiscard]] std::vector<std::string> contact_notes(const study::Study& study,
                                                     const std::vector<PlacedContact>& placed,
                                                     const std::vector<BuiltScene>& scenes);

/// Warnings of where contacts are, of a run and of a case of a sweep alike: tubes that rest in their fixed obstacle by more than their outer
/// radius, clearances of the size of the tube (both of nodes with beams), and the questions of contact_questions.hpp; one an entry.
[[nodiscard]] std::vector<std::string> placement_warnings(const study::Study& study, const fem::Model& model,
                                                          const std::vector<PlacedContact>& placed);

/// Likewise of contacts at the start: two that are one and the same (node, axes and obstacle, or the same two nodes given in the other order),
/// and, one an entry, of those that overlap their obstacle where nothing acts, as of a preload, and are open in the static start.
[[nodiscard]] std::vector<std::string> start_warnings(const study::Study& study,
                                                      const std::vector<PlacedContact>& placed,
                                                      const std::vector<BuiltScene>& scenes);

} // namespace fretwork::app
