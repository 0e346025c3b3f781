// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Sides of a tube at which flat faces meet it, by the contact point (opposite to the normal of the contact): +y and +z are those of
/// y_loc and z_loc. Each face has a scar of its own on the tube.
#pragma once
#include "contact/obstacle.hpp"
#include "contact/plane.hpp"
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace fretwork::contact {

inline constexpr std::array<const char*, 4> side_names{"+y", "+z", "-y", "-z"};

/// Number of the side in `side_names`: that of the larger component of the normal.
[[nodiscard]] inline std::size_t side_of(const ContactAxes& axes) {
  const bool along_y = std::abs(axes.ny) >= std::abs(axes.nz);
  return (along_y ? 0u : 1u) + ((along_y ? axes.ny : axes.nz) > 0.0 ? 2u : 0u);
}

/// Sides that an obstacle of several flat faces touches: two of a plane pair, four of a rectangle (egg crate). Empty for others.
[[nodiscard]] std::vector<std::size_t> flat_sides(const Obstacle& obstacle);

} // namespace fretwork::contact
