// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/frame.hpp"
#include "core/error.hpp"
#include <Eigen/Geometry>
#include <cmath>

namespace fretwork::contact {
namespace {

/// A component this small against the axis is the round-off of whoever wrote the axis; it would turn y_loc by
/// up to 90 degrees.
constexpr double negligible_component = 1e-8;

Vec3 unit_axis(const Vec3& axis) {
  Vec3 unit = axis.normalized();
  for (double& component : unit)
    if (std::abs(component) < negligible_component)
      component = 0.0;
  return unit.normalized();
}

} // namespace

Eigen::Matrix3d Frame::rotation() const {
  Eigen::Matrix3d rows;
  rows << x.transpose(), y.transpose(), z.transpose();
  return rows;
}

Frame nautical_frame(const Vec3& axis, double angle) {
  const Vec3 x = unit_axis(axis);
  const double alpha = std::atan2(x.y(), x.x());
  const double beta = -std::asin(x.z());
  const Vec3 y(-std::sin(alpha), std::cos(alpha), 0.0);
  const Vec3 z(std::cos(alpha) * std::sin(beta), std::sin(alpha) * std::sin(beta), std::cos(beta));
  if (angle == 0.0)
    return {x, y, z};
  return {x, std::cos(angle) * y + std::sin(angle) * z, std::cos(angle) * z - std::sin(angle) * y};
}

Frame frame_from_y(const Vec3& axis, const Vec3& y_axis) {
  const Vec3 x = unit_axis(axis);
  const Vec3 across = y_axis - x.dot(y_axis) * x;
  if (!(across.norm() > negligible_component * y_axis.norm()))
    throw core::Error("y_axis is along the axis of the contact; give a vector across it");
  const Vec3 y = across.normalized();
  return {x, y, x.cross(y)};
}

} // namespace fretwork::contact
