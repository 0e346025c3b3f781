// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A mesh of lines: what every reader gives and all the rest of the program starts from.
#pragma once
#include "core/types.hpp"
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::mesh {

using core::Index;
using core::Vec3;

/// A line element: straight, or (order 2) an arc through a third place between its ends, which is no node.
struct Line {
  std::array<Index, 2> nodes;
  std::optional<Vec3> middle = std::nullopt; ///< m
};

/// Two nodes at the same place that were left apart (it is legal: two structures in contact, a beam folded on
/// itself).
struct CoincidentPair {
  Index first, second;
};

/// Nodes and lines in canonical order: chains are walked from their canonical end (see canonical_order.hpp),
/// so that neither the file's node numbers nor the direction of its elements change anything that is computed
/// from the mesh.
struct LineMesh {
  std::vector<Vec3> nodes;                          ///< m; each belongs to a line or to a named point
  std::vector<Line> lines;                          ///< in walking order, each directed along its chain
  std::map<std::string, std::vector<Index>> points; ///< named points: nodes, ascending
  std::map<std::string, std::vector<Index>> curves; ///< named curves: line numbers, ascending
  std::size_t dropped_nodes = 0;                    ///< nodes of the file that nothing uses
  std::size_t merged_nodes = 0;                     ///< nodes made one (by merge_tolerance)
  std::size_t ignored_elements = 0;       ///< surface and volume elements of the file, which are passed over
  std::vector<CoincidentPair> coincident; ///< left apart, to be reported
};

/// The names of all groups, points first, each sorted; a name that points and curves share appears once.
[[nodiscard]] std::vector<std::string> group_names(const LineMesh& mesh);

/// The nodes of a named point or curve, in walking order; of both where both have the
/// name.
/// @throws core::Error if there is no such group (lists those that exist and the nearest name) or it is
/// empty; `what` names
///         the user of the group in the message, e.g. `[[restraints]] entry 2`
[[nodiscard]] std::vector<Index> group_nodes(const LineMesh& mesh, const std::string& group,
                                             const std::string& what);

/// The lines of a named curve, in walking order.
/// @throws core::Error if there is no such curve, or if `group` names a point, or it is empty
[[nodiscard]] std::vector<Index> group_lines(const LineMesh& mesh, const std::string& group,
                                             const std::string& what);

} // namespace fretwork::mesh
