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

constexpr std::uint8_t translation_dofs = 0b000111, all_dofs = 0b111111;
/// Of the rod's bending and torsion to its axial stiffness: nothing is felt of them.
constexpr double slenderness = 1e-18;

struct Rod {
  Vec3 direction;
  double stiffness; ///< N/m
};

/// What the pin of a contact holds. @param rigid  N/m, of pins that are not elastic
std::vector<Rod> rods_of(const study::Contact& contact, const PlacedContact& pin, const PinKind& kind,
                         double rigid) {
  const auto [y, z] = contact::normal_directions(contact.shape);
  const double normal = kind.elastic ? pin.normal_stiffness : rigid,
               tangential = kind.elastic ? contact.tangential_stiffness : rigid;
  std::vector<Rod> out;
  if (y)
    out.push_back({pin.frame.y, normal});
  if (z)
    out.push_back({pin.frame.z, normal});
  if (!kind.sticking || !(contact.friction_static > 0.0) || !(tangential > 0.0))
    return out;
  if (contact.friction_along.x > 0.0)
    out.push_back({pin.frame.x, tangential});
  if (contact.friction_along.t > 0.0 && !(y && z))
    out.push_back({y ? pin.frame.z : pin.frame.y, tangential});
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
         (model.fixed[static_cast<std::size_t>(contact.other)] & translation_dofs) == translation_dofs;
}

std::vector<PlacedContact> that_can_pin(const fem::Model& model, const std::vector<PlacedContact>& contacts) {
  std::set<Index> carrying;
  for (const fem::Beam& beam : model.beams)
    carrying.insert({beam.a, beam.b});
  std::vector<PlacedContact> out;
  for (const PlacedContact& contact : contacts)
    if (can_pin(model, contact) && carrying.contains(contact.node))
      out.push_back(contact);
  return out;
}

Eigen::MatrixXd stiffness_with_pins(const modal::Basis& basis, Eigen::Index modes, const fem::Model& model,
                                    const fem::Model& pinned) {
  Eigen::MatrixXd stiffness = basis.omega.head(modes).array().square().matrix().asDiagonal();
  for (std::size_t i = model.beams.size(); i < pinned.beams.size(); ++i) {
    const fem::Beam& rod = pinned.beams[i];
    const Eigen::Index row = basis.row_of(rod.a);
    if (row < 0)
      continue;
    const Eigen::VectorXd along =
        basis.shapes.block(row, 0, 3, modes).transpose() * (pinned.node(rod.b) - pinned.node(rod.a));
    stiffness += pinned.properties[static_cast<std::size_t>(rod.property)].material.young_modulus * along *
                 along.transpose(); // of 1 m and 1 m2
  }
  return stiffness;
}

fem::Model pinned_model(const study::Study& study, const fem::Model& model,
                        const std::vector<PlacedContact>& pins, const PinKind& kind) {
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
    for (const Rod& held : rods_of(study.contacts[pin.entry], pin, kind, pin_stiffness * stiffness)) {
      out.nodes.push_back(model.nodes[static_cast<std::size_t>(pin.node)] + held.direction);
      out.fixed.push_back(all_dofs);
      out.properties.push_back(rod(held.stiffness));
      out.beams.push_back({pin.node, static_cast<Index>(out.nodes.size()) - 1,
                           static_cast<Index>(out.properties.size()) - 1});
    }
  }
  return out;
}

} // namespace fretwork::app
