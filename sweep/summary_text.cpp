// SPDX-License-Identifier: GPL-3.0-or-later
// The summary of a sweep in lines for the terminal.
#include "results/figures.hpp"
#include "results/text_file.hpp"
#include "sweep/summary.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

namespace fretwork::sweep {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_ranges = 16; ///< lines of outputs
constexpr std::size_t name_width = 24, cell_width = 31, shown_variables = 4, shown_firsts = 4;

/// Places of the columns in the order in which they are read: lives and depths, work rates, forces, the others, round-off last.
std::vector<std::size_t> reading_order(const std::vector<std::string>& columns) {
  constexpr std::array first{"worst.years",      "worst.wear_depth", "worst.work_rate",  "total.work_rate",
                             "worst.normal_rms", "worst.normal_max", "total.impact_rate"};
  const auto rank = [&](std::size_t place) {
    const auto found = std::find(first.begin(), first.end(), columns[place]) - first.begin();
    return columns[place] == "total.energy_residual" ? static_cast<std::ptrdiff_t>(first.size()) + 1 : found;
  };
  std::vector<std::size_t> out(columns.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  std::stable_sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return out;
}

std::vector<std::string> names_of(const std::vector<Column>& columns) {
  std::vector<std::string> out;
  for (const Column& column : columns)
    out.push_back(column.name);
  return out;
}

std::string figure(const Json& value) {
  if (value.is_null())
    return "-";
  return value.is_string() ? value.get<std::string>() : fmt::format("{:.3g}", value.get<double>());
}

/// With its interval: "3.2 (2.9 to 3.6)", with one end "3.2 (above 2.9)". An end that is a text (never) leaves the other side without a bound.
std::string interval(const Json& entry) {
  const Json &low = entry["low"], &high = entry["high"];
  const std::string value = figure(entry["value"]);
  if (!low.is_null() && !high.is_null())
    return fmt::format("{} ({} to {})", value, figure(low), figure(high));
  if (low.is_number())
    return fmt::format("{} (above {})", value, figure(low));
  if (high.is_number())
    return fmt::format("{} (below {})", value, figure(high));
  return low.is_string() ? value : value + " (no interval)";
}

bool is_of_all(const std::string& name) { return name.starts_with("worst.") || name.starts_with("total."); }

/// A line of right-aligned cells behind a name.
std::string line_of_cells(const std::string& head, const std::vector<std::string>& cells) {
  std::string out = fmt::format("  {:<{}}", results::shortened(head, name_width), name_width);
  for (const std::string& cell : cells)
    out += fmt::format(" {:>{}}", cell, cell_width);
  return out + "\n";
}

std::string quantile_lines(const Json& summary) {
  const Json& outputs = summary["statistics"]["outputs"];
  std::vector<std::string> heads;
  for (const Json& quantile : outputs.front()["quantiles"])
    heads.push_back(fmt::format("{:g} %", 100.0 * quantile["probability"].get<double>()));
  std::string out = line_of_cells("quantile", heads);
  const bool contacts = outputs.contains("worst.work_rate");
  std::size_t lines = 0;
  const std::vector<std::string> columns = summary["columns"];
  for (const std::size_t place : reading_order(columns)) {
    const std::string& name = columns[place];
    const auto found = outputs.find(name);
    if (found == outputs.end()) // an error
      continue;
    const Json& output = *found;
    if (contacts ? !is_of_all(name) : name.ends_with(".error") || ++lines > most_ranges)
      continue;
    std::vector<std::string> cells;
    for (const Json& quantile : output["quantiles"])
      cells.push_back(interval(quantile));
    const std::string unit = summary["units"].value(name, "");
    out += line_of_cells(unit.empty() ? name : name + " " + unit, cells);
  }
  return out;
}

std::string limit_lines(const Json& summary) {
  std::string out;
  for (const Json& limit : summary["statistics"]["limits"])
    if (limit.contains("probability"))
      out += fmt::format("  probability  {} {} {:g}: {:.3g} ({:.3g} to {:.3g}), {} of {} cases\n",
                         limit["output"].get<std::string>(), limit["above"].get<bool>() ? "above" : "below",
                         limit["value"].get<double>(), limit["probability"].get<double>(),
                         limit["low"].get<double>(), limit["high"].get<double>(), limit["hits"].get<int>(),
                         limit["cases"].get<int>());
  return out;
}

std::string name_of_life(const Json& life) {
  return life["support"].get<std::string>() + (life["body"] == "support" ? " (the support)" : "");
}

/// Lives that have no value in some case: these cases are not judged.
std::string unknown_lines(const Json& unknown) {
  std::string names;
  for (std::size_t i = 0; i < std::min(unknown.size(), shown_firsts); ++i)
    names += fmt::format("{}{} in {}", i ? ", " : "", name_of_life(unknown[i]),
                         results::counted(unknown[i]["cases"].get<std::int64_t>(), "case"));
  if (unknown.size() > shown_firsts)
    names += fmt::format(" and {} more", unknown.size() - shown_firsts);
  return fmt::format("    not judged: no life (outside its law, or beyond its geometry) of {}; upper ends of "
                     "the intervals include these cases\n",
                     names);
}

/// Which support is first, by shares of the cases.
std::string first_lines(const Json& summary) {
  const auto found = summary["statistics"].find("first_support");
  if (found == summary["statistics"].end())
    return {};
  const Json& supports = (*found)["supports"];
  const auto not_judged = found->value("not_judged", std::int64_t{0});
  if (supports.empty() && not_judged == 0)
    return {};
  std::string out = "  first to its limit  ";
  for (std::size_t i = 0; i < std::min(supports.size(), shown_firsts); ++i) {
    const Json& first = supports[i];
    const auto percent = [&](const char* key) { return 100.0 * first[key].get<double>(); };
    out += fmt::format("{}{} {:.0f} % ({:.0f} to {:.0f})", i ? ", " : "", name_of_life(first),
                       percent("share"), percent("low"), percent("high"));
  }
  if (supports.size() > shown_firsts)
    out += fmt::format(" and {} more", supports.size() - shown_firsts);
  const auto cases = (*found)["cases"].get<std::int64_t>();
  const auto add_share = [&](const char* what, std::int64_t of) {
    if (of > 0)
      out += fmt::format("{}{} {:.0f} %", out.ends_with("  ") ? "" : ", ", what,
                         100.0 * static_cast<double>(of) / static_cast<double>(cases));
  };
  add_share("none", (*found)["never"].get<std::int64_t>());
  add_share("not judged", not_judged);
  out += fmt::format(" of {}\n", results::counted(cases, "case"));
  return not_judged > 0 ? out + unknown_lines((*found)["unknown"]) : out;
}

std::string sensitivity_lines(const Json& summary) {
  const Json& statistics = summary["statistics"];
  const std::string of = statistics["convergence"]["output"];
  const auto found = statistics["sensitivities"].find(of);
  if (found == statistics["sensitivities"].end())
    return {};
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [name, entry] : found->items())
    order.emplace_back(-std::abs(entry["value"].get<double>()), name);
  std::sort(order.begin(), order.end());
  std::string out =
      fmt::format("  sensitivity  {} of {}:",
                  statistics["method"] == "sobol" ? "Sobol' indices, first order" : "rank correlation", of);
  for (std::size_t i = 0; i < std::min(order.size(), shown_variables); ++i)
    out += fmt::format("{} {} {}", i ? "," : "", order[i].second, interval((*found)[order[i].second]));
  return out + "\n";
}

std::string convergence_line(const Json& summary) {
  const Json& c = summary["statistics"]["convergence"];
  const std::string quantile = fmt::format("{:g} % quantile of {}", 100.0 * c["quantile"].get<double>(),
                                           c["output"].get<std::string>());
  const double asked = 100.0 * c["relative_error"].get<double>();
  const std::string needed =
      c["cases_needed"].is_null()
          ? ""
          : fmt::format("; about {} would make it {:g} %",
                        results::counted(c["cases_needed"].get<std::int64_t>(), "case"), asked);
  if (c["error"].is_null())
    return fmt::format(
        "  convergence  {}: {} give no interval{}\n", quantile,
        results::counted(c["cases"].get<std::int64_t>(), "case"),
        c["cases_needed"].is_null()
            ? ""
            : fmt::format("; {} would", results::counted(c["cases_needed"].get<std::int64_t>(), "case")));
  return fmt::format("  convergence  {}: +-{:.2g} % with {}{}\n", quantile, 100.0 * c["error"].get<double>(),
                     results::counted(c["cases"].get<std::int64_t>(), "case"),
                     c["reached"].get<bool>() ? fmt::format(", {:g} % are asked for: enough", asked)
                                              : needed);
}

} // namespace

