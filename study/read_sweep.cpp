// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "core/names.hpp"
#include "study/number_rows.hpp"
#include "study/sweep.hpp"
#include "study/table_reader.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace fretwork::study {
namespace {

constexpr std::int64_t most_draws = 100'000'000;
/// Times its first draws that `until` goes on to without a limit of its own.
constexpr std::int64_t default_growth = 16;
constexpr double same_sum = 1e-9;
/// Of equidistant values, relative to the larger end: decimals of a number that was meant, and what round-off changes.
constexpr int round_digits = 14;
constexpr double round_off = 4.0 * std::numeric_limits<double>::epsilon();

const Choices<SweepDesign> designs{{{"grid", SweepDesign::grid},
                                    {"monte_carlo", SweepDesign::monte_carlo},
                                    {"latin_hypercube", SweepDesign::latin_hypercube},
                                    {"sobol", SweepDesign::sobol},
                                    {"saltelli", SweepDesign::saltelli}}};

/// A law by its key, and the keys of its parameters.
struct Law {
  const char* key;
  std::vector<std::string> parameters;
};
const std::vector<Law> laws{{"uniform", {"from", "to"}},
                            {"normal", {"mean", "deviation"}},
                            {"lognormal", {"mean", "deviation"}},
                            {"triangular", {"from", "mode", "to"}},
                            {"weibull", {"scale", "shape", "from"}},
                            {"integers", {"from", "to"}}};

double parameter(const TableReader& table, const Law& law, const std::string& key) {
  const bool positive = key == "deviation" || key == "scale" || key == "shape" ||
                        (key == "mean" && std::string(law.key) == "lognormal");
  if (std::string(law.key) == "weibull" && key == "from")
    return table.number_or(key, 0.0, {Range::any});
  return table.number(key, {positive ? Range::above_zero : Range::any});
}

SweepDistribution read_law(const TableReader& variable, const Law& law) {
  const TableReader table(*variable.find(law.key), variable.path(law.key), {law.parameters});
  SweepDistribution out{law.key, {}, {}};
  for (const std::string& key : law.parameters)
    out.parameters.push_back(parameter(table, law, key));
  if (law.parameters.front() == "from") {
    if (!(out.parameters.front() < out.parameters.back()))
      table.fail_at("to", "must lie above from");
    if (out.parameters.size() == 3 &&
        !(out.parameters[0] <= out.parameters[1] && out.parameters[1] <= out.parameters[2]))
      table.fail_at("mode", "must lie between from and to");
  }
  if (out.law == "integers" &&
      std::any_of(out.parameters.begin(), out.parameters.end(), [](double p) { return p != std::round(p); }))
    table.fail_table("integers are expected");
  return out;
}

/// Measured values: inline, or the first column of a file.
SweepDistribution read_measured(const TableReader& variable, const std::filesystem::path& folder) {
  const Value& value = *variable.find("measured");
  SweepDistribution out{"measured", {}, {}};
  if (value.string())
    for (const std::vector<double>& row : read_number_rows(folder / *value.string()).rows)
      out.parameters.push_back(row.front());
  else
    out.parameters = to_numbers(value, variable.path("measured"), 0, {});
  if (out.parameters.size() < 2)
    variable.fail_at("measured", "two values at least make a distribution");
  return out;
}

SweepLevels read_values(const TableReader& variable) {
  SweepLevels out;
  for (const Value& value : to_array(*variable.find("values"), variable.path("values"), "an array of values"))
    out.values.push_back(toml_text(value, Digits::shortest_or_whole));
  const auto count = static_cast<double>(out.values.size());
  out.probabilities.assign(out.values.size(), 1.0 / count);
  if (const auto given =
          variable.optional_numbers("probabilities", out.values.size(), {Range::at_least_zero})) {
    out.probabilities = *given;
    if (std::abs(std::accumulate(given->begin(), given->end(), 0.0) - 1.0) > same_sum)
      variable.fail_at("probabilities", "must sum to 1");
  }
  return out;
}

/// Value i of `count` equidistant ones. The ends are as given; what round-off leaves of a decimal number is removed.
double equidistant(double from, double to, std::int64_t i, std::int64_t count) {
  if (i == 0 || from == to)
    return from;
  if (i + 1 == count)
    return to;
  const double value = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
  const double scale = std::max(std::abs(from), std::abs(to));
  const int decimals = round_digits - 1 - static_cast<int>(std::floor(std::log10(scale)));
  if (decimals < 0 || decimals > std::numeric_limits<double>::max_exponent10)
    return value;
  const double decimal = std::stod(fmt::format("{:.{}f}", value, decimals));
  return std::abs(decimal - value) <= round_off * scale ? decimal : value;
}

SweepLevels read_range(const TableReader& variable) {
  const TableReader table(*variable.find("range"), variable.path("range"), {{"from", "to", "count"}});
  const double from = table.number("from", {}), to = table.number("to", {});
  const auto count = table.optional_integer("count", 2);
  if (!count || *count > most_draws)
    table.fail_table("count, the number of values, is needed: 2 at least");
  SweepLevels out;
  for (std::int64_t i = 0; i < *count; ++i) {
    const Value value{equidistant(from, to, i, *count), {}};
    out.values.push_back(toml_text(value, Digits::shortest_or_whole));
  }
  out.probabilities.assign(out.values.size(), 1.0 / static_cast<double>(*count));
  return out;
}

std::optional<std::array<double, 2>> read_truncated(const TableReader& variable,
                                                    const SweepDistribution& law) {
  const auto given = variable.optional_numbers("truncated", 2, {});
  if (!given)
    return {};
  if (law.law == "integers" || law.law == "measured")
    variable.fail_at("truncated", "is for continuous distributions; give other values instead");
  if (!((*given)[0] < (*given)[1]))
    variable.fail_at("truncated", "[low, high] with low < high is expected");
  return std::array<double, 2>{(*given)[0], (*given)[1]};
}

std::vector<std::string> sources() {
  std::vector<std::string> out{"values", "range", "measured", "seeds"};
  for (const Law& law : laws)
    out.emplace_back(law.key);
  return out;
}

std::variant<SweepLevels, SweepDistribution, SweepSeeds> read_source(const TableReader& variable,
                                                                     const std::filesystem::path& folder) {
  std::vector<std::string> given;
  for (const std::string& key : sources())
    if (variable.has(key))
      given.push_back(key);
  if (given.size() != 1)
    variable.fail_table("exactly one of " + core::list_names(sources()) + " is expected" +
                        (given.empty() ? "" : ", not " + core::list_names(given)));
  if (given[0] != "values" && variable.has("probabilities"))
    variable.fail_at("probabilities", "belongs to values");
  if ((given[0] == "values" || given[0] == "range" || given[0] == "seeds") && variable.has("truncated"))
    variable.fail_at("truncated", "is for continuous distributions; leave it out, and out of " + given[0] +
                                      " what is not to be");
  if (given[0] == "values")
    return read_values(variable);
  if (given[0] == "range")
    return read_range(variable);
  if (given[0] == "seeds")
    return SweepSeeds{*variable.optional_integer("seeds", 0)};
  SweepDistribution out;
  if (given[0] == "measured")
    out = read_measured(variable, folder);
  for (const Law& law : laws)
    if (given[0] == law.key)
      out = read_law(variable, law);
  out.truncated = read_truncated(variable, out);
  return out;
}

/// @throws core::Error for an address that leads nowhere
void check_addresses(const Value& root, const std::vector<std::string>& keys, const Value& where,
                     const std::string& path) {
  for (const std::string& key : keys) {
    Value copy = root;
    try {
      apply_override(copy, key + "=0");
    } catch (const core::Error& error) {
      const std::string problem = error.what();
      fail(where, path, problem.substr(problem.find(": ") + 2));
    }
  }
}

std::vector<SweepVariable> read_variables(const TableReader& sweep, const Document& document) {
  const Value& entries = sweep.required("variables", "an array of tables [[sweep.variables]]");
  std::vector<SweepVariable> out;
  const Array& array = to_array(entries, sweep.path("variables"), "an array of tables");
  for (std::size_t i = 0; i < array.size(); ++i) {
    Keys keys{sources()};
    for (const char* key : {"key", "name", "each", "probabilities", "truncated"})
      keys.known.emplace_back(key);
    const TableReader variable(array[i], sweep.path("variables") + "." + std::to_string(i), keys);
    const Value& key = variable.required("key", "the address of a key, or a pattern: contacts.tsp*.gap");
    const std::vector<std::string> found = matching_keys(document.root, key, variable.path("key"));
    check_addresses(document.root, found, key, variable.path("key"));
    const auto source = read_source(variable, document.file.parent_path());
    const bool each = variable.optional_flag("each").value_or(false);
    if (each && variable.has("name"))
      variable.fail_at("name", "each key is a variable of its own, called by its address; leave name out");
    if (!each)
      out.push_back({variable.optional_text("name").value_or(*key.string()), found, source});
    else
      for (std::size_t k = 0; k < found.size(); ++k) {
        auto own = source;
        if (auto* seeds = std::get_if<SweepSeeds>(&own))
          seeds->first += seeds_apart * static_cast<std::int64_t>(k);
        out.push_back({found[k], {found[k]}, own});
      }
  }
  for (std::size_t i = 0; i < out.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (out[i].name == out[j].name)
        fail(entries, sweep.path("variables"),
             "two variables are called \"" + out[i].name + "\"; give them names");
      for (const std::string& key : out[i].keys)
        if (std::find(out[j].keys.begin(), out[j].keys.end(), key) != out[j].keys.end())
          fail(entries, sweep.path("variables"), "\"" + key + "\" is varied twice; vary it once");
    }
  return out;
}

std::size_t variable_called(const Value& value, const std::string& path,
                            const std::vector<SweepVariable>& variables) {
  std::vector<std::string> names;
  for (const SweepVariable& variable : variables)
    names.push_back(variable.name);
  return to_choice(value, path, names);
}

std::vector<SweepCorrelation> read_correlations(const TableReader& sweep,
                                                const std::vector<SweepVariable>& variables) {
  std::vector<SweepCorrelation> out;
  const Value* found = sweep.find("correlations");
  if (!found)
    return out;
  const std::string path = sweep.path("correlations");
  for (const Value& entry : to_array(*found, path, "an array of [variable, variable, rank correlation]")) {
    const Array& three = to_array(entry, path, "[variable, variable, rank correlation]");
    if (three.size() != 3)
      fail(entry, path, "[variable, variable, rank correlation] is expected");
    const SweepCorrelation correlation{variable_called(three[0], path, variables),
                                       variable_called(three[1], path, variables),
                                       to_number(three[2], path, {})};
    for (const std::size_t v : {correlation.first, correlation.second})
      if (!std::holds_alternative<SweepDistribution>(variables[v].source))
        fail(entry, path, "\"" + variables[v].name + "\" has no distribution that could be correlated");
    if (correlation.first == correlation.second || !(std::abs(correlation.value) < 1.0))
      fail(entry, path, "two variables and a number between -1 and 1 are expected");
    out.push_back(correlation);
  }
  return out;
}

double probability(const TableReader& table, const std::string& key, double otherwise) {
  const double value = table.number_or(key, otherwise, {Range::above_zero});
  if (!(value < 1.0))
    table.fail_at(key, "a probability between 0 and 1 is expected");
  return value;
}

/// `study.toml:12: sweep.until.output`
std::string place_of(const TableReader& table, const std::string& key) {
  const Value* found = table.find(key);
  return found ? fmt::format("{}: {}", found->where.text(), table.path(key)) : table.path(key);
}

std::vector<SweepLimit> read_limits(const TableReader& sweep) {
  std::vector<SweepLimit> out;
  const Value* found = sweep.find("limits");
  if (!found)
    return out;
  const Array& array = to_array(*found, sweep.path("limits"), "an array of tables");
  for (std::size_t i = 0; i < array.size(); ++i) {
    const TableReader table(array[i], sweep.path("limits") + "." + std::to_string(i),
                            {{"output", "above", "below"}});
    if (table.has("above") == table.has("below"))
      table.fail_table("one of above and below is expected");
    const bool above = table.has("above");
    out.push_back({table.text("output", "the name of an output"), table.number(above ? "above" : "below", {}),
                   above, place_of(table, "output")});
  }
  return out;
}

std::optional<SweepUntil> read_until(const TableReader& sweep, const Sweep& so_far) {
  const Value* found = sweep.find("until");
  if (!found)
    return {};
  const TableReader table(*found, sweep.path("until"),
                          {{"relative_error", "output", "quantile", "most_draws"}});
  if (so_far.design == SweepDesign::grid || so_far.design == SweepDesign::saltelli)
    table.fail_table("needs a design that can go on: monte_carlo, latin_hypercube or sobol");
  SweepUntil out;
  out.relative_error = probability(table, "relative_error", out.relative_error);
  out.output = table.optional_text("output").value_or(out.output);
  out.where = place_of(table, "output");
  out.quantile = probability(table, "quantile", out.quantile);
  out.most_draws = table.optional_integer("most_draws", so_far.draws).value_or(default_growth * so_far.draws);
  return out;
}

/// `"worst 5"`
std::int64_t read_keep(const TableReader& sweep) {
  const auto text = sweep.optional_text("keep");
  if (!text)
    return 0;
  const auto count = text->starts_with("worst ") ? to_real(std::string_view(*text).substr(6)) : std::nullopt;
  if (!count || !(*count >= 1.0) || *count != std::round(*count))
    sweep.fail_at("keep",
                  "\"worst 5\" is expected: the cases with the largest work rates, or outputs keep_by");
  return static_cast<std::int64_t>(*count);
}

void check_design(const TableReader& sweep, const Sweep& read) {
  const bool grid = read.design == SweepDesign::grid;
  double size = 1.0;
  for (const SweepVariable& variable : read.variables) {
    if (grid && std::holds_alternative<SweepDistribution>(variable.source))
      sweep.fail_table("a grid needs values or a range of every variable, which \"" + variable.name +
                       "\" has not; give it, or take another design");
    if (const auto* levels = std::get_if<SweepLevels>(&variable.source))
      size *= static_cast<double>(levels->values.size());
  }
  if (grid && size > static_cast<double>(most_draws))
    sweep.fail_at("variables", "the grid has too many cases; give fewer values");
  if (grid && !read.correlations.empty())
    sweep.fail_at("correlations", "a grid has none; take another design");
  if (read.design == SweepDesign::saltelli && !read.correlations.empty())
    sweep.fail_at("correlations",
                  "Sobol' indices are those of independent variables; leave correlations out, "
                  "or take monte_carlo, whose sensitivities are rank correlations");
}

} // namespace

