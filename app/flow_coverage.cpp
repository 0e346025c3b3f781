// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/flow_coverage.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

using core::Index;

constexpr double least_share = 0.005; ///< of the tube: what tables of zones may leave out too

/// The parts of the tube between its zones, with and without fluid, `s = 0.5 to 2 m`.
std::string parts_outside_zones(const PlacedFlow& placed) {
  std::vector<std::pair<double, double>> zones;
  for (const flow::Zone& zone : placed.profile.zones())
    zones.emplace_back(zone.from, zone.to);
  for (const flow::Extent& dry : placed.profile.dry())
    zones.emplace_back(dry.from, dry.to);
  zones.emplace_back(placed.length, placed.length);
  std::sort(zones.begin(), zones.end());
  std::vector<std::string> parts;
  double end = 0.0;
  for (const auto& [from, to] : zones) {
    if (from - end > least_share * placed.length)
      parts.push_back(fmt::format("s = {:.4g} to {:.4g} m", end, from));
    end = std::max(end, to);
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

bool has_no_fluid(const fem::BeamProperty& property) {
  const auto none = [](const auto& of) {
    return of.fluid.inside == 0.0 && of.fluid.outside == 0.0 && of.added_mass == 0.0;
  };
  return none(property) && (!property.taper || none(*property.taper));
}

/// Beams without fluid that are in no flow.
class DryBeams {
public:
  DryBeams(const fem::Model& model, const std::vector<PlacedFlow>& flows)
      : model_(model), at_(model.nodes.size()) {
    std::vector<bool> in_flow(model.beams.size(), false);
    for (const PlacedFlow& placed : flows)
      for (const Index beam : placed.beams)
        in_flow[static_cast<std::size_t>(beam)] = true;
    for (std::size_t b = 0; b < model.beams.size(); ++b)
      if (!in_flow[b] && has_no_fluid(model.properties[static_cast<std::size_t>(model.beams[b].property)]))
        for (const Index node : {model.beams[b].a, model.beams[b].b})
          at_[static_cast<std::size_t>(node)].push_back(b);
  }

  /// Those that a tube is joined to, by each other. @param first  takes the node of the tube where they begin
  [[nodiscard]] std::size_t beyond(const PlacedFlow& placed, Index& first) const {
    std::vector<bool> counted(model_.beams.size(), false);
    std::vector<Index> open;
    for (const Index beam : placed.beams)
      for (const Index node : ends(static_cast<std::size_t>(beam)))
        open.push_back(node);
    std::size_t count = 0;
    while (!open.empty()) {
      const Index node = open.back();
      open.pop_back();
      for (const std::size_t beam : at_[static_cast<std::size_t>(node)]) {
        if (counted[beam])
          continue;
        counted[beam] = true;
        if (count++ == 0)
          first = node;
        for (const Index end : ends(beam))
          open.push_back(end);
      }
    }
    return count;
  }

private:
  [[nodiscard]] std::array<Index, 2> ends(std::size_t beam) const {
    return {model_.beams[beam].a, model_.beams[beam].b};
  }

  const fem::Model& model_;
  std::vector<std::vector<std::size_t>> at_; ///< by nodes
};

} // namespace

std::vector<std::string> parts_without_fluid(const study::Study& study, const fem::Model& model,
                                             const std::vector<PlacedFlow>& flows) {
  const DryBeams dry(model, flows);
  std::vector<std::string> out;
  for (const PlacedFlow& placed : flows) {
    const std::string name = name_of(study.flows[placed.entry]);
    if (const std::string parts = parts_outside_zones(placed); !parts.empty())
      out.push_back(
          fmt::format("{}: no zone has {} of its tube, which is {:.4g} m long: it is without the "
                      "mass and damping of a fluid there; give it a zone, with phase = \"none\" if it is dry",
                      name, parts, placed.length));
    Index first = -1;
    if (const std::size_t beyond = dry.beyond(placed, first); beyond > 0)
      out.push_back(fmt::format(
          "{}: {} on beyond its tube, from {} on, without the mass and damping of a fluid; name "
          "their curves in its group, where a zone with phase = \"none\" may say that they are dry, or give "
          "their [[beams]] fluid_inside and fluid_outside",
          name, beyond == 1 ? "1 beam goes" : fmt::format("{} beams go", beyond),
          fem::place(model.nodes[static_cast<std::size_t>(first)])));
  }
  return out;
}

} // namespace fretwork::app
