// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/build_contacts.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

using core::Index;
using core::Vec3;

/// A component of the default axis below this share of it counts as 0 when the axis is oriented.
constexpr double negligible = 1e-8;
/// Tangents of two beams that meet at a node give a mean this long at least; shorter: they turn back.
constexpr double shortest_mean = 0.1;
/// The bits of ux, uy and uz.
constexpr std::uint8_t translations = 0b000111;

/// Beams are walked along their chain, so that the tangents before and after a node point the same way.
Vec3 mean_tangent(const fem::Model& model, Index node, const std::string& name) {
  Vec3 sum = Vec3::Zero();
  int beams = 0;
  for (const auto& beam : model.beams)
    if (beam.a == node || beam.b == node) {
      sum += (model.nodes[static_cast<std::size_t>(beam.b)] - model.nodes[static_cast<std::size_t>(beam.a)])
                 .normalized();
      ++beams;
    }
  if (beams == 0)
    throw core::Error(fmt::format(
        "contact \"{}\": its node carries no beam that would give the axis; give axis = [x, y, z]", name));
  if (beams > 2 || sum.norm() < shortest_mean)
    throw core::Error(
        fmt::format("contact \"{}\": {} beams meet at its node in no common direction; give axis = [x, y, z]",
                    name, beams));
  return sum.normalized();
}

/// First component that is not negligible in the order z, x, y is made positive.
Vec3 oriented(const Vec3& axis) {
  for (const int d : {2, 0, 1})
    if (std::abs(axis(d)) > negligible)
      return axis(d) < 0.0 ? Vec3(-axis) : axis;
  return axis;
}

contact::Frame frame_of(const study::Contact& contact, const fem::Model& model, Index node,
                        const std::string& name) {
  if (!contact.axis && !contact.y_axis && contact.obstacle != study::ObstacleKind::circle &&
      contact.obstacle != study::ObstacleKind::circle_inside)
    throw core::Error(fmt::format("contact \"{}\": obstacle \"{}\" has a direction; give axis or y_axis",
                                  name, name_of(contact.obstacle)));
  const Vec3 axis = contact.axis ? *contact.axis : oriented(mean_tangent(model, node, name));
  if (contact.y_axis)
    return contact::frame_from_y(axis, *contact.y_axis);
  return contact::nautical_frame(axis, contact.angle * std::numbers::pi / 180.0);
}

} // namespace

std::string name_of(study::ObstacleKind kind) {
  switch (kind) {
  case study::ObstacleKind::circle:
    return "circle";
  case study::ObstacleKind::plane_y:
    return "plane_y";
  case study::ObstacleKind::plane_z:
    return "plane_z";
  case study::ObstacleKind::stop_y:
    return "stop_y";
  case study::ObstacleKind::stop_z:
    return "stop_z";
  case study::ObstacleKind::circle_inside:
    return "circle_inside";
  case study::ObstacleKind::profile:
    return "profile";
  case study::ObstacleKind::broached:
    return "broached";
  case study::ObstacleKind::egg_crate:
    return "egg_crate";
  }
  return {};
}

