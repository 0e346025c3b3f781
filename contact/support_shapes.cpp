// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/support_shapes.hpp"
#include "contact/support_sizes.hpp"
#include "core/error.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::contact {
namespace {

constexpr const char* how_to_press = ". Bars that press on the tube are two contacts of one bar each: in "
                                     "both bars = tube_radius and a negative "
                                     "offset along the normal of the bar, in the second also the opposite "
                                     "y_axis (or, without y_axis, angle = 180)";

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
  check_room("flat bars", tube_radius, "distance", distance, how_to_press);
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
             0.5 * (negative_side + positive_side), how_to_press);
  return {{0.5 * (negative_side + positive_side) - tube_radius, axis}, 0.5 * (positive_side - negative_side)};
}

Profile egg_crate(double tube_radius, double half_width_y, double half_width_z) {
  check_clearance("egg crate", tube_radius, "half width along y", half_width_y);
  check_clearance("egg crate", tube_radius, "half width along z", half_width_z);
  const double y = half_width_y - tube_radius, z = half_width_z - tube_radius;
  constexpr double pi = std::numbers::pi;
  const double angle = std::atan2(z, y), radius = std::sqrt(y * y + z * z);
  const PolarPoint corners[] = {
      {angle, radius}, {pi - angle, radius}, {pi + angle, radius}, {2.0 * pi - angle, radius}};
  return Profile(corners);
}

} // namespace fretwork::contact
