// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A value of a study file and the place where it was written, so that every message can name it.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace fretwork::study {

/// Where a value was written: a line of a file, or an override.
struct Where {
  std::shared_ptr<const std::string> origin; ///< the file's name, or `--set key=value`
  int line = 0;                              ///< from 1; 0: no line (an override, a whole file)

  /// `study.toml:12` or `--set key=value`
  [[nodiscard]] std::string text() const;
};

/// TOML's dates and times: no key takes one, they are kept for the message only.
struct Moment {
  std::string text;
};

struct Value;
using Array = std::vector<Value>;
using Table = std::map<std::string, Value>;

struct Value {
  std::variant<bool, std::int64_t, double, std::string, Moment, Array, Table> data;
  Where where;

  [[nodiscard]] const Array* array() const { return std::get_if<Array>(&data); }
  [[nodiscard]] const Table* table() const { return std::get_if<Table>(&data); }
  [[nodiscard]] const std::string* string() const { return std::get_if<std::string>(&data); }
};

/// `a number`, `a string` ...: what the value is, for messages.
[[nodiscard]] std::string kind_of(const Value& value);

/// How real numbers are written: as short as possible (messages), with 17 digits (canonical text), or as short as possible with whole numbers
/// like integers, so that a key of integers takes them (values of a sweep). All read back as the same number.
enum class Digits { shortest, seventeen, shortest_or_whole };

/// The value as TOML on one line, keys sorted. A real number without fraction is written like an integer, so
/// that 2 and 2.0 are the same.
[[nodiscard]] std::string toml_text(const Value& value, Digits digits);

/// A key as TOML: quoted only where it has to be.
[[nodiscard]] std::string toml_key(const std::string& key);

} // namespace fretwork::study
