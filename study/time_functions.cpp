// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/time_functions.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "study/accelerogram.hpp"
#include "study/number_rows.hpp"
#include <optional>
#include <string_view>
#include <vector>

namespace fretwork::study {
namespace {

constexpr std::string_view acceleration_unit = "m/s2";

/// Appends a row.
/// @return what is wrong with its time, or an empty string
std::string append_row(signals::Table& table, double time, double value) {
  const std::size_t n = table.time.size();
  if (n >= 1 && time < table.time[n - 1])
    return "the time decreases; sort the rows by time";
  if (n >= 2 && time == table.time[n - 2])
    return "a third row at the same time; two rows of equal time make a jump, remove the one between";
  table.time.push_back(time);
  table.value.push_back(value);
  return {};
}

signals::Table rows_of(const Value& value, const std::string& path, const char* unit) {
  const Array& rows = to_array(value, path, "an array of rows [t, value]");
  signals::Table table;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string row_path = path + "[" + std::to_string(i) + "]";
    const auto row = to_numbers(rows[i], row_path, 2, {Range::any, unit});
    if (const auto problem = append_row(table, row[0], row[1]); !problem.empty())
      fail(rows[i], row_path, problem);
  }
  return table;
}

signals::Table table_of(const Value& value, const std::string& path, const std::filesystem::path& folder,
                        const char* unit) {
  if (value.array())
    return rows_of(value, path, unit);
  if (!value.string())
    fail(value, path,
         "the name of a file of rows t,value or an array of rows [t, value] is expected, not " +
             kind_of(value));
  try {
    const std::filesystem::path file = folder / to_text(value, path);
    if (!is_accelerogram(file))
      return read_time_table(file);
    if (std::string_view(unit) != acceleration_unit && !std::string_view(unit).empty())
      throw core::Error("file " + file.string() + " is an accelerogram, and a table in " + unit +
                        " is expected");
    return read_accelerogram(file);
  } catch (const core::Error& error) {
    fail(value, path, error.what());
  }
}

signals::Table scaled(signals::Table table, double scale) {
  for (double& value : table.value)
    value *= scale;
  return table;
}

signals::Harmonic read_harmonic(const TableReader& entry, const char* unit) {
  const TableReader table(*entry.find("harmonic"), entry.path("harmonic"),
                          {{"amplitude", "frequency", "phase"}});
  return {table.number("amplitude", {Range::any, unit}), table.number("frequency", {Range::above_zero, "Hz"}),
          table.number_or("phase", 0.0, {Range::any, "rad"})};
}

signals::Random read_random(const TableReader& entry, const char* unit) {
  const TableReader table(*entry.find("random"), entry.path("random"), {{"rms", "band", "seed"}});
  (void)table.required("band", "two frequencies [low, high] in Hz");
  const double rms = table.number("rms", {Range::at_least_zero, unit});
  const auto band = *table.optional_numbers("band", 2, {Range::at_least_zero, "Hz"});
  if (band[0] >= band[1])
    table.fail_at("band",
                  "the lower frequency is expected first, and below the upper one; write [low, high]");
  return {rms, band[0], band[1], static_cast<std::uint64_t>(table.optional_integer("seed", 0).value_or(1))};
}

} // namespace

signals::Table read_time_table(const std::filesystem::path& file) {
  signals::Table table;
  CellRows rows(file, 2);
  while (rows.next()) {
    const std::vector<std::string>& cells = rows.cells();
    const auto time = to_real(cells[0]);
    const auto value = cells.size() == 2 ? to_real(cells[1]) : std::nullopt;
    if (!time || !value)
      rows.refuse("a row is two finite numbers, t,value");
    if (const auto problem = append_row(table, *time, *value); !problem.empty())
      rows.refuse(problem);
  }
  if (table.time.empty())
    throw core::Error("file " + file.string() + " has no row; give rows t,value");
  return table;
}

signals::TimeFunction read_time_function(const TableReader& entry, const std::filesystem::path& folder,
                                         const char* unit) {
  std::vector<std::string> given;
  for (const std::string& key : time_function_keys)
    if (entry.has(key))
      given.push_back(key);
  if (given.empty())
    entry.fail_table("no time function; give exactly one of " + core::list_names(time_function_keys));
  if (given.size() > 1)
    entry.fail_at(given[1], "several time functions: " + core::list_names(given) + "; keep one");
  const std::string& key = given[0];
  if (key != "table" && entry.has("scale"))
    entry.fail_at("scale", "belongs to a table, whose values it multiplies; leave it out");
  if (key == "constant")
    return signals::Constant{entry.number(key, {Range::any, unit})};
  if (key == "harmonic")
    return read_harmonic(entry, unit);
  if (key == "table")
    return scaled(table_of(*entry.find(key), entry.path(key), folder, unit),
                  entry.number_or("scale", 1.0, {}));
  return read_random(entry, unit);
}

void inline_time_table(Value& entry, const std::string& path, const std::filesystem::path& folder) {
  auto* keys = std::get_if<Table>(&entry.data);
  if (!keys)
    return;
  const auto at = keys->find("table");
  if (at == keys->end() || !at->second.string())
    return;
  const signals::Table table = table_of(at->second, path + ".table", folder, "");
  Array rows;
  for (std::size_t i = 0; i < table.time.size(); ++i)
    rows.push_back({Array{{table.time[i], {}}, {table.value[i], {}}}, {}});
  at->second.data = std::move(rows);
}

} // namespace fretwork::study
