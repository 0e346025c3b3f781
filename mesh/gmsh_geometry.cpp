// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// fretwork-geometry GEOMETRY MSH [--size S] [--order N]: mesh the curves of a geometry by gmsh and write .msh 4.1,
/// binary. A program of its own, so that gmsh (slow to load, and able to crash on a bad file) stays out of
/// the main program.
///
/// - Curves are meshed with the sizes of the file, or with elements of about S (units of the file) where S is
/// given;
///   Transfinite Curve keeps its count. Lines are of order N, or of that which a .geo asks for (Mesh.ElementOrder, by default 1).
/// - STEP: units become metres (the file says which it has). Curves that meet come disconnected and are
/// joined, here and in BREP.
///   Neither format has named groups: a .geo that merges it (Merge "tube.step"; Coherence; Physical
///   Curve("tube") = {1};) names them.
/// - Where a file names physical groups only these are written.
/// - Of a last line of a .geo without an end gmsh (4.8) reads the first command and leaves out the others without a word, groups too: such a
/// file is refused.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <gmsh.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Options {
  std::string geometry, msh;
  double size = 0.0; ///< 0: the sizes of the file
  int order = 0;     ///< 0: the order of the file
};

constexpr int status_wrong_use = 2;
constexpr const char* usage = "usage: fretwork-geometry GEOMETRY MSH [--size S] [--order 1|2]\n";

bool parse(int argc, char** argv, Options& options) {
  if (argc < 3 || argc % 2 == 0)
    return false;
  options.geometry = argv[1];
  options.msh = argv[2];
  for (int i = 3; i < argc; i += 2) {
    const std::string name = argv[i];
    char* end = nullptr;
    const double value = std::strtod(argv[i + 1], &end);
    if (*end != '\0')
      return false;
    if (name == "--size" && value > 0.0)
      options.size = value;
    else if (name == "--order" && (value == 1.0 || value == 2.0))
      options.order = static_cast<int>(value);
    else
      return false;
  }
  return true;
}

bool is_exchange_file(const std::string& file) {
  std::string ending = file.substr(std::min(file.rfind('.'), file.size()));
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".step" || ending == ".stp" || ending == ".brep";
}

/// The last line of a file where no end of line follows it, otherwise "".
std::string line_without_end(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line, last;
  while (std::getline(in, line))
    last = in.eof() ? line : "";
  return last;
}

/// Whether something follows the first command of a line; a comment does not count.
bool has_more_commands(const std::string& line) {
  const std::string code = line.substr(0, line.find("//"));
  const std::size_t end = code.find(';');
  return end != std::string::npos && code.find_first_not_of("; \t\r", end) != std::string::npos;
}

void mesh_curves(const Options& options) {
  const bool exchange = is_exchange_file(options.geometry);
  if (!exchange && has_more_commands(line_without_end(options.geometry)))
    throw std::runtime_error("its last line has no end, and gmsh would read only the first command of it; "
                             "end the file with a new line");
  gmsh::option::setString("Geometry.OCCTargetUnit", "M");
  gmsh::open(options.geometry);
  if (exchange) {
    gmsh::model::occ::removeAllDuplicates();
    gmsh::model::occ::synchronize();
  }
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  if (entities.empty())
    throw std::runtime_error("the file holds no geometry that gmsh can read");
  if (options.size > 0.0) {
    gmsh::option::setNumber("Mesh.CharacteristicLengthMin", options.size);
    gmsh::option::setNumber("Mesh.CharacteristicLengthMax", options.size);
  }
  if (options.order > 0)
    gmsh::option::setNumber("Mesh.ElementOrder", options.order);
  gmsh::model::mesh::generate(1);
  if (exchange)
    gmsh::model::mesh::removeDuplicateNodes();
  gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
  gmsh::option::setNumber("Mesh.Binary", 1);
  gmsh::write(options.msh);
}

/// gmsh goes on after some errors; a geometry with an error is not meshed. @return true where there was one
bool print_logged_errors(const std::string& already_printed) {
  const std::string mark = "Error: ";
  std::vector<std::string> log;
  gmsh::logger::get(log);
  bool found = false;
  for (const std::string& message : log) {
    if (message.rfind(mark, 0) != 0)
      continue;
    found = true;
    if (message.substr(mark.size()) != already_printed)
      std::fprintf(stderr, "%s\n", message.c_str());
  }
  return found;
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) {
    std::fputs(usage, stderr);
    return status_wrong_use;
  }
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::logger::start();
  std::string failure;
  try {
    mesh_curves(options);
  } catch (const std::exception& error) {
    failure = error.what();
  } catch (const std::string& error) { // gmsh throws its messages bare in some versions
    failure = error;
  }
  if (!failure.empty())
    std::fprintf(stderr, "%s\n", failure.c_str());
  const bool logged = print_logged_errors(failure);
  gmsh::finalize();
  return failure.empty() && !logged ? 0 : 1;
}
