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

/// Warnings of contacts that overlap their obstacle where nothing acts, as of a preload, and are open in the static start: one an entry. Empty
/// where the run does not start so.
[[nodiscard]] std::vector<std::string> lost_preloads(const study::Study& study,
                                                     const std::vector<PlacedContact>& placed,
                                                     const std::vector<BuiltScene>& scenes);

/// A warning where two contacts are one and the same: node, axes and obstacle, or the same two nodes given in the other order. Empty
/// where none are.
[[nodiscard]] std::string twice_placed(const std::vector<PlacedContact>& placed);

/// Warnings of tubes that lie in their fixed obstacle by more than their outer radius where they rest, and of clearances of the size of the tube, one an entry; of nodes without beams nothing is known.
[[nodiscard]] std::vector<std::string> inside_obstacles(const study::Study& study, const fem::Model& model,
                                                        const std::vector<PlacedContact>& placed);

} // namespace fretwork::app
