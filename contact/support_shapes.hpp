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
///
/// Broached hole (trefoil, quatrefoil): lands, arcs of radius a over `land_angle`, hold the tube; between
/// them are flow lobes, arcs of radius b > a; radial walls join the two. Seen from the middle, the centre's
/// free space ends
///     over a land           at the circle of radius a - t
///     beside a land         at the circle of radius t about the land's corner
///     farther into a lobe   at the circle of radius b - t, if the corner's circle reaches it (a wide lobe);
///                           else the circles of the lobe's two corners meet in its middle (a narrow one).
/// The walls behind the corners are never touched. A point of the corner's circle at the angle x about the
/// corner (0 at the land) is at radius r and at the angle p from the corner's direction:
///     r^2 = (a - t)^2 + 4 a t sin^2(x/2),   tan p = t sin x / ((a - t) + 2 t sin^2(x/2)),
/// hidden from the middle behind the corner for cos x < t/a. The arcs are sampled at points of their own, so
/// densely that the profile's chords stray from them by no more than the chord error.
#pragma once
#include "contact/obstacle.hpp"
#include "contact/profile.hpp"
#include <algorithm>

namespace fretwork::contact {

inline constexpr double default_chord_error = 1e-8; ///< m; a share of larger clearances than those of tubes:
inline constexpr double default_chord_share = 1e-5;

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

struct BroachedHole {
  double land_radius;       ///< a, m: the inner radius, of the lands
  double lobe_radius;       ///< b > a, m: the outer radius, of the flow lobes
  int lands;                ///< 3 trefoil, 4 quatrefoil; >= 2
  double land_angle;        ///< rad, of each land seen from the middle, > 0
  double orientation = 0.0; ///< rad, of the middle of the first land
};

/// @param chord_error  m, > 0: how far the profile may stray from the exact arcs
/// @throws core::Error if the tube does not fit, the lands leave no lobe, the lobe lets the tube pass behind
/// a corner (the free space would
///         not be visible from the middle), or the chord error asks for more than a million points
[[nodiscard]] Profile broached_hole(double tube_radius, const BroachedHole& hole, double chord_error);
/// @throws core::Error as above
[[nodiscard]] inline Profile broached_hole(double tube_radius, const BroachedHole& hole) {
  return broached_hole(tube_radius, hole,
                       std::max(default_chord_error, default_chord_share * (hole.land_radius - tube_radius)));
}

} // namespace fretwork::contact
