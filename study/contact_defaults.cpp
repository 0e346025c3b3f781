// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "study/document.hpp"
#include <algorithm>

namespace fretwork::study {
namespace {

/// Ways to say the same: a contact that gives one of a set takes no default of the others.
const std::vector<std::vector<std::string>> alternatives{
    {"normal_damping", "normal_dissipation", "restitution", "restitution_mass", "restitution_velocity"},
    {"angle", "y_axis"},
    {"hole_radius", "clearance"},
    {"gap", "distance_1"},
    {"gap", "distance_2"}};

bool gives(const Table& contact, const std::string& key) {
  if (contact.contains(key))
    return true;
  return std::any_of(alternatives.begin(), alternatives.end(), [&](const std::vector<std::string>& set) {
    return std::find(set.begin(), set.end(), key) != set.end() &&
           std::any_of(set.begin(), set.end(), [&](const auto& other) { return contact.contains(other); });
  });
}

} // namespace

void apply_contact_defaults(Value& root) {
  auto& tables = std::get<Table>(root.data);
  const auto found = tables.find("contact_defaults");
  if (found == tables.end())
    return;
  const Table* defaults = found->second.table();
  if (!defaults)
    throw core::Error(found->second.where.text() +
                      ": contact_defaults: a table [contact_defaults] is expected, not " +
                      kind_of(found->second));
  for (const char* own : {"name", "group", "other", "inactive"})
    if (const auto at = defaults->find(own); at != defaults->end())
      throw core::Error(at->second.where.text() + ": contact_defaults." + own +
                        ": belongs to one contact; give it in its [[contacts]]");
  const auto contacts = tables.find("contacts");
  auto* entries = contacts == tables.end() ? nullptr : std::get_if<Array>(&contacts->second.data);
  if (!entries || entries->empty())
    throw core::Error(found->second.where.text() +
                      ": contact_defaults: the study has no [[contacts]] that would take them; "
                      "leave the table out");
  for (Value& entry : *entries) {
    auto* contact = std::get_if<Table>(&entry.data);
    if (!contact)
      continue; // its reader says what is wrong
    const Table given = *contact;
    for (const auto& [key, value] : *defaults)
      if (!gives(given, key))
        contact->emplace(key, value);
  }
  tables.erase(found);
}

} // namespace fretwork::study
