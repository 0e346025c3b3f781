// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/support_shapes.hpp"
#include "core/error.hpp"
#include "study/readers.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

namespace fretwork::study {
namespace {

const Keys contact_keys{{"name",
                         "group",
                         "obstacle",
                         "gap",
                         "axis",
                         "y_axis",
                         "angle",
                         "origin",
                         "offset",
                         "normal_stiffness",
                         "normal_damping",
                         "tangential_stiffness",
                         "tangential_damping",
                         "friction",
                         "friction_memory",
                         "attached_to",
                         "other",
                         "distance_1",
                         "distance_2",
                         "side",
                         "profile",
                         "tube_radius",
                         "land_radius",
                         "lobe_radius",
                         "lands",
                         "land_angle",
                         "half_widths"}};

const Choices<ObstacleKind> obstacles{{{"circle", ObstacleKind::circle},
                                       {"plane_y", ObstacleKind::plane_y},
                                       {"plane_z", ObstacleKind::plane_z},
                                       {"stop_y", ObstacleKind::stop_y},
                                       {"stop_z", ObstacleKind::stop_z},
                                       {"circle_inside", ObstacleKind::circle_inside},
                                       {"profile", ObstacleKind::profile},
                                       {"broached", ObstacleKind::broached},
                                       {"egg_crate", ObstacleKind::egg_crate}}};

bool is_round(ObstacleKind kind) {
  return kind == ObstacleKind::circle || kind == ObstacleKind::circle_inside;
}

constexpr double degree = std::numbers::pi / 180.0;

/// Keys that belong to other obstacles than the one named are refused.
void refuse_others(const TableReader& table, const std::vector<std::string>& own) {
  for (const char* key :
       {"gap", "profile", "tube_radius", "land_radius", "lobe_radius", "lands", "land_angle", "half_widths"})
    if (table.has(key) && std::find(own.begin(), own.end(), key) == own.end())
      table.fail_at(key, "does not belong to this obstacle; leave it out, or take the obstacle that has it");
}

/// A shape made in contact/: its own messages, with the key before them.
template <class Make> contact::Profile made(const TableReader& table, const char* key, Make make) {
  try {
    return make();
  } catch (const core::Error& error) {
    table.fail_at(key, error.what());
  }
}

/// profile = [[degrees, m], ...]
contact::Profile read_profile(const TableReader& table) {
  const Value* rows = table.find("profile");
  if (!rows)
    table.fail_table("obstacle = \"profile\" needs profile = [[degrees, m], ...], the polar points of a hole "
                     "round the node");
  std::vector<contact::PolarPoint> points;
  for (const Value& row : to_array(*rows, table.path("profile"), "polar points [degrees, m]")) {
    const auto pair = to_numbers(row, table.path("profile"), 2, {Range::any});
    points.push_back({pair[0] * degree, pair[1]});
  }
  return made(table, "profile", [&] { return contact::Profile(points); });
}

contact::Profile read_broached(const TableReader& table) {
  const double tube = table.number("tube_radius", {Range::above_zero, "m"});
  contact::BroachedHole hole{};
  hole.land_radius = table.number("land_radius", {Range::above_zero, "m"});
  hole.lobe_radius = table.number("lobe_radius", {Range::above_zero, "m"});
  hole.lands = static_cast<int>(table.optional_integer("lands", 2).value_or(3));
  hole.land_angle = table.number("land_angle", {Range::above_zero, "degrees"}) * degree;
  return made(table, "land_radius", [&] { return contact::broached_hole(tube, hole); });
}

contact::Profile read_egg_crate(const TableReader& table) {
  const double tube = table.number("tube_radius", {Range::above_zero, "m"});
  const auto widths = table.optional_numbers("half_widths", 2, {Range::above_zero, "m"});
  if (!widths)
    table.fail_table("obstacle = \"egg_crate\" needs half_widths = [y, z] (m), from the middle to the faces");
  return made(table, "half_widths", [&] { return contact::egg_crate(tube, (*widths)[0], (*widths)[1]); });
}

/// The size of an obstacle of one node.
void read_hole(const TableReader& table, Contact& contact) {
  switch (contact.obstacle) {
  case ObstacleKind::profile:
    refuse_others(table, {"profile"});
    contact.shape = read_profile(table);
    return;
  case ObstacleKind::broached:
    refuse_others(table, {"tube_radius", "land_radius", "lobe_radius", "lands", "land_angle"});
    contact.shape = read_broached(table);
    return;
  case ObstacleKind::egg_crate:
    refuse_others(table, {"tube_radius", "half_widths"});
    contact.shape = read_egg_crate(table);
    return;
  case ObstacleKind::circle:
  case ObstacleKind::plane_y:
  case ObstacleKind::plane_z:
  case ObstacleKind::stop_y:
  case ObstacleKind::stop_z:
  case ObstacleKind::circle_inside:
    refuse_others(table, {"gap"});
    contact.gap = table.number(
        "gap", {Range::at_least_zero, "m", "an overlap is made by origin or offset, with a gap >= 0"});
  }
}

/// One node: gap. Two nodes: distance_1 and distance_2, and side for planes.
void read_sizes(const TableReader& table, Contact& contact) {
  contact.other = table.optional_text("other");
  if (!contact.other) {
    if (contact.obstacle == ObstacleKind::circle_inside)
      table.fail_at("obstacle",
                    "a ring that moves with a second node; name that node in other, or take circle");
    for (const char* key : {"distance_1", "distance_2", "side"})
      if (table.has(key))
        table.fail_at(
            key, "belongs to a contact between two nodes; name the second one in other, or leave it out");
    read_hole(table, contact);
    return;
  }
  if (contact.obstacle == ObstacleKind::profile || contact.obstacle == ObstacleKind::broached ||
      contact.obstacle == ObstacleKind::egg_crate)
    table.fail_at("obstacle",
                  "a hole fixed in space; between two nodes take circle, circle_inside, plane_y or plane_z");
  if (table.has("gap"))
    table.fail_at(
        "gap",
        "between two nodes the gap follows from their places, distance_1 and distance_2; leave it out");
  if (contact.obstacle == ObstacleKind::stop_y || contact.obstacle == ObstacleKind::stop_z)
    table.fail_at("obstacle", "a stop is fixed in space; between two nodes take plane_y or plane_z");
  contact.distance_1 = table.number("distance_1", {Range::at_least_zero, "m"});
  contact.distance_2 = table.number("distance_2", {Range::at_least_zero, "m"});
  if (contact.obstacle == ObstacleKind::circle_inside && contact.distance_2 < contact.distance_1)
    table.fail_at("distance_2", "the ring round the second node is smaller than what moves in it; give a "
                                "radius of at least distance_1");
  if (contact.obstacle == ObstacleKind::circle && !(contact.distance_1 + contact.distance_2 > 0.0))
    table.fail_at("distance_1", "two bodies without size never meet; give a radius > 0 to one");
  contact.side = table.optional_number("side", {Range::any});
  if (contact.side && is_round(contact.obstacle))
    table.fail_at("side", "round bodies meet on any side; leave it out");
  if (contact.side && *contact.side != 1.0 && *contact.side != -1.0)
    table.fail_at("side", "the side of the second node on which the first stays; give 1 or -1");
}

void read_frame(const TableReader& table, Contact& contact) {
  constexpr double parallel = 1e-8; // sine of the angle below which y_loc would be rounding noise
  contact.axis = table.optional_axis("axis");
  contact.y_axis = table.optional_axis("y_axis");
  if (contact.y_axis && table.has("angle"))
    table.fail_at("y_axis", "angle and y_axis both give the local axes; keep one");
  contact.angle = table.number_or("angle", 0.0, {Range::any, "degrees"});
  if (contact.axis && contact.y_axis &&
      contact.axis->stableNormalized().cross(contact.y_axis->stableNormalized()).norm() < parallel)
    table.fail_at("y_axis", "parallel to axis; give a vector across the axis");
  if (!contact.axis && !contact.y_axis && !is_round(contact.obstacle))
    table.fail_table("planes and stops need their direction; give y_axis, or axis (and angle)");
  contact.origin = table.optional_vector("origin", {Range::any, "m"});
  if (const auto offset = table.optional_numbers("offset", 2, {Range::any, "m"}))
    contact.offset = {(*offset)[0], (*offset)[1]};
}

void read_friction(const TableReader& table, Contact& contact) {
  const Value* friction = table.find("friction");
  if (friction && friction->table()) {
    const TableReader two(*friction, table.path("friction"), {{"static", "dynamic"}});
    contact.friction_static = two.number("static", {Range::at_least_zero});
    contact.friction_dynamic = two.number("dynamic", {Range::at_least_zero});
    if (contact.friction_static < contact.friction_dynamic)
      two.fail_at("static", "less than dynamic; static friction is at least the dynamic one");
  } else if (friction) {
    contact.friction_static = contact.friction_dynamic =
        to_number(*friction, table.path("friction"), {Range::at_least_zero});
  }
  contact.tangential_stiffness = table.number_or("tangential_stiffness", 0.0, {Range::at_least_zero, "N/m"});
  if (contact.friction_static > 0.0 && contact.tangential_stiffness == 0.0)
    table.fail_at(
        "friction",
        "friction needs a tangential_stiffness > 0 (N/m), the stiffness of the contact while it sticks");
  if (const Value* damping = table.find("tangential_damping")) {
    if (damping->string())
      (void)to_choice(*damping, table.path("tangential_damping"), {"auto"});
    else
      contact.tangential_damping =
          to_number(*damping, table.path("tangential_damping"), {Range::at_least_zero, "N s/m"});
  }
  contact.memory = table.choice("friction_memory", FrictionMemory::return_map,
                                Choices<FrictionMemory>{{{"return_map", FrictionMemory::return_map},
                                                         {"reference", FrictionMemory::reference}}});
}

/// A contact's name becomes a group of the results file.
std::string read_name(const TableReader& table, const std::string& group) {
  const std::string name = table.optional_text("name").value_or(group);
  if (name.find('/') != std::string::npos || name == ".")
    fail(*table.find(table.has("name") ? "name" : "group"), table.path("name"),
         "the name of a contact must not contain a slash, nor be a dot: results are filed under it; give "
         "another name");
  return name;
}

} // namespace

std::vector<Contact> read_contacts(const TableReader& root) {
  std::vector<Contact> all;
  std::map<std::string, std::string> places;
  for (const Entry& entry : array_entries(root, "contacts")) {
    const TableReader table(*entry.value, entry.path, contact_keys);
    Contact contact;
    contact.group = table.text("group", "the name of a physical point of the mesh, the contact node");
    contact.name = read_name(table, contact.group);
    contact.obstacle = table.choice("obstacle", ObstacleKind::circle, obstacles);
    read_sizes(table, contact);
    read_frame(table, contact);
    contact.normal_stiffness = table.number("normal_stiffness", {Range::above_zero, "N/m"});
    contact.normal_damping = table.number_or("normal_damping", 0.0, {Range::at_least_zero, "N s/m"});
    read_friction(table, contact);
    if (const Value* attached = table.find("attached_to"))
      (void)to_choice(*attached, table.path("attached_to"), {"base"}, {"ground"});
    const auto [at, added] = places.emplace(contact.name, entry.value->where.text());
    if (!added)
      table.fail_table("a second contact called \"" + contact.name + "\" (the first: " + at->second +
                       "); give each contact a name of its own");
    all.push_back(contact);
  }
  return all;
}

} // namespace fretwork::study
