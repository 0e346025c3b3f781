// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/converter.hpp"
#include "core/error.hpp"
#include <csignal>
#include <fmt/format.h>
#include <fstream>
#include <regex>

namespace fretwork::mesh {
namespace {

namespace fs = std::filesystem;

/// Commands of gmsh's language that run programs, write files or read others, which may hold any command. A word of this kind in a comment
/// counts too.
const char* const commands =
    R"(SystemCall|Onelab\w*|CreateDir|Print\w*|Save|Include|Merge\w*|Plugin|Parse|ShapeFromFile|ListFromFile|ExternalProcess|\w*FileName|Error|Warning)";

/// Files that gmsh reads as geometries without commands.
const char* const exchange_files = R"(.*\.(step|STEP|stp|STP|brep|BREP))";

/// The first command of a geometry that reaches beyond it; empty where there is none.
std::string reaching_command(const fs::path& geometry) {
  if (std::regex_match(geometry.string(), std::regex(exchange_files)))
    return {};
  const std::regex wanted(commands);
  std::ifstream in(geometry, std::ios::binary);
  std::smatch found;
  for (std::string line; std::getline(in, line);)
    if (std::regex_search(line, found, wanted))
      return found.str();
  return {};
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
  if (const std::string command = is_geometry(source.file) ? reaching_command(source.file) : "";
      !command.empty())
    throw core::Error(
        fmt::format("{}: it has the command {}, which may run programs or reach other files, and this system "
                    "cannot confine "
                    "it (no Landlock or no seccomp); set mesh.trusted = true if you trust the file",
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
