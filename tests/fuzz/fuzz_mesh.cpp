// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes (.msh 2.2 and 4.1, text and binary): a mesh in canonical order or core::Error.
#include "core/error.hpp"
#include "core/temporary_directory.hpp"
#include "memory_file.hpp"
#include "mesh/read.hpp"
#include <cstdint>

namespace {

constexpr double merge_tolerance = 1e-3; ///< m: of the order of the distances in the corpus

/// A mesh is known by the ending of its name.
struct MeshFile {
  fretwork::core::TemporaryDirectory folder;
  fretwork::fuzz::MemoryFile file;
  std::filesystem::path path = folder.path() / "fuzz.msh";
  MeshFile() { std::filesystem::create_symlink(file.path(), path); }
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const MeshFile mesh;
  mesh.file.fill({reinterpret_cast<const char*>(bytes), size});
  for (const double tolerance : {0.0, merge_tolerance})
    try {
      static_cast<void>(fretwork::mesh::read({.file = mesh.path, .merge_tolerance = tolerance}));
    } catch (const fretwork::core::Error&) {
    }
  return 0;
}
