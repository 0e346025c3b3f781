// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/names.hpp"
#include "study/sweep.hpp"
#include "study/table_reader.hpp"
#include <algorithm>

namespace fretwork::study {
namespace {

bool is_pattern(const std::string& part) { return part.find_first_of("*?") != std::string::npos; }

/// `name`, else `group` of an entry; empty: neither.
std::string name_of(const Value& entry) {
  for (const char* key : {"name", "group"})
    if (const Table* table = entry.table())
      if (const auto at = table->find(key); at != table->end() && at->second.string())
        return *at->second.string();
  return {};
}

/// Children of a value with the parts that address them: an entry whose name another has, or that has none, by its index.
std::vector<std::pair<std::string, const Value*>> children(const Value& value) {
  std::vector<std::pair<std::string, const Value*>> out;
  if (const Table* table = value.table())
    for (const auto& [key, child] : *table)
      out.emplace_back(key, &child);
  if (const Array* array = value.array()) {
    for (const Value& entry : *array)
      out.emplace_back(name_of(entry), &entry);
    const auto names = out;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (names[i].first.empty() || std::count_if(names.begin(), names.end(), [&](const auto& other) {
                                      return other.first == names[i].first;
                                    }) > 1)
        out[i].first = std::to_string(i);
  }
  return out;
}

void match(const Value* value, const std::vector<std::string>& parts, std::size_t part,
           const std::string& address, std::vector<std::string>& found) {
  if (part == parts.size()) {
    found.push_back(address);
    return;
  }
  const auto extended = [&](const std::string& name) {
    return address.empty() ? toml_key(name) : address + "." + toml_key(name);
  };
  const auto below = value ? children(*value) : std::vector<std::pair<std::string, const Value*>>{};
  if (is_pattern(parts[part])) {
    for (const auto& [name, child] : below)
      if (core::fits(name, parts[part]))
        match(child, parts, part + 1, extended(name), found);
    return;
  }
  const auto at =
      std::find_if(below.begin(), below.end(), [&](const auto& child) { return child.first == parts[part]; });
  match(at == below.end() ? nullptr : at->second, parts, part + 1, extended(parts[part]), found);
}

} // namespace

std::vector<std::string> matching_keys(const Value& root, const Value& pattern, const std::string& path) {
  const std::string text = to_text(pattern, path);
  const std::vector<std::string> parts = address_parts(text);
  if (parts.empty() ||
      std::any_of(parts.begin(), parts.end(), [](const std::string& part) { return part.empty(); }) ||
      text.find('=') != std::string::npos)
    fail(pattern, path, "the address of a key is expected, as of --set: contacts.tsp1.gap");
  if (parts.front() == "sweep")
    fail(pattern, path, "a sweep does not vary itself; name a key of another table");
  if (std::none_of(parts.begin(), parts.end(), is_pattern))
    return {text};
  std::vector<std::string> found;
  match(&root, parts, 0, "", found);
  if (!found.empty())
    return found;
  std::string help;
  if (const Table* tables = root.table(); parts.size() > 1 && tables->contains("contacts"))
    if (const Array* contacts = tables->at("contacts").array(); contacts && parts.front() == "contacts")
      help = help_on_nodes(*contacts, parts[1]);
  fail(pattern, path, "the pattern fits no key of the study; * stands for any characters, ? for one" + help);
}

} // namespace fretwork::study
