// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/figures.hpp"
#include "results/force_results.hpp"
#include "results/text_file.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::results {
namespace {

using post::ForceSummary;

constexpr std::size_t label_width = 18;
constexpr std::size_t most_lines = 12; // of a kind
constexpr double mega = 1e-6;          // MPa in a pascal
constexpr double micro = 1e6;          // um in a metre
/// Of the largest force, moment or stress beside it: the round-off of sums over modes.
constexpr double round_off_of_modes = 1e-10;

/// 1.23 at 0.5: a figure and where it is.
std::string at(double value, double s, int digits) {
  return fmt::format("{} at {:.4g}", figure(value, digits), s);
}

std::string section_line(const RunResults& results, const SectionGroup& group) {
  const auto of = [&](auto value) {
    const LargestOfGroup found = largest_of(results, group, value);
    return std::isnan(found.value) ? std::string("-") : at(found.value, results.force_sites[found.site].s, 3);
  };
  const auto component = [&](std::size_t c) {
    return figure(
        largest_of(results, group, [c](const ForceSummary& force) { return largest_component(force, c); })
            .value,
        3);
  };
  const LargestOfGroup scatter =
      largest_of(results, group, [](const ForceSummary& force) { return force.stress_std; });
  const ForceSummary& there = results.force_summaries[scatter.site];
  const LargestOfGroup stress =
      largest_of(results, group, [](const ForceSummary& force) { return force.stress; });
  const bool still = scatter.value < round_off_of_modes * stress.value;
  return fmt::format("  {:<18} {:>14} {:>20} {:>14} {:>14} {:>8} {:>11}",
                     shortened(results.force_sites[group.first].name, label_width),
                     of([](const ForceSummary& force) { return mega * force.stress; }),
                     std::isnan(scatter.value) ? "-"
                     : still                   ? "0"
                                               : fmt::format("{} at {:.4g}",
                                                             with_error(mega * scatter.value, mega * there.stress_std_error),
                                                             results.force_sites[scatter.site].s),
                     of([](const ForceSummary& force) { return force.moment; }),
                     of([](const ForceSummary& force) { return force.force; }), component(0), component(3));
}

std::string reaction_line(const ForceSite& site, const ForceSummary& force) {
  std::string line = fmt::format("  {:<18}", shortened(site.name, label_width));
  for (std::size_t c = 0; c < post::force_components; ++c)
    line += fmt::format(" {:>10}", (site.fixed >> c) & 1u ? figure(largest_component(force, c), 4) : "free");
  return line + fmt::format(" {:>10} {:>10}", figure(force.force, 4), figure(force.moment, 4));
}

std::string left_out(std::size_t left, const char* what) {
  return fmt::format("  and {} more {} in summary.json", left, what);
}

} // namespace

double largest_component(const ForceSummary& force, std::size_t component) {
  const auto size = [&](std::size_t c) {
    return std::max(std::abs(force.components[c].min), std::abs(force.components[c].max));
  };
  const std::size_t first = component < 3 ? 0 : 3;
  const double beside = std::max({size(first), size(first + 1), size(first + 2)});
  return size(component) < round_off_of_modes * beside ? 0.0 : size(component);
}

std::vector<std::string> force_lines(const RunResults& results) {
  std::vector<std::string> lines;
  const std::vector<SectionGroup> groups = section_groups(results);
  if (!groups.empty())
    lines.push_back(fmt::format("  {:<18} {:>14} {:>20} {:>14} {:>14} {:>8} {:>11}", "largest, at s in m",
                                "stress MPa", "its std MPa", "moment N m", "shear N", "axial N",
                                "torsion N m"));
  for (std::size_t g = 0; g < std::min(most_lines, groups.size()); ++g)
    lines.push_back(section_line(results, groups[g]));
  if (groups.size() > most_lines)
    lines.push_back(left_out(groups.size() - most_lines, "groups"));
  const std::size_t first = groups.empty() ? 0 : groups.back().end;
  const std::size_t count = results.force_sites.size() - first;
  if (count > 0)
    lines.push_back(fmt::format("  {:<18} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}",
                                "largest reactions", "x N", "y N", "z N", "x N m", "y N m", "z N m",
                                "force N", "moment N m"));
  for (std::size_t k = first; k < first + std::min(most_lines, count); ++k)
    lines.push_back(reaction_line(results.force_sites[k], results.force_summaries[k]));
  if (count > most_lines)
    lines.push_back(left_out(count - most_lines, "reactions"));
  return lines;
}

std::vector<std::string> node_lines(const RunResults& results) {
  std::vector<std::string> lines;
  const std::size_t count = results.node_names.size();
  if (count > 0)
    lines.push_back(fmt::format("  {:<18} {:>13} {:>13} {:>13} {:>15} {:>15} {:>15}", "observed nodes",
                                "std x um", "y um", "z um", "range of x um", "y um", "z um"));
  for (std::size_t k = 0; k < std::min(most_lines, count); ++k) {
    const post::NodeSummary& node = results.node_summaries[k];
    double largest = 0.0;
    for (const post::Moments& m : node.displacement)
      largest = std::max({largest, std::abs(m.min), std::abs(m.max)});
    std::string line = fmt::format("  {:<18}", shortened(results.node_names[k], label_width));
    for (std::size_t d = 0; d < 3; ++d)
      line += fmt::format(" {:>13}", with_error(micro * without_round_off(node.displacement[d].std, largest),
                                                micro * without_round_off(node.std_error[d], largest)));
    for (const post::Moments& m : node.displacement)
      line +=
          fmt::format(" {:>15}", fmt::format("{} to {}", figure(micro * without_round_off(m.min, largest), 3),
                                             figure(micro * without_round_off(m.max, largest), 3)));
    lines.push_back(line);
  }
  if (count > most_lines)
    lines.push_back(left_out(count - most_lines, "nodes"));
  return lines;
}

} // namespace fretwork::results
