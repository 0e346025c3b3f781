// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/build_model.hpp"
#include "app/tapers.hpp"
#include "core/error.hpp"
#include "fem/ties.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

using core::Index;

constexpr std::uint8_t all_fixed = 0b111111;

/// The curves a line belongs to, for messages.
std::string curves_of(const mesh::LineMesh& mesh, Index line) {
  std::vector<std::string> names;
  for (const auto& [name, lines] : mesh.curves)
    if (std::binary_search(lines.begin(), lines.end(), line))
      names.push_back("\"" + name + "\"");
  return names.empty() ? "no named curve" : fmt::format("{}", fmt::join(names, ", "));
}

fem::BeamProperty property_of(const study::Study& study, const study::Beams& beams) {
  fem::BeamProperty property{study.materials.at(beams.material),
                             study.sections.at(beams.section),
                             beams.added_mass,
                             beams.added_mass_direction,
                             beams.orientation,
                             beams.axial_force,
                             beams.fluid};
  if (beams.taper)
    property.taper = {study.sections.at(beams.taper->section), beams.taper->added_mass, beams.taper->fluid,
                      beams.taper->axial_force};
  return property;
}

void add_beams(const study::Study& study, const mesh::LineMesh& mesh, fem::Model& model) {
  std::vector<Index> entry_of(mesh.lines.size(), -1);
  for (std::size_t e = 0; e < study.beams.size(); ++e) {
    const study::Beams& beams = study.beams[e];
    model.properties.push_back(property_of(study, beams));
    for (const Index line : mesh::group_lines(mesh, beams.group, fmt::format("[[beams]] entry {}", e + 1))) {
      Index& entry = entry_of[static_cast<std::size_t>(line)];
      if (entry >= 0 && entry != static_cast<Index>(e))
        throw core::Error(fmt::format(
            "a line of group \"{}\" has two [[beams]] entries, \"{}\" and \"{}\"; each line element needs "
            "exactly one: make the groups disjoint",
            beams.group, study.beams[static_cast<std::size_t>(entry)].group, beams.group));
      entry = static_cast<Index>(e);
    }
  }
  for (std::size_t i = 0; i < mesh.lines.size(); ++i) {
    const mesh::Line& line = mesh.lines[i];
    if (entry_of[i] < 0) {
      const auto without = std::count(entry_of.begin(), entry_of.end(), -1);
      throw core::Error(fmt::format(
          "{} of {} line elements have no [[beams]] entry (the first is in {}); give each line element "
          "a material and a section",
          without, mesh.lines.size(), curves_of(mesh, static_cast<Index>(i))));
    }
    model.beams.push_back({line.nodes[0], line.nodes[1], entry_of[i], line.middle});
  }
}

void add_springs(const study::Study& study, const mesh::LineMesh& mesh, fem::Model& model) {
  for (std::size_t e = 0; e < study.springs.size(); ++e) {
    const study::Spring& spring = study.springs[e];
    const std::string what = fmt::format("[[springs]] entry {}", e + 1);
    const std::vector<Index> nodes = mesh::group_nodes(mesh, spring.group, what);
    if (!spring.other) {
      for (const Index node : nodes)
        model.springs.push_back({node, -1, spring.stiffness, spring.damping});
      continue;
    }
    const std::vector<Index> others = paired_nodes(model, mesh, what, spring.group, *spring.other);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      model.springs.push_back({nodes[i], others[i], spring.stiffness, spring.damping});
  }
}

void add_ties(const study::Study& study, const mesh::LineMesh& mesh, fem::Model& model) {
  for (std::size_t e = 0; e < study.ties.size(); ++e) {
    const study::Tie& tie = study.ties[e];
    const std::string what = fmt::format("[[ties]] entry {}", e + 1);
    const std::vector<Index> nodes = mesh::group_nodes(mesh, tie.group, what);
    const std::vector<Index> others = paired_nodes(model, mesh, what, tie.group, tie.other);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      model.ties.push_back({nodes[i], others[i], tie.tied});
  }
}

/// Named points that the study gives neither mass, spring, tie nor restraint and that no line uses are marks, not
/// structure.
void leave_out_marks(fem::Model& model, const std::vector<bool>& restrained) {
  std::vector<bool> used = restrained;
  const auto use = [&](Index node) {
    if (node >= 0)
      used[static_cast<std::size_t>(node)] = true;
  };
  for (const auto& beam : model.beams) {
    use(beam.a);
    use(beam.b);
  }
  for (const auto& mass : model.masses)
    use(mass.node);
  for (const auto& spring : model.springs) {
    use(spring.node);
    use(spring.other);
  }
  for (const auto& tie : model.ties) {
    use(tie.node);
    use(tie.other);
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i])
      model.fixed[i] = all_fixed;
}

/// The node of `others` (not empty) nearest to a place.
Index nearest_node(const fem::Model& model, const std::vector<Index>& others, const core::Vec3& place) {
  return *std::min_element(others.begin(), others.end(), [&](Index a, Index b) {
    const auto distance = [&](Index n) {
      return (model.nodes[static_cast<std::size_t>(n)] - place).squaredNorm();
    };
    return distance(a) < distance(b);
  });
}

} // namespace

std::vector<Index> paired_nodes(const fem::Model& model, const mesh::LineMesh& mesh, const std::string& what,
                                const std::string& group, const std::string& other) {
  const std::vector<Index> nodes = mesh::group_nodes(mesh, group, what);
  const std::vector<Index> others = mesh::group_nodes(mesh, other, what);
  if (others.size() != nodes.size())
    throw core::Error(fmt::format("{}: group \"{}\" has {} nodes and other \"{}\" has {}; pairs need as many "
                                  "nodes in each",
                                  what, group, nodes.size(), other, others.size()));
  std::vector<Index> paired;
  for (const Index node : nodes) {
    const Index nearest = nearest_node(model, others, model.nodes[static_cast<std::size_t>(node)]);
    if (nearest == node)
      throw core::Error(fmt::format(
          "{}: \"{}\" and \"{}\" share a node, which cannot be joined to itself; name two different nodes",
          what, group, other));
    if (std::find(paired.begin(), paired.end(), nearest) != paired.end())
      throw core::Error(fmt::format(
          "{}: two nodes of \"{}\" have the same nearest node in \"{}\"; make one entry for each pair", what,
          group, other));
    paired.push_back(nearest);
  }
  return paired;
}

fem::Model build_model(const study::Study& study, const mesh::LineMesh& mesh) {
  fem::Model model;
  model.nodes = mesh.nodes;
  model.fixed.assign(mesh.nodes.size(), 0);
  add_beams(study, mesh, model);
  place_tapers(study, mesh, model);
  std::vector<bool> restrained(mesh.nodes.size(), false);
  for (std::size_t e = 0; e < study.restraints.size(); ++e)
    for (const Index node :
         mesh::group_nodes(mesh, study.restraints[e].group, fmt::format("[[restraints]] entry {}", e + 1))) {
      model.fixed[static_cast<std::size_t>(node)] |= study.restraints[e].fixed;
      restrained[static_cast<std::size_t>(node)] = true;
    }
  for (std::size_t e = 0; e < study.masses.size(); ++e)
    for (const Index node :
         mesh::group_nodes(mesh, study.masses[e].group, fmt::format("[[masses]] entry {}", e + 1)))
      model.masses.push_back({node, study.masses[e].mass, study.masses[e].inertia, study.masses[e].arm});
  add_springs(study, mesh, model);
  add_ties(study, mesh, model);
  leave_out_marks(model, restrained);
  fem::restrain_tied(model);
  return model;
}

} // namespace fretwork::app
