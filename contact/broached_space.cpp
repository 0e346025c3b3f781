// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/broached_space.hpp"
#include "contact/obstacle.hpp"
#include "contact/support_sizes.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::contact {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double no_arc = 1e-9; ///< rad: of a lobe, what rounding leaves between the circles of its corners

void check(double tube_radius, const BroachedHole& hole) {
  check_clearance("broached hole", tube_radius, "land radius", hole.land_radius);
  check_size("broached hole", "lobe radius", hole.lobe_radius);
  if (hole.lobe_radius <= hole.land_radius)
    throw core::Error(fmt::format("broached hole: lobe radius = {:g} m is not larger than the land radius, "
                                  "{:g} m; give the outer radius "
                                  "of the lobes, or a drilled hole",
                                  hole.lobe_radius, hole.land_radius));
  if (hole.lands < 2)
    throw core::Error(
        fmt::format("broached hole: lands = {} do not hold a tube; give at least 2", hole.lands));
  if (!(hole.land_angle > 0.0) || !(hole.land_angle * hole.lands < 2.0 * pi))
    throw core::Error(fmt::format("broached hole: land angle = {:g} rad times {} lands leaves no lobe in a "
                                  "turn of 2 pi; give one between 0 and {:g} rad",
                                  hole.land_angle, hole.lands, 2.0 * pi / hole.lands));
  if (!hole.land_growth.empty() && hole.land_growth.size() != static_cast<std::size_t>(hole.lands))
    throw core::Error(fmt::format("broached hole: growth of {} lands of {}; give that of each, or none",
                                  hole.land_growth.size(), hole.lands));
  if (!std::isfinite(hole.orientation))
    throw core::Error(
        fmt::format("broached hole: orientation = {:g} rad makes no sense; give the angle of the first land",
                    hole.orientation));
}

/// A place seen from the middle: its distance, and its angle from the corner's direction.
struct Seen {
  double radius, angle;
};

/// The tube's centre where the tube, radius t, touches the corner at a from the middle; x about the corner, 0 at the land.
Seen touching_corner(double t, double a, double x) {
  const double s = std::sin(0.5 * x);
  return {std::sqrt((a - t) * (a - t) + 4.0 * a * t * s * s),
          std::atan2(t * std::sin(x), (a - t) + 2.0 * t * s * s)};
}

/// x of the edge: sin^2(x/2) where the corner's circle meets that of the lobe; in a narrow lobe its middle by the sine rule.
double edge_about_corner(double t, const BroachedHole& hole, double half_lobe) {
  const double a = hole.land_radius, b = hole.lobe_radius;
  const double last_seen = std::acos(t / a); // beyond it the corner hides its circle
  const double meets_lobe = (b - a) * (b + a - 2.0 * t) / (4.0 * a * t);
  const double x = meets_lobe < 1.0 ? 2.0 * std::asin(std::sqrt(meets_lobe)) : pi;
  if (x < last_seen && touching_corner(t, a, x).angle < half_lobe)
    return x;
  if (half_lobe < touching_corner(t, a, last_seen).angle)
    return std::asin(std::min(a * std::sin(half_lobe) / t, 1.0)) - half_lobe;
  throw core::Error(fmt::format("broached hole: a tube of radius {:g} m passes behind the corner of a land "
                                "(land radius {:g} m, lobe radius {:g} m, lobe of {:g} "
                                "rad); give a smaller lobe radius or a larger land angle",
                                t, a, b, 2.0 * half_lobe));
}

/// From a point, `from` away from the middle and by `turned` from the direction of a node at r: distance and direction, in those of the
/// node (e_r, e_angle); on it, inwards.
struct FromPoint {
  double distance, along, across;
};
FromPoint from_point(double from, double turned, double r, double from_land) {
  const double s = std::sin(0.5 * turned), along = (r - from) + 2.0 * from * s * s,
               across = -std::copysign(from, from_land) * std::sin(turned);
  const double distance = std::sqrt(along * along + across * across);
  return distance > 0.0 ? FromPoint{distance, along / distance, across / distance}
                        : FromPoint{0.0, -1.0, 0.0};
}

} // namespace

BroachedSpace::BroachedSpace(double tube_radius, const BroachedHole& hole) : hole_(hole), tube_(tube_radius) {
  check(tube_radius, hole);
  half_lobe_ = pi / hole.lands - 0.5 * hole.land_angle;
  if (hole.land_growth.empty())
    halves_.push_back(half_of(hole.land_radius));
  for (const double growth : hole.land_growth)
    halves_.push_back(half_of(hole.land_radius + growth));
  clearance_ = std::min_element(halves_.begin(), halves_.end(),
                                [](const Half& a, const Half& b) { return a.radius < b.radius; })
                   ->radius -
               tube_radius;
}

BroachedSpace::Half BroachedSpace::half_of(double land_radius) const {
  BroachedHole alike = hole_; // all lands of this radius
  alike.land_radius = land_radius;
  check(tube_, alike);
  const double x = edge_about_corner(tube_, alike, half_lobe_);
  const Seen edge = touching_corner(tube_, land_radius, x);
  return {
      land_radius, x, std::sin(x), std::cos(x), half_lobe_ - edge.angle < no_arc ? half_lobe_ : edge.angle,
      edge.radius};
}

