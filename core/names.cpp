// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/names.hpp"
#include <algorithm>
#include <cctype>
#include <iterator>
#include <numeric>

namespace fretwork::core {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// Letters to insert, drop, replace, or swap with their neighbour (restricted Damerau-Levenshtein distance).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

/// The shortest candidate that begins with some letters, three at least, where it begins all others that do; else an empty string.
std::string completed(const std::string& beginning, const std::vector<std::string>& candidates) {
  constexpr std::size_t least_letters = 3;
  if (beginning.size() < least_letters)
    return {};
  std::vector<std::string> found;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(found),
               [&](const std::string& candidate) { return lower(candidate).starts_with(beginning); });
  const auto shortest = std::min_element(found.begin(), found.end(),
                                         [](const auto& a, const auto& b) { return a.size() < b.size(); });
  const bool begins_all = std::all_of(found.begin(), found.end(),
                                      [&](const std::string& other) { return other.starts_with(*shortest); });
  return shortest != found.end() && begins_all ? *shortest : std::string();
}

} // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string wanted = lower(name);
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, wanted.size() / 3) + 1;
  for (const auto& candidate : candidates) {
    if (wanted.size() >= candidate.size() + best_distance ||
        candidate.size() >= wanted.size() + best_distance)
      continue; // a letter each at least; a name may have millions
    const std::size_t distance = edit_distance(wanted, lower(candidate));
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best.empty() ? completed(wanted, candidates) : best;
}

std::string list_names(const std::vector<std::string>& names, std::size_t most) {
  if (names.empty())
    return "none";
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    out += (i ? ", \"" : "\"") + names[i] + "\"";
  if (names.size() > most)
    out += " and " + std::to_string(names.size() - most) + " more";
  return out;
}

std::string name_help(std::string_view name, const std::vector<std::string>& candidates,
                      std::string_view existing) {
  std::string out;
  if (const std::string near = nearest_name(name, candidates); !near.empty())
    out += "; did you mean \"" + near + "\"?";
  return out + (out.empty() ? "; " : " ") + std::string(existing) + ": " + list_names(candidates);
}

bool fits(std::string_view name, std::string_view pattern) {
  if (pattern.empty())
    return name.empty();
  if (pattern.front() == '*')
    return fits(name, pattern.substr(1)) || (!name.empty() && fits(name.substr(1), pattern));
  return !name.empty() && (pattern.front() == '?' || pattern.front() == name.front()) &&
         fits(name.substr(1), pattern.substr(1));
}

} // namespace fretwork::core
