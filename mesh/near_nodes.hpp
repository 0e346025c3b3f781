// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Nodes at the same place: found by sorting them into cells, O(n log n) as long as few nodes share a cell.
#pragma once
#include "mesh/raw_mesh.hpp"
#include <span>
#include <utility>
#include <vector>

namespace fretwork::mesh {

/// Largest side of the box round the nodes, m.
[[nodiscard]] double extent(std::span<const Vec3> nodes);

/// All pairs (smaller number first, ascending) not farther apart than `distance` (>= 0, coordinates finite).
[[nodiscard]] std::vector<std::pair<Index, Index>> near_pairs(std::span<const Vec3> nodes, double distance);

/// Make one of all nodes that are joined by gaps shorter than `tolerance` (> 0); each such set takes the
/// position of its lexicographically smallest node, so that the order of the file changes nothing.
/// @return the number of nodes that went
/// @throws core::Error if a line is shorter than the tolerance or loses its length, naming the line
std::size_t merge_nodes(RawMesh& mesh, double tolerance);

/// The line as a message shows it: `line (0, 0, 0)-(1, 0, 0) of "tube"`.
[[nodiscard]] std::string describe_line(const RawMesh& mesh, Index line);

} // namespace fretwork::mesh
