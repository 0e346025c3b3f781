// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/force_file.hpp"
#include "results/basis_file.hpp"
#include "results/csv_columns.hpp"
#include "results/force_results.hpp"
#include "results/named_groups.hpp"
#include "results/text_file.hpp"
#include <array>

namespace fretwork::results {
namespace {

using post::ForceSummary;
using post::Moments;

/// Of six components each.
struct ComponentFigure {
  const char* name;
  double Moments::*value;
};
constexpr std::array<ComponentFigure, 4> component_figures{
    {{"mean", &Moments::mean}, {"std", &Moments::std}, {"min", &Moments::min}, {"max", &Moments::max}}};

struct SiteFigure {
  const char *name, *unit;
  double ForceSummary::*value;
};
constexpr std::array<SiteFigure, 6> site_figures{
    {{"largest_shear_force", "N", &ForceSummary::force},
     {"largest_moment", "N m", &ForceSummary::moment},
     {"largest_stress", "Pa", &ForceSummary::stress},
     {"largest_stress_time", "s", &ForceSummary::stress_time},
     {"stress_std", "Pa", &ForceSummary::stress_std},
     {"stress_std_error", "Pa", &ForceSummary::stress_std_error}}};
constexpr std::array<const char*, post::force_components> section_components{"N", "Vy", "Vz",
                                                                             "T", "My", "Mz"};
constexpr std::array<const char*, post::force_components> component_units{"N", "N", "N", "N m", "N m", "N m"};
constexpr const char* of_components = "N: N Vy Vz; N m: T My Mz";

/// Of the sections of a group, one a row.
template <class Figure> Eigen::VectorXd column(const SectionGroup& group, Figure figure) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(group.end - group.first));
  for (std::size_t k = group.first; k < group.end; ++k)
    out(static_cast<Eigen::Index>(k - group.first)) = figure(k);
  return out;
}

void write_sections(const h5::Group& out, const RunResults& results, const SectionGroup& group) {
  const auto of_sites = [&](auto figure) {
    return column(group, [&](std::size_t k) { return figure(results.force_sites[k]); });
  };
  std::vector<core::Index> nodes, beams;
  std::vector<std::uint8_t> ends;
  for (std::size_t k = group.first; k < group.end; ++k) {
    nodes.push_back(results.force_sites[k].node);
    beams.push_back(results.force_sites[k].beam);
    ends.push_back(results.force_sites[k].at_b);
  }
  out.write<core::Index>("node", nodes, {nodes.size()}, "");
  out.write<core::Index>("beam", beams, {beams.size()}, "");
  out.write<std::uint8_t>("end", ends, {ends.size()}, "0: the first node of the beam, 1: the second");
  write_vector(out, "s", of_sites([](const ForceSite& site) { return site.s; }), "m");
  const auto write_components = [&](const char* name, auto value) {
    Eigen::MatrixXd all(static_cast<Eigen::Index>(nodes.size()), post::force_components);
    for (std::size_t c = 0; c < post::force_components; ++c)
      all.col(static_cast<Eigen::Index>(c)) =
          column(group, [&](std::size_t k) { return value(results.force_summaries[k], c); });
    write_matrix(out, name, all, of_components);
  };
  for (const ComponentFigure& figure : component_figures)
    write_components(figure.name, [&](const ForceSummary& force, std::size_t c) {
      return force.components[c].*figure.value;
    });
  write_components("std_error", [](const ForceSummary& force, std::size_t c) { return force.std_error[c]; });
  for (const SiteFigure& figure : site_figures)
    write_vector(out, figure.name,
                 column(group, [&](std::size_t k) { return results.force_summaries[k].*figure.value; }),
                 figure.unit);
}

void read_sections(const h5::Group& group, RunResults& results) {
  const std::string name = group.text("name");
  const auto nodes = group.read<core::Index>("node"), beams = group.read<core::Index>("beam");
  const auto ends = group.read<std::uint8_t>("end");
  const Eigen::VectorXd s = read_vector(group, "s");
  const auto rows = static_cast<Eigen::Index>(nodes.size());
  const auto all_fit = [&](const Eigen::MatrixXd& values, Eigen::Index columns) {
    if (values.rows() != rows || values.cols() != columns)
      throw h5::Failure("sections of " + name + " of unequal length");
  };
  all_fit(s, 1);
  if (beams.size() != nodes.size() || ends.size() != nodes.size())
    throw h5::Failure("sections of " + name + " of unequal length");
  const std::size_t first = results.force_sites.size();
  for (std::size_t k = 0; k < nodes.size(); ++k)
    results.force_sites.push_back({name, nodes[k], beams[k], ends[k] != 0, s(static_cast<Eigen::Index>(k))});
  results.force_summaries.resize(results.force_sites.size());
  const auto read_components = [&](const char* figure, auto value) {
    const Eigen::MatrixXd all = read_matrix(group, figure);
    all_fit(all, post::force_components);
    for (Eigen::Index k = 0; k < rows; ++k)
      for (std::size_t c = 0; c < post::force_components; ++c)
        value(results.force_summaries[first + static_cast<std::size_t>(k)], c) =
            all(k, static_cast<Eigen::Index>(c));
  };
  for (const ComponentFigure& figure : component_figures)
    read_components(figure.name, [&](ForceSummary& force, std::size_t c) -> double& {
      return force.components[c].*figure.value;
    });
  read_components("std_error",
                  [](ForceSummary& force, std::size_t c) -> double& { return force.std_error[c]; });
  for (const SiteFigure& figure : site_figures) {
    const Eigen::VectorXd values = read_vector(group, figure.name);
    all_fit(values, 1);
    for (Eigen::Index k = 0; k < rows; ++k)
      results.force_summaries[first + static_cast<std::size_t>(k)].*figure.value = values(k);
  }
}

} // namespace

