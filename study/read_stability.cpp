// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/names.hpp"
#include "study/contact_readers.hpp"
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
    if (std::none_of(names.begin(), names.end(),
                     [&](const std::string& contact) { return names_contact(name, contact); }))
      fail(item, path, "no contact is called so" + core::name_help(name, names));
    named.push_back(name);
  }
}

namespace {

/// What the stability diagrams of flows with a law cover.
void read_diagram(const TableReader& table, const Study& study, Stability& out) {
  constexpr std::int64_t most_points = 10000, most_modes = 1000;
  const bool law = std::any_of(study.flows.begin(), study.flows.end(),
                               [](const Flow& flow) { return flow.law.has_value(); });
  for (const char* key : {"factors", "points", "modes"})
    if (table.has(key) && !law)
      table.fail_at(key,
                    "it is of the stability diagram of a [[flow]] with a law, and none has one; give law, or "
                    "leave it out");
  if (const auto factors = table.optional_numbers("factors", 2, {Range::at_least_zero})) {
    if ((*factors)[1] <= (*factors)[0])
      table.fail_at("factors", "[first, last] factor of all velocities is expected, in this order");
    out.factors = {(*factors)[0], (*factors)[1]};
  }
  const auto count = [&](const char* key, std::int64_t least, std::int64_t most, int& to) {
    const auto given = table.optional_integer(key, least);
    if (given && *given > most)
      table.fail_at(key, "at most " + std::to_string(most) + " are taken");
    if (given)
      to = static_cast<int>(*given);
  };
  count("points", 2, most_points, out.points);
  count("modes", 1, most_modes, out.modes);
}

} // namespace

std::vector<Stability> read_stabilities(const TableReader& root, const Study& study) {
  std::vector<Stability> all;
  for (const Entry& entry : array_entries(root, "stability")) {
    const TableReader table(*entry.value, entry.path,
                            {{"name", "pinned", "elastic", "sticking", "component", "sweep", "damping",
                              "strouhal", "factors", "points", "modes"}});
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
    out.elastic = table.optional_flag("elastic").value_or(false);
    out.sticking = table.optional_flag("sticking").value_or(false);
    read_diagram(table, study, out);
    out.strouhal = table.optional_number("strouhal", {Range::above_zero});
    for (const Stability& before : all)
      if (before.name == out.name)
        table.fail_table("a second assessment called \"" + out.name + "\"; give each a name of its own");
    all.push_back(std::move(out));
  }
  return all;
}

} // namespace fretwork::study
