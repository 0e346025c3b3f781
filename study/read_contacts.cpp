// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/readers.hpp"
#include <Eigen/Geometry>

namespace fretwork::study {
namespace {

const Keys contact_keys{{"name", "group", "obstacle", "gap", "axis", "y_axis", "angle", "origin", "offset",
                         "normal_stiffness", "normal_damping", "tangential_stiffness", "tangential_damping",
                         "friction", "friction_memory", "attached_to"},
                        {"other", "distance_1", "distance_2", "profile", "side"}};

const Choices<ObstacleKind> obstacles{{{"circle", ObstacleKind::circle},
                                       {"plane_y", ObstacleKind::plane_y},
                                       {"plane_z", ObstacleKind::plane_z},
                                       {"stop_y", ObstacleKind::stop_y},
                                       {"stop_z", ObstacleKind::stop_z}},
                                      {"profile", "circle_inside"}};

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
  if (!contact.axis && !contact.y_axis && contact.obstacle != ObstacleKind::circle)
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
    contact.gap = table.number(
        "gap", {Range::at_least_zero, "m", "an overlap is made by origin or offset, with a gap >= 0"});
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
