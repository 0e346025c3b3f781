// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/printable.hpp"
#include <algorithm>

namespace fretwork::core {
namespace {

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

/// The two bytes of U+0080 to U+009F, which are control characters too.
bool is_control_pair(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]) == 0xc2 && at + 1 < text.size() &&
         static_cast<unsigned char>(text[at + 1]) < 0xa0 && continues_character(text[at + 1]);
}

void append_escaped(std::string& out, char byte) {
  constexpr const char* digits = "0123456789abcdef";
  const auto value = static_cast<unsigned char>(byte);
  out += "\\x";
  out += digits[value >> 4];
  out += digits[value & 15];
}

void append_line(std::string& out, std::string_view line, std::size_t longest) {
  std::size_t end = std::min(line.size(), longest);
  while (end < line.size() && end > 0 && continues_character(line[end]))
    --end;
  for (std::size_t i = 0; i < end; ++i) {
    const auto value = static_cast<unsigned char>(line[i]);
    if (value < 0x20 || value == 0x7f || is_control_pair(line, i))
      append_escaped(out, line[i]);
    else if (i > 0 && is_control_pair(line, i - 1))
      append_escaped(out, line[i]);
    else
      out += line[i];
  }
  if (end < line.size())
    out += "... (" + std::to_string(line.size() - end) + " more bytes)";
}

} // namespace

std::string printable(std::string_view text, std::size_t longest) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    append_line(out, text.substr(begin, end - begin), longest);
    if (end < text.size())
      out += '\n';
    begin = end + 1;
  }
  return out;
}

} // namespace fretwork::core
