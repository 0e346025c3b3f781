// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Obstacles of contacts after wear.
///
/// Flat faces on several sides of the tube, of planes, bars and egg crates, move away from it each by p_t + p_s of its own side: the
/// obstacle grows by the mean of two opposite sides, and its centre moves by half their difference. Each facet of a convex polygon moves
/// along its normal, and the radius of each land grows, by p_t + p_s of its own. All of any other obstacle moves by p_t + p_s of its support: the sum of the clearances of two sides is an upper bound.
///     circle, planes, stop      gap + growth
///     ellipse                   semi-axes + growth
///     broached                  radius of the lands + growth, of each land its own
///     rectangle (egg crate)     half widths + growth
///     convex polygon            each facet along its normal
///     profile                   radius of each point + growth
///     two nodes                 the bodies are smaller by growth: distances - growth, the gap of circle_inside + growth
/// A circle that wears by angular sectors becomes the profile of its sectors (wear::opened_profile).
#pragma once
#include "app/build_contacts.hpp"
#include "contact/profile.hpp"
#include "contact/sides.hpp"
#include <array>

namespace fretwork::app {

/// @param growth  m, >= 0, of the gap as it was placed
/// @throws core::Error where the obstacle does not exist any more (lands as wide as the lobes)
[[nodiscard]] contact::Obstacle opened_obstacle(const contact::Obstacle& obstacle, double growth);

/// m, by number of a side (contact/sides.hpp).
using SideGrowth = std::array<double, contact::most_sides>;

/// Of an obstacle of several sides.
void open_sides(const SideGrowth& growth, PlacedContact& placed);

/// Whether its gap can open by angle: a circle round one node, of gap > 0.
[[nodiscard]] bool opens_by_angle(const PlacedContact& placed);

} // namespace fretwork::app
