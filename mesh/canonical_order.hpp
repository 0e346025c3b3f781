// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A numbering of nodes and lines that depends on the geometry only, not on a file's node numbers, its
/// element order or the direction of its elements; along a chain neighbours have neighbouring numbers, so
/// that matrices are narrow.
///
/// - A chain is a walk along lines between two nodes that are ends or junctions (any number of lines but
/// two); a ring has
///   neither. A chain runs in the direction in which its sequence of nodes is smaller; a ring starts at its
///   smallest node and goes to the smaller neighbour.
/// - Nodes compare by coordinates x, y, z: first rounded to 1e-10 of the extent (a mesher's last digits shall
/// not turn a tube
///   round), then exactly, then by label. Sequences compare node by node, middle nodes included, then by the
///   labels of the lines.
/// - Connected structures follow each other by their smallest node, chains within one by their sequence;
/// nodes without a
///   line come last, by coordinates.
/// - What is equal in all this (coincident nodes without distinguishing labels) stays in the order given.
/// Cost O(n log n); structures that coincide node for node cost the comparison of their sequences more.
#pragma once
#include "mesh/raw_mesh.hpp"
#include <span>
#include <vector>

namespace fretwork::mesh {

/// The new numbering in terms of the old one.
struct CanonicalOrder {
  std::vector<Index> nodes;   ///< old number of each node in the new order
  std::vector<Index> lines;   ///< old number of each line in the new order
  std::vector<char> reversed; ///< in the new order: 1 where the line must swap its ends
};

/// What tells coincident things apart: the groups they are in.
struct Labels {
  std::vector<Index> of_node;
  std::vector<Index> of_line;
};

/// Two nodes (lines) have the same label if and only if they are in the same groups; 0 where they are in
/// none. The labels depend on the names and the membership only.
[[nodiscard]] Labels group_labels(const RawMesh& mesh);

/// @param nodes   positions, finite
/// @param lines   each with two different ends
/// @param labels  as many as nodes and lines
[[nodiscard]] CanonicalOrder canonical_order(std::span<const Vec3> nodes, std::span<const RawLine> lines,
                                             const Labels& labels);

} // namespace fretwork::mesh
