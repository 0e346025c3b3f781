// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/names.hpp"
#include "study/readers.hpp"
#include <algorithm>

namespace fretwork::study {
namespace {

using enum Range;

const std::vector<std::string> dof_names{"ux", "uy", "uz", "rx", "ry", "rz"};

/// Bit d set = dof d named in an array.
std::uint8_t read_dofs(const Value& names, const std::string& path, const std::string& expected) {
  std::uint8_t bits = 0;
  for (const Value& dof : to_array(names, path, expected))
    bits = static_cast<std::uint8_t>(bits | 1u << to_choice(dof, path, dof_names));
  return bits;
}

} // namespace

mesh::Source read_mesh(const TableReader& root, const std::filesystem::path& folder) {
  const TableReader table(root.required("mesh", "a table [mesh] with the key file"), "mesh",
                          {{"file", "element_size", "order", "scale", "merge_tolerance", "trusted"}});
  mesh::Source source;
  source.file = (folder / table.text("file", "the path of a mesh or a geometry")).lexically_normal();
  source.element_size = table.optional_number("element_size", {above_zero, "m"});
  if (const auto order = table.optional_integer("order", 1)) {
    if (*order > 2)
      table.fail_at("order", "1 (straight elements) or 2 (arcs) is expected");
    source.order = static_cast<int>(*order);
  }
  source.scale = table.number_or("scale", 1.0, {above_zero});
  source.trusted = table.optional_flag("trusted").value_or(false);
  source.merge_tolerance = table.number_or("merge_tolerance", 0.0, {at_least_zero, "m"});
  return source;
}

std::vector<Restraint> read_restraints(const TableReader& root) {
  const std::string expected = "\"all\" or an array of \"ux\", \"uy\", \"uz\", \"rx\", \"ry\", \"rz\"";
  constexpr std::uint8_t all_dofs = 0b111111;
  std::vector<Restraint> all;
  for (const Entry& entry : array_entries(root, "restraints")) {
    const TableReader table(*entry.value, entry.path, {{"group", "fixed"}});
    Restraint restraint{table.text("group", "the name of a physical point or curve of the mesh"), 0};
    const Value& fixed = table.required("fixed", expected);
    if (fixed.string()) {
      if (core::nearest_name(*fixed.string(), {"all"}).empty()) // a component without brackets
        fail(fixed, table.path("fixed"), expected + " is expected");
      (void)to_choice(fixed, table.path("fixed"), {"all"});
      restraint.fixed = all_dofs;
    } else {
      restraint.fixed = read_dofs(fixed, table.path("fixed"), expected);
    }
    all.push_back(restraint);
  }
  return all;
}

std::vector<Mass> read_masses(const TableReader& root) {
  std::vector<Mass> all;
  for (const Entry& entry : array_entries(root, "masses")) {
    const TableReader table(*entry.value, entry.path, {{"group", "mass", "inertia", "arm"}});
    all.push_back({table.text("group", "the name of a physical point or curve of the mesh"),
                   table.number("mass", {at_least_zero, "kg"}),
                   table.optional_vector("inertia", {at_least_zero, "kg m2"}).value_or(Vec3::Zero()),
                   table.optional_vector("arm", {any, "m"}).value_or(Vec3::Zero())});
  }
  return all;
}

std::vector<Spring> read_springs(const TableReader& root) {
  std::vector<Spring> all;
  for (const Entry& entry : array_entries(root, "springs")) {
    const TableReader table(*entry.value, entry.path, {{"group", "other", "stiffness", "damping"}});
    Spring spring;
    spring.group = table.text("group", "the name of a physical point or curve of the mesh");
    spring.other = table.optional_text("other");
    if (spring.other == spring.group)
      table.fail_at("other",
                    "the group itself: a spring needs two nodes; leave other out for a spring to the ground");
    if (!table.has("stiffness") && !table.has("damping"))
      table.fail_table(
          "neither stiffness nor damping; give 6 numbers [ux, uy, uz, rx, ry, rz] of one of them");
    if (const auto values = table.optional_numbers("stiffness", 6, {at_least_zero, "N/m, N m/rad"}))
      std::copy(values->begin(), values->end(), spring.stiffness.begin());
    if (const auto values = table.optional_numbers("damping", 6, {at_least_zero, "N s/m, N m s/rad"}))
      std::copy(values->begin(), values->end(), spring.damping.begin());
    all.push_back(spring);
  }
  return all;
}

std::vector<Tie> read_ties(const TableReader& root) {
  const std::string expected = R"(an array of "ux", "uy", "uz", "rx", "ry", "rz")";
  std::vector<Tie> all;
  for (const Entry& entry : array_entries(root, "ties")) {
    const TableReader table(*entry.value, entry.path, {{"group", "other", "tied"}});
    Tie tie{table.text("group", "the name of a physical point or curve of the mesh"),
            table.text("other", "the group whose nodes move with those of group"), 0};
    if (tie.other == tie.group)
      table.fail_at("other", "the group itself: a tie needs two nodes; name the group of the other one");
    tie.tied = read_dofs(table.required("tied", expected), table.path("tied"), expected);
    all.push_back(tie);
  }
  return all;
}

} // namespace fretwork::study
