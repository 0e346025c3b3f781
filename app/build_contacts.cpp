// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/build_contacts.hpp"
#include "app/contact_axes.hpp"
#include "contact/restitution.hpp"
#include "core/error.hpp"
#include "fem/beam_constants.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fretwork::app {
namespace {

using core::Index;
using core::Vec3;

/// Part of a unit vector that is none.
constexpr double negligible_part = 1e-8;
/// Two nodes are beside each other, on no side of planes, where what parts them is no more than the last digits
/// of axes that people write (a share of the distance between the nodes) and of coordinates.
constexpr double digits_of_axes = 1e-8, digits_of_places = 1e-12;
/// Relative difference up to which two walls are one: round-off of sizes that change along a tube.
constexpr double same_wall = 1e-9;

/// A tube_radius that no beam at the node has, a diameter most often; empty where one has it.
std::string radius_warning(const study::Contact& contact, const fem::Model& model, Index node,
                           const std::string& name) {
  constexpr double same_radius = 0.05; // sleeves, wear, rounded sizes
  std::optional<double> other;
  for (const fem::Beam& beam : model.beams)
    if (beam.a == node || beam.b == node) {
      const auto here =
          fem::outer_radius(fem::property_at(model.properties[static_cast<std::size_t>(beam.property)],
                                             beam.along[beam.a == node ? 0 : 1])
                                .section);
      if (!here || std::abs(*here - *contact.tube_radius) <= same_radius * *here)
        return {};
      other = here;
    }
  return other ? fmt::format("contact \"{}\": tube_radius = {:g} m, but the section of the beam at its node "
                             "has an outer "
                             "radius of {:g} m; make them agree",
                             name, *contact.tube_radius, *other)
               : std::string();
}

/// Stiffness of the tube's wall at a node, N/m.
double wall_at(const study::Study& study, const fem::Model& model, Index node, const std::string& name) {
  std::optional<double> stiffness;
  for (const fem::Beam& beam : model.beams) {
    if (beam.a != node && beam.b != node)
      continue;
    const study::Beams& made_of = study.beams[static_cast<std::size_t>(beam.property)];
    const fem::BeamProperty here = fem::property_at(model.properties[static_cast<std::size_t>(beam.property)],
                                                    beam.along[beam.a == node ? 0 : 1]);
    const auto* pipe = std::get_if<fem::Pipe>(&here.section.shape);
    if (!pipe)
      throw core::Error(
          fmt::format("contact \"{}\": normal_stiffness = \"wall\" needs a tube, and section \"{}\" of the "
                      "beam at its node is no pipe; give normal_stiffness a value (N/m)",
                      name, made_of.section));
    const double wall =
        contact::wall_stiffness(here.material.young_modulus, pipe->outer_diameter, pipe->thickness);
    if (stiffness && std::abs(*stiffness - wall) > same_wall * wall)
      throw core::Error(fmt::format("contact \"{}\": normal_stiffness = \"wall\", but tubes of different "
                                    "walls meet at its node; give normal_stiffness a value (N/m)",
                                    name));
    stiffness = wall;
  }
  if (!stiffness)
    throw core::Error(fmt::format("contact \"{}\": normal_stiffness = \"wall\" needs a tube, and its node "
                                  "carries no beam; give normal_stiffness a value (N/m)",
                                  name));
  return *stiffness;
}

/// Of two tubes: their walls in series.
double stiffness_of(const study::Study& study, const fem::Model& model, const PlacedContact& placed) {
  if (const auto& given = study.contacts[placed.entry].normal_stiffness)
    return *given;
  const double wall = wall_at(study, model, placed.node, placed.name);
  if (placed.other < 0)
    return wall;
  const double other = wall_at(study, model, placed.other, placed.name);
  return wall * other / (wall + other);
}

/// Whether restraints hold every displacement that would move the point.
bool is_held(const fem::Model& model, const fem::BeamPoint& point) {
  for (const fem::NodeShare& share : point.motion)
    for (int d = 0; d < core::dofs_per_node; ++d)
      if (!share.weights.col(d).isZero(0.0) && !model.is_fixed(share.node, d))
        return false;
  return true;
}

void check_moves(const fem::Model& model, const PlacedContact& placed, const fem::BeamPoint& point) {
  if (!is_held(model, point))
    return;
  if (placed.other < 0 && !has_beam(model, placed.node))
    throw core::Error(
        fmt::format("contact \"{}\" is at a node that cannot move: {}, or give it a [[masses]] entry",
                    placed.name, without_beam(model, placed.node)));
  if (placed.other < 0)
    throw core::Error(fmt::format(
        "contact \"{}\" is at a node that cannot move; release it in [[restraints]]", placed.name));
  if (is_held(model, fem::point_at(model, placed.other)))
    throw core::Error(fmt::format(
        "contact \"{}\" joins two nodes that cannot move; release one in [[restraints]] or give it a mass",
        placed.name));
}

/// The obstacle, of two flat bodies with the side on which the first is drawn, `offset` left aside: it moves
/// the surfaces, not the nodes.
contact::Obstacle obstacle_of(const study::Contact& contact, const fem::Model& model,
                              const PlacedContact& placed, std::vector<std::string>& warnings) {
  contact::Obstacle shape = contact.shape;
  auto* planes = std::get_if<contact::FacingPlanes>(&shape);
  if (!planes)
    return shape;
  const Vec3& first = model.nodes[static_cast<std::size_t>(placed.node)];
  const Vec3& second = model.nodes[static_cast<std::size_t>(placed.other)];
  const Vec3 between = first - second;
  const double apart = (planes->axis == contact::PlaneAxis::y ? placed.frame.y : placed.frame.z).dot(between);
  const double least = digits_of_axes * between.norm() +
                       digits_of_places * std::max(first.cwiseAbs().maxCoeff(), second.cwiseAbs().maxCoeff());
  if (std::abs(apart) > least) {
    if (contact.side && *contact.side * apart < 0.0)
      warnings.push_back(fmt::format(
          "contact \"{}\": side = {:g}, but the first node is drawn {:.4g} m on the other side of the "
          "second: "
          "the bodies start passed through each other; leave side out, or exchange group and other",
          placed.name, *contact.side, std::abs(apart)));
    if (!contact.side)
      planes->side = std::copysign(1.0, apart);
    return shape;
  }
  if (!contact.side)
    throw core::Error(fmt::format("contact \"{}\": its two nodes are at the same place across the planes, so "
                                  "that neither has a side; give side = 1 or -1",
                                  placed.name));
  return shape;
}

/// Bodies of two nodes whose clearance at rest is given: as large as leaves it.
contact::Obstacle with_gap(contact::Obstacle shape, double gap, const PlacedContact& placed) {
  const auto distance_at = [&](double between) {
    if (!(between - gap > 0.0))
      throw core::Error(
          fmt::format("contact \"{}\": gap = {:g} m, but its nodes are {:.4g} m from each other across "
                      "the contact: nothing is left for the bodies; give a smaller gap",
                      placed.name, gap, std::max(between, 0.0)));
    return between - gap;
  };
  if (auto* round = std::get_if<contact::RoundPair>(&shape))
    round->distance = distance_at(std::hypot(placed.rest.y(), placed.rest.z()));
  if (auto* planes = std::get_if<contact::FacingPlanes>(&shape))
    planes->distance = distance_at(
        planes->side * (planes->axis == contact::PlaneAxis::y ? placed.rest.y() : placed.rest.z()));
  return shape;
}

/// The points of a support of one node: the node, or points from edge to edge of a thickness.
std::vector<fem::BeamPoint> points_of(const study::Contact& contact, const fem::Model& model,
                                      const PlacedContact& placed) {
  if (contact.points == 1)
    return {fem::point_at(model, placed.node)};
  const std::string what = fmt::format("contact \"{}\"", placed.name);
  std::vector<fem::BeamPoint> points;
  for (int k = 0; k < contact.points; ++k) {
    const double along = contact.thickness * (k / (contact.points - 1.0) - 0.5);
    const Vec3 direction = along < 0.0 ? Vec3(-placed.frame.x) : placed.frame.x;
    points.push_back(fem::point_along(model, placed.node, direction, std::abs(along), what));
  }
  return points;
}

/// True where no restraint lets the point move across the axis of the contact.
bool is_held_across(const fem::Model& model, const fem::BeamPoint& point, const contact::Frame& frame) {
  for (const fem::NodeShare& share : point.motion)
    for (int dof = 0; dof < 6; ++dof) {
      const Vec3 moved = share.weights.col(dof);
      if (!model.is_fixed(share.node, dof) &&
          (std::abs(moved.dot(frame.y)) > negligible_part || std::abs(moved.dot(frame.z)) > negligible_part))
        return false;
    }
  return true;
}

/// Of a contact that cannot change; empty where it can.
std::string held_warning(const fem::Model& model, const PlacedContact& placed, const fem::BeamPoint& point) {
  if (!is_held_across(model, point, placed.frame) ||
      (placed.other >= 0 && !is_held_across(model, fem::point_at(model, placed.other), placed.frame)))
    return {};
  return fmt::format(
      "contact \"{}\": its node is restrained in both normal directions: it neither opens nor "
      "closes, and its forces move nothing; release the node in [[restraints]], or leave the contact out",
      placed.name);
}

/// The contacts at one node of a group, appended.
void place(const study::Study& study, const fem::Model& model, PlacedContact contact,
           std::vector<PlacedContact>& out, std::vector<std::string>& warnings) {
  const study::Contact& entry = study.contacts[contact.entry];
  contact.frame = frame_of(entry, model, contact.node, contact.name);
  contact.obstacle = obstacle_of(entry, model, contact, warnings);
  contact.normal_stiffness = stiffness_of(study, model, contact);
  const auto points = points_of(entry, model, contact);
  contact.share = 1.0 / static_cast<double>(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    PlacedContact placed = contact;
    if (points.size() > 1)
      placed.name = fmt::format("{}@{}", contact.name, k + 1);
    check_moves(model, placed, points[k]);
    if (const std::string warning = held_warning(model, placed, points[k]); !warning.empty())
      warnings.push_back(warning);
    placed.motion = points[k].motion;
    placed.place = points[k].place;
    const Vec3 centre = placed.other >= 0 ? model.nodes[static_cast<std::size_t>(placed.other)]
                                          : entry.origin.value_or(points[k].place);
    placed.rest = placed.frame.rotation() * (points[k].place - centre);
    placed.rest.y() -= entry.offset[0];
    placed.rest.z() -= entry.offset[1];
    if (entry.pair_gap)
      placed.obstacle = with_gap(placed.obstacle, *entry.pair_gap, placed);
    placed.order = out.size();
    out.push_back(std::move(placed));
  }
}

/// Points of a group and edges of a thickness are named after their entry, which another entry may be called.
void check_names(const study::Study& study, const std::vector<PlacedContact>& contacts) {
  std::map<std::string, std::size_t> entry_of;
  for (const PlacedContact& placed : contacts) {
    const auto [seen, is_new] = entry_of.emplace(placed.name, placed.entry);
    if (!is_new)
      throw core::Error(fmt::format("contacts \"{}\" and \"{}\" both have a point called \"{}\"; rename one "
                                    "of them",
                                    study.contacts[seen->second].name, study.contacts[placed.entry].name,
                                    placed.name));
  }
}

void deactivate(const study::Study& study, std::vector<PlacedContact>& contacts) {
  for (PlacedContact& placed : contacts) {
    const study::Contact& entry = study.contacts[placed.entry];
    placed.active = entry.active && std::find(entry.inactive.begin(), entry.inactive.end(), placed.support) ==
                                        entry.inactive.end();
  }
  for (const study::Contact& entry : study.contacts)
    for (const std::string& name : entry.inactive)
      check_index("inactive", name, study, contacts);
}

} // namespace

