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

/// Outward normals of the facets of a convex polygon of few corners, none of them straight; else empty.
std::vector<PlanePoint> normals_of(const Profile& profile) {
  constexpr double straight = 1e-6; // sine of the turn at a corner
  const auto corners = profile.vertices();
  const std::size_t n = corners.size();
  if (n > most_sides)
    return {};
  std::vector<PlanePoint> out;
  for (std::size_t i = 0; i < n; ++i) {
    const PlanePoint &a = corners[i], &b = corners[(i + 1) % n];
    const double length = std::hypot(b.y - a.y, b.z - a.z);
    out.push_back({(b.z - a.z) / length, -(b.y - a.y) / length});
  }
  for (std::size_t i = 0; i < n; ++i) {
    const PlanePoint &a = out[i], &b = out[(i + 1) % n];
    if (!(a.y * b.z - a.z * b.y > straight))
      return {};
  }
  return out;
}

std::vector<Side> flat(std::initializer_list<std::size_t> numbers) {
  std::vector<Side> out;
  for (const std::size_t number : numbers)
    out.push_back({number, flat_side_names[number]});
  return out;
}

std::string name_of_land(std::size_t number) { return fmt::format("land {}", number + 1); }

std::string name_of_facet(std::size_t number) { return fmt::format("facet {}", number + 1); }

struct SidesOf {
  std::vector<Side> operator()(const PlanePair& planes) const {
    return planes.axis == PlaneAxis::y ? flat({0, 2}) : flat({1, 3});
  }
  std::vector<Side> operator()(const Stop& stop) const {
    return stop.axis == PlaneAxis::y ? flat({0}) : flat({1});
  }
  std::vector<Side> operator()(const Profile& profile) const {
    if (is_rectangle(profile))
      return flat({0, 1, 2, 3});
    std::vector<Side> out;
    for (std::size_t number = 0, count = normals_of(profile).size(); number < count; ++number)
      out.push_back({number, name_of_facet(number)});
    return out;
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
    if (name == name_of_land(number) || name == name_of_facet(number))
      return number;
  return {};
}

std::vector<PlanePoint> facet_normals(const Obstacle& obstacle) {
  const auto* profile = std::get_if<Profile>(&obstacle);
  return profile && !is_rectangle(*profile) ? normals_of(*profile) : std::vector<PlanePoint>{};
}

SideFinder::SideFinder(const Obstacle& obstacle) : facets_(facet_normals(obstacle)) {
  const auto* space = std::get_if<BroachedSpace>(&obstacle);
  if (!space || space->hole().lands > static_cast<int>(most_sides))
    return;
  lands_ = space->hole().lands;
  orientation_ = space->hole().orientation;
  half_land_ = 0.5 * space->hole().land_angle;
}

std::size_t SideFinder::facet_of(const ContactAxes& axes) const {
  const auto off = [&](const PlanePoint& facet) { return axes.ny * facet.y + axes.nz * facet.z; };
  const auto nearest = std::min_element(facets_.begin(), facets_.end(),
                                        [&](const auto& a, const auto& b) { return off(a) < off(b); });
  return static_cast<std::size_t>(nearest - facets_.begin());
}

std::size_t SideFinder::land_of(const ContactAxes& axes) const {
  const double pitch = 2.0 * std::numbers::pi / lands_;
  const double from_first = std::atan2(-axes.nz, -axes.ny) - orientation_;
  const int land =
      static_cast<int>(std::nearbyint(std::remainder(from_first, 2.0 * std::numbers::pi) / pitch));
  return static_cast<std::size_t>((land + lands_) % lands_);
}

} // namespace fretwork::contact
