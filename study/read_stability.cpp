// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/names.hpp"
#include "study/readers.hpp"
#include <algorithm>

namespace fretwork::study {
namespace {

flow::Component read_component(const TableReader& table) {
  using Kind = flow::Component::Kind;
  const Value* found = table.find("component");
  if (found && found->array())
    return {Kind::axis, *table.optional_axis("component")};
  return {table.choice("component", Kind::normal,
                       Choices<Kind>{{{"normal", Kind::normal}, {"drag", Kind::drag}, {"lift", Kind::lift}}}),
          Vec3::Zero()};
}

} // namespace

void read_pinned(const TableReader& table, const std::vector<Contact>& contacts, Pinned& pinned,
                 std::vector<std::string>& named) {
  const Value* found = table.find("pinned");
  if (!found)
    return;
  if (!found->array()) {
    pinned = table.choice("pinned", Pinned::contacts,
                          Choices<Pinned>{{{"contacts", Pinned::contacts}, {"none", Pinned::none}}});
    return;
  }
  pinned = Pinned::named;
  std::vector<std::string> names;
  for (const Contact& contact : contacts)
    names.push_back(contact.name);
  const std::string path = table.path("pinned");
  for (const Value& item : to_array(*found, path, "an array of names of contacts")) {
    const std::string name = to_text(item, path);
    if (std::find(names.begin(), names.end(), name) == names.end())
      fail(item, path, "no contact is called so" + core::name_help(name, names));
    named.push_back(name);
  }
}

std::vector<Stability> read_stabilities(const TableReader& root, const Study& study) {
  std::vector<Stability> all;
  for (const Entry& entry : array_entries(root, "stability")) {
    const TableReader table(*entry.value, entry.path,
                            {{"name", "pinned", "component", "sweep", "damping", "strouhal"}});
    if (study.flows.empty())
      table.fail_table("there is no [[flow]] to be stable in; add it, or leave [[stability]] out");
    Stability out;
    out.name = table.optional_text("name").value_or("assessment " + std::to_string(all.size() + 1));
    read_pinned(table, study.contacts, out.pinned, out.contacts);
    out.component = read_component(table);
    if (const Value* sweep = table.find("sweep"))
      out.sweep = to_numbers(*sweep, table.path("sweep"), 0, {Range::at_least_zero});
    out.damping = table.optional_number("damping", {Range::above_zero});
    if (out.damping && *out.damping >= 1.0)
      table.fail_at("damping", "a ratio to critical below 1 is expected; 0.01 is 1 %");
    out.strouhal = table.optional_number("strouhal", {Range::above_zero});
    for (const Stability& before : all)
      if (before.name == out.name)
        table.fail_table("a second assessment called \"" + out.name + "\"; give each a name of its own");
    all.push_back(std::move(out));
  }
  return all;
}

} // namespace fretwork::study
