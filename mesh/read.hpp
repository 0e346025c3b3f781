// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// From a file to a LineMesh.
#pragma once
#include "mesh/line_mesh.hpp"
#include <filesystem>
#include <optional>

namespace fretwork::mesh {

/// What a study says about its mesh.
struct Source {
  std::filesystem::path file;
  std::optional<double> element_size =
      std::nullopt;                        ///< m after scaling, > 0: target size when the file is a geometry
  std::optional<int> order = std::nullopt; ///< 1: straight lines, 2: arcs; default: as the file has it
  double scale = 1.0;                      ///< > 0: file coordinates * scale = metres
  double merge_tolerance = 0.0;            ///< m, >= 0: nodes closer than this become one
};

/// True where the file is a geometry that must be meshed first (.geo, .step, .stp, .brep).
[[nodiscard]] bool is_geometry(const std::filesystem::path& file);

/// Mesh a geometry with gmsh, in a child process (gmsh is slow to load and its readers may crash), and write
/// it as .msh 4.1.
/// @throws core::Error with gmsh's own message
void mesh_geometry(const Source& source, const std::filesystem::path& msh_file);

/// Convert any format meshio reads to .msh, in a child process.
/// @throws core::Error with meshio's own message, or naming the package to install
void convert_with_meshio(const std::filesystem::path& file, const std::filesystem::path& msh_file);

/// Read a mesh: .msh 2.2 and 4.1 (ASCII, binary) by ourselves; geometries and other formats through the two
/// above, by way of a temporary file.
/// @throws core::Error if the file does not exist, cannot be read, or holds neither lines nor named points, or
/// where the middle of an arc is more than a place (a named point, the end of another line)
[[nodiscard]] LineMesh read(const Source& source);

} // namespace fretwork::mesh
