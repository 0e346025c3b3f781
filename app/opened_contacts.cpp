// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/opened_contacts.hpp"
#include "contact/support_shapes.hpp"
#include <cmath>
#include <numbers>

namespace fretwork::app {
namespace {

/// The corners moved away from the origin, along the radius or, of a rectangle, along both axes.
contact::Profile opened_profile_of(const contact::Profile& profile, bool is_rectangle, double growth) {
  std::vector<contact::PolarPoint> points;
  for (const contact::PlanePoint& corner : profile.vertices()) {
    const double radius = std::hypot(corner.y, corner.z);
    const double y =
        is_rectangle ? corner.y + std::copysign(growth, corner.y) : corner.y * (1.0 + growth / radius);
    const double z =
        is_rectangle ? corner.z + std::copysign(growth, corner.z) : corner.z * (1.0 + growth / radius);
    points.push_back({std::atan2(z, y), std::hypot(y, z)});
  }
  // the first corner keeps its place: angles increase from it on, within one turn
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].angle < points[i - 1].angle)
      points[i].angle += 2.0 * std::numbers::pi;
  return contact::Profile(points);
}

struct Opened {
  const study::Contact& contact;
  double growth;
  contact::Obstacle operator()(contact::Circle shape) const { return contact::Circle{shape.gap + growth}; }
  contact::Obstacle operator()(contact::PlanePair shape) const {
    return contact::PlanePair{shape.gap + growth, shape.axis};
  }
  contact::Obstacle operator()(contact::Stop shape) const {
    return contact::Stop{shape.gap + growth, shape.axis};
  }
  contact::Obstacle operator()(contact::RoundPair shape) const {
    return contact::RoundPair{shape.distance - growth};
  }
  contact::Obstacle operator()(contact::FacingPlanes shape) const {
    return contact::FacingPlanes{shape.distance - growth, shape.axis, shape.side};
  }
  contact::Obstacle operator()(contact::Ellipse shape) const {
    return contact::Ellipse{shape.semi_y + growth, shape.semi_z + growth, shape.radius};
  }
  contact::Obstacle operator()(const contact::Profile& shape) const {
    if (!contact.broached)
      return opened_profile_of(shape, contact.obstacle == study::ObstacleKind::egg_crate, growth);
    contact::BroachedHole hole = *contact.broached;
    hole.land_radius += growth;
    return contact::broached_hole(*contact.tube_radius, hole);
  }
};

} // namespace

contact::Obstacle opened_obstacle(const study::Contact& contact, const contact::Obstacle& obstacle,
                                  double growth) {
  return std::visit(Opened{contact, growth}, obstacle);
}

bool opens_by_angle(const PlacedContact& placed) {
  const auto* circle = std::get_if<contact::Circle>(&placed.obstacle);
  return placed.other < 0 && circle && circle->gap > 0.0;
}

} // namespace fretwork::app
