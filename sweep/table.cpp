// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep/table.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "results/columns_file.hpp"
#include "results/text_file.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace fretwork::sweep {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A cell between quotes where it has to be.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos)
    return text;
  std::string out = "\"";
  for (const char c : text)
    out.append(c == '"' ? 2 : 1, c);
  out += '"';
  return out;
}

/// A text of TOML without its quotes.
std::string unquoted(const std::string& text) {
  return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2)
                                                                       : text;
}

std::string head(const std::string& name, const std::string& unit) {
  return cell(unit.empty() ? name : name + " [" + unit + "]");
}

/// Column of each variable among the draws; -1: it is not drawn.
std::vector<Eigen::Index> columns_of(const study::Sweep& sweep) {
  std::vector<Eigen::Index> out(sweep.variables.size(), -1);
  Eigen::Index next = 0;
  for (const std::size_t v : drawn_variables(sweep))
    out[v] = next++;
  return out;
}

bool is_of_wear(const std::string& output) {
  return output.ends_with(".wear_depth") || output.ends_with(".years");
}

double drawn_at(const Draws& draws, std::int64_t number, Eigen::Index column) {
  return column < 0 ? 0.0 : draws(number, column);
}

} // namespace

std::vector<std::size_t> Table::done() const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].outcome == Outcome::done)
      out.push_back(i);
  return out;
}

bool Table::has_contacts() const {
  return std::any_of(outputs.begin(), outputs.end(),
                     [](const Column& column) { return column.name == "worst.work_rate"; });
}

std::size_t place_of(const std::vector<Column>& columns, const std::string& output,
                     const std::string& where) {
  const auto at = std::find_if(columns.begin(), columns.end(),
                               [&](const Column& column) { return column.name == output; });
  if (at != columns.end())
    return static_cast<std::size_t>(at - columns.begin());
  std::vector<std::string> names;
  for (const Column& column : columns)
    if (!column.name.ends_with(".error"))
      names.push_back(column.name);
  std::stable_partition(names.begin(), names.end(), [](const std::string& name) {
    return name.starts_with("worst.") || name.starts_with("total.");
  });
  const bool wears = std::any_of(names.begin(), names.end(), is_of_wear);
  throw core::Error(fmt::format("{}: no output is called \"{}\"{}{}", where, output,
                                core::name_help(output, names, "outputs"),
                                is_of_wear(output) && !wears ? "; wear needs [[wear]]" : ""));
}

void write_csv(const std::filesystem::path& file, const study::Sweep& sweep, const Draws& draws,
               const Table& table) {
  const std::vector<Eigen::Index> columns = columns_of(sweep);
  std::vector<std::string> cells{"case", "outcome", "identity"};
  for (const study::SweepVariable& variable : sweep.variables)
    cells.push_back(head(variable.name, ""));
  for (const Column& output : table.outputs)
    cells.push_back(head(output.name, output.unit));
  cells.emplace_back("message");
  std::string text = fmt::format("{}\n", fmt::join(cells, ","));
  for (const Row& row : table.rows) {
    cells = {std::to_string(row.number), name_of(row.outcome), row.identity};
    for (std::size_t v = 0; v < sweep.variables.size(); ++v)
      cells.push_back(cell(
          unquoted(value_text(sweep.variables[v], drawn_at(draws, row.number, columns[v]), row.number))));
    for (std::size_t j = 0; j < table.outputs.size(); ++j)
      cells.push_back(row.values.empty() ? "" : fmt::format("{}", row.values[j]));
    cells.push_back(cell(row.message));
    fmt::format_to(std::back_inserter(text), "{}\n", fmt::join(cells, ","));
  }
  results::write_text(file, text);
}

void write_archive(const std::filesystem::path& file, const study::Sweep& sweep, const Draws& draws,
                   const Table& table, std::map<std::string, std::string> attributes) {
  const std::vector<Eigen::Index> columns = columns_of(sweep);
  std::vector<results::NumberColumn> out{{"case", "number", "", {}}, {"case", "outcome", "", {}}};
  for (const Row& row : table.rows) {
    out[0].values.push_back(static_cast<double>(row.number));
    out[1].values.push_back(static_cast<double>(row.outcome));
  }
  for (std::size_t v = 0; v < sweep.variables.size(); ++v) {
    const study::SweepVariable& variable = sweep.variables[v];
    results::NumberColumn& column = out.emplace_back(results::NumberColumn{"inputs", variable.name, "", {}});
    for (const Row& row : table.rows)
      column.values.push_back(value_number(variable, drawn_at(draws, row.number, columns[v]), row.number));
    std::vector<std::string> names = value_names(variable);
    std::transform(names.begin(), names.end(), names.begin(), unquoted);
    if (!names.empty())
      attributes["values of " + results::path_name(variable.name)] =
          fmt::format("{}", fmt::join(names, "\n"));
  }
  for (std::size_t j = 0; j < table.outputs.size(); ++j) {
    results::NumberColumn& column =
        out.emplace_back(results::NumberColumn{"outputs", table.outputs[j].name, table.outputs[j].unit, {}});
    for (const Row& row : table.rows)
      column.values.push_back(row.values.empty() ? no_number : row.values[j]);
  }
  results::write_columns(file, attributes, out);
}

} // namespace fretwork::sweep
