// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/support_shapes.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <string_view>

namespace fretwork::contact {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double most_points_of_hole = 1e6;
constexpr double no_arc =
    1e-9; // rad: a lobe's arc that rounding alone leaves between the circles of its corners

void check_size(std::string_view object, std::string_view name, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw core::Error(fmt::format("{}: {} = {:g} m makes no sense; give a length > 0", object, name, value));
}

void check_room(std::string_view object, double tube_radius, std::string_view name, double room) {
  check_size(object, "tube radius", tube_radius);
  check_size(object, name, room);
  if (room < tube_radius)
    throw core::Error(
        fmt::format("{}: {} = {:g} m is less than the tube radius, {:g} m; give at least the tube radius",
                    object, name, room, tube_radius));
}

void check_clearance(std::string_view object, double tube_radius, std::string_view name, double room) {
  check_room(object, tube_radius, name, room);
  if (room == tube_radius)
    throw core::Error(fmt::format(
        "{}: {} = {:g} m is the tube radius and leaves no room; give a radius or width with a clearance",
        object, name, room));
}

constexpr std::string_view broached = "broached hole";

void check_broached(double tube_radius, const BroachedHole& hole, double chord_error) {
  check_clearance(broached, tube_radius, "land radius", hole.land_radius);
  check_size(broached, "lobe radius", hole.lobe_radius);
  check_size(broached, "chord error", chord_error);
  if (chord_error >= hole.land_radius - tube_radius)
    throw core::Error(fmt::format("broached hole: chord error = {:g} m is not less than the clearance at the "
                                  "lands, {:g} m; give a small part of it",
                                  chord_error, hole.land_radius - tube_radius));
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
  if (!std::isfinite(hole.orientation))
    throw core::Error(
        fmt::format("broached hole: orientation = {:g} rad makes no sense; give the angle of the first land",
                    hole.orientation));
}

/// Chords of an arc that stray from it by no more than `error` < radius: the sagitta of a chord over the
/// angle d is 2 r sin^2(d/4).
double chords(double radius, double angle, double error) {
  const double s = std::sqrt(0.5 * error / radius);
  return std::max(1.0, std::ceil(angle / (4.0 * std::asin(s))));
}

/// The free space's edge from a land's corner to the middle of the lobe; angles from the corner's direction.
struct HalfLobe {
  double corner_angle; ///< about the corner, at which its circle ends
  double edge; ///< at which the corner's circle ends; the lobe's circle follows up to half_angle, if less
  double half_angle; ///< to the middle of the lobe
};

HalfLobe half_lobe(double t, const BroachedHole& hole) {
  const double a = hole.land_radius, b = hole.lobe_radius, half = pi / hole.lands - 0.5 * hole.land_angle;
  const double last_seen = std::acos(t / a);
  // the circle of the corner against that of the lobe: sin^2 of half the angle, > 1 where it ends before
  const double meets_lobe = (b - a) * (b + a - 2.0 * t) / (4.0 * a * t);
  const double x = meets_lobe < 1.0 ? 2.0 * std::asin(std::sqrt(meets_lobe)) : pi;
  const auto seen_at = [&](double angle) {
    const double s = std::sin(0.5 * angle);
    return std::atan2(t * std::sin(angle), (a - t) + 2.0 * t * s * s);
  };
  if (x < last_seen && seen_at(x) < half)
    return {x, seen_at(x), half};
  if (half < seen_at(last_seen)) { // the angle about the corner of the direction `half`: the sine rule
    const double sine = a * std::sin(half) / t; // of the angle between the two radii, at the tube's centre
    return {std::asin(std::min(sine, 1.0)) - half, half, half};
  }
  throw core::Error(fmt::format("broached hole: a tube of radius {:g} m passes behind the corner of a land "
                                "(land radius {:g} m, lobe radius {:g} m, lobe of {:g} "
                                "rad); give a smaller lobe radius or a larger land angle",
                                t, a, b, 2.0 * half));
}

} // namespace

Circle drilled_hole(double tube_radius, double hole_radius) {
  check_room("drilled hole", tube_radius, "hole radius", hole_radius);
  return {hole_radius - tube_radius};
}

