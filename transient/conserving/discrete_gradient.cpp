// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/conserving/discrete_gradient.hpp"
#include <cmath>
#include <limits>

namespace fretwork::transient {
namespace {

using contact::Location;
using contact::PlaneAxis;
using contact::PlanePoint;

/// Of the positions: what a gap's difference is not known better than.
constexpr double round_off = 8.0 * std::numeric_limits<double>::epsilon();

/// sign (x0 + x1)/(r0 + r1): sign -1 for a circle, +1 for a round pair.
DiscreteGradient round(double sign, const Location& to, PlanePoint x0, PlanePoint x1) {
  const double r0 = std::sqrt(x0.y * x0.y + x0.z * x0.z), r1 = std::sqrt(x1.y * x1.y + x1.z * x1.z);
  const double sum = r0 + r1;
  if (!(sum > 0.0))
    return {to.gap, to.ny, to.nz, to.ny, to.nz, 0.0, 0.0, 0.0, 0.0};
  const double y = sign * (x0.y + x1.y) / sum, z = sign * (x0.z + x1.z) / sum;
  const double ey = r1 > 0.0 ? x1.y / r1 : 0.0, ez = r1 > 0.0 ? x1.z / r1 : 0.0; // gradient of r1
  return {
      to.gap, to.ny, to.nz, y, z, (sign - y * ey) / sum, -y * ez / sum, -z * ey / sum, (sign - z * ez) / sum};
}

/// Along the axis of a plane pair, c0 and c1 the coordinates on it.
DiscreteGradient across_planes(PlaneAxis axis, const Location& to, double c0, double c1) {
  const double sum = std::abs(c0) + std::abs(c1);
  const double n1 = to.ny + to.nz; // one of them is 0
  const double d = sum > 0.0 ? -(c0 + c1) / sum : n1;
  const double slope = sum > 0.0 ? (d * n1 - 1.0) / sum : 0.0; // d|c1|/dc1 = -n1
  if (axis == PlaneAxis::y)
    return {to.gap, to.ny, to.nz, d, 0.0, slope, 0.0, 0.0, 0.0};
  return {to.gap, to.ny, to.nz, 0.0, d, 0.0, 0.0, 0.0, slope};
}

DiscreteGradient flat(const Location& to) { return {to.gap, to.ny, to.nz, to.ny, to.nz, 0.0, 0.0, 0.0, 0.0}; }

DiscreteGradient along_curve(const contact::Obstacle& obstacle, PlanePoint x0, const Location& from,
                             PlanePoint x1, const PlanePoint* held) {
  const Location to = contact::locate(obstacle, x1.y, x1.z);
  const PlanePoint b = held ? *held : PlanePoint{0.5 * (from.ny + to.ny), 0.5 * (from.nz + to.nz)};
  const double bend = held ? 0.0 : 0.5 * contact::curvature(obstacle, x1.y, x1.z);
  const double ty = to.nz, tz = -to.ny;
  DiscreteGradient g{to.gap,         to.ny,          to.nz,          b.y,           b.z,
                     bend * ty * ty, bend * ty * tz, bend * tz * ty, bend * tz * tz};
  const double dy = x1.y - x0.y, dz = x1.z - x0.z, d2 = dy * dy + dz * dz;
  const double missing = to.gap - from.gap - (b.y * dy + b.z * dz);
  if (!(std::abs(missing) > round_off * (std::abs(x0.y) + std::abs(x0.z) + std::abs(x1.y) + std::abs(x1.z))))
    return g; // also where the node has not moved
  const double c = missing / d2;
  // dc = ((n1 - b - 2 c d).dx1 - d.db)/d2
  const double cy = (to.ny - b.y - 2.0 * c * dy - (dy * g.yy + dz * g.zy)) / d2;
  const double cz = (to.nz - b.z - 2.0 * c * dz - (dy * g.yz + dz * g.zz)) / d2;
  g.y += c * dy;
  g.z += c * dz;
  g.yy += c + cy * dy;
  g.yz += cz * dy;
  g.zy += cy * dz;
  g.zz += c + cz * dz;
  return g;
}

struct OfKind {
  const contact::Obstacle& obstacle;
  PlanePoint x0, x1;
  const Location& from;
  const PlanePoint* held;
  DiscreteGradient operator()(const contact::Circle& o) const {
    return round(-1.0, contact::locate(o, x1.y, x1.z), x0, x1);
  }
  DiscreteGradient operator()(const contact::RoundPair& o) const {
    return round(1.0, contact::locate(o, x1.y, x1.z), x0, x1);
  }
  DiscreteGradient operator()(const contact::PlanePair& o) const {
    const bool y = o.axis == PlaneAxis::y;
    return across_planes(o.axis, contact::locate(o, x1.y, x1.z), y ? x0.y : x0.z, y ? x1.y : x1.z);
  }
  DiscreteGradient operator()(const contact::Stop& o) const { return flat(contact::locate(o, x1.y, x1.z)); }
  DiscreteGradient operator()(const contact::FacingPlanes& o) const {
    return flat(contact::locate(o, x1.y, x1.z));
  }
  /// Of any obstacle.
  template <class Other> DiscreteGradient operator()(const Other&) const {
    return along_curve(obstacle, x0, from, x1, held);
  }
};

} // namespace

DiscreteGradient discrete_gradient(const contact::Obstacle& obstacle, PlanePoint x0, const Location& from,
                                   PlanePoint x1, const PlanePoint* held) {
  return std::visit(OfKind{obstacle, x0, x1, from, held}, obstacle);
}

} // namespace fretwork::transient