std::vector<PlacedContact> place_contacts(const study::Study& study, const mesh::LineMesh& mesh,
                                          const fem::Model& model, std::vector<std::string>& warnings) {
  std::vector<PlacedContact> out;
  for (std::size_t e = 0; e < study.contacts.size(); ++e) {
    const study::Contact& contact = study.contacts[e];
    const std::string what = fmt::format("contact \"{}\"", contact.name);
    const std::vector<Index> nodes = mesh::group_nodes(mesh, contact.group, what);
    const std::vector<Index> others = contact.other
                                          ? paired_nodes(model, mesh, what, contact.group, *contact.other)
                                          : std::vector<Index>(nodes.size(), -1);
    if (contact.other && contact.origin)
      warnings.push_back(what +
                         ": origin moves nothing between two nodes, where only their relative position "
                         "counts; leave it out, or shift the obstacle by offset");
    std::string radius_said, axis_said; // of the first node of the group that it is true of
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      PlacedContact placed{};
      placed.name = placed.support =
          nodes.size() == 1 ? contact.name : fmt::format("{}[{}]", contact.name, i);
      placed.entry = e;
      placed.node = nodes[i];
      placed.other = others[i];
      if (contact.tube_radius && radius_said.empty())
        radius_said = radius_warning(contact, model, nodes[i], placed.name);
      if (axis_said.empty())
        axis_said = axis_warning(contact, model, nodes[i], placed.name);
      place(study, model, std::move(placed), out, warnings);
    }
    for (const std::string& said : {radius_said, axis_said})
      if (!said.empty())
        warnings.push_back(said);
  }
  check_names(study, out);
  deactivate(study, out);
  return out;
}

