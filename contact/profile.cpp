// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/profile.hpp"
#include "contact/facet_index.hpp"
#include "contact/obstacle.hpp"
#include "core/error.hpp"
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <vector>

namespace fretwork::contact {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double same_angle = 1e-9;    // rad: what decimal degrees leave of one turn or half a turn
constexpr double same_radius = 1e-9;   // relative, for the same reason
constexpr double nearly_closed = 1e-6; // of the radius: what six digits leave of a point written twice; a
                                       // facet of a million is longer
constexpr double same_point = 1e-12;   // of the radius: a shorter facet has no direction in double precision
constexpr double smallest = 1e-100, largest = 1e100; // m: squares of radii stay numbers
constexpr double no_direction =
    8.0 * std::numeric_limits<double>::epsilon(); // of the radius: rounding of a position

constexpr std::size_t most_points = 1000000; // whose cells take a minute or two to make

std::string name(std::size_t k, const PolarPoint& p) {
  return fmt::format("point {} ({:.12g} degrees, {:g} m)", k + 1, p.angle * 360.0 / turn, p.radius);
}

[[noreturn]] void refuse(const std::string& what) { throw core::Error("profile: " + what); }

void check_values(std::span<const PolarPoint> points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto [angle, radius] = points[k];
    if (!std::isfinite(angle) || !std::isfinite(radius))
      refuse(name(k, points[k]) + " is not a finite number; give an angle and a radius");
    if (radius <= 0.0)
      refuse(name(k, points[k]) +
             " has no positive radius; give the distance from the obstacle's origin, > 0");
    if (radius < smallest || radius > largest)
      refuse(name(k, points[k]) + " is no size of a hole; give the radius in metres");
  }
}

void check_order(std::span<const PolarPoint> points) {
  for (std::size_t k = 1; k < points.size(); ++k) {
    const PolarPoint &before = points[k - 1], &p = points[k];
    if (p.angle == before.angle && p.radius == before.radius)
      refuse(name(k - 1, before) + " and " + name(k, p) + " are equal; leave one out");
    if (p.angle == before.angle)
      refuse(name(k - 1, before) + " and " + name(k, p) +
             " have the same angle; make it a little larger in the second");
    if (p.angle < before.angle)
      refuse(name(k, p) + " comes after " + name(k - 1, before) + "; sort the points by increasing angle");
    if (p.angle - points[0].angle > turn + same_angle)
      refuse(name(k, p) + " is more than one turn after " + name(0, points[0]) +
             "; keep the angles within 360 degrees");
  }
}

/// Leaves out a last point that repeats the first.
std::span<const PolarPoint> one_turn(std::span<const PolarPoint> points) {
  const PolarPoint &first = points.front(), &last = points.back();
  const double missing = turn - (last.angle - first.angle);
  if (missing > same_angle) {
    if (missing < nearly_closed && std::abs(last.radius - first.radius) < nearly_closed * first.radius)
      refuse(name(points.size() - 1, last) + " nearly repeats " + name(0, first) +
             " but does not close the " +
             "hole; repeat the first point exactly, one turn later, or leave the last out");
    return points;
  }
  if (std::abs(last.radius - first.radius) > same_radius * first.radius)
    refuse(name(points.size() - 1, last) + " closes the turn but is not " + name(0, first) +
           "; repeat the first point or leave the last out");
  return points.first(points.size() - 1);
}

void check_number(std::size_t number) {
  if (number < 3)
    refuse(fmt::format(
        "{} point{} do{} not enclose a hole; give at least 3, by increasing angle within one turn", number,
        number == 1 ? "" : "s", number == 1 ? "es" : ""));
  if (number > most_points)
    refuse(fmt::format("{} points are more than any hole is known by; give at most {}", number, most_points));
}

void check_inside(std::span<const PolarPoint> points, std::span<const PlanePoint> vertices) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t next = (k + 1) % points.size();
    const double between = points[next].angle - points[k].angle + (next == 0 ? turn : 0.0);
    const std::string pair = name(k, points[k]) + " and " + name(next, points[next]);
    if (between > std::numbers::pi - same_angle)
      refuse(fmt::format(
          "between {} the angle is {:.12g} degrees, so that the obstacle's origin is not inside the hole; "
          "leave less than 180 degrees between neighbours or move the origin",
          pair, between * 360.0 / turn));
    const double length = std::hypot(vertices[next].y - vertices[k].y, vertices[next].z - vertices[k].z);
    if (length <= same_point * points[k].radius)
      refuse(pair + " are equal to rounding; leave one out");
  }
}

