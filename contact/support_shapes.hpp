// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Obstacles of the supports that hold tubes, in terms of the tube's centre: the free space of the centre is
/// the hole less the tube's radius t all round (the points at least t away from the plate). Origin at the
/// middle of the hole; angles from y_loc to z_loc; everything in m and rad.
///
///     drilled hole of radius h                  a circle of gap h - t
///     elliptic hole                             the ellipse, and the tube as a round body in it
///     flat bars, faces at d from the centre     planes of gap d - t
///     egg crate, faces at y = +-hy, z = +-hz    the rectangle of half widths hy - t, hz - t
///     broached hole                             broached_space.hpp
#pragma once
#include "contact/obstacle.hpp"
#include "contact/profile.hpp"

namespace fretwork::contact {

/// @throws core::Error if a radius is not positive or the tube does not fit
[[nodiscard]] Circle drilled_hole(double tube_radius, double hole_radius);

/// A hole worn or ovalised: an ellipse.
/// @throws core::Error unless both semi-axes exceed the tube's radius, and the least radius of curvature (the smaller one squared by the
/// larger one) does: the tube would touch at two places at once
[[nodiscard]] Ellipse elliptic_hole(double tube_radius, double semi_y, double semi_z);

enum class BarSides { one, two };

/// Bars across `axis`, on its positive side only or on both.
/// @param distance  m, from the tube's centre to the face of each bar
/// @throws core::Error if the tube does not fit
[[nodiscard]] Obstacle flat_bars(double tube_radius, double distance, PlaneAxis axis, BarSides sides);

/// Two planes whose middle is not the tube's centre.
struct OffsetPlanes {
  PlanePair planes;
  double offset; ///< m, along the axis, of the obstacle's centre from the tube's
};

/// Bars at unequal distances (m, from the tube's centre to the face) on the negative and the positive side.
/// A negative distance is a bar beyond the centre: only the room between the two must hold the tube.
/// @throws core::Error if the tube does not fit between them
[[nodiscard]] OffsetPlanes flat_bars_between(double tube_radius, double negative_side, double positive_side,
                                             PlaneAxis axis);

/// @throws core::Error unless both half widths exceed the tube's radius
[[nodiscard]] Profile egg_crate(double tube_radius, double half_width_y, double half_width_z);

} // namespace fretwork::contact