std::string range_lines(const Table& table) {
  const std::vector<std::size_t> done = table.done();
  const bool contacts = table.has_contacts();
  const std::string head = line_of_cells("range", {"least", "largest"});
  std::string out;
  std::size_t lines = 0;
  for (const std::size_t place : reading_order(names_of(table.outputs))) {
    const Column& column = table.outputs[place];
    if (column.name.ends_with(".error") || column.name == "total.energy_residual" ||
        (contacts && !is_of_all(column.name)))
      continue;
    const Row *least = nullptr, *largest = nullptr;
    for (const std::size_t i : done) {
      const Row& row = table.rows[i];
      if (std::isnan(row.values[place]))
        continue;
      least = !least || row.values[place] < least->values[place] ? &row : least;
      largest = !largest || row.values[place] > largest->values[place] ? &row : largest;
    }
    if (!least || std::abs(largest->values[place]) < round_off_of_outputs)
      continue;
    if (++lines > most_ranges)
      return head + out + "  and more in table.csv\n";
    const auto text = [&](const Row& row) {
      return fmt::format("{} (case {})", figure(Json(row.values[place])), row.number);
    };
    out += line_of_cells(column.unit.empty() ? column.name : column.name + " " + column.unit,
                         {text(*least), text(*largest)});
  }
  return out.empty() ? out : head + out;
}

std::string summary_text(const Json& summary) {
  const auto done = summary["done"].get<std::int64_t>(), rows = summary["rows"].get<std::int64_t>(),
             cases = summary["cases"].get<std::int64_t>();
  std::string out = fmt::format("  cases        {} ({}), {} done", results::grouped(cases),
                                summary["design"].get<std::string>(), results::grouped(done));
  if (rows > done)
    out += fmt::format(", {} without a result", results::grouped(rows - done));
  if (cases > rows)
    out += fmt::format(", {} missing", results::grouped(cases - rows));
  out += "\n";
  for (const Json& warning : summary["warnings"])
    out += fmt::format("  warning      {}\n", warning.get<std::string>());
  if (!summary.contains("statistics"))
    return out;
  return out + quantile_lines(summary) + first_lines(summary) + limit_lines(summary) +
         sensitivity_lines(summary) + convergence_line(summary);
}

} // namespace fretwork::sweep
