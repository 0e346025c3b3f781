// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The free space of a tube's centre in a broached hole (trefoil, quatrefoil), exactly, of arcs. Lands, arcs of radius a over
/// `land_angle`, hold the tube of radius t; between them are flow lobes, arcs of radius b > a; radial walls join the two.
///
/// Half a land and half the lobe beside it are the whole by symmetry: what is nearest to a node is on its side of the middles. With the
/// angle d from the corner C of the land, > 0 beside the land, and D = |node - C|:
///     over a land            d <= 0                                   gap = a - t - r,  n = -e_r
///     corner of a land       d > 0, seen from C before the edge       gap = D - t,      n = from C to the node
///     lobe                   d >= that of the edge                    gap = b - t - r,  n = -e_r
///     edge                   beyond it, where no arc has its foot     gap = -distance,  n = from the node to the edge
/// the least of those that apply. The edge is where the corner's circle meets that of the lobe (a wide lobe), or that of the lobe's other
/// corner in the lobe's middle (a narrow one, which the tube does not reach the end of). The walls behind the corners are never touched.
/// Arcs of land and corner have one tangent where they meet: there the normal does not jump.
/// Lands of unequal radii (worn ones) have each their own half, and the corners of the others count too, by D - t: gaps are exact, depths
/// beyond the edge of a lobe too narrow for an arc are those of its own half.
#pragma once
#include "contact/plane.hpp"
#include <vector>

namespace fretwork::contact {

struct Location;

/// The plate; origin at the middle of the hole, angles from y_loc to z_loc.
struct BroachedHole {
  double land_radius;       ///< a, m: the inner radius, of the lands
  double lobe_radius;       ///< b > a, m: the outer radius, of the flow lobes
  int lands;                ///< 3 trefoil, 4 quatrefoil; >= 2
  double land_angle;        ///< rad, of each land seen from the middle, > 0
  double orientation = 0.0; ///< rad, of the middle of the first land
  std::vector<double> land_growth =
      {}; ///< m, >= 0: of the radius of each land beyond `land_radius`, where they differ; empty: 0
};

/// Immutable.
class BroachedSpace {
public:
  /// @throws core::Error if the tube does not fit, the lands leave no lobe, or the lobe lets the tube pass behind a corner
  BroachedSpace(double tube_radius, const BroachedHole& hole);

  /// Gap and normal of a node.
  [[nodiscard]] Location locate(double y, double z) const;
  /// contact::curvature: of the arc that is nearest, -1/r or 1/D; 1/gap at the edge.
  [[nodiscard]] double curvature(double y, double z) const;
  /// Radial clearance at the nearest land, m: the gap in the middle, gap(y, z) >= clearance() - r.
  [[nodiscard]] double clearance() const { return clearance_; }
  /// Points of the free space's end, m, by increasing angle, so many on each arc.
  [[nodiscard]] std::vector<PlanePoint> outline(int arc_points) const;

  [[nodiscard]] const BroachedHole& hole() const { return hole_; }
  [[nodiscard]] double tube_radius() const { return tube_; }

private:
  struct Nearest;
  [[nodiscard]] Nearest nearest(double y, double z) const;

  /// Half of a land and of the lobe beside it.
  struct Half {
    double radius;       ///< a, m
    double edge_x;       ///< rad, about the corner, from the land to the edge
    double sin_x, cos_x; ///< of it
    double edge_angle;   ///< rad, of the edge from the corner, seen from the middle
    double edge_radius;  ///< m, of the edge from the middle
  };
  [[nodiscard]] Half half_of(double land_radius) const;
  [[nodiscard]] Nearest nearest_in(const Half& half, double r, double from_land) const;

  BroachedHole hole_;
  double tube_;              ///< t, m
  double clearance_;         ///< m
  double half_lobe_;         ///< rad, from the corner to the middle of the lobe
  std::vector<Half> halves_; ///< of all lands, or of each
};

} // namespace fretwork::contact
