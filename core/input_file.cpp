// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input_file.hpp"
#include "core/error.hpp"
#include <fstream>
#include <iterator>

namespace fretwork::core {

namespace fs = std::filesystem;

void check_input_file(const fs::path& file, const std::string& what) {
  std::error_code failure;
  const fs::file_type type = fs::status(file, failure).type();
  if (type == fs::file_type::not_found)
    throw Error(what + " does not exist; check the path (relative paths start from the study's folder)");
  if (type == fs::file_type::directory)
    throw Error(what + " is a directory; give the path of a file");
  if (type != fs::file_type::regular)
    throw Error(what + " is not a regular file" + (failure ? " (" + failure.message() + ")" : "") +
                "; give the path of a file on a disk");
}

std::string read_input_file(const fs::path& file, const std::string& what, std::uintmax_t most) {
  check_input_file(file, what);
  std::error_code ignored;
  if (const std::uintmax_t size = fs::file_size(file, ignored); most > 0 && size > most)
    throw Error(what + " has " + std::to_string(size) + " bytes, more than " + std::to_string(most) +
                "; put its tables into files of their own");
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in)
    throw Error(what + " cannot be read; check its permissions");
  return bytes;
}

} // namespace fretwork::core
