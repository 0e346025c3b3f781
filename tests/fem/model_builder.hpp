// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Models for tests, built node by node.
#pragma once
#include "fem/model.hpp"
#include "fem/section.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fretwork::tests {

using core::Index;
using core::Vec3;

/// Bit masks of restraints.
enum Restraint : unsigned { ux = 1, uy = 2, uz = 4, rx = 8, ry = 16, rz = 32, all = 63 };

struct ModelBuilder {
  fem::Model model;

  Index node(const Vec3& point) {
    model.nodes.push_back(point);
    model.fixed.push_back(0);
    return static_cast<Index>(model.nodes.size()) - 1;
  }

  Index property(const fem::BeamProperty& value) {
    model.properties.push_back(value);
    return static_cast<Index>(model.properties.size()) - 1;
  }

  void fix(Index n, unsigned dofs) {
    auto& bits = model.fixed[static_cast<std::size_t>(n)];
    bits = static_cast<std::uint8_t>(bits | dofs);
  }

  void fix_everywhere(unsigned dofs) {
    for (Index n = 0; n < static_cast<Index>(model.nodes.size()); ++n)
      fix(n, dofs);
  }

  /// Beams along points; starts from an existing node where `from` is given (points then continue from it).
  std::vector<Index> chain(const std::vector<Vec3>& points, Index number, Index from = -1) {
    std::vector<Index> nodes;
    if (from >= 0)
      nodes.push_back(from);
    for (const Vec3& point : points) {
      nodes.push_back(node(point));
      if (nodes.size() > 1)
        model.beams.push_back({nodes[nodes.size() - 2], nodes.back(), number});
    }
    return nodes;
  }

  /// n equal beams from a to b, all nodes new.
  std::vector<Index> line(const Vec3& a, const Vec3& b, int n, Index number) {
    std::vector<Vec3> points;
    for (int i = 0; i <= n; ++i)
      points.push_back(a + (b - a) * (static_cast<double>(i) / n));
    return chain(points, number);
  }

  /// n equal beams from an existing node to b.
  std::vector<Index> line_from(Index from, const Vec3& b, int n, Index number) {
    const Vec3 a = model.nodes[static_cast<std::size_t>(from)];
    std::vector<Vec3> points;
    for (int i = 1; i <= n; ++i)
      points.push_back(a + (b - a) * (static_cast<double>(i) / n));
    return chain(points, number, from);
  }

  /// n equal chords of the circle centre + radius (u cos t + v sin t), from an existing node at t0 to t1.
  std::vector<Index> arc_from(Index from, const Vec3& centre, const Vec3& u, const Vec3& v, double t0,
                              double t1, int n, Index number) {
    std::vector<Vec3> points;
    for (int i = 1; i <= n; ++i) {
      const double t = t0 + (t1 - t0) * i / n;
      points.push_back(centre + u * std::cos(t) + v * std::sin(t));
    }
    return chain(points, number, from);
  }

  /// The same with n arcs.
  std::vector<Index> arcs_from(Index from, const Vec3& centre, const Vec3& u, const Vec3& v, double t0,
                               double t1, int n, Index number) {
    const std::size_t first = model.beams.size();
    const auto nodes = arc_from(from, centre, u, v, t0, t1, n, number);
    for (int i = 0; i < n; ++i) {
      const double t = t0 + (t1 - t0) * (i + 0.5) / n;
      model.beams[first + static_cast<std::size_t>(i)].middle = centre + u * std::cos(t) + v * std::sin(t);
    }
    return nodes;
  }
};

/// A steam generator tube: 19.05 x 1.09 mm.
inline fem::BeamProperty tube_property() {
  return {{2.0e11, 0.3, 8000.0}, fem::pipe_section(0.01905, 0.00109)};
}

} // namespace fretwork::tests
