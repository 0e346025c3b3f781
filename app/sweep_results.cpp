// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/sweep_results.hpp"
#include "results/summary_file.hpp"
#include "sweep/summary.hpp"
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace fretwork::app {
namespace {

/// Of each node its length along the mesh, m, where that is one open chain; else empty.
std::vector<double> abscissae(const mesh::LineMesh& mesh) {
  std::vector<double> out(mesh.nodes.size(), std::numeric_limits<double>::quiet_NaN());
  double length = 0.0;
  for (std::size_t i = 0; i < mesh.lines.size(); ++i) { // in walking order
    const auto [from, to] = mesh.lines[i].nodes;
    const auto begin = static_cast<std::size_t>(from), end = static_cast<std::size_t>(to);
    if ((i > 0 && from != mesh.lines[i - 1].nodes[1]) || !std::isnan(out[end]))
      return {}; // another chain, or a closed one
    out[begin] = length;
    length += (mesh.nodes[end] - mesh.nodes[begin]).norm();
    out[end] = length;
  }
  return out;
}

nlohmann::json contacts_of(const SweepFacts& facts, const mesh::LineMesh& mesh) {
  auto out = nlohmann::json::array();
  const std::vector<double> places = abscissae(mesh);
  for (const auto& [name, node] : facts.contacts) {
    out.push_back({{"name", name}, {"node", node}});
    if (!places.empty() && !std::isnan(places[static_cast<std::size_t>(node)]))
      out.back()["abscissa_m"] = places[static_cast<std::size_t>(node)];
  }
  return out;
}

} // namespace

std::string write_sweep(const SweepPlan& plan, SweepResults& results) {
  nlohmann::json& summary = results.summary;
  const std::string& title = plan.inputs.study.title;
  const std::map<std::string, std::string> record{{"version", FRETWORK_VERSION},
                                                  {"title", title},
                                                  {"study", plan.inputs.study.text},
                                                  {"input_sha256", plan.inputs.whole_key}};
  sweep::write_csv(plan.directory / "table.csv", plan.sweep, results.draws, results.table);
  sweep::write_archive(plan.directory / "table.h5", plan.sweep, results.draws, results.table, record);
  if (!results.facts.contacts.empty())
    summary["contacts"] = contacts_of(results.facts, mesh_stage(MPI_COMM_SELF, plan.inputs));
  for (const auto& [name, text] : record)
    summary[name] = text;
  std::string out = title.empty() ? "Sweep\n" : "Sweep: " + title + "\n";
  out += sweep::summary_text(summary);
  std::vector<std::string> warnings = results.warnings;
  for (const auto& later : summary["warnings"])
    warnings.push_back(later.get<std::string>());
  summary["warnings"] = warnings;
  results::save_summary(plan.directory / "summary.json", summary);
  if (plan.sweep.design == study::SweepDesign::grid)
    out += sweep::range_lines(results.table);
  for (const auto& number : summary["worst"])
    out += fmt::format("  kept         {}\n", folder_of_case(plan, number.get<std::int64_t>()).string());
  return out;
}

std::filesystem::path folder_of_case(const SweepPlan& plan, std::int64_t number) {
  return plan.directory / "runs" / fmt::format("case_{}", number);
}

} // namespace fretwork::app
