// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep/row.hpp"
#include "core/hash.hpp"
#include "core/printable.hpp"
#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <limits>

namespace fretwork::sweep {
namespace {

constexpr std::array outcomes{Outcome::done, Outcome::refused, Outcome::failed, Outcome::defect,
                              Outcome::crashed};
constexpr std::size_t longest_message = 1000;

/// Takes the first word, and the blank behind it, off a text.
std::string_view take_word(std::string_view& text) {
  const std::size_t end = std::min(text.find(' '), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

template <class T> std::optional<T> number_of(std::string_view word) {
  T number{};
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
  return failure == std::errc{} && end == word.data() + word.size() ? std::optional(number) : std::nullopt;
}

} // namespace

std::string name_of(Outcome outcome) {
  switch (outcome) {
  case Outcome::done:
    return "done";
  case Outcome::refused:
    return "refused";
  case Outcome::failed:
    return "failed";
  case Outcome::defect:
    return "defect";
  case Outcome::crashed:
    return "crashed";
  }
  return {};
}

std::string short_digest(std::string_view text) { return core::sha256(text).substr(0, digest_digits); }

std::string line_of(const Row& row) {
  std::string text = fmt::format("{} {} {}", row.number, row.identity, name_of(row.outcome));
  for (const double value : row.values)
    fmt::format_to(std::back_inserter(text), " {}", value);
  std::string message = core::printable(row.message, longest_message);
  std::replace(message.begin(), message.end(), '\n', ' ');
  text += " | " + message;
  return short_digest(text) + " " + text + "\n";
}

std::optional<Row> row_of(std::string_view line) {
  const std::string_view checksum = take_word(line);
  if (checksum.size() != digest_digits || short_digest(line) != checksum)
    return {};
  Row row;
  const auto number = number_of<std::int64_t>(take_word(line));
  if (!number)
    return {};
  row.number = *number;
  row.identity = take_word(line);
  const std::string_view outcome = take_word(line);
  const auto named = std::find_if(outcomes.begin(), outcomes.end(),
                                  [&](Outcome candidate) { return name_of(candidate) == outcome; });
  if (named == outcomes.end())
    return {};
  row.outcome = *named;
  for (std::string_view word = take_word(line); word != "|"; word = take_word(line)) {
    const auto value = number_of<double>(word);
    if (!value)
      return {};
    row.values.push_back(*value);
  }
  row.message = line;
  return row;
}

} // namespace fretwork::sweep
