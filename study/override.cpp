// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "core/names.hpp"
#include "study/document.hpp"
#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace fretwork::study {
namespace {

/// One override being applied: its text is what every message starts with.
struct Override {
  std::string text;
  std::vector<std::string> address;
  Value value;

  [[noreturn]] void fail(const std::string& problem) const {
    throw core::Error("--set " + text + ": " + problem);
  }

  /// The first `parts` of the address, as a user writes it.
  [[nodiscard]] std::string path(std::size_t parts) const {
    std::string out;
    for (std::size_t i = 0; i < parts; ++i) {
      out += i ? "." : "";
      out += toml_key(address[i]);
    }
    return out;
  }
};

std::vector<std::string> split_address(const Override& self, const std::string& text) {
  std::vector<std::string> parts = address_parts(text);
  if (parts.empty())
    self.fail("a double quote is not closed");
  if (std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.empty(); }))
    self.fail("a part of the address is empty; write for example transient.duration=1");
  return parts;
}

/// A TOML value; a bare word that is none is a string.
Value parse_value(const Override& self, const std::string& text) {
  auto origin = std::make_shared<const std::string>("--set " + self.text);
  if (text.find_first_not_of(" \t") == std::string::npos)
    self.fail("no value after =");
  try {
    Value parsed = parse_toml("value = " + text, origin, Lines::none);
    return std::move(std::get<Table>(parsed.data).at("value"));
  } catch (const core::Error& error) {
    if (const char first = text[text.find_first_not_of(" \t")];
        std::string_view("[{\"'").find(first) != std::string_view::npos)
      throw;
    return {text, {origin, 0}};
  }
}

std::optional<std::size_t> index_of(const std::string& text) {
  std::size_t index = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (failure != std::errc{} || end != text.data() + text.size())
    return std::nullopt;
  return index;
}

/// Indices of the entries whose `key` is `wanted`.
std::vector<std::size_t> entries_with(const Array& array, const char* key, const std::string& wanted) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < array.size(); ++i)
    if (const Table* entry = array[i].table())
      if (const auto at = entry->find(key);
          at != entry->end() && at->second.string() && *at->second.string() == wanted)
        found.push_back(i);
  return found;
}

/// How the entries of an array can be addressed: by name, else by group, and always by index.
std::vector<std::string> addresses_of(const Array& array) {
  std::vector<std::string> names;
  for (const char* key : {"name", "group"})
    for (const Value& item : array)
      if (const Table* entry = item.table())
        if (const auto at = entry->find(key);
            at != entry->end() && at->second.string() &&
            std::find(names.begin(), names.end(), *at->second.string()) == names.end())
          names.push_back(*at->second.string());
  return names;
}

Value& array_item(const Override& self, Array& array, std::size_t part) {
  const std::string& wanted = self.address[part];
  for (const char* key : {"name", "group"}) {
    const auto found = entries_with(array, key, wanted);
    if (found.size() == 1)
      return array[found[0]];
    if (found.size() > 1) {
      std::string indices;
      for (const std::size_t i : found)
        indices += (indices.empty() ? "" : ", ") + std::to_string(i);
      self.fail(self.path(part) + " has several entries with " + key + " \"" + wanted +
                "\"; address one by its index: " + indices);
    }
  }
  if (const auto index = index_of(wanted); index && *index < array.size())
    return array[*index];
  const std::string indices =
      array.empty() ? "no entries" : "indices 0 to " + std::to_string(array.size() - 1);
  self.fail(self.path(part) + " has no entry \"" + wanted + "\"" +
            core::name_help(wanted, addresses_of(array)) + "; " + indices +
            (self.path(part) == "contacts" ? help_on_nodes(array, wanted) : ""));
}

Value& table_item(const Override& self, Value& parent, std::size_t part) {
  constexpr std::array optional_tables{"mesh",      "modes",  "contact_defaults", "gravity",
                                       "transient", "output", "gap_opening"};
  Table& table = std::get<Table>(parent.data);
  const std::string& key = self.address[part];
  const auto at = table.find(key);
  if (at != table.end())
    return at->second;
  const bool last = part + 1 == self.address.size();
  if (last ||
      (part == 0 && std::find(optional_tables.begin(), optional_tables.end(), key) != optional_tables.end()))
    return table[key] = Value{Table{}, self.value.where};
  std::vector<std::string> keys;
  for (const auto& entry : table)
    keys.push_back(entry.first);
  self.fail((part ? self.path(part) : "the study") + " has no \"" + key + "\"" + core::name_help(key, keys));
}

} // namespace

std::vector<std::string> address_parts(const std::string& address) {
  std::vector<std::string> parts(1);
  bool quoted = false;
  for (const char c : address) {
    if (c == '"')
      quoted = !quoted;
    else if (c == '.' && !quoted)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return quoted ? std::vector<std::string>{} : parts;
}

std::string help_on_nodes(const Array& contacts, const std::string& part) {
  const std::string entry = part.substr(0, part.find('['));
  const std::vector<std::string> entries = addresses_of(contacts);
  return part == entry || std::find(entries.begin(), entries.end(), entry) == entries.end()
             ? ""
             : "; \"" + entry +
                   "\" has one value for all nodes of its group: what is to differ between nodes needs "
                   "entries of its own";
}

void apply_override(Value& root, const std::string& override_text) {
  Override self{override_text, {}, {}};
  const auto equals = override_text.find('=');
  if (equals == std::string::npos)
    self.fail("no = in it; write --set key=value");
  if (override_text.find_first_of("\r\n") != std::string::npos)
    self.fail("a line break is not allowed");
  std::string address = override_text.substr(0, equals);
  address.erase(0, address.find_first_not_of(" \t"));
  address.erase(address.find_last_not_of(" \t") + 1);
  self.address = split_address(self, address);
  self.value = parse_value(self, override_text.substr(equals + 1));
  Value* at = &root;
  for (std::size_t part = 0; part < self.address.size(); ++part) {
    if (auto* array = std::get_if<Array>(&at->data))
      at = &array_item(self, *array, part);
    else if (at->table())
      at = &table_item(self, *at, part);
    else
      self.fail(self.path(part) + " is " + kind_of(*at) + ", nothing is inside it; end the address there");
  }
  *at = std::move(self.value);
}

} // namespace fretwork::study