Ellipse elliptic_hole(double tube_radius, double semi_y, double semi_z) {
  check_clearance("elliptic hole", tube_radius, "semi-axis along y", semi_y);
  check_clearance("elliptic hole", tube_radius, "semi-axis along z", semi_z);
  return {semi_y, semi_z, tube_radius};
}

Obstacle flat_bars(double tube_radius, double distance, PlaneAxis axis, BarSides sides) {
  check_room("flat bars", tube_radius, "distance", distance);
  if (sides == BarSides::one)
    return Stop{distance - tube_radius, axis};
  return PlanePair{distance - tube_radius, axis};
}

OffsetPlanes flat_bars_between(double tube_radius, double negative_side, double positive_side,
                               PlaneAxis axis) {
  if (!(negative_side + positive_side > 0.0))
    throw core::Error(
        fmt::format("flat bars: {:g} m from the centre towards the negative side and {:g} m towards "
                    "the positive one leave nothing between the bars; give two distances > 0",
                    negative_side, positive_side));
  check_room("flat bars", tube_radius, "half the distance between the bars",
             0.5 * (negative_side + positive_side));
  return {{0.5 * (negative_side + positive_side) - tube_radius, axis}, 0.5 * (positive_side - negative_side)};
}

Profile egg_crate(double tube_radius, double half_width_y, double half_width_z) {
  check_clearance("egg crate", tube_radius, "half width along y", half_width_y);
  check_clearance("egg crate", tube_radius, "half width along z", half_width_z);
  const double y = half_width_y - tube_radius, z = half_width_z - tube_radius;
  const double angle = std::atan2(z, y), radius = std::sqrt(y * y + z * z);
  const PolarPoint corners[] = {
      {angle, radius}, {pi - angle, radius}, {pi + angle, radius}, {2.0 * pi - angle, radius}};
  return Profile(corners);
}

Profile broached_hole(double tube_radius, const BroachedHole& hole, double chord_error) {
  check_broached(tube_radius, hole, chord_error);
  const double t = tube_radius, a = hole.land_radius, b = hole.lobe_radius;
  const HalfLobe lobe = half_lobe(t, hole);
  const double free_arc = 2.0 * (lobe.half_angle - lobe.edge);
  const double land_chords = chords(a - t, hole.land_angle, chord_error);
  const double corner_chords = chords(t, lobe.corner_angle, chord_error);
  const double lobe_chords = free_arc > no_arc ? chords(b - t, free_arc, chord_error) : 0.0;
  const double number = hole.lands * (land_chords + 2.0 * corner_chords + lobe_chords);
  if (number > most_points_of_hole)
    throw core::Error(
        fmt::format("broached hole: chord error = {:g} m asks for {:.2g} points; give a larger one",
                    chord_error, number));

  std::vector<PolarPoint> points;
  points.reserve(static_cast<std::size_t>(number));
  const double pitch = 2.0 * pi / hole.lands;
  const auto from_corner =
      [&](double share) { // a point of the corner's circle, angle from the corner's direction
        const double x = share * lobe.corner_angle, s = std::sin(0.5 * x);
        return PolarPoint{std::atan2(t * std::sin(x), (a - t) + 2.0 * t * s * s),
                          std::sqrt((a - t) * (a - t) + 4.0 * a * t * s * s)};
      };
  for (int land = 0; land < hole.lands; ++land) {
    const double start = hole.orientation + land * pitch - 0.5 * hole.land_angle;
    const double corner = start + hole.land_angle, next = start + pitch;
    for (double k = 0.0; k < land_chords; ++k)
      points.push_back({start + k / land_chords * hole.land_angle, a - t});
    for (double k = 0.0; k < corner_chords; ++k) {
      const auto [angle, radius] = from_corner(k / corner_chords);
      points.push_back({corner + angle, radius});
    }
    for (double k = 0.0; k < lobe_chords; ++k)
      points.push_back({corner + lobe.edge + k / lobe_chords * free_arc, b - t});
    for (double k = corner_chords; k > 0.0; --k) {
      const auto [angle, radius] = from_corner(k / corner_chords);
      points.push_back({next - angle, radius});
    }
  }
  return Profile(points);
}

} // namespace fretwork::contact