/// What is nearest: its gap, and its normal and curvature in the directions e_r and e_angle of the node.
struct BroachedSpace::Nearest {
  double gap, along, across;
  double curvature;
};

BroachedSpace::Nearest BroachedSpace::nearest(double y, double z) const {
  const double r = std::sqrt(y * y + z * z);
  if (!(r > 0.0))
    return {clearance(), -1.0, 0.0, 0.0};
  const double from_first = std::atan2(z, y) - hole_.orientation, pitch = 2.0 * pi / hole_.lands;
  const double land = std::nearbyint(from_first / pitch), from_land = from_first - pitch * land;
  if (halves_.size() == 1)
    return nearest_in(halves_.front(), r, from_land);
  const int own = (static_cast<int>(land) % hole_.lands + hole_.lands) % hole_.lands;
  Nearest out = nearest_in(halves_[static_cast<std::size_t>(own)], r, from_land);
  for (int k = 1; k < hole_.lands; ++k) { // corners of the others
    const double from_other = std::remainder(from_land - k * pitch, 2.0 * pi);
    const double angle = std::abs(from_other) - 0.5 * hole_.land_angle;
    const FromPoint corner =
        from_point(halves_[static_cast<std::size_t>((own + k) % hole_.lands)].radius, -angle, r, from_other);
    if (const double gap = corner.distance - tube_; gap < out.gap && corner.distance > 0.0)
      out = {gap, corner.along, corner.across, 1.0 / corner.distance};
  }
  return out;
}

BroachedSpace::Nearest BroachedSpace::nearest_in(const Half& half, double r, double from_land) const {
  const double a = half.radius, land_clearance = a - tube_;
  const double angle = std::abs(from_land) - 0.5 * hole_.land_angle; // from the corner
  const auto on_circle = [&](double radius) { return Nearest{radius - r, -1.0, 0.0, -1.0 / r}; };
  const auto at_edge = [&] {
    const FromPoint edge = from_point(half.edge_radius, half.edge_angle - angle, r, from_land);
    return edge.distance > 0.0 ? Nearest{-edge.distance, -edge.along, -edge.across, -1.0 / edge.distance}
                               : Nearest{0.0, edge.along, edge.across, 0.0};
  };
  if (angle <= 0.0) {
    const Nearest land = on_circle(land_clearance);
    if (r <= a)
      return land;
    const Nearest edge = at_edge(); // deeper than the land is thick
    return edge.gap > land.gap ? edge : land;
  }
  const double s = std::sin(0.5 * angle);
  const bool has_corner = half.sin_x * ((a - r) + 2.0 * r * s * s) >= half.cos_x * r * std::sin(angle);
  const bool has_lobe = angle >= half.edge_angle && half.edge_angle < half_lobe_;
  if (!has_corner && !has_lobe)
    return at_edge();
  const Nearest lobe = on_circle(hole_.lobe_radius - tube_);
  if (!has_corner)
    return lobe;
  const FromPoint corner = from_point(a, -angle, r, from_land);
  const double gap = corner.distance - tube_;
  if (has_lobe && lobe.gap < gap)
    return lobe;
  return {gap, corner.along, corner.across, corner.distance > 0.0 ? 1.0 / corner.distance : 0.0};
}

Location BroachedSpace::locate(double y, double z) const {
  const Nearest at = nearest(y, z);
  const double r = std::sqrt(y * y + z * z);
  if (!(r > 0.0))
    return centred(at.gap);
  const double cy = y / r, cz = z / r; // e_r; e_angle = (-cz, cy)
  return {at.gap, at.along * cy - at.across * cz, at.along * cz + at.across * cy};
}

double BroachedSpace::curvature(double y, double z) const { return nearest(y, z).curvature; }

std::vector<PlanePoint> BroachedSpace::outline(int arc_points) const {
  std::vector<PlanePoint> points;
  const auto add = [&](double angle, double radius) {
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  };
  const double pitch = 2.0 * pi / hole_.lands, half_land = 0.5 * hole_.land_angle;
  for (int land = 0; land < hole_.lands; ++land) {
    const Half &half = halves_[static_cast<std::size_t>(land) % halves_.size()],
               &beyond = halves_[static_cast<std::size_t>(land + 1) % hole_.lands % halves_.size()];
    const double middle = hole_.orientation + land * pitch, next = middle + pitch;
    for (int k = 0; k < arc_points; ++k)
      add(middle - half_land + k * hole_.land_angle / arc_points, half.radius - tube_);
    const auto corner_at = [&](const Half& of, int k) {
      return touching_corner(tube_, of.radius, k * of.edge_x / arc_points);
    };
    for (int k = 0; k < arc_points; ++k)
      add(middle + half_land + corner_at(half, k).angle, corner_at(half, k).radius);
    const double arc = 2.0 * half_lobe_ - half.edge_angle - beyond.edge_angle;
    if (half.edge_angle < half_lobe_)
      for (int k = 0; k < arc_points; ++k)
        add(middle + half_land + half.edge_angle + k * arc / arc_points, half.edge_radius);
    for (int k = arc_points; k > 0; --k)
      add(next - half_land - corner_at(beyond, k).angle, corner_at(beyond, k).radius);
  }
  return points;
}

} // namespace fretwork::contact
