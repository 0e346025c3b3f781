// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep/summary.hpp"
#include "results/figures.hpp"
#include "results/grouped_messages.hpp"
#include "results/text_file.hpp"
#include "sweep/openturns.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace fretwork::sweep {
namespace {

using nlohmann::json;

constexpr std::size_t most_failures = 100; ///< that the summary lists; the table has all
constexpr std::size_t most_case_warnings = 10;
constexpr std::size_t most_ranges = 16; ///< lines of outputs
constexpr double round_off = 1e-12;     ///< of displacements, m, and forces, N: nothing moves so little
constexpr std::size_t name_width = 24, cell_width = 31, shown_variables = 4, shown_firsts = 4;

/// Inputs that are drawn and outputs, as numbers, of the rows that statistics are made from: the done ones; of a design whose estimator needs every case all.
std::vector<double> values_of(const study::Sweep& sweep, const Draws& draws, const Table& table,
                              std::size_t& rows) {
  const std::vector<std::size_t> drawn = drawn_variables(sweep);
  std::vector<double> out;
  rows = 0;
  for (const Row& row : table.rows) {
    const bool done = row.outcome == Outcome::done;
    if (!done && sweep.design != study::SweepDesign::saltelli)
      continue;
    ++rows;
    for (Eigen::Index j = 0; j < draws.cols(); ++j)
      out.push_back(value_number(sweep.variables[drawn[static_cast<std::size_t>(j)]], draws(row.number, j),
                                 row.number));
    for (std::size_t j = 0; j < table.outputs.size(); ++j)
      out.push_back(done ? row.values[j] : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

/// Of a support: of its tube, or its own.
bool is_life(const std::string& name) {
  return (name.ends_with(".years") || name.ends_with(".support_years")) && name != "worst.years";
}

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

json statistics_request(const study::Sweep& sweep, const Table& table) {
  json out{{"operation", "summarize"},     {"design", name_of(sweep.design)}, {"count", sweep.draws},
           {"quantiles", sweep.quantiles}, {"confidence", sweep.confidence},  {"limits", json::array()},
           {"inputs", json::array()},      {"outputs", json::array()}};
  for (const std::size_t v : drawn_variables(sweep))
    out["inputs"].push_back(sweep.variables[v].name);
  out["lives"] = json::array();
  for (const Column& column : table.outputs) {
    out["outputs"].push_back(column.name);
    if (is_life(column.name)) {
      out["lives"].push_back({{"output", column.name}, {"contacts", json::array()}});
      for (const std::string& contact : column.contacts)
        out["lives"].back()["contacts"].push_back(contact + ".work_rate");
    }
  }
  for (const study::SweepLimit& limit : sweep.limits)
    out["limits"].push_back({{"output", limit.output}, {"value", limit.value}, {"above", limit.above}});
  study::SweepUntil until = sweep.until.value_or(study::SweepUntil{});
  if (until.output.empty())
    until.output = measure_of(table);
  out["until"] = {
      {"output", until.output}, {"quantile", until.quantile}, {"relative_error", until.relative_error}};
  return out;
}

std::string figure(const json& value) {
  if (value.is_null())
    return "-";
  return value.is_string() ? value.get<std::string>() : fmt::format("{:.3g}", value.get<double>());
}

/// With its interval: "3.2 (2.9 to 3.6)", with one end "3.2 (above 2.9)". An end that is a text (never) leaves the other side without a bound.
std::string interval(const json& entry) {
  const json &low = entry["low"], &high = entry["high"];
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

/// Whether the study has any: else there are no outputs of all of them.
bool has_contacts(const Table& table) {
  return std::any_of(table.outputs.begin(), table.outputs.end(),
                     [](const Column& column) { return column.name == "worst.work_rate"; });
}

/// A line of right-aligned cells behind a name.
std::string line_of_cells(const std::string& head, const std::vector<std::string>& cells) {
  std::string out = fmt::format("  {:<{}}", results::shortened(head, name_width), name_width);
  for (const std::string& cell : cells)
    out += fmt::format(" {:>{}}", cell, cell_width);
  return out + "\n";
}

std::string quantile_lines(const json& summary) {
  const json& outputs = summary["statistics"]["outputs"];
  std::vector<std::string> heads;
  for (const json& quantile : outputs.front()["quantiles"])
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
    const json& output = *found;
    if (contacts ? !is_of_all(name) : name.ends_with(".error") || ++lines > most_ranges)
      continue;
    std::vector<std::string> cells;
    for (const json& quantile : output["quantiles"])
      cells.push_back(interval(quantile));
    const std::string unit = summary["units"].value(name, "");
    out += line_of_cells(unit.empty() ? name : name + " " + unit, cells);
  }
  return out;
}

std::string limit_lines(const json& summary) {
  std::string out;
  for (const json& limit : summary["statistics"]["limits"])
    if (limit.contains("probability"))
      out += fmt::format("  probability  {} {} {:g}: {:.3g} ({:.3g} to {:.3g}), {} of {} cases\n",
                         limit["output"].get<std::string>(), limit["above"].get<bool>() ? "above" : "below",
                         limit["value"].get<double>(), limit["probability"].get<double>(),
                         limit["low"].get<double>(), limit["high"].get<double>(), limit["hits"].get<int>(),
                         limit["cases"].get<int>());
  return out;
}

std::string name_of_life(const json& life) {
  return life["support"].get<std::string>() + (life["body"] == "support" ? " (the support)" : "");
}

/// Lives that have no value in some case: these cases are not judged.
std::string unknown_lines(const json& unknown) {
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
std::string first_lines(const json& summary) {
  const auto found = summary["statistics"].find("first_support");
  if (found == summary["statistics"].end())
    return {};
  const json& supports = (*found)["supports"];
  const auto not_judged = found->value("not_judged", std::int64_t{0});
  if (supports.empty() && not_judged == 0)
    return {};
  std::string out = "  first to its limit  ";
  for (std::size_t i = 0; i < std::min(supports.size(), shown_firsts); ++i) {
    const json& first = supports[i];
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

std::string sensitivity_lines(const json& summary) {
  const json& statistics = summary["statistics"];
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

/// Why a case has no result, or its warnings.
std::vector<std::string> messages_of(const Row& row) {
  constexpr std::string_view between = Row::between;
  std::vector<std::string> out;
  for (std::size_t from = 0; from < row.message.size();) {
    const std::size_t end = row.outcome == Outcome::done
                                ? std::min(row.message.find(between, from), row.message.size())
                                : row.message.size();
    out.push_back(row.message.substr(from, end - from));
    from = end + between.size();
  }
  return out;
}

std::string convergence_line(const json& summary) {
  const json& c = summary["statistics"]["convergence"];
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

json summarize(const study::Sweep& sweep, const Draws& draws, const Table& table) {
  check_outputs(sweep, table.outputs);
  json out{{"design", name_of(sweep.design)}, {"cases", draws.rows()},     {"rows", table.rows.size()},
           {"done", table.done().size()},     {"failures", json::array()}, {"units", json::object()},
           {"confidence", sweep.confidence}};
  for (const Column& column : table.outputs) {
    out["columns"].push_back(column.name); // in their order
    out["units"][column.name] = column.unit;
  }
  for (const Row& row : table.rows)
    if (row.outcome != Outcome::done && out["failures"].size() < most_failures)
      out["failures"].push_back(
          {{"case", row.number}, {"outcome", name_of(row.outcome)}, {"message", row.message}});
  out["warnings"] = case_warnings(table);
  if (sweep.design == study::SweepDesign::grid || table.done().empty())
    return out;
  json request = statistics_request(sweep, table);
  std::size_t rows = 0;
  const std::vector<double> values = values_of(sweep, draws, table, rows);
  request["rows"] = rows;
  out["statistics"] = ask_openturns(request, values).json;
  if (const auto missing = draws.rows() - static_cast<Eigen::Index>(table.rows.size()); missing > 0)
    out["warnings"].push_back(fmt::format(
        "cases that are missing, {} of {}: the statistics are those of the others", missing, draws.rows()));
  if (const std::size_t done = table.done().size(); done < table.rows.size())
    out["warnings"].push_back(
        fmt::format("cases without a result, {} of {}: {}", table.rows.size() - done, table.rows.size(),
                    sweep.design == study::SweepDesign::saltelli
                        ? "Sobol' indices need them all, there are none"
                        : "the statistics are those of the others, as if these could not occur"));
  return out;
}

std::string measure_of(const Table& table) {
  const std::vector<std::size_t> done = table.done();
  for (const char* output : {"worst.work_rate", "worst.normal_max"}) {
    const auto found = std::find_if(table.outputs.begin(), table.outputs.end(),
                                    [&](const Column& column) { return column.name == output; });
    const auto place = static_cast<std::size_t>(found - table.outputs.begin());
    const auto differs = [&](std::size_t row) { return table.rows[row].values[place] > 0.0; };
    if (found != table.outputs.end() && std::any_of(done.begin(), done.end(), differs))
      return output;
  }
  if (has_contacts(table))
    return "worst.work_rate";
  for (std::size_t place = 0; place < table.outputs.size(); ++place)
    if (std::any_of(done.begin(), done.end(),
                    [&](std::size_t row) { return std::abs(table.rows[row].values[place]) > round_off; }))
      return table.outputs[place].name;
  return table.outputs.front().name;
}

std::string range_lines(const Table& table) {
  const std::vector<std::size_t> done = table.done();
  const bool contacts = has_contacts(table);
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
    if (!least || std::abs(largest->values[place]) < round_off)
      continue;
    if (++lines > most_ranges)
      return head + out + "  and more in table.csv\n";
    const auto text = [&](const Row& row) {
      return fmt::format("{} (case {})", figure(json(row.values[place])), row.number);
    };
    out += line_of_cells(column.unit.empty() ? column.name : column.name + " " + column.unit,
                         {text(*least), text(*largest)});
  }
  return out.empty() ? out : head + out;
}

std::string no_sliding_warning(const Table& table) {
  if (!has_contacts(table))
    return {};
  const std::size_t work = place_of(table.outputs, "total.work_rate", "no sliding"),
                    force = place_of(table.outputs, "worst.normal_rms", "no sliding");
  bool acts = false;
  for (const std::size_t i : table.done()) {
    if (table.rows[i].values[work] != 0.0)
      return {};
    acts = acts || table.rows[i].values[force] > 0.0;
  }
  return acts ? "no contact slides in any case, though contacts have friction: work rates and wear are 0. A "
                "motion "
                "along one line does so: see whether loads have one direction, or random loads one seed"
              : "";
}

std::vector<std::string> case_warnings(const Table& table, const std::string& done) {
  struct Line {
    std::size_t cases;
    std::string text;
  };
  std::vector<Line> lines;
  for (const Outcome outcome :
       {Outcome::refused, Outcome::failed, Outcome::crashed, Outcome::defect, Outcome::done}) {
    std::vector<std::string> messages;
    std::vector<std::int64_t> numbers; // of their cases
    for (const Row& row : table.rows)
      if (row.outcome == outcome)
        for (std::string& message : messages_of(row)) {
          messages.push_back(std::move(message));
          numbers.push_back(row.number);
        }
    const std::string what = outcome == Outcome::done ? done : name_of(outcome);
    for (const results::AlikeMessages& alike : results::alike_messages(messages)) {
      const std::size_t cases = alike.members.size();
      const std::int64_t first = numbers[alike.members.front()];
      const std::string which =
          cases == 1 ? fmt::format("case {} {}", first, what)
                     : fmt::format("{} {}, the first is case {}",
                                   results::counted(static_cast<std::int64_t>(cases), "case"), what, first);
      lines.push_back({cases, which + ": " + alike.text});
    }
  }
  std::vector<std::string> out;
  if (lines.size() > most_case_warnings) {
    std::stable_sort(lines.begin(), lines.end(),
                     [](const Line& a, const Line& b) { return a.cases > b.cases; });
    lines.resize(most_case_warnings);
    out.push_back("cases have more kinds of messages than these:");
  }
  for (Line& line : lines)
    out.push_back(std::move(line.text));
  return out;
}

void check_outputs(const study::Sweep& sweep, const std::vector<Column>& outputs) {
  for (const study::SweepLimit& limit : sweep.limits)
    (void)place_of(outputs, limit.output, limit.where);
  if (!sweep.keep_by.empty())
    (void)place_of(outputs, sweep.keep_by, sweep.keep_by_where);
  if (sweep.until && !sweep.until->output.empty())
    (void)place_of(outputs, sweep.until->output, sweep.until->where);
}

std::vector<std::int64_t> worst_cases(const Table& table, const std::string& output, std::int64_t count) {
  const std::size_t place = place_of(table.outputs, output, "the worst cases");
  std::vector<std::size_t> rows = table.done();
  std::erase_if(rows, [&](std::size_t i) { return std::isnan(table.rows[i].values[place]); });
  const bool smallest = is_life(output) || output == "worst.years";
  std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
    const double first = table.rows[a].values[place], second = table.rows[b].values[place];
    return smallest ? first < second : first > second;
  });
  std::vector<std::int64_t> out;
  for (std::size_t i = 0; i < rows.size() && static_cast<std::int64_t>(i) < count; ++i)
    out.push_back(table.rows[rows[i]].number);
  return out;
}

std::string summary_text(const json& summary) {
  const auto done = summary["done"].get<std::int64_t>(), rows = summary["rows"].get<std::int64_t>(),
             cases = summary["cases"].get<std::int64_t>();
  std::string out = fmt::format("  cases        {} ({}), {} done", results::grouped(cases),
                                summary["design"].get<std::string>(), results::grouped(done));
  if (rows > done)
    out += fmt::format(", {} without a result", results::grouped(rows - done));
  if (cases > rows)
    out += fmt::format(", {} missing", results::grouped(cases - rows));
  out += "\n";
  for (const json& warning : summary["warnings"])
    out += fmt::format("  warning      {}\n", warning.get<std::string>());
  if (!summary.contains("statistics"))
    return out;
  return out + quantile_lines(summary) + first_lines(summary) + limit_lines(summary) +
         sensitivity_lines(summary) + convergence_line(summary);
}

} // namespace fretwork::sweep
