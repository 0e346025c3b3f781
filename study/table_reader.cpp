// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/table_reader.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace fretwork::study {
namespace {

constexpr std::size_t longest_value = 60; ///< characters of a value that a message shows

std::string in_unit(const Quantity& quantity) {
  return *quantity.unit ? std::string(" in ") + quantity.unit : "";
}

std::string describe(const Quantity& quantity) {
  switch (quantity.range) {
  case Range::any:
    return "a number" + in_unit(quantity);
  case Range::at_least_zero:
    return "a number >= 0" + in_unit(quantity);
  case Range::above_zero:
    return "a number > 0" + in_unit(quantity);
  }
  return {};
}

bool in_range(double number, Range range) {
  switch (range) {
  case Range::any:
    return true;
  case Range::at_least_zero:
    return number >= 0.0;
  case Range::above_zero:
    return number > 0.0;
  }
  return false;
}

std::string item_path(const std::string& path, std::size_t i) { return path + "[" + std::to_string(i) + "]"; }

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

void fail(const Value& value, const std::string& path, const std::string& problem) {
  std::string shown;
  if (!value.table()) {
    shown = toml_text(value, Digits::shortest);
    if (shown.size() > longest_value)
      shown = shown.substr(0, longest_value) + "...";
    shown = " = " + shown;
  }
  throw core::Error(value.where.text() + ": " + path + shown + ": " + problem);
}

double to_number(const Value& value, const std::string& path, const Quantity& quantity) {
  double number = 0.0;
  if (const auto* real = std::get_if<double>(&value.data))
    number = *real;
  else if (const auto* integer = std::get_if<std::int64_t>(&value.data))
    number = static_cast<double>(*integer);
  else
    fail(value, path, describe(quantity) + " is expected, not " + kind_of(value));
  if (!std::isfinite(number))
    fail(value, path, "a finite number is expected; give " + describe(quantity));
  if (!in_range(number, quantity.range))
    fail(value, path,
         describe(quantity) + " is expected" + (*quantity.cure ? std::string("; ") + quantity.cure : ""));
  return number;
}

std::string to_text(const Value& value, const std::string& path) {
  if (!value.string())
    fail(value, path, "a string between quotes is expected, not " + kind_of(value));
  if (value.string()->empty())
    fail(value, path, "the string is empty; give a name, or leave the key out where it is optional");
  return *value.string();
}

const Array& to_array(const Value& value, const std::string& path, const std::string& expected) {
  if (!value.array())
    fail(value, path, expected + " is expected, not " + kind_of(value));
  if (value.array()->empty())
    fail(value, path, "the array is empty; give " + expected + ", or leave the key out where it is optional");
  return *value.array();
}

std::vector<double> to_numbers(const Value& value, const std::string& path, std::size_t size,
                               const Quantity& quantity) {
  const std::string count = size ? std::to_string(size) : "at least 1";
  const std::string expected = "an array of numbers (" + count + in_unit(quantity) + ")";
  const Array& items = to_array(value, path, expected);
  if (size && items.size() != size)
    fail(value, path, expected + " is expected, not of " + std::to_string(items.size()));
  std::vector<double> numbers;
  for (std::size_t i = 0; i < items.size(); ++i)
    numbers.push_back(to_number(items[i], item_path(path, i), quantity));
  return numbers;
}

std::size_t to_choice(const Value& value, const std::string& path, const std::vector<std::string>& names) {
  const std::string name = to_text(value, path);
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    fail(value, path, "unknown" + core::name_help(name, names, "available"));
  return static_cast<std::size_t>(at - names.begin());
}

TableReader::TableReader(const Value& value, std::string path, const Keys& keys)
    : value_(value), path_(std::move(path)) {
  if (!value.table()) {
    const bool entries = value.array() && !value.array()->empty() && value.array()->front().table();
    fail(value, path_,
         "a table is expected, not " +
             (entries ? "an array of tables; write [" + path_ + "]" : kind_of(value)));
  }
  for (const auto& [key, item] : *value.table()) {
    if (!contains(keys.known, key))
      fail(item, this->path(key), "unknown key" + core::name_help(key, keys.known, "keys"));
  }
}

const Value* TableReader::find(const std::string& key) const {
  const auto at = value_.table()->find(key);
  return at == value_.table()->end() ? nullptr : &at->second;
}

std::string TableReader::path(const std::string& key) const {
  return path_.empty() ? toml_key(key) : path_ + "." + toml_key(key);
}

double TableReader::number(const std::string& key, const Quantity& quantity) const {
  return to_number(required(key, describe(quantity)), path(key), quantity);
}

double TableReader::number_or(const std::string& key, double otherwise, const Quantity& quantity) const {
  return optional_number(key, quantity).value_or(otherwise);
}

std::optional<double> TableReader::optional_number(const std::string& key, const Quantity& quantity) const {
  const Value* found = find(key);
  return found ? std::optional(to_number(*found, path(key), quantity)) : std::nullopt;
}

std::optional<std::int64_t> TableReader::optional_integer(const std::string& key, std::int64_t lowest) const {
  const Value* found = find(key);
  if (!found)
    return std::nullopt;
  const std::string expected = "an integer >= " + std::to_string(lowest) + " is expected";
  const auto* integer = std::get_if<std::int64_t>(&found->data);
  if (!integer)
    fail(*found, path(key), expected + ", not " + kind_of(*found));
  if (*integer < lowest)
    fail(*found, path(key), expected);
  return *integer;
}

std::optional<bool> TableReader::optional_flag(const std::string& key) const {
  const Value* found = find(key);
  if (!found)
    return std::nullopt;
  const bool* flag = std::get_if<bool>(&found->data);
  if (!flag)
    fail(*found, path(key), "true or false is expected, not " + kind_of(*found));
  return *flag;
}

std::string TableReader::text(const std::string& key, const std::string& expected) const {
  return to_text(required(key, expected), path(key));
}

std::optional<std::string> TableReader::optional_text(const std::string& key) const {
  const Value* found = find(key);
  return found ? std::optional(to_text(*found, path(key))) : std::nullopt;
}

std::optional<std::vector<double>> TableReader::optional_numbers(const std::string& key, std::size_t size,
                                                                 const Quantity& quantity) const {
  const Value* found = find(key);
  return found ? std::optional(to_numbers(*found, path(key), size, quantity)) : std::nullopt;
}

std::optional<Vec3> TableReader::optional_vector(const std::string& key, const Quantity& quantity) const {
  const auto numbers = optional_numbers(key, 3, quantity);
  return numbers ? std::optional(Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2])) : std::nullopt;
}

