// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A hole of any shape, given in polar points about the obstacle's origin and closed by straight facets. The
/// free space is the inside.
///
///     y = r cos(angle), z = r sin(angle)
///     gap = distance to the polygon, > 0 inside, < 0 outside;  n = gradient of the gap
/// by what is nearest to the node:
///     a facet                        n = its normal to the inside, gap = n.(node - facet), on both its sides
///     a corner that protrudes        n = from the corner to the node, gap > 0: a round tip of radius 0
///     a corner of the hole, outside  n = from the node to the corner, gap < 0
///
/// The polygon need not be convex, only visible from the origin as a whole (angles that increase within a
/// turn). The nearest of all facets counts, not the one of the node's sector. The gap is continuous and
/// changes by no more than the node moves. The normal jumps only where two parts of the polygon are equally
/// near; there the facet of lowest number counts. On a corner itself, where the gap has no gradient, n is the
/// bisector to the inside. A finite node within 1e150 m never gives NaN.
///
/// Source: R5.06.03 section 4.1.3, which leaves corners open.
#pragma once
#include "contact/plane.hpp"
#include <cstdint>
#include <memory>
#include <span>

namespace fretwork::contact {

struct Location;

struct PolarPoint {
  double angle;  ///< rad, from y_loc to z_loc
  double radius; ///< m, > 0
};

/// Immutable; copies share their tables.
class Profile {
public:
  /// @param points  3 to a million, by increasing angle within one turn; a last point that repeats the first is
  /// dropped
  /// @throws core::Error naming the point, counted from 1
  explicit Profile(std::span<const PolarPoint> points);

  /// Gap and normal of a node; no allocation. Its cost hardly depends on the number of facets, but for the few
  /// nodes that have a great part of the polygon at nearly the same distance (facet_cells.hpp).
  [[nodiscard]] Location locate(double y, double z) const;

  /// How the normal turns, 1/m (contact::curvature): 0 on a facet; 1/gap where a corner is nearest, for n
  /// then turns about it; 0 on the corner itself.
  [[nodiscard]] double curvature(double y, double z) const;

  /// Gap at the origin, m, > 0: gap(y, z) >= inscribed() - sqrt(y^2 + z^2).
  [[nodiscard]] double inscribed() const;

  /// Corners by increasing angle, as long as the profile or a copy of it lives.
  [[nodiscard]] std::span<const PlanePoint> vertices() const&;
  std::span<const PlanePoint> vertices() && = delete;

private:
  struct Tables;
  [[nodiscard]] std::uint32_t corner_of(std::uint32_t k, double along) const;
  [[nodiscard]] Location locate_at_corner(std::uint32_t corner, double y, double z) const;

  std::shared_ptr<const Tables> tables_;
};

} // namespace fretwork::contact
