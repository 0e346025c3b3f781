// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// From a study and its mesh to the mechanical model.
#pragma once
#include "fem/model.hpp"
#include "mesh/line_mesh.hpp"
#include "study/study.hpp"

namespace fretwork::app {

struct BuiltModel {
  fem::Model model;
  std::vector<std::vector<core::Index>>
      beams_of_line; ///< by line of the mesh: one beam, two for a line of order 2
};

/// @throws core::Error for groups that do not exist, lines without or with two `[[beams]]` entries, springs
/// that cannot be paired
[[nodiscard]] BuiltModel build_model(const study::Study& study, const mesh::LineMesh& mesh);

/// The node of `among` (not empty) nearest to a place.
[[nodiscard]] core::Index nearest_node(const fem::Model& model, const std::vector<core::Index>& among,
                                       const core::Vec3& place);

} // namespace fretwork::app
