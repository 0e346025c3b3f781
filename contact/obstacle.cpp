// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/obstacle.hpp"
#include <algorithm>
#include <numbers>
#include <utility>

namespace fretwork::contact {

namespace {

constexpr int ellipse_points = 180, points_of_arc = 16; ///< of outlines

/// -1/r or 1/r; 0 at the centre, where the normal is a choice that does not turn.
double of_circle(double sign, double y, double z) {
  const double r = std::sqrt(y * y + z * z);
  return r > 0.0 ? sign / r : 0.0;
}

/// Outward unit normal of the ellipse a >= b > 0 where it is nearest to (y, z), both >= 0.
PlanePoint nearest_normal(double a, double b, double y, double z) {
  const double focal = (a - b) * (a + b); // a^2 - b^2
  double s = std::max(b * z, a * y - focal);
  if (!(s > 0.0)) { // on the axis between the centres of curvature, both sides are as near: the upper one
    if (!(focal > 0.0))
      return {1.0, 0.0};
    const double across = a * y / focal; // of the nearest place, along the long axis by a
    const PlanePoint m{across / a, std::sqrt(std::max(0.0, 1.0 - across * across)) / b};
    const double length = std::sqrt(m.y * m.y + m.z * m.z);
    return {m.y / length, m.z / length};
  }
  for (;;) { // the sum of squares is convex and falls: each step stays below the root
    const double p = a * y / (s + focal), q = b * z / s;
    const double next = s + 0.5 * (p * p + q * q - 1.0) / (p * p / (s + focal) + q * q / s);
    if (!(next > s))
      break;
    s = next;
  }
  const double my = y / (s + focal), mz = z / s, length = std::sqrt(my * my + mz * mz);
  return {my / length, mz / length};
}

/// The same of any position and axes.
PlanePoint outward_normal(const Ellipse& e, double y, double z) {
  PlanePoint m{};
  if (e.semi_y >= e.semi_z) {
    m = nearest_normal(e.semi_y, e.semi_z, std::abs(y), std::abs(z));
  } else {
    m = nearest_normal(e.semi_z, e.semi_y, std::abs(z), std::abs(y));
    std::swap(m.y, m.z);
  }
  return {std::copysign(m.y, y), std::copysign(m.z, z)};
}

/// Where the ellipse has the outward normal m, along it: h.
double support_of(const Ellipse& e, PlanePoint m) {
  return std::sqrt(e.semi_y * e.semi_y * m.y * m.y + e.semi_z * e.semi_z * m.z * m.z);
}

} // namespace

Location locate(const Ellipse& ellipse, double y, double z) {
  const PlanePoint m = outward_normal(ellipse, y, z);
  return {support_of(ellipse, m) - (y * m.y + z * m.z) - ellipse.radius, -m.y, -m.z};
}

double curvature(const Obstacle& obstacle, double y, double z) {
  struct Visitor {
    double y, z;
    double operator()(const Circle&) const { return of_circle(-1.0, y, z); }
    double operator()(const PlanePair&) const { return 0.0; }
    double operator()(const Stop&) const { return 0.0; }
    double operator()(const RoundPair&) const { return of_circle(1.0, y, z); }
    double operator()(const FacingPlanes&) const { return 0.0; }
    double operator()(const Ellipse& e) const {
      const PlanePoint m = outward_normal(e, y, z);
      const double h = support_of(e, m), ab = e.semi_y * e.semi_z;
      const double from_centre = ab * ab / (h * h * h) - (h - y * m.y - z * m.z); // of curvature
      return from_centre > 0.0 ? -1.0 / from_centre : 0.0;
    }
    double operator()(const BroachedSpace& space) const { return space.curvature(y, z); }
    double operator()(const Profile& profile) const { return profile.curvature(y, z); }
  };
  return std::visit(Visitor{y, z}, obstacle);
}

ObstacleProperties properties_of(const Obstacle& obstacle) {
  struct Visitor {
    static GapBound plane(PlaneAxis axis, double limit, double radial, double linear) {
      return axis == PlaneAxis::y ? GapBound{1.0, 0.0, limit, radial, linear, 0.0}
                                  : GapBound{0.0, 1.0, limit, radial, 0.0, linear};
    }
    ObstacleProperties operator()(const Circle& c) const {
      return {.extent = c.gap,
              .gap_bound = {1.0, 1.0, c.gap},
              .is_bound_gap = true,
              .is_concave = true,
              .has_parts = false,
              .has_opposite_sides = true};
    }
    ObstacleProperties operator()(const PlanePair& p) const {
      return {.extent = p.gap,
              .gap_bound = plane(p.axis, p.gap, 1.0, 0.0),
              .is_bound_gap = true,
              .is_concave = true,
              .has_parts = false,
              .has_opposite_sides = true};
    }
    ObstacleProperties operator()(const Stop& s) const {
      return {.extent = std::abs(s.gap),
              .gap_bound = plane(s.axis, s.gap, 0.0, 1.0),
              .is_bound_gap = true,
              .is_concave = true,
              .has_parts = false,
              .has_opposite_sides = false};
    }
    ObstacleProperties operator()(const RoundPair& p) const {
      return {.extent = p.distance,
              .gap_bound = {1.0, 1.0, -p.distance, -1.0},
              .is_bound_gap = true,
              .is_concave = false,
              .has_parts = false,
              .has_opposite_sides = false};
    }
    ObstacleProperties operator()(const FacingPlanes& p) const {
      return {.extent = p.distance,
              .gap_bound = plane(p.axis, -p.distance, 0.0, -p.side),
              .is_bound_gap = true,
              .is_concave = true,
              .has_parts = false,
              .has_opposite_sides = false};
    }
    ObstacleProperties operator()(const Ellipse& e) const {
      const double least = std::min(e.semi_y, e.semi_z), largest = std::max(e.semi_y, e.semi_z);
      return {.extent = largest - e.radius,
              .gap_bound = {1.0, 1.0, least - e.radius},
              .is_bound_gap = false,
              .is_concave = true,
              .has_parts = least * least < e.radius * largest,
              .has_opposite_sides = true};
    }
    ObstacleProperties operator()(const BroachedSpace& s) const {
      return {.extent = s.clearance(),
              .gap_bound = {1.0, 1.0, s.clearance()},
              .is_bound_gap = false,
              .is_concave = false,
              .has_parts = true,
              .has_opposite_sides = true};
    }
    ObstacleProperties operator()(const Profile& p) const {
      return {.extent = p.inscribed(),
              .gap_bound = {1.0, 1.0, p.inscribed()},
              .is_bound_gap = false,
              .is_concave = false,
              .has_parts = true,
              .has_opposite_sides = true};
    }
  };
  return std::visit(Visitor{}, obstacle);
}

bool rolls_round(const Obstacle& obstacle, PlanePoint position, PlanePoint velocity, double dt) {
  constexpr double round_off = 1e-9; // of a distance from the centre
  struct Visitor {
    PlanePoint p, v;
    double dt;
    double speed;
    /// @param ahead  m, clearance along the path   @param across  m, from the centre to the tangents of the free space along it
    [[nodiscard]] bool misses(double ahead, double across) const {
      return ahead < speed * dt &&
             std::abs(p.y * v.z - p.z * v.y) > (across + round_off * std::hypot(p.y, p.z)) * speed;
    }
    bool operator()(const Circle& c) const { return misses(c.gap, c.gap); }
    bool operator()(const Ellipse& e) const {
      if (!(speed > 0.0))
        return false;
      const PlanePoint along{v.y / speed, v.z / speed}, across{along.z, -along.y};
      return misses(support_of(e, along) - e.radius, support_of(e, across) - e.radius);
    }
    // their walls turn at corners alone, which a shorter interval resolves
    bool operator()(const BroachedSpace&) const { return false; }
    bool operator()(const Profile&) const { return false; }
    // no hole
    bool operator()(const PlanePair&) const { return false; }
    bool operator()(const Stop&) const { return false; }
    bool operator()(const RoundPair&) const { return false; }
    bool operator()(const FacingPlanes&) const { return false; }
  };
  return std::visit(
      Visitor{position, velocity, dt, std::sqrt(velocity.y * velocity.y + velocity.z * velocity.z)},
      obstacle);
}

std::vector<PlanePoint> outline_of(const Obstacle& obstacle) {
  struct Visitor {
    std::vector<PlanePoint> operator()(const BroachedSpace& s) const { return s.outline(points_of_arc); }
    std::vector<PlanePoint> operator()(const Profile& p) const {
      return {p.vertices().begin(), p.vertices().end()};
    }
    /// The inner parallel curve at the distance `radius`, places of the body's centre, up to the corners on the long axis where the body
    /// touches at two places: there y^2 = (a^2 - b^2)(1 - R^2/b^2).
    std::vector<PlanePoint> operator()(const Ellipse& e) const {
      const double y2 = e.semi_y * e.semi_y, z2 = e.semi_z * e.semi_z, r2 = e.radius * e.radius;
      const PlanePoint corner{std::sqrt(std::max(0.0, (y2 - z2) * (1.0 - r2 / z2))),
                              std::sqrt(std::max(0.0, (z2 - y2) * (1.0 - r2 / y2)))};
      std::vector<PlanePoint> points;
      for (int k = 0; k < ellipse_points; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / ellipse_points;
        const double c = std::cos(angle), s = std::sin(angle);
        const double length = std::sqrt(c * c / (e.semi_y * e.semi_y) + s * s / (e.semi_z * e.semi_z));
        const double by_y = e.semi_y - e.radius / (e.semi_y * length),
                     by_z = e.semi_z - e.radius / (e.semi_z * length);
        const bool beyond_corner = by_y < 0.0 || by_z < 0.0;
        points.push_back(beyond_corner ? PlanePoint{std::copysign(corner.y, c), std::copysign(corner.z, s)}
                                       : PlanePoint{by_y * c, by_z * s});
      }
      return points;
    }
    std::vector<PlanePoint> operator()(const Circle&) const { return {}; }
    std::vector<PlanePoint> operator()(const PlanePair&) const { return {}; }
    std::vector<PlanePoint> operator()(const Stop&) const { return {}; }
    std::vector<PlanePoint> operator()(const RoundPair&) const { return {}; }
    std::vector<PlanePoint> operator()(const FacingPlanes&) const { return {}; }
  };
  return std::visit(Visitor{}, obstacle);
}

std::array<bool, 2> normal_directions(const Obstacle& obstacle) {
  const GapBound bound = properties_of(obstacle).gap_bound;
  return {bound.wy > 0.0, bound.wz > 0.0};
}

} // namespace fretwork::contact
