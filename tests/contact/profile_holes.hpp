// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Holes of many shapes.
#pragma once
#include "contact/profile.hpp"
#include "uniform.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace fretwork::tests::holes {

using contact::PolarPoint;
using contact::Profile;

constexpr double pi = std::numbers::pi;

inline std::vector<PolarPoint> polygon(int n, auto radius, double turned = 0.0) {
  std::vector<PolarPoint> points;
  for (int k = 0; k < n; ++k)
    points.push_back({2.0 * pi * k / n + turned, radius(2.0 * pi * k / n)});
  return points;
}
inline std::vector<PolarPoint> jagged(int n, std::uint64_t seed) {
  tests::Uniform uniform(seed);
  std::vector<PolarPoint> points;
  for (int k = 0; k < n; ++k)
    points.push_back({2.0 * pi * (k + uniform(-0.45, 0.45)) / n, uniform(0.4, 1.2)});
  return points;
}
inline double round_hole(double) { return 1.0; }
inline double trefoil(double angle) { return 0.7 + 0.4 * std::cos(3.0 * angle); }
inline double quatrefoil(double angle) { return 0.8 + 0.3 * std::cos(4.0 * angle); }
inline double slot(double angle) {
  return std::min(1.0 / std::abs(std::cos(angle)), 0.05 / std::abs(std::sin(angle)));
}

/// Holes from few to many facets, convex or not, smooth or not.
inline std::vector<Profile> all() {
  return {Profile(polygon(3, round_hole)),
          Profile(polygon(4, round_hole, 0.3)),
          Profile(polygon(10, round_hole)),
          Profile(polygon(997, round_hole)),
          Profile(polygon(60, trefoil)),
          Profile(polygon(2000, trefoil, -1.0)),
          Profile(polygon(301, quatrefoil)),
          Profile(polygon(400, slot, 0.01)),
          Profile(jagged(7, 1)),
          Profile(jagged(50, 2)),
          Profile(jagged(400, 3))};
}

} // namespace fretwork::tests::holes
