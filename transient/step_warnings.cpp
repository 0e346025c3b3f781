// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/step_warnings.hpp"
#include "transient/scene/scheme_limits.hpp"
#include "transient/step_terms.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <string_view>

namespace fretwork::transient {
namespace {

/// A step given with three digits of the longest is no reason for a warning.
constexpr double rounded = 1.01;

/// What a step does not resolve.
struct Unresolved {
  std::string what;                ///< with its figure and bound
  double longest;                  ///< s, step that would resolve it
  const char* spoiled = "results"; ///< what cannot be trusted
};
using AllUnresolved = std::vector<Unresolved>;

void look_at(AllUnresolved& out, const StepChoice& c, const StepTerm& term) {
  if (term.rate > 0.0 && c.step > term.longest() * rounded)
    out.push_back({fmt::format("{}: {} = {:.3g}, at most {:.4g}", term.name, term.symbol, term.rate * c.step,
                               term.bound.largest),
                   term.longest(), term.spoiled});
}

void look_at_points(AllUnresolved& out, const StepChoice& c, const char* name, double frequency,
                    double fewest) {
  if (const double points = 1.0 / (frequency * c.step); points * rounded < fewest)
    out.push_back({fmt::format("{}: {:.3g} steps a period, at least {:g}", name, points, fewest),
                   1.0 / (frequency * fewest)});
}

AllUnresolved unresolved(const StepChoice& c) {
  AllUnresolved out;
  for (const StepTerm& term : contact_terms(c))
    look_at(out, c, term);
  for (const StepTerm& term : damper_terms(c))
    look_at(out, c, term);
  look_at(out, c, mode_term(c, true));
  if (const double longest = longest_for_tables(c);
      c.table_interval > 0.0 && c.step > longest * (1.0 + time_round_off))
    out.push_back({fmt::format("{} ({:.4g} s)", name_of_table_interval, c.table_interval), longest});
  if (c.step > c.record_interval * (1.0 + time_round_off))
    look_at_points(out, c, name_of_record_band, c.record_rate / (2.0 * std::numbers::pi),
                   c.scheme == SchemeKind::splitting ? fewest_points_of_records : fewest_points);
  look_at_points(out, c, name_of_excitation, c.excitation, fewest_points);
  return out;
}

/// s, a step that resolves all of it, to three digits.
double resolving_step(const AllUnresolved& all) {
  const auto worst =
      std::min_element(all.begin(), all.end(), [](const Unresolved& one, const Unresolved& other) {
        return one.longest < other.longest;
      });
  const double digit = std::pow(10.0, std::floor(std::log10(worst->longest)) - 2.0);
  return std::floor(worst->longest / digit * (1.0 + 10.0 * time_round_off)) * digit;
}

/// One warning of all that the step does not resolve; none where that is nothing.
std::vector<std::string> warning_of(const StepChoice& c, const AllUnresolved& all, const std::string& cure) {
  if (all.empty())
    return {};
  std::string what;
  for (const Unresolved& one : all)
    what += (what.empty() ? "" : "; ") + one.what;
  const std::string_view spoiled = all.front().spoiled;
  const bool alike =
      std::all_of(all.begin(), all.end(), [&](const Unresolved& one) { return one.spoiled == spoiled; });
  return {fmt::format("the step {:.3g} s does not resolve {} for {} that can be trusted; {}", c.step, what,
                      alike ? spoiled : "results", cure)};
}

} // namespace

std::vector<std::string> warnings_of_given_step(const StepChoice& c) {
  const AllUnresolved all = unresolved(c);
  if (all.empty())
    return {};
  return warning_of(c, all,
                    fmt::format("take a smaller step or leave it out; {:.3g} s would do{}",
                                resolving_step(all), all.size() > 1 ? " for all of them" : ""));
}

std::vector<std::string> warnings_of_automatic_step(const StepChoice& c) {
  AllUnresolved dampers;
  look_at(dampers, c, normal_damper_term(c));
  return warning_of(c, dampers,
                    c.scheme == SchemeKind::collocation
                        ? "take scheme = \"energy_conserving\", or a smaller damper"
                        : "give a smaller damper where these matter");
}

} // namespace fretwork::transient
