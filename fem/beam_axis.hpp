// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The axis of a beam: the straight line from a to b, or the arc of a circle from a through a middle point m.
///
/// With p = a - m, q = b - m the arc turns by phi = 2 atan2(|p x q|, -p.q) (angle at the circumference); with
/// the chord c = b - a its length is |c| (phi/2) / sin(phi/2), its curvature phi / length. From the tangent t0
/// and the inward normal n0 at a
///     x(s) = a + s [sinc(k s) t0 + sin(k s/2) sinc(k s/2) n0],   t(s) = cos(k s) t0 + sin(k s) n0,
/// sinc(x) = sin(x)/x, which is as exact for the smallest angles as for large ones. m need not be half way.
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>

namespace fretwork::fem {

class BeamAxis {
public:
  /// @throws core::Error where a and b are one point, or m lies on the chord's line outside the chord
  BeamAxis(const Vec3& a, const Vec3& b, const std::optional<Vec3>& middle);

  [[nodiscard]] double length() const { return length_; } ///< m, along the axis
  [[nodiscard]] double angle() const { return angle_; }   ///< rad, 0 for a straight axis
  [[nodiscard]] bool is_straight() const { return angle_ == 0.0; }
  /// At the distance s (m, 0 to length) from a along the axis.
  [[nodiscard]] Vec3 point(double s) const;
  [[nodiscard]] Vec3 tangent(double s) const; ///< a unit vector towards b
  [[nodiscard]] Vec3
  inward(double s) const; ///< a unit vector towards the centre of the arc; zero where straight

private:
  Vec3 start_, tangent_, normal_ = Vec3::Zero();
  double length_, angle_ = 0.0;
};

/// `beam from (0, 0, 0) to (1, 0, 0)`
[[nodiscard]] std::string beam_text(const Vec3& a, const Vec3& b);

/// Rows: x (a unit vector), y, z of a frame whose y axis lies in the plane of x and `orientation`; without
/// one, a fixed rule picks it.
/// @param a, b  ends of the beam, for the message
/// @throws core::Error where the orientation is along x or zero
[[nodiscard]] Eigen::Matrix3d frame_along(const Vec3& x, const std::optional<Vec3>& orientation,
                                          const Vec3& a, const Vec3& b);

} // namespace fretwork::fem
