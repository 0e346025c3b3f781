// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Sides of a tube: surfaces of an obstacle that touch it at places of their own, by the contact point (opposite to the normal of the
/// contact). Each has a scar of its own on the tube.
///     flat faces   +y and +z, those of y_loc and z_loc, -y and -z: the larger component of the normal
///     facets       of a convex polygon of up to 8 corners that is no such rectangle, "facet 1" from its first corner on, the others by increasing
///                  angle: the nearest normal
///     lands        of a broached hole, "land 1" the first, the others by increasing angle from y_loc to z_loc: the nearest land
#pragma once
#include "contact/obstacle.hpp"
#include "contact/plane.hpp"
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::contact {

inline constexpr std::size_t most_sides = 8; ///< of an obstacle; a hole with more lands counts as one surface
inline constexpr std::array<const char*, 4> flat_side_names{"+y", "+z", "-y", "-z"};

struct Side {
  std::size_t number; ///< in `flat_side_names`, or of the facet or land, from 0
  std::string name;
};

/// Of planes, bars, stops (one), rectangles (egg crates, four), convex polygons and broached holes. Empty for other obstacles, which are one
/// surface.
[[nodiscard]] std::vector<Side> sides_of(const Obstacle& obstacle);

/// The number of a name; nothing where no side is called so.
[[nodiscard]] std::optional<std::size_t> side_number(const std::string& name);

/// Number of the flat face.
[[nodiscard]] inline std::size_t flat_side_of(const ContactAxes& axes) {
  const bool along_y = std::abs(axes.ny) >= std::abs(axes.nz);
  return (along_y ? 0u : 1u) + ((along_y ? axes.ny : axes.nz) > 0.0 ? 2u : 0u);
}

/// Outward normals of the facets of a polygon whose facets are sides; empty for other obstacles.
[[nodiscard]] std::vector<PlanePoint> facet_normals(const Obstacle& obstacle);

/// The side of an obstacle at a normal.
class SideFinder {
public:
  explicit SideFinder(const Obstacle& obstacle);
  /// Number of the side, < most_sides; without a meaning for obstacles that have none.
  [[nodiscard]] std::size_t operator()(const ContactAxes& axes) const {
    return lands_ != 0 ? land_of(axes) : facets_.empty() ? flat_side_of(axes) : facet_of(axes);
  }
  /// Whether a tube that touches, its centre at a place (m, from the middle of the hole), is at the corner of a land, the end of its width: seen
  /// from the middle, the centre is beside the land. Never true of other obstacles.
  [[nodiscard]] bool at_corner(double y, double z) const {
    return lands_ != 0 && std::abs(from_land(std::atan2(z, y))) > half_land_;
  }

private:
  [[nodiscard]] std::size_t land_of(const ContactAxes& axes) const;
  [[nodiscard]] std::size_t facet_of(const ContactAxes& axes) const;
  /// rad, of an angle from the middle of the nearest land.
  [[nodiscard]] double from_land(double angle) const {
    return std::remainder(angle - orientation_, 2.0 * std::numbers::pi / lands_);
  }
  int lands_ = 0;                  ///< 0: flat faces
  double orientation_ = 0.0;       ///< rad, of the first land
  double half_land_ = 0.0;         ///< rad, half the angle of a land
  std::vector<PlanePoint> facets_; ///< outward normals; empty: none
};

} // namespace fretwork::contact
