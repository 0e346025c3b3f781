// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/force_results.hpp"
#include "results/json_number.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace fretwork::results {
namespace {

using post::ForceSummary;

Json largest(const RunResults& results, const LargestOfGroup& found) {
  const ForceSite& site = results.force_sites[found.site];
  const core::Vec3& place = results.nodes[static_cast<std::size_t>(site.node)];
  return {{"largest", number(found.value)},
          {"s", number(site.s)},
          {"position", {number(place.x()), number(place.y()), number(place.z())}}};
}

/// Of sections without outline: null.
Json stress(const RunResults& results, const SectionGroup& group) {
  const auto found = largest_of(results, group, [](const ForceSummary& force) { return force.stress; });
  if (std::isnan(found.value))
    return nullptr;
  Json out = largest(results, found);
  out["time"] = number(results.force_summaries[found.site].stress_time);
  const auto scatter = largest_of(results, group, [](const ForceSummary& force) { return force.stress_std; });
  const ForceSummary& there = results.force_summaries[scatter.site];
  out["std"] = {{"largest", number(scatter.value)},
                {"s", number(results.force_sites[scatter.site].s)},
                {"standard_error", number(there.stress_std_error)},
                {"batches", number(there.batches)}};
  return out;
}

Json sections(const RunResults& results, const SectionGroup& group) {
  const auto of = [&](auto figure) { return largest(results, largest_of(results, group, figure)); };
  const auto component = [&](std::size_t c) {
    return of([c](const ForceSummary& force) { return largest_component(force, c); });
  };
  return {{"group", results.force_sites[group.first].name},
          {"stress", stress(results, group)},
          {"moment", of([](const ForceSummary& force) { return force.moment; })},
          {"shear_force", of([](const ForceSummary& force) { return force.force; })},
          {"axial_force", component(0)},
          {"torsion", component(3)},
          {"shear_y", component(1)},
          {"shear_z", component(2)},
          {"moment_y", component(4)},
          {"moment_z", component(5)}};
}

Json reaction(const ForceSite& site, const ForceSummary& force) {
  constexpr std::array axes{"x", "y", "z"};
  Json forces = Json::object(), moments_about = Json::object(), errors = Json::object(),
       errors_about = Json::object();
  for (std::size_t c = 0; c < post::force_components; ++c) {
    const bool held = (site.fixed >> c) & 1u;
    (c < 3 ? forces : moments_about)[axes[c % 3]] = held ? moments(force.components[c]) : Json(nullptr);
    (c < 3 ? errors : errors_about)[axes[c % 3]] =
        held ? Json{{"std", number(force.std_error[c])}} : Json(nullptr);
  }
  return {
      {"name", site.name},
      {"force", forces},
      {"moment", moments_about},
      {"largest_force", number(force.force)},
      {"largest_moment", number(force.moment)},
      {"standard_error", {{"force", errors}, {"moment", errors_about}, {"batches", number(force.batches)}}}};
}

} // namespace

void add_forces(Json& out, const RunResults& results) {
  for (const SectionGroup& group : section_groups(results))
    out["section_forces"].push_back(sections(results, group));
  for (std::size_t k = 0; k < results.force_sites.size(); ++k)
    if (!results.force_sites[k].is_section())
      out["reactions"].push_back(reaction(results.force_sites[k], results.force_summaries[k]));
}

} // namespace fretwork::results
