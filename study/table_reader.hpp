// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Typed, checked access to the keys of one table of a study. Every failure throws core::Error:
/// `study.toml:12: contacts.tsp1.gap = -0.1: what is expected; the cure`. The path is also the address for
/// `--set`.
#pragma once
#include "core/types.hpp"
#include "study/value.hpp"
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fretwork::study {

using core::Vec3;

inline constexpr double degree = std::numbers::pi / 180.0; ///< rad: studies give angles in degrees

enum class Range { any, at_least_zero, above_zero };

/// What a number has to be. Infinities and NaN are always refused.
struct Quantity {
  Range range = Range::any;
  const char* unit = ""; ///< empty: dimensionless
  const char* cure = ""; ///< said when the number is out of range
};

/// The keys of a table: any other is an error.
struct Keys {
  std::vector<std::string> known;
};

/// The values of an enumeration by name.
template <class E> struct Choices { std::vector<std::pair<std::string, E>> available; };

/// @throws core::Error `where: path = value: problem`
[[noreturn]] void fail(const Value& value, const std::string& path, const std::string& problem);

/// Single values; `path` is for messages.
[[nodiscard]] double to_number(const Value& value, const std::string& path, const Quantity& quantity);
[[nodiscard]] std::string to_text(const Value& value, const std::string& path);
/// The items of an array, at least one; `expected` says what they should be.
[[nodiscard]] const Array& to_array(const Value& value, const std::string& path, const std::string& expected);
/// `size` numbers, or at least one where size is 0.
[[nodiscard]] std::vector<double> to_numbers(const Value& value, const std::string& path, std::size_t size,
                                             const Quantity& quantity);
/// The index of a string among names.
[[nodiscard]] std::size_t to_choice(const Value& value, const std::string& path,
                                    const std::vector<std::string>& names);

class TableReader {
public:
  /// @throws core::Error where the value is not a table or has a key that is not in `keys`
  TableReader(const Value& value, std::string path, const Keys& keys);

  [[nodiscard]] const Value* find(const std::string& key) const;
  [[nodiscard]] bool has(const std::string& key) const { return find(key) != nullptr; }
  [[nodiscard]] std::string path(const std::string& key) const;
  [[nodiscard]] const Value& value() const { return value_; }

  [[nodiscard]] double number(const std::string& key, const Quantity& quantity) const;
  [[nodiscard]] double number_or(const std::string& key, double otherwise, const Quantity& quantity) const;
  [[nodiscard]] std::optional<double> optional_number(const std::string& key, const Quantity& quantity) const;
  [[nodiscard]] std::optional<std::int64_t> optional_integer(const std::string& key,
                                                             std::int64_t lowest) const;
  [[nodiscard]] std::optional<bool> optional_flag(const std::string& key) const;
  [[nodiscard]] std::string text(const std::string& key, const std::string& expected) const;
  [[nodiscard]] std::optional<std::string> optional_text(const std::string& key) const;
  [[nodiscard]] std::optional<std::vector<double>> optional_numbers(const std::string& key, std::size_t size,
                                                                    const Quantity& quantity) const;
  [[nodiscard]] std::optional<Vec3> optional_vector(const std::string& key, const Quantity& quantity) const;
  /// A vector that must not be zero, as given.
  [[nodiscard]] std::optional<Vec3> optional_axis(const std::string& key) const;
  /// A required vector that must not be zero, made a unit vector.
  [[nodiscard]] Vec3 direction(const std::string& key) const;
  template <class E>
  [[nodiscard]] E choice(const std::string& key, E otherwise, const Choices<E>& choices) const {
    const Value* found = find(key);
    if (!found)
      return otherwise;
    std::vector<std::string> names;
    for (const auto& entry : choices.available)
      names.push_back(entry.first);
    return choices.available[to_choice(*found, path(key), names)].second;
  }

  /// The value of a required key; `expected` says in the message what it would be.
  [[nodiscard]] const Value& required(const std::string& key, const std::string& expected) const;
  /// A message about a key that is there, or about the table as a whole.
  [[noreturn]] void fail_at(const std::string& key, const std::string& problem) const;
  [[noreturn]] void fail_table(const std::string& problem) const;

private:
  const Value& value_;
  std::string path_;
};

/// An entry of an array of tables, or of a table of tables.
struct Entry {
  const Value* value;
  std::string path; ///< `contacts.tsp1`, `loads.0`
  std::string name; ///< of a table of tables
};

/// The entries of `[[key]]`, none where the study has no such key. The path names an entry by its name, else
/// by its group where that is unique, else by its index.
[[nodiscard]] std::vector<Entry> array_entries(const TableReader& root, const std::string& key);

/// The entries of `[key.name]`, by name.
[[nodiscard]] std::vector<Entry> table_entries(const TableReader& root, const std::string& key);

} // namespace fretwork::study
