// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Points and facets of a polygon in the local plane.
#pragma once
#include <algorithm>

namespace fretwork::contact {

/// A point of the local plane, m.
struct PlanePoint {
  double y, z;
};

/// From vertex a on, along the unit vector u.
struct Facet {
  double ay, az, uy, uz, length;
};

/// The point of a facet, ends included, that is nearest to a point.
inline PlanePoint foot(const Facet& f, double y, double z) {
  const double along = std::min(std::max((y - f.ay) * f.uy + (z - f.az) * f.uz, 0.0), f.length);
  return {f.ay + along * f.uy, f.az + along * f.uz};
}

/// Squared distance of a point to a facet, m^2.
inline double distance2(const Facet& f, double y, double z) {
  const double wy = y - f.ay, wz = z - f.az;
  const double inner = wy * f.uy + wz * f.uz, after = inner > 0.0 ? inner : 0.0;
  const double along = after < f.length ? after : f.length;
  const double ry = wy - along * f.uy, rz = wz - along * f.uz;
  return ry * ry + rz * rz;
}

} // namespace fretwork::contact
