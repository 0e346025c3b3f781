// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Meshes as .msh 2.2 text.
#pragma once
#include "core/types.hpp"
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace fretwork::app::test {

struct MeshText {
  std::vector<core::Vec3> nodes;
  std::vector<int> numbers;                        ///< in the file, of each node; empty: 1, 2, 3 ...
  std::vector<std::pair<std::string, int>> points; ///< group, node
  struct Line {
    std::string group;
    std::array<int, 2> nodes;
  };
  std::vector<Line> lines;

  [[nodiscard]] std::string text() const;
};

/// Lone named points, all at the origin's line x = 0, 1, 2 ...
[[nodiscard]] MeshText lone_points(const std::vector<std::string>& names);

/// A chain of `elements` equal lines from a to b, group `group`, its ends named `group`_begin and
/// `group`_end.
[[nodiscard]] MeshText straight_line(const std::string& group, const core::Vec3& a, const core::Vec3& b,
                                     int elements);

/// Both meshes as one, nothing joined.
[[nodiscard]] MeshText together(const MeshText& a, const MeshText& b);

} // namespace fretwork::app::test
