// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep/design.hpp"
#include "sweep/openturns.hpp"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace fretwork::sweep {
namespace {

using study::SweepDistribution;
using study::SweepLevels;
using study::SweepSeeds;

/// The number that a text is; none where it is anything else.
std::optional<double> parsed(const std::string& text) {
  double number = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  return failure == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

nlohmann::json request_of(const study::SweepVariable& variable) {
  if (const auto* levels = std::get_if<SweepLevels>(&variable.source))
    return {{"levels", levels->probabilities}};
  const auto& law = std::get<SweepDistribution>(variable.source);
  nlohmann::json out{{"law", law.law}, {"parameters", law.parameters}};
  if (law.truncated)
    out["truncated"] = *law.truncated;
  return out;
}

nlohmann::json request_of(const study::Sweep& sweep, std::int64_t blocks) {
  const std::vector<std::size_t> drawn = drawn_variables(sweep);
  nlohmann::json out{{"operation", "draw"},
                     {"design", name_of(sweep.design)},
                     {"count", sweep.draws},
                     {"blocks", blocks},
                     {"seed", sweep.seed},
                     {"variables", nlohmann::json::array()},
                     {"correlations", nlohmann::json::array()}};
  std::vector<std::size_t> column(sweep.variables.size());
  for (const std::size_t v : drawn) {
    column[v] = out["variables"].size();
    out["variables"].push_back(request_of(sweep.variables[v]));
    out["variables"].back()["name"] = sweep.variables[v].name;
  }
  for (const study::SweepCorrelation& c : sweep.correlations)
    out["correlations"].push_back({column[c.first], column[c.second], c.value});
  return out;
}

} // namespace

std::vector<std::size_t> drawn_variables(const study::Sweep& sweep) {
  std::vector<std::size_t> out;
  for (std::size_t v = 0; v < sweep.variables.size(); ++v)
    if (!std::holds_alternative<SweepSeeds>(sweep.variables[v].source))
      out.push_back(v);
  return out;
}

Draws full_grid(const study::Sweep& sweep) {
  std::vector<Eigen::Index> sizes;
  Eigen::Index cases = 1;
  for (const std::size_t v : drawn_variables(sweep)) {
    sizes.push_back(
        static_cast<Eigen::Index>(std::get<SweepLevels>(sweep.variables[v].source).values.size()));
    cases *= sizes.back();
  }
  Draws out(cases, static_cast<Eigen::Index>(sizes.size()));
  for (Eigen::Index i = 0; i < cases; ++i)
    for (Eigen::Index j = out.cols() - 1, left = i; j >= 0; --j) {
      const Eigen::Index size = sizes[static_cast<std::size_t>(j)];
      out(i, j) = static_cast<double>(left % size);
      left /= size;
    }
  return out;
}

Draws make_design(const study::Sweep& sweep, std::int64_t blocks) {
  if (sweep.design == study::SweepDesign::grid)
    return full_grid(sweep);
  if (drawn_variables(sweep).empty())
    return Draws(sweep.draws * blocks, 0);
  const Answer answer = ask_openturns(request_of(sweep, blocks), {});
  Draws out(answer.json.at("rows").get<Eigen::Index>(), answer.json.at("columns").get<Eigen::Index>());
  std::copy(answer.values.begin(), answer.values.end(), out.data());
  return out;
}

std::string value_text(const study::SweepVariable& variable, double drawn, std::int64_t number) {
  if (const auto* seeds = std::get_if<SweepSeeds>(&variable.source))
    return std::to_string(seeds->first + number);
  if (const auto* levels = std::get_if<SweepLevels>(&variable.source))
    return levels->values[static_cast<std::size_t>(drawn)];
  if (std::get<SweepDistribution>(variable.source).law == "integers")
    return std::to_string(std::llround(drawn));
  return fmt::format("{}", drawn);
}

std::vector<std::string> value_names(const study::SweepVariable& variable) {
  const auto* levels = std::get_if<SweepLevels>(&variable.source);
  if (!levels || std::all_of(levels->values.begin(), levels->values.end(),
                             [](const std::string& text) { return parsed(text).has_value(); }))
    return {};
  const std::vector<std::string> booleans{"false", "true"};
  const bool is_boolean = std::all_of(levels->values.begin(), levels->values.end(), [&](const auto& text) {
    return std::find(booleans.begin(), booleans.end(), text) != booleans.end();
  });
  return is_boolean ? booleans : levels->values;
}

double value_number(const study::SweepVariable& variable, double drawn, std::int64_t number) {
  const std::string text = value_text(variable, drawn, number);
  const std::vector<std::string> names = value_names(variable);
  return names.empty() ? parsed(text).value()
                       : static_cast<double>(std::find(names.begin(), names.end(), text) - names.begin());
}

std::vector<std::string> overrides_of(const study::Sweep& sweep, const Draws& draws, std::int64_t number) {
  std::vector<std::string> out;
  Eigen::Index column = 0;
  for (const study::SweepVariable& variable : sweep.variables) {
    if (std::holds_alternative<SweepSeeds>(variable.source)) {
      for (std::size_t k = 0; k < variable.keys.size(); ++k)
        out.push_back(variable.keys[k] + "=" +
                      value_text(variable, 0.0, number + study::seeds_apart * static_cast<std::int64_t>(k)));
      continue;
    }
    const std::string value = value_text(variable, draws(number, column++), number);
    for (const std::string& key : variable.keys)
      out.push_back(key + "=" + value);
  }
  return out;
}

} // namespace fretwork::sweep
