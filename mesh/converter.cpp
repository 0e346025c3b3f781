// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/converter.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <array>
#include <csignal>
#include <fmt/format.h>
#include <fstream>
#include <string>

namespace fretwork::mesh {
namespace {

namespace fs = std::filesystem;

/// Beginnings of words of gmsh's language that run programs, write files or read others, which may hold any command; and of the functions
/// that make a name of a text, which could be that of such a command. They count in comments too.
constexpr std::array commands{
    "System",       "Onelab", "CreateDir",       "Print",          "Save",          "Include", "Merge",
    "Plugin",       "Parse",  "ShapeFromFile",   "FileName",       "Error",         "Warning", "ListFromFile",
    "StringToName", "S2N",    "ExternalProcess", "NameFromString", "StringFromName"};

/// Endings of files that gmsh reads as geometries without commands; under one of another case (.Step) it takes its language.
constexpr std::array exchange_files{".step", ".STEP", ".stp", ".STP", ".brep"};

/// The first command of a geometry that reaches beyond it; empty where there is none.
std::string reaching_command(const fs::path& geometry) {
  if (std::ranges::find(exchange_files, geometry.extension().string()) != exchange_files.end())
    return {};
  std::ifstream in(geometry, std::ios::binary);
  for (std::string line; std::getline(in, line);)
    for (const char* command : commands)
      if (line.find(command) != std::string::npos)
        return command;
  return {};
}

/// gmsh runs the file GEOMETRY.opt beside a geometry.
void refuse_options(const fs::path& geometry) {
  fs::path options = geometry;
  options += ".opt";
  if (fs::exists(fs::symlink_status(options)))
    throw core::Error(fmt::format("{}: gmsh would run it, and this system cannot confine it (no Landlock or "
                                  "no seccomp); remove it, or set "
                                  "mesh.trusted = true if you trust it",
                                  options.string()));
}

} // namespace

Converter::Converter(const Source& source, const fs::path& folder) : source_(source) {
  if (source.trusted)
    return;
  if (core::Confinement::available()) {
    // an interpreter may be a script that starts another; a geometry has no reason to start anything
    confinement_.emplace(folder,
                         is_geometry(source.file) ? core::Processes::refused : core::Processes::allowed);
    return;
  }
  if (!is_geometry(source.file))
    return;
  refuse_options(source.file);
  if (const std::string command = reaching_command(source.file); !command.empty())
    throw core::Error(fmt::format(
        "{}: it has the command {}, which may run programs or reach other files, and this system "
        "cannot confine it (no Landlock or no seccomp); set mesh.trusted = true if you trust the file",
        source.file.string(), command));
}

core::ChildResult Converter::run(const std::vector<std::string>& arguments) const {
  if (source_.trusted)
    return core::run_child(arguments);
  core::ChildResult child =
      core::run_child(arguments, {source_.longest_conversion, most_memory, most_file, most_output},
                      confinement_ ? &*confinement_ : nullptr);
  if (!child.stopped.empty())
    refuse("its conversion was ended: " + child.stopped);
  if (confinement_ && child.status == of_a_signal + core::process_refused)
    refuse("it runs a command, which a file of unknown origin may not");
  if (child.status == of_a_signal + SIGXFSZ)
    refuse(fmt::format("its mesh takes more than {:.2g} GB", static_cast<double>(most_file) * 1e-9));
  if (child.status != 0 && child.output.find("bad_alloc") != std::string::npos)
    refuse(fmt::format("its conversion takes more than {:.2g} GB of memory",
                       static_cast<double>(most_memory) * 1e-9));
  return child;
}

void Converter::refuse(const std::string& why) const {
  throw core::Error(fmt::format("{}: {}; correct the file, or set mesh.trusted = true if you trust it",
                                source_.file.string(), why));
}

} // namespace fretwork::mesh
