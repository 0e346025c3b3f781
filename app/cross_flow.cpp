// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cross_flow.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fretwork::app {
namespace {

/// Abscissae of the ends of bends, in the order of s: elements that are arcs, or chords at an angle, from the first corner to the last.
std::vector<std::array<double, 2>> bends_of(const flow::Tube& tube) {
  constexpr double turn = 1e-3;   // rad, of the tangent
  constexpr double inside = 1e-6; // of an element, from its ends
  std::vector<std::array<double, 2>> out;
  const auto bent = [&](double from, double to, double joined) {
    if (!out.empty() && joined <= out.back()[1])
      out.back()[1] = to;
    else
      out.push_back({from, to});
  };
  const auto& elements = tube.elements();
  core::Vec3 before = tube.at(0.0).tangent;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const double margin = inside * (elements[e].to - elements[e].from);
    const core::Vec3 first = tube.at(elements[e].from + margin).tangent,
                     second = tube.at(elements[e].to - margin).tangent;
    if (e > 0 && before.cross(first).norm() > turn)
      bent(elements[e].from, elements[e].from, elements[e - 1].from);
    if (first.cross(second).norm() > turn)
      bent(elements[e].from, elements[e].to, elements[e].from);
    before = second;
  }
  return out;
}

/// Abscissae of contacts on a tube, ascending.
std::vector<double> contacts_on(const flow::Tube& tube, const std::vector<PlacedContact>& contacts) {
  std::vector<double> out;
  for (const PlacedContact& contact : contacts)
    for (const flow::Tube::Element& element : tube.elements())
      if (element.first == contact.node || element.second == contact.node) {
        out.push_back(element.first == contact.node ? element.from : element.to);
        break;
      }
  std::sort(out.begin(), out.end());
  return out;
}

bool is_one_number(const flow::Zone& zone) {
  const auto* velocity = std::get_if<flow::ScalarVelocity>(&zone.velocity);
  return velocity && velocity->speed.is_constant() && velocity->speed.values.front() > 0.0;
}

} // namespace

std::vector<std::string> cross_flow_in_legs(const study::Study& study, const fem::Model& model,
                                            const std::vector<PlacedFlow>& flows,
                                            const std::vector<PlacedContact>& contacts) {
  constexpr double least_reach = 0.005; // of the tube, as zones and tables may differ
  std::vector<std::string> out;
  for (const PlacedFlow& placed : flows) {
    const flow::Tube tube = tube_of(study, placed, model);
    const std::vector<std::array<double, 2>> bends = bends_of(tube);
    const std::vector<double> at = contacts_on(tube, contacts);
    for (const flow::Zone& zone : placed.profile.zones()) {
      if (!is_one_number(zone))
        continue;
      const double to = std::min(zone.to, placed.length), reach = least_reach * placed.length;
      std::vector<std::string> parts;
      const auto add = [&](double first, double second) {
        if (second - first > reach)
          parts.push_back(fmt::format("s = {:.4g} to {:.4g} m", first, second));
      };
      for (std::size_t b = 0; b < bends.size(); ++b) {
        const auto [begin, end] = bends[b];
        if (zone.from > end - reach || to < begin + reach) // a leg of its own
          continue;
        const double before = b > 0 ? bends[b - 1][1] : 0.0,
                     after = b + 1 < bends.size() ? bends[b + 1][0] : placed.length;
        const auto first = std::lower_bound(at.begin(), at.end(), begin),
                   last = std::upper_bound(at.begin(), at.end(), end);
        if (first != at.begin())
          add(std::max(zone.from, before), *(first - 1));
        if (last != at.end())
          add(*last, std::min(to, after));
      }
      if (!parts.empty())
        out.push_back(fmt::format("{}, zone \"{}\": its velocity is across the tube in the straight leg too, "
                                  "past the first contact beside the bend: {}. "
                                  "Where the flow is along the leg, give velocity as a vector, whose part "
                                  "across the tube acts, or as rows "
                                  "[[s, value], ...], or end the zone",
                                  name_of(study.flows[placed.entry]), zone.name, fmt::join(parts, ", ")));
    }
  }
  return out;
}

} // namespace fretwork::app
