// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/near_nodes.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <numeric>
#include <tuple>

namespace fretwork::mesh {
namespace {

using Cell = std::array<std::int64_t, 3>;

/// Cells finer than this part of the extent would overflow their numbers; larger cells only cost time.
constexpr double smallest_cell = 1e-12;

bool before(const Vec3& a, const Vec3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

/// Union-find with the numbers of nodes.
class Sets {
public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index root(Index i) {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index a, Index b) { parent_[root(b)] = root(a); }

private:
  std::vector<Index> parent_;
};

void check_not_shorter(const RawMesh& mesh, double tolerance) {
  for (std::size_t i = 0; i < mesh.lines.size(); ++i) {
    const auto& [a, b] = mesh.lines[i].nodes;
    const double length = (mesh.nodes[a] - mesh.nodes[b]).norm();
    if (length < tolerance)
      throw core::Error(
          fmt::format("merge_tolerance = {} m is more than the length {} m of {}, which would vanish; "
                      "give a smaller one",
                      tolerance, length, describe_line(mesh, static_cast<Index>(i))));
  }
}

} // namespace

double extent(std::span<const Vec3> nodes) {
  if (nodes.empty())
    return 0.0;
  Vec3 low = nodes[0], high = nodes[0];
  for (const Vec3& x : nodes) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (high - low).maxCoeff();
}

std::vector<std::pair<Index, Index>> near_pairs(std::span<const Vec3> nodes, double distance) {
  std::vector<std::pair<Index, Index>> pairs;
  if (nodes.size() < 2)
    return pairs;
  const Vec3 low = std::accumulate(nodes.begin(), nodes.end(), nodes[0],
                                   [](const Vec3& a, const Vec3& b) -> Vec3 { return a.cwiseMin(b); });
  const double size = std::max(distance, smallest_cell * extent(nodes));
  const auto cell_of = [&](const Vec3& x) -> Cell {
    if (size == 0.0)
      return {0, 0, 0};
    const Vec3 at = (x - low) / size;
    return {std::int64_t(at.x()), std::int64_t(at.y()), std::int64_t(at.z())};
  };
  std::vector<std::pair<Cell, Index>> sorted(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sorted[i] = {cell_of(nodes[i]), static_cast<Index>(i)};
  std::sort(sorted.begin(), sorted.end());

  // Neighbours of ascending cells ascend too: nine cursors (one for each row of three cells along z) pass
  // once over the list.
  std::array<std::size_t, 9> cursors{};
  for (const auto& [cell, node] : sorted)
    for (std::size_t row = 0; row < 9; ++row) {
      const Cell first{cell[0] + std::int64_t(row / 3) - 1, cell[1] + std::int64_t(row % 3) - 1, cell[2] - 1};
      std::size_t& cursor = cursors[row];
      while (cursor < sorted.size() && sorted[cursor].first < first)
        ++cursor;
      const Cell last{first[0], first[1], cell[2] + 1};
      for (std::size_t k = cursor; k < sorted.size() && sorted[k].first <= last; ++k)
        if (const Index other = sorted[k].second;
            node < other && (nodes[node] - nodes[other]).norm() <= distance)
          pairs.emplace_back(node, other);
    }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::string describe_line(const RawMesh& mesh, Index line) {
  const auto& [a, b] = mesh.lines[line].nodes;
  const Vec3 &p = mesh.nodes[a], &q = mesh.nodes[b];
  std::string text = fmt::format("line ({:.6g}, {:.6g}, {:.6g})-({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(),
                                 p.z(), q.x(), q.y(), q.z());
  for (const auto& [name, lines] : mesh.curves)
    if (std::find(lines.begin(), lines.end(), line) != lines.end())
      return text + " of \"" + name + "\"";
  return text;
}

std::size_t merge_nodes(RawMesh& mesh, double tolerance) {
  check_not_shorter(mesh, tolerance);
  Sets sets(mesh.nodes.size());
  for (const auto& [a, b] : near_pairs(mesh.nodes, tolerance))
    if ((mesh.nodes[a] - mesh.nodes[b]).norm() < tolerance)
      sets.join(a, b);
  for (std::size_t i = 0; i < mesh.lines.size(); ++i)
    if (sets.root(mesh.lines[i].nodes[0]) == sets.root(mesh.lines[i].nodes[1]))
      throw core::Error(
          fmt::format("merge_tolerance = {} m makes one node of both ends of {}; give a smaller one",
                      tolerance, describe_line(mesh, static_cast<Index>(i))));

  std::vector<Index> chosen(mesh.nodes.size(), -1);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    Index& best = chosen[sets.root(static_cast<Index>(i))];
    if (best < 0 || before(mesh.nodes[i], mesh.nodes[best]))
      best = static_cast<Index>(i);
  }
  std::size_t merged = 0;
  const auto moved = [&](Index node) { return node < 0 ? node : chosen[sets.root(node)]; };
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    merged += moved(static_cast<Index>(i)) != static_cast<Index>(i) ? 1 : 0;
  for (RawLine& line : mesh.lines)
    line = {{moved(line.nodes[0]), moved(line.nodes[1])}, moved(line.middle)};
  for (auto& [name, nodes] : mesh.points)
    std::transform(nodes.begin(), nodes.end(), nodes.begin(), moved);
  return merged;
}

} // namespace fretwork::mesh
