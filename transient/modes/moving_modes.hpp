// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The modes of a scene that something moves. The others stay where they are, q_i = 0 at every instant, and cost a run nothing if they
/// are left out of it: torsion and axial modes of a tube that loads push across, for one.
///
/// A mode moves where it moves a contact (its column of b), a load acts on it, or its initial state is not zero, and where the damping
/// matrix couples it to one that moves. All tests are for exact zeros: what is round-off is for those to say who make the scene.
#pragma once
#include "transient/scene/scene.hpp"
#include <vector>

namespace fretwork::transient {

/// Ascending numbers.
[[nodiscard]] std::vector<Eigen::Index> moving_modes(const Scene& scene);

/// The scene with these modes alone. Where they are all that move, its motion is that of the whole scene.
[[nodiscard]] Scene with_modes(const Scene& scene, const std::vector<Eigen::Index>& modes);
/// The contacts over these modes.
[[nodiscard]] std::vector<ContactPoint> with_modes(std::vector<ContactPoint> contacts,
                                                   const std::vector<Eigen::Index>& modes);

} // namespace fretwork::transient
