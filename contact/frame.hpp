// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The local axes of a contact.
///
/// x_loc is the generator of the tube. The first two nautical angles of x_loc = (nx, ny, nz) fix the
/// principal frame,
///     alpha = atan2(ny, nx),  beta = -asin(nz),
///     y = (-sin alpha, cos alpha, 0),  z = (cos alpha sin beta, sin alpha sin beta, cos beta),
/// and a turn by `angle` about x_loc gives y_loc, z_loc. So X -> (+Y, +Z), Y -> (-X, +Z), Z -> (+Y, -X).
/// Source: R5.06.03, section 6.2.
#pragma once
#include "core/types.hpp"

namespace fretwork::contact {

using core::Vec3;

/// Unit vectors in global axes, right-handed.
struct Frame {
  Vec3 x, y, z;
  /// Rows x, y, z: global to local components.
  [[nodiscard]] Eigen::Matrix3d rotation() const;
};

/// Frame of an axis (any length > 0; components below 1e-8 of it count as 0) turned by `angle` (rad) about
/// it.
[[nodiscard]] Frame nautical_frame(const Vec3& axis, double angle);

/// Frame of an axis and a vector in the plane of x_loc and y_loc.
/// @throws core::Error if y_axis is along the axis
[[nodiscard]] Frame frame_from_y(const Vec3& axis, const Vec3& y_axis);

} // namespace fretwork::contact
