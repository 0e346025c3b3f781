// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/text_file.hpp"
#include "results/whole_file.hpp"
#include <fmt/format.h>

namespace fretwork::results {

void write_text(const std::filesystem::path& file, std::string_view text) {
  write_whole(file, {text}, Durability::cached);
}

std::string path_name(std::string_view name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto byte = static_cast<unsigned char>(name[i]);
    const bool plain = byte >= 0x20 && byte != 0x7f && byte != '/' && byte != '%' && !(i == 0 && byte == '.');
    if (plain)
      out += name[i];
    else
      out += fmt::format("%{:02X}", byte);
  }
  return out;
}

std::string shortened(const std::string& name, std::size_t width) {
  if (name.size() <= width)
    return name;
  std::size_t end = width - 3;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80)
    --end;
  return name.substr(0, end) + "...";
}

} // namespace fretwork::results
