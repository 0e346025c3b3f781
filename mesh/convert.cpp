// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "core/temporary_directory.hpp"
#include "mesh/converter.hpp"
#include "mesh/meshio_script.hpp"
#include "mesh/read.hpp"
#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace fretwork::mesh {
namespace {

namespace fs = std::filesystem;

constexpr int not_started = 127;

std::string lower_case_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// What a child wrote, without terminal colours (ESC [ numbers m) and the empty lines at its end.
std::string trimmed(const std::string& output) {
  std::string text;
  for (std::size_t i = 0; i < output.size(); ++i) {
    const std::size_t end = output.compare(i, 2, "\x1b[") == 0
                                ? output.find_first_not_of("0123456789;", i + 2)
                                : std::string::npos;
    if (end != std::string::npos && output[end] == 'm')
      i = end;
    else
      text += output[i];
  }
  while (!text.empty() && (text.back() == '\n' || text.back() == ' '))
    text.pop_back();
  return text.empty() ? "no message" : text;
}

std::string geometry_program() {
  if (const char* given = std::getenv("FRETWORK_GEOMETRY")) {
    if (!fs::exists(given))
      throw core::Error(fmt::format(
          "FRETWORK_GEOMETRY = \"{}\" does not exist; it names the program fretwork-geometry", given));
    return given;
  }
  const fs::path here = core::executable_directory();
  for (const fs::path& candidate :
       {here / "fretwork-geometry", here / "../libexec/fretwork/fretwork-geometry"})
    if (fs::exists(candidate))
      return candidate.lexically_normal().string();
  throw core::Error(fmt::format(
      "fretwork-geometry, which meshes geometries, is neither in {} nor in ../libexec/fretwork; install "
      "it or name it in FRETWORK_GEOMETRY",
      here.string()));
}

std::vector<std::string> pythons() {
  if (const char* given = std::getenv("FRETWORK_PYTHON"))
    return {given};
  return {"python3", "/usr/bin/python3"};
}

void mesh_geometry(const Source& source, const fs::path& msh_file, const Converter& converter) {
  std::vector<std::string> arguments{geometry_program(), source.file.string(), msh_file.string()};
  if (source.element_size) {
    arguments.emplace_back("--size");
    arguments.push_back(fmt::format("{}", *source.element_size / source.scale));
  }
  if (source.order) {
    arguments.emplace_back("--order");
    arguments.push_back(fmt::format("{}", *source.order));
  }
  const core::ChildResult child = converter.run(arguments);
  if (child.status == not_started)
    throw core::Error(fmt::format("{} cannot be started: {}", arguments[0], trimmed(child.output)));
  if (child.status != 0 || !fs::exists(msh_file))
    throw core::Error(fmt::format("{}: gmsh cannot mesh the geometry: {}", source.file.string(),
                                  child.status > of_a_signal
                                      ? fmt::format("it crashed (signal {})", child.status - of_a_signal)
                                      : trimmed(child.output)));
}

void convert_with_meshio(const Source& source, const fs::path& msh_file, const Converter& converter) {
  const fs::path& file = source.file;
  if (lower_case_ending(file) == ".unv") // meshio has no reader, and gmsh 4.8 ends at their groups
    throw core::Error(
        fmt::format("{}: universal files (.unv) cannot be read; save the mesh with its groups as "
                    ".med (Salome), .msh (gmsh) or .inp (Abaqus)",
                    file.string()));
  std::string tried;
  for (const std::string& python : pythons()) {
    // -I: neither the current folder nor PYTHONPATH gives modules
    const core::ChildResult child =
        converter.run({python, "-I", "-c", meshio_script, file.string(), msh_file.string()});
    if (child.status == 0)
      return;
    if (child.status != no_meshio && child.status != not_started) {
      const bool needs_h5py = child.output.find("'h5py'") != std::string::npos;
      throw core::Error(fmt::format("{}: meshio cannot read the mesh: {}{}", file.string(),
                                    trimmed(child.output),
                                    needs_h5py ? "; install the package python3-h5py" : ""));
    }
    tried += fmt::format("; {}: {}", python, trimmed(child.output));
  }
  throw core::Error(fmt::format(
      "{}: this format is read through meshio, and no Python with it was found; install the package "
      "python3-meshio (and python3-h5py for .med and .xdmf) or name an interpreter in FRETWORK_PYTHON{}",
      file.string(), tried));
}

} // namespace

bool is_msh(const fs::path& file) { return lower_case_ending(file) == ".msh"; }

bool is_geometry(const fs::path& file) {
  const std::string ending = lower_case_ending(file);
  return ending == ".geo" || ending == ".step" || ending == ".stp" || ending == ".brep";
}

std::string as_msh(const Source& source) {
  const core::TemporaryDirectory directory;
  const fs::path msh_file = directory.path() / "mesh.msh";
  const Converter converter(source, directory.path());
  if (is_geometry(source.file))
    mesh_geometry(source, msh_file, converter);
  else
    convert_with_meshio(source, msh_file, converter);
  if (fs::symlink_status(msh_file).type() != fs::file_type::regular)
    throw core::Error(fmt::format("{}: nothing came out of its conversion", source.file.string()));
  std::ifstream in(msh_file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace fretwork::mesh
