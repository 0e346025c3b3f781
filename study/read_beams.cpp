// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/names.hpp"
#include "fem/section.hpp"
#include "study/readers.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace fretwork::study {
namespace {

using enum Range;

/// The section of one shape, from the keys of that shape.
struct Shape {
  std::vector<std::string> keys;
  fem::Section (*read)(const TableReader&);
};

double length(const TableReader& table, const char* key) { return table.number(key, {above_zero, "m"}); }

fem::Section read_pipe(const TableReader& table) {
  const double outer_diameter = length(table, "outer_diameter"), thickness = length(table, "thickness");
  if (2.0 * thickness > outer_diameter)
    table.fail_at(
        "thickness",
        "more than half of outer_diameter; give a wall that fits, or shape = \"circle\" for a solid bar");
  return fem::pipe_section(outer_diameter, thickness);
}

fem::Section read_circle(const TableReader& table) { return fem::circle_section(length(table, "diameter")); }

fem::Section read_rectangle(const TableReader& table) {
  return fem::rectangle_section(length(table, "height_y"), length(table, "height_z"));
}

fem::Section read_general(const TableReader& table) {
  const double iy = table.number("iy", {above_zero, "m4"});
  const double iz = table.number("iz", {above_zero, "m4"});
  return {table.number("area", {above_zero, "m2"}), iy, iz,
          table.number("torsion_constant", {above_zero, "m4"}),
          table.number_or("polar_inertia", iy + iz, {at_least_zero, "m4"})};
}

const Choices<Shape> shapes{
    {{"pipe", {{"outer_diameter", "thickness"}, read_pipe}},
     {"circle", {{"diameter"}, read_circle}},
     {"rectangle", {{"height_y", "height_z"}, read_rectangle}},
     {"general", {{"area", "iy", "iz", "torsion_constant", "polar_inertia"}, read_general}}}};

fem::Shear read_shear(const TableReader& table, const fem::Section& section) {
  const auto y = table.optional_number("shear_coefficient_y", {above_zero}),
             z = table.optional_number("shear_coefficient_z", {above_zero});
  const bool shears = table.optional_flag("shear").value_or(y || z);
  if (!shears && (y || z))
    table.fail_at(y ? "shear_coefficient_y" : "shear_coefficient_z",
                  "of no effect with shear = false; leave one of them out");
  if (y.has_value() != z.has_value())
    table.fail_at(y ? "shear_coefficient_y" : "shear_coefficient_z",
                  "one coefficient only; give both shear_coefficient_y and shear_coefficient_z");
  if (y)
    return fem::ShearCoefficients{*y, *z};
  if (!shears)
    return {};
  if (std::holds_alternative<std::monostate>(section.shape))
    table.fail_at("shear", "there is no formula for this shape; give shear_coefficient_y and "
                           "shear_coefficient_z");
  return fem::ShapeShear{};
}

/// Only the keys of the section's shape are known; those of all shapes where it has none, to tell a misspelt
/// `shape`.
fem::Section read_section(const Entry& entry) {
  std::vector<std::string> names;
  for (const auto& choice : shapes.available)
    names.push_back(choice.first);
  const auto& values = *entry.value->table();
  const auto given = values.find("shape");
  const Shape* shape = nullptr;
  if (given != values.end())
    shape = &shapes.available[to_choice(given->second, entry.path + ".shape", names)].second;
  Keys keys{{"shape"}};
  for (const auto& choice : shapes.available)
    if (!shape || shape == &choice.second)
      keys.known.insert(keys.known.end(), choice.second.keys.begin(), choice.second.keys.end());
  keys.known.insert(keys.known.end(),
                    {"shear", "shear_coefficient_y", "shear_coefficient_z", "rotary_inertia"});
  const TableReader table(*entry.value, entry.path, keys);
  (void)table.required("shape", "one of " + core::list_names(names));
  fem::Section section = shape->read(table);
  section.shear = read_shear(table, section);
  section.rotary_inertia = table.optional_flag("rotary_inertia").value_or(false);
  return section;
}

template <class T>
void check_named(const TableReader& table, const std::string& key, const std::string& name,
                 const std::map<std::string, T>& map) {
  if (map.contains(name))
    return;
  std::vector<std::string> names;
  for (const auto& entry : map)
    names.push_back(entry.first);
  table.fail_at(key, "there is no [" + key + "s." + toml_key(name) + "]" + core::name_help(name, names));
}

/// Whether the two bending planes differ, so that the beam needs to know its axes.
bool needs_orientation(const fem::Section& section) {
  constexpr double equal_inertia =
      1e-9; // relative: rounding of computed inertias, far below what a user means by different
  return std::abs(section.iy - section.iz) > equal_inertia * std::max(section.iy, section.iz);
}

/// A value at each end of the group.
template <class T> using Ends = std::array<T, 2>;

/// The key that says where the group begins: only with it may values be pairs.
const char* const near_end = "from";

void need_near_end(const TableReader& entry, const TableReader& table, const char* key) {
  if (!entry.has(near_end))
    table.fail_at(key, std::string("two values need ") + near_end +
                           ", the physical point at the end of the group where the first holds");
}

/// One value for all of the group, or a pair. @param entry  the table of the beams, which `table` is or is in
Ends<double> ends_or(const TableReader& entry, const TableReader& table, const char* key, double otherwise,
                     const Quantity& quantity) {
  const Value* value = table.find(key);
  if (!value)
    return {otherwise, otherwise};
  if (!value->array()) {
    const double number = to_number(*value, table.path(key), quantity);
    return {number, number};
  }
  need_near_end(entry, table, key);
  const std::vector<double> pair = to_numbers(*value, table.path(key), 2, quantity);
  return {pair[0], pair[1]};
}

Ends<std::string> read_section_names(const TableReader& table, const Study& study) {
  const std::string expected = "the name of a [sections.name], or two of them";
  const Value& value = table.required("section", expected);
  Ends<std::string> names;
  if (value.array()) {
    need_near_end(table, table, "section");
    if (value.array()->size() != 2)
      table.fail_at("section", expected + ", is expected");
    for (std::size_t i = 0; i < 2; ++i)
      names[i] = to_text((*value.array())[i], table.path("section"));
  } else {
    names.fill(to_text(value, table.path("section")));
  }
  for (const std::string& name : names)
    check_named(table, "section", name, study.sections);
  if (!fem::same_kind(study.sections.at(names[0]), study.sections.at(names[1])))
    table.fail_at("section",
                  "the two differ in shape, in shear or in rotary_inertia; a section changes its sizes "
                  "only: make them alike");
  return names;
}

/// Mass of the fluid needs a round section, the inner one a bore.
void check_fluid(const TableReader& table, const Ends<fem::Fluid>& fluid, const Ends<std::string>& names,
                 const Study& study) {
  for (std::size_t i = 0; i < 2; ++i) {
    const auto outline = fem::outline_of(study.sections.at(names[i]));
    if (!outline)
      table.fail_at(
          table.has("fluid_inside") ? "fluid_inside" : "fluid_outside",
          "the section \"" + names[i] +
              "\" is neither a pipe nor a circle, which the mass of the fluid follows from; give added_mass "
              "(kg/m)");
    if (fluid[i].inside > 0.0 && outline->bore == 0.0)
      table.fail_at("fluid_inside", "the section \"" + names[i] + "\" has no bore; leave it out");
  }
}

Ends<fem::Fluid> read_fluid(const TableReader& table, const Ends<std::string>& names, const Study& study) {
  Ends<fem::Fluid> fluid{};
  if (!table.has("fluid_inside") && !table.has("fluid_outside"))
    return fluid;
  const Ends<double> inside = ends_or(table, table, "fluid_inside", 0.0, {at_least_zero, "kg/m3"});
  Ends<double> outside{}, confinement{1.0, 1.0};
  if (const Value* given = table.find("fluid_outside")) {
    const TableReader reader(*given, table.path("fluid_outside"), {{"density", "confinement"}});
    (void)reader.required("density", "a number >= 0 in kg/m3, or two");
    outside = ends_or(table, reader, "density", 0.0, {at_least_zero, "kg/m3"});
    confinement = ends_or(table, reader, "confinement", 1.0, {at_least_zero});
  }
  for (std::size_t i = 0; i < 2; ++i)
    fluid[i] = {inside[i], outside[i], confinement[i]};
  check_fluid(table, fluid, names, study);
  return fluid;
}

/// What the entry is made of at both ends of its group, and where they are.
void read_ends(const TableReader& table, const Study& study, Beams& beams) {
  const Ends<std::string> sections = read_section_names(table, study);
  beams.orientation = table.optional_axis("orientation");
  for (const std::string& name : sections)
    if (!beams.orientation && needs_orientation(study.sections.at(name)))
      (void)table.required("orientation", "a vector [x, y, z] in the local x-y plane: the section \"" + name +
                                              "\" has different iy and iz");
  const Ends<double> added = ends_or(table, table, "added_mass", 0.0, {at_least_zero, "kg/m"});
  const Ends<fem::Fluid> fluid = read_fluid(table, sections, study);
  const Ends<double> force = ends_or(table, table, "axial_force", 0.0, {any, "N"});
  beams.section = sections[0];
  beams.added_mass = added[0];
  beams.fluid = fluid[0];
  beams.axial_force = force[0];
  const bool changes =
      sections[0] != sections[1] || added[0] != added[1] || fluid[0] != fluid[1] || force[0] != force[1];
  if (table.has(near_end) && !changes)
    table.fail_at(near_end, "nothing changes along the group: give two values [a, b] of section, added_mass, "
                            "axial_force or a fluid, or leave it out");
  if (table.has(near_end))
    beams.taper = Taper{table.text(near_end, "the name of a physical point"), sections[1], added[1], fluid[1],
                        force[1]};
}

} // namespace

