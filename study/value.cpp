// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/value.hpp"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace fretwork::study {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04X", static_cast<unsigned>(static_cast<unsigned char>(c)));
      out += escape;
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string real_text(double value, Digits digits) {
  if (!std::isfinite(value)) // the C library may print a sign in front of nan
    return std::isnan(value) ? "nan" : (value > 0 ? "inf" : "-inf");
  if (value == 0.0 && digits != Digits::shortest)
    return "0"; // so is -0
  char buffer[40];
  if (digits == Digits::seventeen) {
    std::snprintf(buffer, sizeof buffer, "%.17g", value);
    return buffer;
  }
  constexpr double below_all_are_exact = 9007199254740992.0; // 2^53
  const bool whole = value == std::round(value) && std::abs(value) < below_all_are_exact;
  const auto format =
      digits == Digits::shortest_or_whole && whole ? std::chars_format::fixed : std::chars_format::general;
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format).ptr;
  return std::string(buffer, end);
}

/// One case for each kind of value; std::visit does not compile where one is missing.
struct Printer {
  Digits digits;

  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return real_text(value, digits); }
  std::string operator()(const std::string& value) const { return quoted(value); }
  std::string operator()(const Moment& value) const { return value.text; }
  std::string operator()(const Array& items) const {
    std::string out = "[";
    for (const Value& item : items)
      out += (out.size() > 1 ? ", " : "") + toml_text(item, digits);
    return out + "]";
  }
  std::string operator()(const Table& table) const {
    std::string out = "{";
    for (const auto& [key, item] : table)
      out += (out.size() > 1 ? ", " : "") + toml_key(key) + " = " + toml_text(item, digits);
    return out + "}";
  }
};

struct KindName {
  std::string operator()(bool) const { return "true or false"; }
  std::string operator()(std::int64_t) const { return "an integer"; }
  std::string operator()(double) const { return "a number"; }
  std::string operator()(const std::string&) const { return "a string"; }
  std::string operator()(const Moment&) const { return "a date or time"; }
  std::string operator()(const Array&) const { return "an array"; }
  std::string operator()(const Table&) const { return "a table"; }
};

} // namespace

std::string Where::text() const { return line > 0 ? *origin + ":" + std::to_string(line) : *origin; }

std::string kind_of(const Value& value) { return std::visit(KindName{}, value.data); }

std::string toml_text(const Value& value, Digits digits) { return std::visit(Printer{digits}, value.data); }

std::string toml_key(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : quoted(key);
}

} // namespace fretwork::study
