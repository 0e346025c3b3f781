// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// From a study and its mesh to the mechanical model.
#pragma once
#include "fem/model.hpp"
#include "mesh/line_mesh.hpp"
#include "study/study.hpp"

namespace fretwork::app {

/// The mechanical model; its nodes are those of the mesh, each line of the mesh is the beam of the same number.
/// @throws core::Error for groups that do not exist, lines without or with two `[[beams]]` entries, springs
/// that cannot be paired
[[nodiscard]] fem::Model build_model(const study::Study& study, const mesh::LineMesh& mesh);

/// The node of `among` (not empty) nearest to a place.
[[nodiscard]] core::Index nearest_node(const fem::Model& model, const std::vector<core::Index>& among,
                                       const core::Vec3& place);

} // namespace fretwork::app
