// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/msh_scanner.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <limits>

namespace fretwork::mesh {
namespace {

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

} // namespace

void MshScanner::skip_space() {
  while (position_ < text_.size() && is_space(text_[position_]))
    ++position_;
}

void MshScanner::fail(const std::string& what) const {
  const std::string where = section_.empty() ? "" : " in $" + section_;
  if (binary_)
    throw core::Error(file_ + ": " + what + where);
  const auto here = text_.begin() + static_cast<std::ptrdiff_t>(std::min(position_, text_.size()));
  const auto line = 1 + std::count(text_.begin(), here, '\n');
  throw core::Error(file_ + ", line " + std::to_string(line) + ": " + what + where);
}

void MshScanner::fail_early() const {
  throw core::Error(file_ + ": the file ends inside $" + section_ + "; it is truncated: write it again");
}

std::string_view MshScanner::next_section() {
  section_.clear();
  skip_space();
  if (position_ >= text_.size())
    return {};
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  std::string_view line = std::string_view(text_).substr(position_, end - position_);
  while (!line.empty() && is_space(line.back()))
    line.remove_suffix(1);
  if (line.size() < 2 || line[0] != '$')
    fail("\"" + std::string(line.substr(0, 40)) + "\" stands where a section ($...) should begin");
  position_ = std::min(end + 1, text_.size());
  section_ = line.substr(1);
  return section_;
}

void MshScanner::end_section() {
  skip_space();
  const std::string end = "$End" + section_;
  if (position_ >= text_.size())
    fail_early();
  if (text_.compare(position_, end.size(), end) != 0)
    fail("more data than announced");
  position_ += end.size();
}

void MshScanner::skip_section() {
  const std::string end = "$End" + section_;
  const std::size_t found = text_.find(end, position_);
  if (found == std::string::npos)
    fail_early();
  position_ = found + end.size();
}

void MshScanner::fail_word(const char* kind) const {
  const auto begin = text_.begin() + static_cast<std::ptrdiff_t>(position_);
  const auto end = std::find_if(begin, begin + std::min<std::ptrdiff_t>(40, text_.end() - begin), is_space);
  fail(fmt::format("\"{}\" is not {}", std::string_view(begin, end), kind));
}

template <typename T> T MshScanner::text_value(const char* kind) {
  skip_space();
  const char* begin = text_.data() + position_;
  const char* end = text_.data() + text_.size();
  if (begin == end)
    fail_early();
  T value{};
  const auto [stop, error] = std::from_chars(*begin == '+' ? begin + 1 : begin, end, value);
  if (error != std::errc{} || (stop != end && !is_space(*stop))) {
    if (*begin == '$')
      fail("less data than announced");
    fail_word(kind);
  }
  position_ = static_cast<std::size_t>(stop - text_.data());
  return value;
}

template <typename T> T MshScanner::binary_value() {
  if (text_.size() - position_ < sizeof(T))
    fail_early();
  T value;
  std::memcpy(&value, text_.data() + position_, sizeof(T));
  position_ += sizeof(T);
  return value;
}

int MshScanner::integer() { return binary_ ? binary_value<std::int32_t>() : text_value<int>("an integer"); }

std::size_t MshScanner::size() {
  return binary_ ? binary_value<std::uint64_t>() : text_value<std::size_t>("a whole number");
}

double MshScanner::number() { return binary_ ? binary_value<double>() : text_value<double>("a number"); }

int MshScanner::text_integer() { return text_value<int>("an integer"); }

double MshScanner::text_number() { return text_value<double>("a number"); }

std::string MshScanner::quoted() {
  const std::size_t line_end = std::min(text_.find('\n', position_), text_.size());
  const std::string_view line = std::string_view(text_).substr(position_, line_end - position_);
  const std::size_t first = line.find('"');
  const std::size_t last = line.rfind('"');
  if (line_end == text_.size())
    fail_early();
  if (first == last)
    fail("a name in double quotes is missing");
  position_ = line_end;
  return std::string(line.substr(first + 1, last - first - 1));
}

void MshScanner::end_line() {
  const std::size_t line_end = text_.find('\n', position_);
  if (line_end == std::string::npos)
    fail_early();
  position_ = line_end + 1;
}

std::size_t MshScanner::fitting(std::size_t count, std::size_t bytes) const {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  if (count > most)
    fail("a count of " + std::to_string(count) + " is more than " + std::to_string(most));
  if (count * bytes > text_.size() - position_)
    fail_early();
  return count;
}

} // namespace fretwork::mesh
