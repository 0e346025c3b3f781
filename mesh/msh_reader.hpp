// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Reader of gmsh meshes (.msh 2.2 and 4.1, text and binary): the lines, the named points and the names.
/// Linking gmsh for it would cost every start of the program a tenth of a second, and this is faster.
///
/// - Read: points (type 15), lines of order 1 and 2 (types 1 and 8), physical names of dimension 0 and 1.
/// Elements of surfaces
///   and volumes are counted and passed over. Lines of higher order are refused.
/// - A physical group without a name is called by its number: "7".
/// - A line in two groups is written twice in format 2.2: there two lines over the same nodes are one. In
/// format 4.1 only where
///   they are of the same curve; two curves may share all their nodes (a sleeve).
/// - Source: Gmsh reference manual, "MSH file format" and "Legacy formats"; the sign of a physical tag is an
/// orientation.
#pragma once
#include "mesh/raw_mesh.hpp"
#include <filesystem>

namespace fretwork::mesh {

/// @throws core::Error where the file cannot be opened, is not a mesh of these formats, is truncated or
/// contradicts itself
[[nodiscard]] RawMesh read_msh(const std::filesystem::path& file);
/// The same from its bytes; `name` is for messages.
[[nodiscard]] RawMesh read_msh_text(std::string text, const std::string& name);

} // namespace fretwork::mesh
