// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/build_flow.hpp"
#include "core/error.hpp"
#include "fem/fields.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fretwork::app {
namespace {

using core::Index;

std::vector<Index> beams_of(const study::Flow& flow, const mesh::LineMesh& mesh) {
  std::vector<Index> beams;
  for (const std::string& group : flow.groups)
    for (const Index line : mesh::group_lines(mesh, group, name_of(flow))) // a line is the beam of its number
      if (std::find(beams.begin(), beams.end(), line) == beams.end())
        beams.push_back(line);
  return beams;
}

/// Nodes with one beam of the tube.
std::vector<Index> ends_of(const fem::Model& model, const std::vector<Index>& beams) {
  std::map<Index, int> met;
  for (const Index beam : beams)
    for (const Index node :
         {model.beams[static_cast<std::size_t>(beam)].a, model.beams[static_cast<std::size_t>(beam)].b})
      ++met[node];
  std::vector<Index> ends;
  for (const auto& [node, count] : met)
    if (count == 1)
      ends.push_back(node);
  return ends;
}

Index start_of(const study::Flow& flow, const mesh::LineMesh& mesh, const std::vector<Index>& ends) {
  const std::vector<Index> nodes = mesh::group_nodes(mesh, flow.from, name_of(flow));
  std::vector<Index> starts;
  for (const Index end : ends)
    if (std::find(nodes.begin(), nodes.end(), end) != nodes.end())
      starts.push_back(end);
  if (starts.size() != 1)
    throw core::Error(
        fmt::format("{}: from = \"{}\" has {} of the {} ends of its curves; name a group with one end "
                    "of the tube",
                    name_of(flow), flow.from, starts.size(), ends.size()));
  return starts.front();
}

bool has_fluid(const fem::BeamProperty& property) {
  const auto some = [](const fem::Fluid& fluid) { return fluid.inside > 0.0 || fluid.outside > 0.0; };
  return some(property.fluid) || (property.taper && some(property.taper->fluid));
}

/// @param owner  by beams: number of the flow that has it, -1: none
void check_beams(const study::Study& study, std::size_t entry, const std::vector<Index>& beams,
                 const fem::Model& model, std::vector<int>& owner) {
  const study::Flow& flow = study.flows[entry];
  for (const Index beam : beams) {
    int& has = owner[static_cast<std::size_t>(beam)];
    if (has >= 0)
      throw core::Error(fmt::format("{} and {} share a beam; let each tube belong to one [[flow]]",
                                    name_of(study.flows[static_cast<std::size_t>(has)]), name_of(flow)));
    has = static_cast<int>(entry);
    const Index property = model.beams[static_cast<std::size_t>(beam)].property;
    if (has_fluid(model.properties[static_cast<std::size_t>(property)]))
      throw core::Error(fmt::format(
          "{}: [[beams]] of group \"{}\" have fluid_inside or fluid_outside, and the flow gives the beams "
          "their fluid too; leave one of them out",
          name_of(flow), study.beams[static_cast<std::size_t>(property)].group));
  }
}

flow::Profile profile_of(const study::Flow& flow, double length) {
  std::vector<flow::Zone> zones = flow.zones;
  std::vector<flow::Extent> dry = flow.dry;
  const auto end_at_length = [length](auto& all) {
    for (auto& zone : all)
      if (zone.to == study::end_of_tube)
        zone.to = length;
  };
  end_at_length(zones);
  end_at_length(dry);
  try {
    return {std::move(zones), length, std::move(dry)};
  } catch (const core::Error& error) {
    throw core::Error(fmt::format("{}: {}", name_of(flow), error.what()));
  }
}

/// The number of a property like that of the beam, with this fluid.
Index wet_property(fem::Model& model, Index dry, const fem::Fluid& fluid, std::size_t first_wet) {
  fem::BeamProperty wet = model.properties[static_cast<std::size_t>(dry)];
  wet.fluid = fluid;
  if (wet.taper)
    wet.taper->fluid = fluid;
  const auto begin = model.properties.begin() + static_cast<std::ptrdiff_t>(first_wet);
  const auto found = std::find(begin, model.properties.end(), wet);
  const auto number = static_cast<Index>(found - model.properties.begin());
  if (found == model.properties.end())
    model.properties.push_back(std::move(wet));
  return number;
}

void fill(fem::Model& model, const flow::TubeFluid& fluid) {
  const std::size_t first_wet = model.properties.size();
  for (const flow::ElementFluid& element : fluid.elements) {
    Index& property = model.beams[static_cast<std::size_t>(element.beam)].property;
    if (element.fluid.inside > 0.0 || element.fluid.outside > 0.0)
      property = wet_property(model, property, element.fluid, first_wet);
  }
}

/// @throws core::Error with the name of the flow
flow::TubeFluid fluid_of(const study::Flow& flow, const flow::Tube& tube, const flow::Profile& profile) {
  try {
    return flow::fluid_of_elements(tube, profile);
  } catch (const core::Error& error) {
    throw core::Error(fmt::format("{}: {}", name_of(flow), error.what()));
  }
}

/// What one kind of limit says. @param value, bound  of the case that is farthest from its bound
std::string limit_text(flow::LimitKind kind, double value, double bound) {
  switch (kind) {
  case flow::LimitKind::damping_floor:
    return fmt::format(
        "damping of the stability set, {:.3g} %, raised to {:.3g} %, the least that is measured in liquid",
        100.0 * value, 100.0 * bound);
  case flow::LimitKind::damping_ceiling:
    return fmt::format(
        "damping of the stability set, {:.3g} %, lowered to {:.3g} %, the most that is assumed",
        100.0 * value, 100.0 * bound);
  case flow::LimitKind::stokes_number:
    return fmt::format("viscous damping is correlated for pi f D^2/(2 nu) above {:g}, here {:.3g}", bound,
                       value);
  case flow::LimitKind::confinement:
    return fmt::format("viscous damping is correlated for De/D above {:g}, here {:.4g}", bound, value);
  case flow::LimitKind::pitch_ratio:
    return fmt::format("added mass is correlated for P/D from 1.2 to 2, here {:.4g}", value);
  case flow::LimitKind::elements_of_zone:
    return fmt::format("{:g} elements, fewer than {:g}: mass and shapes change in steps; mesh more finely",
                       value, bound);
  case flow::LimitKind::support_in_no_fluid:
    return fmt::format("its support number {:g} is in no zone and damps nothing", value + 1.0);
  }
  return {};
}

} // namespace