std::vector<SectionGroup> section_groups(const RunResults& results) {
  std::vector<SectionGroup> out;
  const auto& sites = results.force_sites;
  for (std::size_t k = 0; k < sites.size() && sites[k].is_section(); ++k) {
    if (out.empty() || sites[k].name != sites[k - 1].name)
      out.push_back({k, k});
    out.back().end = k + 1;
  }
  return out;
}

void write_forces(const h5::Group& root, const RunResults& results) {
  const std::vector<SectionGroup> groups = section_groups(results);
  if (!groups.empty()) {
    const h5::Group sections = root.create("sections");
    for (std::size_t g = 0; g < groups.size(); ++g)
      write_sections(create_named(sections, results.force_sites[groups[g].first].name, g), results,
                     groups[g]);
  }
  const auto& reactions = results.series.reactions;
  if (reactions.empty())
    return;
  const h5::Group out = root.create("reactions");
  const std::size_t first = results.force_sites.size() - reactions.size();
  for (std::size_t k = 0; k < reactions.size(); ++k) {
    const h5::Group group = create_named(out, reactions[k].name, k);
    group.set("node", static_cast<std::int64_t>(results.force_sites[first + k].node));
    group.set("fixed", static_cast<std::int64_t>(results.force_sites[first + k].fixed));
    write_matrix(group, "force", reactions[k].force.topRows(results.series.time.size()),
                 "N: x y z; N m: about x y z");
  }
}

void read_forces(const h5::Group& root, RunResults& results) {
  if (root.has("sections"))
    for (const h5::Group& group : in_order(root.open("sections")))
      read_sections(group, results);
  if (root.has("reactions"))
    for (const h5::Group& group : in_order(root.open("reactions"))) {
      ForceSite site{group.text("name"), static_cast<core::Index>(group.integer("node"))};
      site.fixed = static_cast<std::uint8_t>(group.integer("fixed"));
      results.series.reactions.push_back({site.name, read_matrix(group, "force")});
      results.force_sites.push_back(std::move(site));
      results.force_summaries.emplace_back();
    }
}

void export_forces_csv(const std::filesystem::path& directory, const RunResults& results) {
  for (const SectionGroup& group : section_groups(results)) {
    std::vector<CsvColumn> columns;
    const auto add = [&](std::string name, auto figure) {
      columns.push_back({std::move(name), column(group, figure)});
    };
    add("s [m]", [&](std::size_t k) { return results.force_sites[k].s; });
    const std::array<const char*, 3> axes{"x [m]", "y [m]", "z [m]"};
    for (std::size_t d = 0; d < axes.size(); ++d)
      add(axes[d], [&](std::size_t k) {
        return results.nodes.at(static_cast<std::size_t>(results.force_sites[k].node))(
            static_cast<Eigen::Index>(d));
      });
    for (const SiteFigure& figure : site_figures)
      add(std::string(figure.name) + " [" + figure.unit + "]",
          [&](std::size_t k) { return results.force_summaries[k].*figure.value; });
    for (std::size_t c = 0; c < post::force_components; ++c)
      for (const ComponentFigure& figure : component_figures)
        add(std::string(section_components[c]) + "_" + figure.name + " [" + component_units[c] + "]",
            [&](std::size_t k) { return results.force_summaries[k].components[c].*figure.value; });
    write_csv(directory / ("sections_" + path_name(results.force_sites[group.first].name) + ".csv"), columns);
  }
  for (const post::ReactionSeries& reaction : results.series.reactions) {
    std::vector<CsvColumn> columns{{"time [s]", results.series.time}};
    add_columns(columns, "force", reaction.force.leftCols<3>(), {"x", "y", "z"}, "N");
    add_columns(columns, "moment", reaction.force.rightCols<3>(), {"x", "y", "z"}, "N m");
    write_csv(directory / ("reaction_" + path_name(reaction.name) + ".csv"), columns);
  }
}

} // namespace fretwork::results
