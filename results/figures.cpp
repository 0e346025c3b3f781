// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/figures.hpp"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::results {
namespace {

constexpr int most_decimals = 7;
constexpr double most_in_full = 1e15; ///< of a sentence; all digits of an integer below

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Whether the space at `at` stands between two groups of digits of one number, as `grouped` writes them.
bool inside_number(const std::string& text, std::size_t at) {
  constexpr std::size_t group = 3; // digits
  const auto digit = [&](std::size_t i) { return i < text.size() && is_digit(text[i]); };
  if (at == 0 || !digit(at - 1) || !digit(at + 1) || !digit(at + 2) || !digit(at + group))
    return false;
  return !digit(at + group + 1) && text.substr(at + group + 1, 1) != ".";
}

} // namespace

std::string grouped(std::int64_t count) {
  std::string digits = std::to_string(count);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  return digits;
}

std::string figure(double value, int digits) {
  const double size = std::abs(value);
  if (size < shown_as_zero)
    return "0";
  return size >= 1e3 && size < 1e6 ? fmt::format("{:.0f}", value) : fmt::format("{:.{}g}", value, digits);
}

std::string without_exponent(double value, int digits) {
  const double full = std::pow(10.0, digits);
  if (value >= most_in_full || !(value >= full - 0.5)) // those below are shorter than their digits
    return fmt::format("{:.{}g}", value, digits);
  const double unit = std::pow(10.0, std::floor(std::log10(value)) + 1.0 - digits);
  return grouped(static_cast<std::int64_t>(std::llround(std::round(value / unit) * unit)));
}

double without_round_off(double value, double beside) {
  constexpr double round_off = 1e-12; // of a long sum
  return std::abs(value) < round_off * std::abs(beside) ? 0.0 : value;
}

std::string counted(std::int64_t count, const std::string& what) {
  return grouped(count) + " " + what + (count == 1 ? "" : "s");
}

std::string with_error(double value, double error) {
  if (std::abs(value) < shown_as_zero && !(std::abs(error) >= shown_as_zero))
    return "0";
  if (!std::isfinite(value) || !(error > 0.0) || !std::isfinite(error))
    return fmt::format("{:.3g}", value);
  if (std::abs(value) < 1e-4 || std::max(std::abs(value), error) >= 1e6)
    return fmt::format("{:.3g}+-{:.1g}", value, error);
  constexpr double round_off = 1e-9; // of what does not scatter
  if (error < round_off * std::abs(value))
    return fmt::format("{:.3g}", value);
  const double first = std::floor(std::log10(error));
  if (first < -most_decimals)
    return fmt::format("{:.3g}+-{:.1g}", value, error);
  const bool one = error < 1.95 * std::pow(10.0, first);
  const int decimals = std::clamp(static_cast<int>(-first) + (one ? 1 : 0), 0, most_decimals);
  return fmt::format("{:.{}f}+-{:.{}f}", value, decimals, error, decimals);
}

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines(1);
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = std::min(text.find(' ', at), text.size());
    while (end < text.size() && inside_number(text, end))
      end = std::min(text.find(' ', end + 1), text.size());
    const std::string word = text.substr(at, end - at);
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width)
      lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    at = end + 1;
  }
  return lines;
}

} // namespace fretwork::results