std::optional<Vec3> TableReader::optional_axis(const std::string& key) const {
  const auto axis = optional_vector(key, {});
  if (axis && axis->stableNorm() == 0.0)
    fail_at(key, "a zero vector has no direction; give one component at least that is not 0");
  return axis;
}

Vec3 TableReader::direction(const std::string& key) const {
  (void)required(key, "a vector of 3 numbers, not zero");
  return optional_axis(key)->stableNormalized();
}

const Value& TableReader::required(const std::string& key, const std::string& expected) const {
  const Value* found = find(key);
  if (!found)
    throw core::Error(value_.where.text() + ": " + path(key) + ": this required key is missing; give " +
                      expected);
  return *found;
}

void TableReader::fail_at(const std::string& key, const std::string& problem) const {
  fail(*find(key), path(key), problem);
}

void TableReader::fail_table(const std::string& problem) const { fail(value_, path_, problem); }

std::vector<Entry> array_entries(const TableReader& root, const std::string& key) {
  const Value* found = root.find(key);
  if (!found)
    return {};
  const std::string brackets = "[[" + key + "]]";
  if (found->table())
    fail(*found, key, "several entries may follow: write " + brackets + ", not [" + key + "]");
  const Array& items = to_array(*found, key, "an array of tables " + brackets);
  std::vector<std::string> names;
  std::unordered_map<std::string, int> count;
  for (const Value& item : items) {
    if (!item.table())
      fail(item, key, "a table is expected for each entry; write " + brackets);
    std::string name;
    for (const char* label : {"group", "name"})
      if (const auto at = item.table()->find(label); at != item.table()->end() && at->second.string())
        name = *at->second.string();
    ++count[name];
    names.push_back(std::move(name));
  }
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const bool unique = !names[i].empty() && count[names[i]] == 1;
    entries.push_back({&items[i], key + "." + (unique ? toml_key(names[i]) : std::to_string(i)), names[i]});
  }
  return entries;
}

std::vector<Entry> table_entries(const TableReader& root, const std::string& key) {
  const Value* found = root.find(key);
  if (!found)
    return {};
  const std::string form = "write [" + key + ".some_name]";
  if (!found->table())
    fail(*found, key, "a table is expected, not " + kind_of(*found) + "; " + form);
  if (found->table()->empty())
    fail(*found, key, "the table is empty; " + form + ", or leave it out");
  std::vector<Entry> entries;
  for (const auto& [name, item] : *found->table()) {
    if (!item.table())
      fail(item, key + "." + toml_key(name), "a table is expected, not " + kind_of(item) + "; " + form);
    entries.push_back({&item, key + "." + toml_key(name), name});
  }
  return entries;
}

} // namespace fretwork::study
