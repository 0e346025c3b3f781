// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/grouped_messages.hpp"
#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <set>
#include <string_view>
#include <unordered_map>

namespace fretwork::results {
namespace {

constexpr std::size_t most_in_group = 3;
constexpr std::size_t most_digits = 10; ///< characters of a number of a range
/// Fewer messages than these stand by themselves.
constexpr std::size_t least_alike = 3;

/// A message as the words around its names and numbers, and these.
struct Parts {
  std::string message;
  std::vector<std::string> words; ///< one more than values
  std::vector<std::string>
      values; ///< a name with its quotes, a list of such (with how many more), a number, or a range of numbers

  /// The same of messages that are alike: the words, and which values are names.
  [[nodiscard]] std::string kind() const {
    std::string out = words.front();
    for (std::size_t i = 0; i < values.size(); ++i)
      out += (values[i].front() == '"' ? "\x01" : "\x02") + words[i + 1];
    return out;
  }
};

bool is_decimal(char c) { return c >= '0' && c <= '9'; }
bool is_of_word(char c) {
  return is_decimal(c) || c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::size_t after_digits(const std::string& text, std::size_t at) {
  while (at < text.size() && is_decimal(text[at]))
    ++at;
  return at;
}

constexpr std::string_view between = " to ",
                           between_names = ", "; // of the ends of a range, of names in a list
constexpr std::string_view before_rest = " and ", after_rest = " more"; // of a list that is not in full

/// The end of ` and 12 more` at a place; the place itself where it is not.
std::size_t end_of_rest(const std::string& text, std::size_t at) {
  if (text.compare(at, before_rest.size(), before_rest) != 0)
    return at;
  const std::size_t first = at + before_rest.size(), last = after_digits(text, first);
  return last > first && text.compare(last, after_rest.size(), after_rest) == 0 ? last + after_rest.size()
                                                                                : at;
}

/// The end of the number that begins at a place; the place itself where none does. A number that is part of a word (x_1, mm2) is none, nor is
/// a minus a sign within one (pressure-3).
std::size_t end_of_number(const std::string& text, std::size_t at) {
  const std::size_t first = at < text.size() && text[at] == '-' ? at + 1 : at;
  if (first >= text.size() || !is_decimal(text[first]) || (at > 0 && is_of_word(text[at - 1])))
    return at;
  std::size_t end = after_digits(text, first);
  if (end + 1 < text.size() && text[end] == '.' && is_decimal(text[end + 1]))
    end = after_digits(text, end + 1);
  if (end < text.size() && text[end] == 'e') {
    const std::size_t digits =
        end + (end + 1 < text.size() && (text[end + 1] == '-' || text[end + 1] == '+') ? 2 : 1);
    if (const std::size_t last = after_digits(text, digits); last > digits)
      end = last;
  }
  return end < text.size() && is_of_word(text[end]) ? at : end;
}

/// The end of the name, number or range that begins at a place; the place itself where none does. No regular expression: those of the standard
/// library need a stack as long as the name.
std::size_t end_of_value(const std::string& text, std::size_t at) {
  if (text[at] == '"') {
    std::size_t end = text.find('"', at + 1);
    while (end != std::string::npos && text.compare(end + 1, between_names.size(), between_names) == 0 &&
           text[end + 1 + between_names.size()] == '"') // a list
      end = text.find('"', end + between_names.size() + 2);
    return end == std::string::npos ? at : end_of_rest(text, end + 1);
  }
  const std::size_t end = end_of_number(text, at);
  if (end == at || text.compare(end, between.size(), between) != 0)
    return end;
  const std::size_t second = end + between.size(), last = end_of_number(text, second);
  return last > second ? last : end;
}

Parts parts_of(const std::string& message) {
  Parts parts{.message = message, .words = {}, .values = {}};
  std::size_t from = 0;
  for (std::size_t at = 0; at < message.size();) {
    const std::size_t end = end_of_value(message, at);
    if (end == at) {
      ++at;
      continue;
    }
    parts.words.push_back(message.substr(from, at - from));
    parts.values.push_back(message.substr(at, end - at));
    from = at = end;
  }
  parts.words.push_back(message.substr(from));
  return parts;
}

/// The names that a list shows, with their quotes.
std::vector<std::string> names_of(const std::string& list) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < list.size() && list[at] == '"';) {
    const std::size_t end = list.find('"', at + 1) + 1;
    out.push_back(list.substr(at, end - at));
    at = end + between_names.size();
  }
  return out;
}

/// All that stands at one place of alike messages.
std::string together(std::vector<std::string> values) {
  const bool in_full = std::none_of(values.begin(), values.end(), [](const std::string& value) {
    return value.front() == '"' && value.back() != '"';
  });
  if (!in_full &&
      std::all_of(values.begin(), values.end(), [&](const auto& value) { return value == values.front(); }))
    return values.front();
  std::vector<std::string> different;
  std::set<std::string> seen;
  const auto add = [&](const std::string& value) {
    if (seen.insert(value).second)
      different.push_back(value);
  };
  for (const std::string& value : values)
    if (value.front() == '"')
      for (const std::string& name : names_of(value))
        add(name);
    else
      add(value);
  if (different.size() == 1)
    return different.front();
  if (different.front().front() == '"')
    return different.size() <= most_in_group
               ? fmt::format("{}{}", fmt::join(different, ", "), in_full ? "" : " and more")
               : fmt::format("{} ... {} ({}{})", different.front(), different.back(), different.size(),
                             in_full ? "" : " or more");
  std::vector<std::string> ends;
  for (const std::string& value : different) {
    const std::size_t split = value.find(between);
    ends.push_back(value.substr(0, split));
    if (split != std::string::npos)
      ends.push_back(value.substr(split + between.size()));
  }
  const auto [least, most] = std::minmax_element(ends.begin(), ends.end(), [](const auto& a, const auto& b) {
    return std::strtod(a.c_str(), nullptr) < std::strtod(b.c_str(), nullptr);
  });
  const auto shown = [](const std::string& number) { // drawn ones have all their digits
    return number.size() <= most_digits ? number
                                        : fmt::format("{:.6g}", std::strtod(number.c_str(), nullptr));
  };
  return fmt::format("{}{}{}", shown(*least), between, shown(*most));
}

/// Messages that are alike, with their numbers.
struct Group {
  std::vector<Parts> alike;
  std::vector<std::size_t> members;

