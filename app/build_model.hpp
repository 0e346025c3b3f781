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
/// and ties that cannot be paired
[[nodiscard]] fem::Model build_model(const study::Study& study, const mesh::LineMesh& mesh);

/// For each node of group the nearest of group `other`, each of them once.
/// @param what  the entry, for messages
/// @throws core::Error for groups of different sizes, a node in both, and a node nearest to two
[[nodiscard]] std::vector<core::Index> paired_nodes(const fem::Model& model, const mesh::LineMesh& mesh,
                                                    const std::string& what, const std::string& group,
                                                    const std::string& other);

} // namespace fretwork::app
