// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/opened_contacts.hpp"
#include "contact/support_shapes.hpp"
#include "core/error.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <type_traits>

namespace fretwork::app {
namespace {

/// The corners moved away from the origin by a function of their place, or of that and their number.
template <class Moved> contact::Profile moved_profile(const contact::Profile& profile, Moved moved) {
  std::vector<contact::PolarPoint> points;
  for (const contact::PlanePoint& corner : profile.vertices()) {
    const auto [y, z] = [&] {
      if constexpr (std::is_invocable_v<Moved, contact::PlanePoint, std::size_t>)
        return moved(corner, points.size());
      else
        return moved(corner);
    }();
    points.push_back({std::atan2(z, y), std::hypot(y, z)});
  }
  // the first corner keeps its place: angles increase from it on, within one turn
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].angle < points[i - 1].angle)
      points[i].angle += 2.0 * std::numbers::pi;
  return contact::Profile(points);
}

contact::Profile opened_rectangle(const contact::Profile& profile, double growth_y, double growth_z) {
  return moved_profile(profile, [&](const contact::PlanePoint& corner) {
    return contact::PlanePoint{corner.y + std::copysign(growth_y, corner.y),
                               corner.z + std::copysign(growth_z, corner.z)};
  });
}

/// Each facet moved along its normal: corners are where neighbours then meet.
/// @throws core::Error where they meet before a facet between them: it is worn away
contact::Profile opened_facets(const contact::Profile& profile,
                               const std::vector<contact::PlanePoint>& normals, const SideGrowth& growth) {
  const std::size_t n = normals.size();
  const auto opened = [&](const contact::PlanePoint& corner, std::size_t i) {
    const std::size_t before = (i + n - 1) % n;
    const contact::PlanePoint &a = normals[before], &b = normals[i];
    const double sine = a.y * b.z - a.z * b.y;
    return contact::PlanePoint{corner.y + (growth[before] * b.z - growth[i] * a.z) / sine,
                               corner.z + (growth[i] * a.y - growth[before] * b.y) / sine};
  };
  const auto corners = profile.vertices();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const contact::PlanePoint from = opened(corners[i], i), to = opened(corners[next], next);
    if (!((to.y - from.y) * (corners[next].y - corners[i].y) +
              (to.z - from.z) * (corners[next].z - corners[i].z) >
          0.0))
      throw core::Error(
          fmt::format("facet {} of the profile is worn away: its neighbours meet before it", i + 1));
  }
  return moved_profile(profile, opened);
}

struct Opened {
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
    if (const auto normals = contact::facet_normals(shape); !normals.empty()) {
      SideGrowth all;
      all.fill(growth);
      return opened_facets(shape, normals, all);
    }
    if (!contact::sides_of(shape).empty())
      return opened_rectangle(shape, growth, growth);
    return moved_profile(shape, [this](const contact::PlanePoint& corner) {
      const double factor = 1.0 + growth / std::hypot(corner.y, corner.z);
      return contact::PlanePoint{corner.y * factor, corner.z * factor};
    });
  }
  contact::Obstacle operator()(const contact::BroachedSpace& shape) const {
    contact::BroachedHole hole = shape.hole();
    hole.land_radius += growth;
    return contact::BroachedSpace(shape.tube_radius(), hole);
  }
};

void open_lands(const SideGrowth& growth, contact::Obstacle& obstacle) {
  const auto& space = std::get<contact::BroachedSpace>(obstacle);
  contact::BroachedHole hole = space.hole();
  hole.land_growth.resize(static_cast<std::size_t>(hole.lands), 0.0);
  for (std::size_t land = 0; land < hole.land_growth.size(); ++land)
    hole.land_growth[land] += growth[land];
  obstacle = contact::BroachedSpace(space.tube_radius(), hole);
}

} // namespace

contact::Obstacle opened_obstacle(const contact::Obstacle& obstacle, double growth) {
  return std::visit(Opened{growth}, obstacle);
}

void open_sides(const SideGrowth& growth, PlacedContact& placed) {
  if (std::holds_alternative<contact::BroachedSpace>(placed.obstacle))
    return open_lands(growth, placed.obstacle);
  if (const auto normals = contact::facet_normals(placed.obstacle); !normals.empty()) {
    placed.obstacle = opened_facets(std::get<contact::Profile>(placed.obstacle), normals, growth);
    return;
  }
  // of two opposite sides
  const auto mean = [&](std::size_t side) { return 0.5 * (growth[side] + growth[side + 2]); };
  const auto shift = [&](std::size_t side) { return 0.5 * (growth[side] - growth[side + 2]); };
  placed.rest.y() -= shift(0);
  placed.rest.z() -= shift(1);
  if (auto* planes = std::get_if<contact::PlanePair>(&placed.obstacle))
    planes->gap += mean(planes->axis == contact::PlaneAxis::y ? 0 : 1);
  else
    placed.obstacle = opened_rectangle(std::get<contact::Profile>(placed.obstacle), mean(0), mean(1));
}

bool opens_by_angle(const PlacedContact& placed) {
  const auto* circle = std::get_if<contact::Circle>(&placed.obstacle);
  return placed.other < 0 && circle && circle->gap > 0.0;
}

} // namespace fretwork::app
