// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pinned_model.hpp"
#include "core/error.hpp"
#include "fem/beam_element.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace fretwork::app {
namespace {

using core::Index;
using core::Vec3;

constexpr std::uint8_t translations = 0b000111, all_dofs = 0b111111;
/// Of the rod's bending and torsion to its axial stiffness: nothing is felt of them.
constexpr double slenderness = 1e-18;

/// Local axes along which the obstacle presses.
std::vector<Vec3> directions(const contact::Obstacle& obstacle, const contact::Frame& frame) {
  const auto [y, z] = contact::normal_directions(obstacle);
  std::vector<Vec3> out;
  if (y)
    out.push_back(frame.y);
  if (z)
    out.push_back(frame.z);
  return out;
}

/// N/m, the largest on the diagonal of the beams at the node.
double stiffness_at(const fem::Model& model, Index node) {
  double largest = 0.0;
  for (const fem::Beam& beam : model.beams)
    if (beam.a == node || beam.b == node)
      largest = std::max(largest, fem::BeamElement(model, beam)
                                      .stiffness()
                                      .diagonal()
                                      .segment<3>(beam.a == node ? 0 : core::dofs_per_node)
                                      .maxCoeff());
  return largest;
}

/// Of a rod of 1 m.
fem::BeamProperty rod(double stiffness) {
  const double bending = slenderness;
  return {{stiffness, 0.0, 0.0}, {1.0, bending, bending, bending, 0.0}};
}

} // namespace

bool can_pin(const fem::Model& model, const PlacedContact& contact) {
  return contact.other < 0 ||
         (model.fixed[static_cast<std::size_t>(contact.other)] & translations) == translations;
}

fem::Model pinned_model(const study::Study& study, const fem::Model& model,
                        const std::vector<PlacedContact>& pins) {
  fem::Model out = model;
  std::set<std::pair<Index, std::size_t>> done; // nodes and entries: points along a thickness pin once
  for (const PlacedContact& pin : pins) {
    if (!done.emplace(pin.node, pin.entry).second)
      continue;
    const double stiffness = stiffness_at(model, pin.node);
    if (!(stiffness > 0.0))
      throw core::Error(fmt::format("contact \"{}\" cannot pin: its node carries no beam; leave it out of "
                                    "[[stability]] pinned",
                                    pin.name));
    const auto property = static_cast<Index>(out.properties.size());
    out.properties.push_back(rod(pin_stiffness * stiffness));
    for (const Vec3& direction : directions(study.contacts[pin.entry].shape, pin.frame)) {
      out.nodes.push_back(model.nodes[static_cast<std::size_t>(pin.node)] + direction);
      out.fixed.push_back(all_dofs);
      out.beams.push_back({pin.node, static_cast<Index>(out.nodes.size()) - 1, property});
    }
  }
  return out;
}

} // namespace fretwork::app
