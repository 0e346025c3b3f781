// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/flow_tables.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "study/number_rows.hpp"
#include <algorithm>

namespace fretwork::study {
namespace {

const std::string velocity_key = "velocity";
const std::vector<std::string> components{"velocity_x", "velocity_y", "velocity_z"};

/// Rows s, value or s, x, y, z.
using Rows = std::vector<std::vector<double>>;

std::optional<std::size_t> column_of(const NumberRows& file, const std::string& name) {
  const auto at = std::find(file.columns.begin(), file.columns.end(), name);
  return at == file.columns.end()
             ? std::nullopt
             : std::optional<std::size_t>(static_cast<std::size_t>(at - file.columns.begin()));
}

/// Of the columns that the header names for the key.
Rows named_columns(const NumberRows& file, const std::string& key) {
  std::vector<std::size_t> wanted;
  const auto take = [&](const std::string& name) {
    const auto column = column_of(file, name);
    if (!column)
      throw core::Error("its header has no column \"" + name + "\"" + core::name_help(name, file.columns));
    wanted.push_back(*column);
  };
  take("s");
  if (key == velocity_key && !column_of(file, key))
    std::for_each(components.begin(), components.end(), take);
  else
    take(key);
  Rows out;
  for (const std::vector<double>& row : file.rows) {
    out.emplace_back();
    for (const std::size_t column : wanted)
      out.back().push_back(row[column]);
  }
  return out;
}

bool fits(std::size_t columns, const std::string& key) {
  return columns == 2 || (key == velocity_key && columns == 1 + components.size());
}

Rows file_rows(const Value& value, const std::string& path, const std::string& key,
               const std::filesystem::path& folder) {
  try {
    NumberRows file = read_number_rows(folder / to_text(value, path));
    if (!file.columns.empty())
      return named_columns(file, key);
    if (!fits(file.rows.front().size(), key))
      throw core::Error("it has " + std::to_string(file.rows.front().size()) +
                        " columns and no header; give a header with s and " + key +
                        ", or rows of s and the value");
    return std::move(file.rows);
  } catch (const core::Error& error) {
    fail(value, path, error.what());
  }
}

Rows inline_rows(const Value& value, const std::string& path, const std::string& key) {
  Rows out;
  const Array& rows = *value.array();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string row_path = path + "[" + std::to_string(i) + "]";
    const std::vector<double> row = to_numbers(rows[i], row_path, 0, {});
    if (!fits(row.size(), key) || (i > 0 && row.size() != out.front().size()))
      fail(rows[i], row_path,
           key == velocity_key ? "a row [s, value] or [s, x, y, z] is expected, all rows alike"
                               : "a row [s, value] is expected");
    out.push_back(row);
  }
  return out;
}

Rows rows_of(const Value& value, const std::string& path, const std::string& key,
             const std::filesystem::path& folder) {
  if (value.string())
    return file_rows(value, path, key, folder);
  if (value.array() && !value.array()->empty())
    return inline_rows(value, path, key);
  fail(value, path,
       "a number, an array of rows [s, value] or the name of a file of rows is expected, not " +
           kind_of(value));
}

template <class T, class Make> flow::Table<T> table_of(const Rows& rows, const Make& make) {
  flow::Table<T> out;
  for (const std::vector<double>& row : rows) {
    out.s.push_back(row[0]);
    out.values.push_back(make(row));
  }
  return out;
}

template <class T>
void check_order(const flow::Table<T>& table, const Value& value, const std::string& path) {
  for (std::size_t i = 1; i < table.s.size(); ++i)
    if (table.s[i] <= table.s[i - 1])
      fail(value, path,
           "row " + std::to_string(i + 1) + " is not beyond the one before; let s rise from row to row");
}

flow::Table<double> values_of(const Rows& rows, const Value& value, const std::string& path,
                              const Quantity& quantity) {
  auto table = table_of<double>(rows, [](const std::vector<double>& row) { return row[1]; });
  for (std::size_t i = 0; i < table.values.size(); ++i) // as if it were a number of the study
    (void)to_number({table.values[i], value.where}, path + "[" + std::to_string(i) + "]", quantity);
  check_order(table, value, path);
  return table;
}

bool is_vector(const Value& value) {
  const Array* items = value.array();
  return items && !items->empty() && !items->front().array();
}

bool is_number(const Value& value) { return !value.array() && !value.string(); }

} // namespace

flow::Table<double> read_flow_table(const TableReader& table, const std::string& key,
                                    const std::filesystem::path& folder, const Quantity& quantity) {
  const Value& value = *table.find(key);
  const std::string path = table.path(key);
  if (is_number(value))
    return flow::Table<double>::constant(to_number(value, path, quantity));
  return values_of(rows_of(value, path, key, folder), value, path, quantity);
}

flow::Velocity read_velocity(const TableReader& zone, const std::filesystem::path& folder) {
  const Quantity speed{Range::at_least_zero, "m/s", "a direction is given by direction, or by a vector"};
  const Value* value = zone.find(velocity_key);
  if (!value)
    return flow::ScalarVelocity{flow::Table<double>::constant(0.0), zone.optional_axis("direction")};
  const std::string path = zone.path(velocity_key);
  const auto vectors = [&](flow::Table<Vec3> table) {
    if (zone.has("direction"))
      zone.fail_at("direction", "the velocity is a vector, which has a direction; keep one");
    return flow::VectorVelocity{std::move(table)};
  };
  if (is_vector(*value)) {
    const std::vector<double> u = to_numbers(*value, path, 3, {Range::any, "m/s"});
    return vectors(flow::Table<Vec3>::constant({u[0], u[1], u[2]}));
  }
  if (is_number(*value))
    return flow::ScalarVelocity{flow::Table<double>::constant(to_number(*value, path, speed)),
                                zone.optional_axis("direction")};
  const Rows rows = rows_of(*value, path, velocity_key, folder);
  if (rows.front().size() == 2)
    return flow::ScalarVelocity{values_of(rows, *value, path, speed), zone.optional_axis("direction")};
  auto table =
      table_of<Vec3>(rows, [](const std::vector<double>& row) { return Vec3(row[1], row[2], row[3]); });
  check_order(table, *value, path);
  return vectors(std::move(table));
}

void inline_flow_tables(Value& entry, const std::string& path, const std::filesystem::path& folder) {
  auto* keys = std::get_if<Table>(&entry.data);
  const auto zones = keys ? keys->find("zones") : Table::iterator{};
  auto* all = keys && zones != keys->end() ? std::get_if<Array>(&zones->second.data) : nullptr;
  if (!all)
    return;
  for (std::size_t i = 0; i < all->size(); ++i) {
    auto* zone = std::get_if<Table>(&(*all)[i].data);
    if (!zone)
      continue;
    for (const std::string& key : flow_table_keys) {
      const auto at = zone->find(key);
      if (at == zone->end() || !at->second.string())
        continue;
      Array rows;
      for (const auto& row :
           file_rows(at->second, path + ".zones." + std::to_string(i) + "." + key, key, folder)) {
        Array cells;
        for (const double number : row)
          cells.push_back({number, {}});
        rows.push_back({std::move(cells), {}});
      }
      at->second.data = std::move(rows);
    }
  }
}

} // namespace fretwork::study