contact::Obstacle obstacle_of(const study::Contact& c, const PlacedContact& placed) {
  using contact::PlaneAxis;
  const auto plane = [&](PlaneAxis axis) -> contact::Obstacle {
    if (placed.other < 0)
      return contact::PlanePair{c.gap, axis};
    const double apart = axis == PlaneAxis::y ? placed.rest.y() : placed.rest.z();
    if (!c.side && apart == 0.0)
      throw core::Error(fmt::format("contact \"{}\": its two nodes are at the same place across the planes, "
                                    "so that neither has a side; give side = 1 "
                                    "or -1",
                                    placed.name));
    return contact::FacingPlanes{c.distance_1 + c.distance_2, axis,
                                 c.side ? *c.side : std::copysign(1.0, apart)};
  };
  switch (c.obstacle) {
  case study::ObstacleKind::circle:
    if (placed.other >= 0)
      return contact::RoundPair{c.distance_1 + c.distance_2};
    return contact::Circle{c.gap};
  case study::ObstacleKind::profile:
  case study::ObstacleKind::broached:
  case study::ObstacleKind::egg_crate:
    return *c.shape;
  case study::ObstacleKind::circle_inside:
    return contact::Circle{c.distance_2 - c.distance_1};
  case study::ObstacleKind::plane_y:
    return plane(PlaneAxis::y);
  case study::ObstacleKind::plane_z:
    return plane(PlaneAxis::z);
  case study::ObstacleKind::stop_y:
    return contact::Stop{c.gap, PlaneAxis::y};
  case study::ObstacleKind::stop_z:
    return contact::Stop{c.gap, PlaneAxis::z};
  }
  return contact::Circle{c.gap};
}

namespace {

/// The second nodes of a contact between two groups, paired with the first by nearest place.
std::vector<Index> second_nodes(const study::Contact& contact, const mesh::LineMesh& mesh,
                                const fem::Model& model, const std::vector<Index>& nodes) {
  const std::string what = fmt::format("contact \"{}\"", contact.name);
  const std::vector<Index> others = mesh::group_nodes(mesh, *contact.other, what);
  if (others.size() != nodes.size())
    throw core::Error(fmt::format("{}: group \"{}\" has {} nodes and other \"{}\" has {}; contacts between "
                                  "groups need as many nodes in each",
                                  what, contact.group, nodes.size(), *contact.other, others.size()));
  std::vector<Index> paired;
  for (const Index node : nodes) {
    const Index other = nearest_node(model, others, model.nodes[static_cast<std::size_t>(node)]);
    if (other == node)
      throw core::Error(fmt::format(
          "{}: \"{}\" and \"{}\" share a node, which cannot meet itself; name two different nodes", what,
          contact.group, *contact.other));
    if (std::find(paired.begin(), paired.end(), other) != paired.end())
      throw core::Error(fmt::format(
          "{}: two nodes of \"{}\" have the same nearest node in \"{}\"; make one contact for each pair",
          what, contact.group, *contact.other));
    paired.push_back(other);
  }
  return paired;
}

} // namespace

std::vector<PlacedContact> place_contacts(const study::Study& study, const mesh::LineMesh& mesh,
                                          const fem::Model& model) {
  std::vector<PlacedContact> out;
  for (std::size_t e = 0; e < study.contacts.size(); ++e) {
    const study::Contact& contact = study.contacts[e];
    const std::vector<Index> nodes =
        mesh::group_nodes(mesh, contact.group, fmt::format("contact \"{}\"", contact.name));
    const std::vector<Index> others =
        contact.other ? second_nodes(contact, mesh, model, nodes) : std::vector<Index>(nodes.size(), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      PlacedContact placed;
      placed.name = nodes.size() == 1 ? contact.name : fmt::format("{}[{}]", contact.name, i);
      placed.entry = e;
      placed.node = nodes[i];
      if ((model.fixed[static_cast<std::size_t>(placed.node)] & translations) == translations)
        throw core::Error(fmt::format(
            "contact \"{}\" is at a node that cannot move; release it in [[restraints]] or give it a mass",
            placed.name));
      placed.frame = frame_of(contact, model, nodes[i], placed.name);
      const Vec3& place = model.nodes[static_cast<std::size_t>(nodes[i])];
      placed.other = others[i];
      const Vec3 centre = placed.other >= 0 ? model.nodes[static_cast<std::size_t>(placed.other)]
                                            : contact.origin.value_or(place);
      placed.rest = placed.frame.rotation() * (place - centre);
      placed.rest.y() -= contact.offset[0];
      placed.rest.z() -= contact.offset[1];
      out.push_back(placed);
    }
  }
  return out;
}

} // namespace fretwork::app