std::string name_of(SweepDesign design) {
  return std::find_if(designs.available.begin(), designs.available.end(),
                      [&](const auto& entry) { return entry.second == design; })
      ->first;
}

Sweep read_sweep(const Document& document) {
  const auto& root = *document.root.table();
  const auto found = root.find("sweep");
  if (found == root.end())
    throw core::Error(document.file.string() +
                      " has no [sweep]; add what varies between the cases (doc/sweep.md)");
  const TableReader sweep(found->second, "sweep",
                          {{"study", "design", "draws", "seed", "variables", "correlations", "quantiles",
                            "confidence", "limits", "until", "keep", "keep_by"}});
  Sweep out;
  out.design = sweep.choice("design", out.design, designs);
  const auto draws = sweep.optional_integer("draws", 1);
  if (out.design != SweepDesign::grid && !draws)
    sweep.fail_table("draws, the number of cases, is needed; or design = \"grid\", whose values give it");
  if (out.design == SweepDesign::grid && draws)
    sweep.fail_at("draws", "of a grid the number of cases follows from its values; leave draws out");
  if (draws.value_or(0) > most_draws)
    sweep.fail_at("draws", "at most 1e8 are expected");
  out.draws = draws.value_or(0);
  const auto seed = sweep.optional_integer("seed", 0).value_or(out.seed);
  if (seed > std::numeric_limits<std::int32_t>::max())
    sweep.fail_at("seed", "at most 2147483647 is expected");
  out.seed = static_cast<std::uint32_t>(seed);
  out.variables = read_variables(sweep, document);
  out.correlations = read_correlations(sweep, out.variables);
  if (auto quantiles = sweep.optional_numbers("quantiles", 0, {Range::above_zero})) {
    if (std::any_of(quantiles->begin(), quantiles->end(), [](double p) { return !(p < 1.0); }))
      sweep.fail_at("quantiles", "probabilities between 0 and 1 are expected");
    out.quantiles = *quantiles;
  }
  out.confidence = probability(sweep, "confidence", out.confidence);
  out.limits = read_limits(sweep);
  if (out.design == SweepDesign::grid && sweep.has("limits"))
    sweep.fail_at("limits", "the cases of a grid have no probabilities, and all outputs of each are in "
                            "table.csv; leave limits out, or "
                            "take a design that draws");
  out.until = read_until(sweep, out);
  out.keep = read_keep(sweep);
  if (const auto output = sweep.optional_text("keep_by")) {
    if (out.keep == 0)
      sweep.fail_at("keep_by", "says which cases keep = \"worst n\" keeps; give keep, or leave keep_by out");
    out.keep_by = *output;
    out.keep_by_where = place_of(sweep, "keep_by");
  }
  check_design(sweep, out);
  return out;
}

} // namespace fretwork::study