std::string name_of(const study::Flow& flow) { return fmt::format("flow \"{}\"", flow.name); }

flow::Tube tube_of(const study::Study& study, const PlacedFlow& placed, const fem::Model& model) {
  return {model, placed.beams, placed.start, study.flows[placed.entry].name};
}

std::vector<PlacedFlow> place_flows(const study::Study& study, const mesh::LineMesh& mesh, fem::Model& model,
                                    std::vector<std::string>& notes) {
  std::vector<PlacedFlow> out;
  std::vector<int> owner(model.beams.size(), -1);
  for (std::size_t e = 0; e < study.flows.size(); ++e) {
    const study::Flow& flow = study.flows[e];
    const std::vector<Index> beams = beams_of(flow, mesh);
    check_beams(study, e, beams, model, owner);
    const Index start = start_of(flow, mesh, ends_of(model, beams));
    const flow::Tube tube(model, beams, start, flow.name);
    PlacedFlow placed{e, beams, start, tube.length(), profile_of(flow, tube.length())};
    const flow::TubeFluid fluid = fluid_of(flow, tube, placed.profile);
    for (std::string& note : limit_notes(name_of(flow), fluid.limits, placed.profile))
      notes.push_back(std::move(note));
    fill(model, fluid);
    out.push_back(std::move(placed));
  }
  return out;
}

std::optional<Eigen::VectorXd> steady_force(const study::Study& study, const PlacedFlow& placed,
                                            const fem::Model& model) {
  const study::Flow& flow = study.flows[placed.entry];
  if (!(flow.law && flow.law->steady))
    return std::nullopt;
  const auto [drag, lift] = *flow.law->steady;
  Eigen::VectorXd out =
      Eigen::VectorXd::Zero(core::dofs_per_node * static_cast<Eigen::Index>(model.nodes.size()));
  const flow::Tube tube = tube_of(study, placed, model);
  for (const flow::Tube::Element& element : tube.elements()) {
    const flow::TubePoint point = tube.at(0.5 * (element.from + element.to));
    const flow::FlowPoint at = placed.profile.at(point);
    if (at.velocity > 0.0)
      out += fem::line_forces(model, {&element.beam, 1},
                              0.5 * at.density * at.velocity * at.velocity * point.outer_diameter *
                                  (drag * at.drag + lift * at.lift));
  }
  return out;
}

std::vector<std::string> limit_notes(const std::string& what, const flow::Limits& limits,
                                     const flow::Profile& profile) {
  std::vector<std::string> out;
  std::vector<bool> said(limits.size(), false);
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (said[i])
      continue;
    flow::Limit worst = limits[i];
    int modes = 0;
    for (std::size_t k = i; k < limits.size(); ++k) {
      const bool alike = limits[k].kind == worst.kind && limits[k].zone == worst.zone;
      if (!alike || (limits[k].mode < 0 && k > i))
        continue;
      said[k] = true;
      modes += limits[k].mode >= 0 ? 1 : 0;
      if (std::abs(limits[k].value - limits[k].bound) > std::abs(worst.value - worst.bound))
        worst = limits[k];
    }
    std::string text = what;
    if (worst.zone >= 0)
      text += fmt::format(", zone \"{}\"", profile.zones()[static_cast<std::size_t>(worst.zone)].name);
    text += ": " + limit_text(worst.kind, worst.value, worst.bound);
    if (modes > 1)
      text += fmt::format(", the farthest of {} modes", modes);
    else if (modes == 1)
      text += fmt::format(" (mode {})", worst.mode + 1);
    out.push_back(std::move(text));
  }
  return out;
}

} // namespace fretwork::app