  [[nodiscard]] std::string text() const {
    const Parts& first = alike.front();
    std::string text = first.words.front();
    for (std::size_t i = 0; i < first.values.size(); ++i) {
      std::vector<std::string> values;
      for (const Parts& parts : alike)
        values.push_back(parts.values[i]);
      text += together(std::move(values)) + first.words[i + 1];
    }
    return text;
  }
};

std::vector<Group> groups_of(const std::vector<std::string>& messages) {
  std::vector<Group> groups;
  std::unordered_map<std::string, std::size_t> by_kind;
  for (std::size_t k = 0; k < messages.size(); ++k) {
    Parts parts = parts_of(messages[k]);
    const auto [place, is_new] = by_kind.try_emplace(parts.kind(), groups.size());
    if (is_new)
      groups.emplace_back();
    groups[place->second].alike.push_back(std::move(parts));
    groups[place->second].members.push_back(k);
  }
  return groups;
}

} // namespace

std::vector<AlikeMessages> alike_messages(const std::vector<std::string>& messages) {
  std::vector<AlikeMessages> out;
  for (const Group& group : groups_of(messages))
    out.push_back({group.text(), group.members});
  return out;
}

std::vector<std::string> grouped_messages(const std::vector<std::string>& messages) {
  std::vector<std::string> out;
  for (const Group& group : groups_of(messages))
    if (group.alike.size() < least_alike)
      for (const Parts& alone : group.alike) {
        if (std::find(out.begin(), out.end(), alone.message) == out.end())
          out.push_back(alone.message);
      }
    else
      out.push_back(group.text());
  return out;
}

} // namespace fretwork::results