/// To the inside of the corner between the facets `in` and `out`, of any length: along both normals, or, where
/// the facets fold back and their normals cancel, along the difference of the directions.
PlanePoint inwards_of(const Facet& in, const Facet& out) {
  PlanePoint m{-in.uz - out.uz, in.uy + out.uy};
  if (in.uy * out.uy + in.uz * out.uz < 0.0) {
    const double side = in.uy * out.uz - in.uz * out.uy < 0.0 ? -1.0 : 1.0;
    m = {side * (out.uy - in.uy), side * (out.uz - in.uz)};
  }
  return m;
}

/// On a corner itself the normal is the bisector.
Location on_corner(double gap, PlanePoint inwards) {
  const double length = std::sqrt(inwards.y * inwards.y + inwards.z * inwards.z);
  return {gap, inwards.y / length, inwards.z / length};
}

/// Against the line of a facet, `w` = node - any point of the line.
Location on_line(const Facet& f, double wy, double wz) { return {f.uy * wz - f.uz * wy, -f.uz, f.uy}; }

/// Whether a node, `w` from the corner v, is on it.
bool is_on_corner(PlanePoint v, double wy, double wz) {
  return wy * wy + wz * wz <= no_direction * no_direction * (v.y * v.y + v.z * v.z);
}

/// Whether the foot of a node is at an end of its facet, or by rounding. Rounding chooses between the two facets of a corner, so that nothing
/// could predict at which end of one it is: one branch for both.
bool at_end(const Facet& f, double along, double y, double z) {
  return std::min(along, f.length - along) <= no_direction * (std::abs(y) + std::abs(z));
}

} // namespace

struct Profile::Tables {
  std::vector<PlanePoint> vertices;
  FacetIndex index;
  double inscribed;
};

Profile::Profile(std::span<const PolarPoint> points) {
  check_number(points.size());
  check_values(points);
  check_order(points);
  points = one_turn(points);
  check_number(points.size());
  std::vector<PlanePoint> vertices;
  vertices.reserve(points.size());
  for (const auto& [angle, radius] : points)
    vertices.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  check_inside(points, vertices);

  FacetIndex index(vertices);
  auto tables = std::make_shared<Tables>(Tables{std::move(vertices), std::move(index), 0.0});
  tables_ = tables;
  tables->inscribed = locate(0.0, 0.0).gap;
}

double Profile::inscribed() const { return tables_->inscribed; }

std::span<const PlanePoint> Profile::vertices() const& { return tables_->vertices; }

Location Profile::locate(double y, double z) const {
  const std::uint32_t k = tables_->index.nearest(y, z);
  const Facet& f = tables_->index[k];
  const double wy = y - f.ay, wz = z - f.az, along = wy * f.uy + wz * f.uz;
  if (!at_end(f, along, y, z))
    return on_line(f, wy, wz);
  return locate_at_corner(corner_of(k, along), y, z);
}

double Profile::curvature(double y, double z) const {
  const std::uint32_t k = tables_->index.nearest(y, z);
  const Facet& f = tables_->index[k];
  const double along = (y - f.ay) * f.uy + (z - f.az) * f.uz;
  if (!(std::min(along, f.length - along) <= 0.0))
    return 0.0;
  const std::uint32_t corner = corner_of(k, along);
  const PlanePoint v = tables_->vertices[corner];
  if (is_on_corner(v, y - v.y, z - v.z))
    return 0.0;
  return 1.0 / locate_at_corner(corner, y, z).gap;
}

/// At the end of facet k to which `along` is nearer.
std::uint32_t Profile::corner_of(std::uint32_t k, double along) const {
  const std::uint32_t corner = k + (along + along > tables_->index[k].length ? 1u : 0u);
  return corner == tables_->index.size() ? 0 : corner;
}

Location Profile::locate_at_corner(std::uint32_t corner, double y, double z) const {
  const FacetIndex& index = tables_->index;
  const Facet in = index[(corner == 0 ? index.size() : corner) - 1], out = index[corner];
  const PlanePoint v{out.ay, out.az}, m = inwards_of(in, out);
  const double wy = y - v.y, wz = z - v.z, distance = std::sqrt(wy * wy + wz * wz);
  const double inwards = wy * m.y + wz * m.z;
  if (is_on_corner(v, wy, wz))
    return on_corner(std::copysign(distance, inwards), m);
  // rounding chose the corner where the foot is on one of its facets
  if (wy * out.uy + wz * out.uz > 0.0)
    return on_line(out, wy, wz);
  if (wy * in.uy + wz * in.uz < 0.0)
    return on_line(in, wy, wz);
  const double signed_distance = std::copysign(distance, inwards);
  return {signed_distance, wy / signed_distance, wz / signed_distance};
}

} // namespace fretwork::contact
