// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep/summary.hpp"
#include "results/figures.hpp"
#include "results/grouped_messages.hpp"
#include "results/text_file.hpp"
#include "sweep/openturns.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::sweep {
namespace {

using nlohmann::json;

constexpr std::size_t most_failures = 100; ///< that the summary lists; the table has all
constexpr std::size_t most_case_warnings = 10;

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
  if (table.has_contacts())
    return "worst.work_rate";
  for (std::size_t place = 0; place < table.outputs.size(); ++place)
    if (std::any_of(done.begin(), done.end(), [&](std::size_t row) {
          return std::abs(table.rows[row].values[place]) > round_off_of_outputs;
        }))
      return table.outputs[place].name;
  return table.outputs.front().name;
}

std::string no_sliding_warning(const Table& table) {
  if (!table.has_contacts())
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
      std::vector<std::int64_t> of_cases; // one may have several alike
      for (const std::size_t member : alike.members)
        of_cases.push_back(numbers[member]);
      std::sort(of_cases.begin(), of_cases.end());
      of_cases.erase(std::unique(of_cases.begin(), of_cases.end()), of_cases.end());
      const std::size_t cases = of_cases.size();
      const std::int64_t first = of_cases.front();
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

} // namespace fretwork::sweep
