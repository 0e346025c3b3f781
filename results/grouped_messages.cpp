// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/grouped_messages.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <regex>

namespace fretwork::results {
namespace {

constexpr std::size_t most_in_group = 3;
/// Fewer messages than these stand by themselves.
constexpr std::size_t least_alike = 3;

/// A message as the words around its names and numbers, and these.
struct Parts {
  std::string message;
  std::vector<std::string> words;  ///< one more than values
  std::vector<std::string> values; ///< a name with its quotes, or a number

  [[nodiscard]] bool alike(const Parts& other) const {
    const auto same_kind = [](const std::string& a, const std::string& b) {
      return (a.front() == '"') == (b.front() == '"');
    };
    return words == other.words &&
           std::equal(values.begin(), values.end(), other.values.begin(), other.values.end(), same_kind);
  }
};

/// A number that is part of a word (x_1, mm2) is none.
Parts parts_of(const std::string& message) {
  static const std::regex value(R"("[^"]*"|\b\d+(\.\d+)?(e[-+]?\d+)?\b)");
  Parts parts{.message = message, .words = {}, .values = {}};
  auto from = message.begin();
  for (std::sregex_iterator at(message.begin(), message.end(), value), end; at != end; ++at) {
    parts.words.emplace_back(from, (*at)[0].first);
    parts.values.push_back(at->str());
    from = (*at)[0].second;
  }
  parts.words.emplace_back(from, message.end());
  return parts;
}

/// All that stands at one place of alike messages.
std::string together(std::vector<std::string> values) {
  std::vector<std::string> different;
  for (const std::string& value : values)
    if (std::find(different.begin(), different.end(), value) == different.end())
      different.push_back(value);
  if (different.size() == 1)
    return different.front();
  if (different.front().front() == '"')
    return different.size() <= most_in_group
               ? fmt::format("{}", fmt::join(different, ", "))
               : fmt::format("{} ... {} ({})", different.front(), different.back(), different.size());
  const auto [least, most] =
      std::minmax_element(different.begin(), different.end(),
                          [](const auto& a, const auto& b) { return std::stod(a) < std::stod(b); });
  return *least + " to " + *most;
}

std::string text_of(const std::vector<Parts>& group) {
  const Parts& first = group.front();
  std::string text = first.words.front();
  for (std::size_t i = 0; i < first.values.size(); ++i) {
    std::vector<std::string> values;
    for (const Parts& parts : group)
      values.push_back(parts.values[i]);
    text += together(std::move(values)) + first.words[i + 1];
  }
  return text;
}

} // namespace

std::vector<std::string> grouped_messages(const std::vector<std::string>& messages) {
  std::vector<std::vector<Parts>> groups;
  for (const std::string& message : messages) {
    Parts parts = parts_of(message);
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&](const auto& other) { return other.front().alike(parts); });
    if (group == groups.end())
      groups.push_back({std::move(parts)});
    else
      group->push_back(std::move(parts));
  }
  std::vector<std::string> out;
  for (const auto& group : groups)
    if (group.size() < least_alike)
      for (const Parts& alone : group) {
        if (std::find(out.begin(), out.end(), alone.message) == out.end())
          out.push_back(alone.message);
      }
    else
      out.push_back(text_of(group));
  return out;
}

} // namespace fretwork::results
