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
  bool trusted = false;              ///< a geometry or foreign format is read without confinement or limits
  double longest_conversion = 120.0; ///< s, for gmsh or meshio, unless the file is trusted
};

/// True for gmsh's own meshes (.msh), which are read by ourselves.
[[nodiscard]] bool is_msh(const std::filesystem::path& file);

/// True where the file is a geometry that must be meshed first (.geo, .step, .stp, .brep).
[[nodiscard]] bool is_geometry(const std::filesystem::path& file);

/// The bytes of the .msh file that a geometry becomes by gmsh, any other format by meshio. Both are child processes: they are slow to load
/// and may crash. A geometry may hold commands and an endless loop: unless it is trusted the child is confined (core/confinement.hpp) to a
/// temporary folder and ended beyond a time, a memory and a size; where the system cannot confine, geometries with commands that run
/// programs or read and write files are refused.
/// @throws core::Error with gmsh's or meshio's own message, or naming the package to install
[[nodiscard]] std::string as_msh(const Source& source);

/// Read a mesh: .msh 2.2 and 4.1 (ASCII, binary) by ourselves; geometries and other formats by way of as_msh.
/// @throws core::Error if the file does not exist, cannot be read, or holds neither lines nor named points, or
/// where the middle of an arc is more than a place (a named point, the end of another line)
[[nodiscard]] LineMesh read(const Source& source);

} // namespace fretwork::mesh
