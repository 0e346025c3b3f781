// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/contact_readers.hpp"
#include "study/readers.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>

namespace fretwork::study {
namespace {

constexpr std::int64_t most_along = 1000; ///< along a thickness: each is a contact of its own

Keys contact_keys() {
  Keys keys{{"name", "group", "axis", "y_axis", "angle", "origin", "offset", "thickness", "thickness_points",
             "attached_to", "active", "inactive", "series"}};
  for (const auto* more : {&obstacle_keys, &normal_law_keys, &friction_keys})
    keys.known.insert(keys.known.end(), more->begin(), more->end());
  return keys;
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
    table.fail_table("obstacle \"" + name_of(contact.obstacle) +
                     "\" needs its direction; give y_axis, or axis (and angle)");
  contact.origin = table.optional_vector("origin", {Range::any, "m"});
  if (const auto offset = table.optional_numbers("offset", 2, {Range::any, "m"})) {
    contact.offset[0] += (*offset)[0]; // bars at unequal distances have made one of their own
    contact.offset[1] += (*offset)[1];
  }
}

void read_thickness(const TableReader& table, Contact& contact) {
  if (!table.has("thickness")) {
    if (table.has("thickness_points"))
      table.fail_at("thickness_points", "belongs to a support with a thickness; give thickness (m), or leave "
                                        "it out");
    return;
  }
  contact.thickness = table.number("thickness", {Range::above_zero, "m"});
  if (contact.other)
    table.fail_at("thickness", "belongs to a support fixed in space; between two nodes make one contact for "
                               "each pair of nodes that meet");
  const auto points = table.optional_integer("thickness_points", 2).value_or(2);
  if (points > most_along)
    table.fail_at("thickness_points",
                  "each point is a contact of its own; give at most " + std::to_string(most_along));
  contact.points = static_cast<int>(points);
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

/// What the obstacle moves with: the base, nothing, or a support that moves by itself.
void read_carrier(const TableReader& table, const TableReader& root, Contact& contact) {
  Choices<std::string> choices{{{"base", "base"}, {"ground", "ground"}}};
  for (const Entry& motion : array_entries(root, "support_motion"))
    if (const auto group = motion.value->table()->find("group");
        group != motion.value->table()->end() && group->second.string())
      choices.available.emplace_back(*group->second.string(), *group->second.string());
  const std::string carrier = table.choice<std::string>("attached_to", "base", choices);
  contact.grounded = carrier == "ground";
  if (carrier != "base" && carrier != "ground")
    contact.carrier = carrier;
}

/// What of the contact does nothing: all of it, or the supports that it names.
void read_active(const TableReader& table, Contact& contact) {
  contact.active = table.optional_flag("active").value_or(true);
  const Value* found = table.find("inactive");
  if (!found)
    return;
  const std::string path = table.path("inactive"), first = contact.name + "[0]";
  if (!contact.active)
    table.fail_at("inactive", "with active = false no support of this contact is; keep one of the keys");
  for (const Value& item : to_array(*found, path, "an array of names as of the results, \"" + first + "\"")) {
    const std::string name = to_text(item, path);
    if (name == contact.name || !names_contact(name, contact.name))
      fail(item, path,
           "no support of this contact; they are called \"" + first +
               "\" ... in the order of its group; active = false is for all");
    contact.inactive.push_back(name);
  }
}

} // namespace

bool names_contact(std::string_view name, const std::string& contact) {
  if (!name.starts_with(contact))
    return false;
  name.remove_prefix(contact.size());
  return name.empty() || (name.size() > 2 && name.front() == '[' && name.back() == ']' &&
                          std::all_of(name.begin() + 1, name.end() - 1,
                                      [](unsigned char c) { return std::isdigit(c) != 0; }));
}

std::vector<Contact> read_contacts(const TableReader& root) {
  std::vector<Contact> all;
  std::map<std::string, std::string> places;
  for (const Entry& entry : array_entries(root, "contacts")) {
    const TableReader table(*entry.value, entry.path, contact_keys());
    Contact contact;
    contact.group = table.text("group", "the name of a physical point of the mesh, the contact node");
    contact.name = read_name(table, contact.group);
    read_obstacle(table, contact);
    read_frame(table, contact);
    read_thickness(table, contact);
    read_normal_law(table, contact);
    read_friction(table, contact);
    read_carrier(table, root, contact);
    read_active(table, contact);
    contact.series = table.optional_flag("series").value_or(true);
    if (table.has("attached_to") && contact.other && (contact.grounded || contact.carrier))
      table.fail_at("attached_to", "an obstacle between two nodes moves with them; leave attached_to out");
    const auto [at, added] = places.emplace(contact.name, entry.value->where.text());
    if (!added)
      table.fail_table("a second contact called \"" + contact.name + "\" (the first: " + at->second +
                       "); give each contact a name of its own");
    all.push_back(contact);
  }
  return all;
}

} // namespace fretwork::study
