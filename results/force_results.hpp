// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Forces of sections and restraints (`[output] section_forces`, `reactions`) and observed nodes in summary.json, on the terminal and as
/// CSV: keys and columns as in doc/results.md.
#pragma once
#include "results/run_results.hpp"
#include <nlohmann/json_fwd.hpp>

namespace fretwork::results {

/// The sections of a group: places in RunResults::force_sites that follow each other.
struct SectionGroup {
  std::size_t first = 0, end = 0;
};
[[nodiscard]] std::vector<SectionGroup> section_groups(const RunResults& results);

/// The largest of a group.
struct LargestOfGroup {
  double value = 0.0; ///< not a number where no section has it
  std::size_t site = 0;
};
/// @param figure  of a ForceSummary
template <class Figure>
[[nodiscard]] LargestOfGroup largest_of(const RunResults& results, const SectionGroup& group, Figure figure) {
  LargestOfGroup out{figure(results.force_summaries[group.first]), group.first};
  for (std::size_t k = group.first; k < group.end; ++k)
    if (const double value = figure(results.force_summaries[k]); value > out.value || out.value != out.value)
      out = {value, k};
  return out;
}
/// The larger of |min| and |max|, N or N m; 0 where it is round-off beside the force, or moment, of its site.
[[nodiscard]] double largest_component(const post::ForceSummary& force, std::size_t component);

/// Adds `section_forces` and `reactions`, where there are any.
void add_forces(nlohmann::ordered_json& out, const RunResults& results);

/// A line a group of sections, a restraint and an observed node, of each kind at most 12.
[[nodiscard]] std::vector<std::string> force_lines(const RunResults& results);
[[nodiscard]] std::vector<std::string> node_lines(const RunResults& results);

/// sections_<group>.csv, one section a row, and reaction_<name>.csv, one instant a row.
void export_forces_csv(const std::filesystem::path& directory, const RunResults& results);

} // namespace fretwork::results
