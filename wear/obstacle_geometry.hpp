// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Geometry of wear of a contact, from its own obstacle:
///
///     circle of gap c > 0       drilled hole of clearance c
///     circle of gap 0           ring
///     plane pair, stop          flat bar
///     round pair                tube on tube, for tubes that cross
///     broached hole             lands: clearance a - t at the lands (a their radius, t the tube's), half-angle
///                               land_angle/2
///     facing planes, profile    none: the first has no round body, the second does not know what it was made of
#pragma once
#include "contact/support_shapes.hpp"
#include "wear/depth.hpp"

namespace fretwork::wear {

struct TubeInSupport {
  double radius;            ///< R, m, > 0
  double length;            ///< B, m, > 0: of the support along the tube
  double inclination = 0.0; ///< rad: between tube and support, or between tubes that cross
};

/// @throws core::Error for an obstacle without a geometry of wear (what to give instead), and as `check`
[[nodiscard]] Geometry geometry_of(const contact::Obstacle& obstacle, const TubeInSupport& tube);

} // namespace fretwork::wear
