// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sides.hpp"
#include <algorithm>

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

} // namespace

std::vector<std::size_t> flat_sides(const Obstacle& obstacle) {
  if (const auto* planes = std::get_if<PlanePair>(&obstacle))
    return planes->axis == PlaneAxis::y ? std::vector<std::size_t>{0, 2} : std::vector<std::size_t>{1, 3};
  const auto* profile = std::get_if<Profile>(&obstacle);
  return profile && is_rectangle(*profile) ? std::vector<std::size_t>{0, 1, 2, 3}
                                           : std::vector<std::size_t>{};
}

} // namespace fretwork::contact
