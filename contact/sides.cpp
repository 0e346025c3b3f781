// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sides.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::contact {

namespace {

/// Four corners, of which neighbours share a coordinate: up to the round-off of polar points.
bool is_rectangle(const Profile& profile) {
  constexpr double round_off = 1e-9;
  const auto corners = profile.vertices();
  if (corners.size() != 4)
    return false;
  for (std::size_t i = 0; i < 4; ++i) {
    const PlanePoint &a = corners[i], &b = corners[(i + 1) % 4];
    const double y = std::abs(b.y - a.y), z = std::abs(b.z - a.z);
    if (std::min(y, z) > round_off * std::max(y, z))
      return false;
  }
  return true;
}

std::vector<Side> flat(std::initializer_list<std::size_t> numbers) {
  std::vector<Side> out;
  for (const std::size_t number : numbers)
    out.push_back({number, flat_side_names[number]});
  return out;
}

std::string name_of_land(std::size_t number) { return fmt::format("land {}", number + 1); }

struct SidesOf {
  std::vector<Side> operator()(const PlanePair& planes) const {
    return planes.axis == PlaneAxis::y ? flat({0, 2}) : flat({1, 3});
  }
  std::vector<Side> operator()(const Stop& stop) const {
    return stop.axis == PlaneAxis::y ? flat({0}) : flat({1});
  }
  std::vector<Side> operator()(const Profile& profile) const {
    return is_rectangle(profile) ? flat({0, 1, 2, 3}) : std::vector<Side>{};
  }
  std::vector<Side> operator()(const BroachedSpace& space) const {
    const auto lands = static_cast<std::size_t>(space.hole().lands);
    std::vector<Side> out;
    for (std::size_t number = 0; number < lands && lands <= most_sides; ++number)
      out.push_back({number, name_of_land(number)});
    return out;
  }
  template <class One> std::vector<Side> operator()(const One&) const { return {}; }
};

} // namespace

std::vector<Side> sides_of(const Obstacle& obstacle) { return std::visit(SidesOf{}, obstacle); }

std::optional<std::size_t> side_number(const std::string& name) {
  for (std::size_t number = 0; number < flat_side_names.size(); ++number)
    if (name == flat_side_names[number])
      return number;
  for (std::size_t number = 0; number < most_sides; ++number)
    if (name == name_of_land(number))
      return number;
  return {};
}

SideFinder::SideFinder(const Obstacle& obstacle) {
  const auto* space = std::get_if<BroachedSpace>(&obstacle);
  if (!space || space->hole().lands > static_cast<int>(most_sides))
    return;
  lands_ = space->hole().lands;
  orientation_ = space->hole().orientation;
  half_land_ = 0.5 * space->hole().land_angle;
}

std::size_t SideFinder::land_of(const ContactAxes& axes) const {
  const double pitch = 2.0 * std::numbers::pi / lands_;
  const double from_first = std::atan2(-axes.nz, -axes.ny) - orientation_;
  const int land =
      static_cast<int>(std::nearbyint(std::remainder(from_first, 2.0 * std::numbers::pi) / pitch));
  return static_cast<std::size_t>((land + lands_) % lands_);
}

} // namespace fretwork::contact
