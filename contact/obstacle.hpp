// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Obstacles in the plane y_loc, z_loc, their centre at the origin. `locate` turns a position into a gap and
/// a normal. For a contact between two nodes the position is that of the first from the second, and a circle
/// is a ring round the second node in which the first moves.
///
/// Sign rule of the whole program: gap > 0 open, gap < 0 penetrates; the normal n is the gradient of the gap
/// (into free space).
///     circle       gap = g - r,            n = -e_r       hole of radial clearance g
///     plane pair   gap = g - |c|,          n = -sign(c) e two planes at c = +-g, c = y or z
///     stop         gap = g - c,            n = -e         one plane: contact where c exceeds g
///     round pair   gap = r - d,            n = e_r        two round bodies side by side, d = R_1 + R_2
///     profile      signed distance to a polygon round the origin (profile.hpp)
///     broached     signed distance to the arcs of lands, corners and lobes (broached_space.hpp)
///     facing planes gap = s c - d,         n = s e        two flat bodies, d = D_1 + D_2, the first on
///                                                the side s = +-1 of the second
///     ellipse      gap = h(m) - p.m - R,   n = -m         a round body of radius R in an elliptic hole of
///                                                semi-axes a, b: its distance from the ellipse less R
/// h(m) = (a^2 m_y^2 + b^2 m_z^2)^1/2 is the support function of the ellipse, m its outward normal where it is nearest
/// to the position p: m ~ (y/(s + a^2 - b^2), z/s) for a >= b, where s is the largest root of
/// (a y/(s + a^2 - b^2))^2 + (b z/s)^2 = 1, found by Newton's steps from below, which grow to it.
/// Source: R5.06.03 sections 4.1.1 and 4.1.2 (whose normals are opposite to each other), 4.2.1 (where the
/// side follows the sign of c, so that bodies that pass through each other are pushed on), 4.2.2.
#pragma once
#include "contact/broached_space.hpp"
#include "contact/plane.hpp"
#include "contact/profile.hpp"
#include <array>
#include <cmath>
#include <variant>
#include <vector>