void check_index(const std::string& what, const std::string& name, const study::Study& study,
                 const std::vector<PlacedContact>& placed) {
  const study::Contact* group = nullptr;
  for (const study::Contact& contact : study.contacts)
    if (name.starts_with(contact.name + "[") && (!group || contact.name.size() > group->name.size()))
      group = &contact;
  std::vector<std::string> supports;
  for (const PlacedContact& contact : placed) {
    if (contact.support == name || study.contacts[contact.entry].name == name)
      return;
    if (&study.contacts[contact.entry] == group &&
        contact.support != (supports.empty() ? "" : supports.back()))
      supports.push_back(contact.support);
  }
  throw core::Error(fmt::format("{} \"{}\": contact \"{}\" has {} support{}, {}", what, name, group->name,
                                supports.size(), supports.size() == 1 ? "" : "s",
                                supports.size() == 1
                                    ? fmt::format("called \"{}\"", supports.front())
                                    : fmt::format("\"{}\" to \"{}\"", supports.front(), supports.back())));
}

double gap_of(const PlacedContact& placed, const contact::Obstacle& obstacle) {
  return placed.other < 0 ? contact::locate(obstacle, 0.0, 0.0).gap
                          : contact::locate(obstacle, placed.rest.y(), placed.rest.z()).gap;
}

std::vector<PlacedContact> take_inactive(std::vector<PlacedContact>& placed) {
  const auto first = std::stable_partition(placed.begin(), placed.end(),
                                           [](const PlacedContact& contact) { return contact.active; });
  std::vector<PlacedContact> inactive(first, placed.end());
  placed.erase(first, placed.end());
  return inactive;
}

std::vector<PlacedContact> together(std::vector<PlacedContact> placed,
                                    const std::vector<PlacedContact>& inactive) {
  placed.insert(placed.end(), inactive.begin(), inactive.end());
  std::stable_sort(placed.begin(), placed.end(),
                   [](const PlacedContact& a, const PlacedContact& b) { return a.order < b.order; });
  return placed;
}

} // namespace fretwork::app
