// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a mesh file says, before anything is merged, dropped or ordered.
#pragma once
#include "mesh/line_mesh.hpp"
#include <map>
#include <string>
#include <vector>

namespace fretwork::mesh {

/// Named groups: numbers of nodes or of lines; a group that is named but holds nothing is present and empty.
using Groups = std::map<std::string, std::vector<Index>>;

/// A line element: two ends and, for order 2, a node between them (-1 without).
struct RawLine {
  std::array<Index, 2> nodes;
  Index middle = -1;
};

/// Nodes and lines in the order of the file, in the units of the file. Numbers of nodes count from 0 in that
/// order.
struct RawMesh {
  std::vector<Vec3> nodes;
  std::vector<RawLine> lines;
  Groups points;                    ///< named points: nodes, in any order, perhaps repeated
  Groups curves;                    ///< named curves: lines, in any order, perhaps repeated
  std::size_t ignored_elements = 0; ///< surface and volume elements
};

} // namespace fretwork::mesh