namespace fretwork::contact {

enum class PlaneAxis { y, z };

struct Circle {
  double gap; ///< m, >= 0
};
struct PlanePair {
  double gap; ///< m, >= 0
  PlaneAxis axis;
};
struct Stop {
  double gap; ///< m, >= 0
  PlaneAxis axis;
};
struct RoundPair {
  double distance; ///< m, > 0: sum of the radii
};
struct FacingPlanes {
  double distance; ///< m, >= 0: sum of the half thicknesses
  PlaneAxis axis;
  double side; ///< +1 or -1: of the second node on which the first stays
};
struct Ellipse {
  double semi_y, semi_z; ///< m, > 0: semi-axes of the hole
  double
      radius; ///< m, >= 0, of the body; above the hole's least radius of curvature it touches at two places where it reaches farthest
};
using Obstacle =
    std::variant<Circle, PlanePair, Stop, RoundPair, FacingPlanes, Ellipse, BroachedSpace, Profile>;

/// Where a node is against its obstacle; the contact's tangent directions are x_loc and t = n x x_loc = (0,
/// nz, -ny).
struct Location {
  double gap;    ///< m
  double ny, nz; ///< unit normal in local axes
  [[nodiscard]] ContactAxes axes() const { return {ny, nz}; }
  /// The same place from the opposite face, which is farther away: open, by |gap| at least.
  [[nodiscard]] Location from_opposite() const { return {std::abs(gap), -ny, -nz}; }
};

/// Direction taken for a node at the very centre of a circle, where every direction is as good.
inline constexpr Location centred(double gap) { return {gap, -1.0, 0.0}; }

[[nodiscard]] inline Location locate(const Circle& circle, double y, double z) {
  const double r = std::sqrt(y * y + z * z);
  if (!(r > 0.0))
    return centred(circle.gap);
  return {circle.gap - r, -y / r, -z / r};
}

[[nodiscard]] inline Location locate(const PlanePair& plane, double y, double z) {
  const bool along_y = plane.axis == PlaneAxis::y;
  const double c = along_y ? y : z;
  const double n = c < 0.0 ? 1.0 : -1.0;
  return {plane.gap - std::abs(c), along_y ? n : 0.0, along_y ? 0.0 : n};
}

[[nodiscard]] inline Location locate(const Stop& stop, double y, double z) {
  const bool along_y = stop.axis == PlaneAxis::y;
  return {stop.gap - (along_y ? y : z), along_y ? -1.0 : 0.0, along_y ? 0.0 : -1.0};
}

[[nodiscard]] inline Location locate(const RoundPair& pair, double y, double z) {
  const double r = std::sqrt(y * y + z * z);
  if (!(r > 0.0))
    return {-pair.distance, 1.0, 0.0}; // centres on each other: every direction is as good
  return {r - pair.distance, y / r, z / r};
}

[[nodiscard]] inline Location locate(const FacingPlanes& planes, double y, double z) {
  const bool along_y = planes.axis == PlaneAxis::y;
  return {planes.side * (along_y ? y : z) - planes.distance, along_y ? planes.side : 0.0,
          along_y ? 0.0 : planes.side};
}

[[nodiscard]] Location locate(const Ellipse& ellipse, double y, double z);

[[nodiscard]] inline Location locate(const BroachedSpace& space, double y, double z) {
  return space.locate(y, z);
}

[[nodiscard]] inline Location locate(const Profile& profile, double y, double z) {
  return profile.locate(y, z);
}

[[nodiscard]] inline Location locate(const Obstacle& obstacle, double y, double z) {
  return std::visit([&](const auto& shape) { return locate(shape, y, z); }, obstacle);
}

/// kappa, 1/m, with which the normal turns as the node moves: dn = kappa t (t.du), so that the Hessian of the
/// gap is kappa t t^T. Circle -1/r, round pair 1/r, planes 0, ellipse -1/(rho - distance from it) with the radius of curvature rho where it is
/// nearest, others: broached_space.hpp, profile.hpp. Where the normal is a
/// choice (centred tube, coincident nodes, on the corner of a profile) 0, as the choice does not turn.
[[nodiscard]] double curvature(const Obstacle& obstacle, double y, double z);

/// A bound that shows cheaply that a node is out of reach, and the form of all gaps that are one formula:
///     limit - (radial sqrt(wy y^2 + wz z^2) + ly y + lz z),
/// whose rate is at least -sqrt(wy vy^2 + wz vz^2).
struct GapBound {
  double wy, wz, limit;
  double radial = 1.0, ly = 0.0, lz = 0.0;
};

/// What others ask of an obstacle without knowing its kind.
struct ObstacleProperties {
  double extent;      ///< m, how far it reaches
  GapBound gap_bound; ///< the gap is at least this
  bool
      is_bound_gap; ///< it is this, and the normal its gradient: both are found in vector lanes; else by `locate`
  bool is_concave; ///< the gap bends nowhere upwards: the energy of a spring on the penetration is convex
  bool has_parts;  ///< deeper or farther on another part may be the nearest one, and the normal jump
  bool has_opposite_sides; ///< a node that crosses the free space meets a wall with the opposite normal
};
[[nodiscard]] ObstacleProperties properties_of(const Obstacle& obstacle);

/// Whether a node that is closed rolls round the wall of a hole over a time dt: it moves by more than the clearance, and its straight path misses
/// the free space, so that no time of the interval has it open.   @param position  y, z, m   @param velocity  y, z, m/s
[[nodiscard]] bool rolls_round(const Obstacle& obstacle, PlanePoint position, PlanePoint velocity, double dt);

/// Points of its surface, m, closed; none where its gap and kind tell all.
[[nodiscard]] std::vector<PlanePoint> outline_of(const Obstacle& obstacle);

/// Local directions (y, z) the normal can take: those whose stiffness counts in the contact frequency.
[[nodiscard]] std::array<bool, 2> normal_directions(const Obstacle& obstacle);

} // namespace fretwork::contact