std::map<std::string, fem::Material> read_materials(const TableReader& root) {
  std::map<std::string, fem::Material> materials;
  for (const Entry& entry : table_entries(root, "materials")) {
    const TableReader table(*entry.value, entry.path, {{"young_modulus", "poisson_ratio", "density"}});
    const fem::Material material{table.number("young_modulus", {above_zero, "Pa"}),
                                 table.number("poisson_ratio", {}),
                                 table.number("density", {at_least_zero, "kg/m3"})};
    if (material.poisson_ratio <= -1.0 || material.poisson_ratio >= 0.5)
      table.fail_at("poisson_ratio", "a number between -1 and 0.5 is expected, both excluded");
    materials.emplace(entry.name, material);
  }
  return materials;
}

std::map<std::string, fem::Section> read_sections(const TableReader& root) {
  std::map<std::string, fem::Section> sections;
  for (const Entry& entry : table_entries(root, "sections"))
    sections.emplace(entry.name, read_section(entry));
  return sections;
}

std::vector<Beams> read_beams(const TableReader& root, const Study& study) {
  std::vector<Beams> all;
  for (const Entry& entry : array_entries(root, "beams")) {
    const TableReader table(
        *entry.value, entry.path,
        {{"group", "material", "section", "orientation", "added_mass", "added_mass_direction", "fluid_inside",
          "fluid_outside", "axial_force", "from"}});
    Beams beams;
    beams.group = table.text("group", "the name of a physical curve of the mesh");
    beams.material = table.text("material", "the name of a [materials.name]");
    check_named(table, "material", beams.material, study.materials);
    read_ends(table, study, beams);
    beams.added_mass_direction = table.choice(
        "added_mass_direction", fem::AddedMass::transverse,
        Choices<fem::AddedMass>{{{"transverse", fem::AddedMass::transverse}, {"all", fem::AddedMass::all}}});
    all.push_back(beams);
  }
  return all;
}

} // namespace fretwork::study
