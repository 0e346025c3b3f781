// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/names.hpp"
#include "fem/section.hpp"
#include "study/readers.hpp"
#include <cmath>
#include <numbers>

namespace fretwork::study {
namespace {

constexpr Range any = Range::any;
constexpr Range at_least_zero = Range::at_least_zero;
constexpr Range above_zero = Range::above_zero;

/// The section of one shape, from the keys of that shape.
struct Shape {
  std::vector<std::string> keys;
  fem::Section (*read)(const TableReader&);
};

double length(const TableReader& table, const char* key) { return table.number(key, {above_zero, "m"}); }

Pipe pipe_of(const TableReader& table) {
  const Pipe pipe{length(table, "outer_diameter"), length(table, "thickness")};
  if (2.0 * pipe.thickness > pipe.outer_diameter)
    table.fail_at(
        "thickness",
        "more than half of outer_diameter; give a wall that fits, or shape = \"circle\" for a solid bar");
  return pipe;
}

fem::Section read_pipe(const TableReader& table) {
  const Pipe pipe = pipe_of(table);
  return fem::pipe_section(pipe.outer_diameter, pipe.thickness);
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
  const TableReader table(*entry.value, entry.path, keys);
  (void)table.required("shape", "one of " + core::list_names(names));
  return shape->read(table);
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

const std::vector<std::string> dof_names{"ux", "uy", "uz", "rx", "ry", "rz"};

/// Bit d set = dof d named in an array.
std::uint8_t read_dofs(const Value& names, const std::string& path, const std::string& expected) {
  std::uint8_t bits = 0;
  for (const Value& dof : to_array(names, path, expected))
    bits = static_cast<std::uint8_t>(bits | 1u << to_choice(dof, path, dof_names));
  return bits;
}

/// kg/m, from the keys of the fluid; 0 without them.
double read_fluid(const TableReader& table, const std::string& section, const Study& study) {
  if (!table.has("fluid_inside") && !table.has("fluid_outside"))
    return 0.0;
  const auto outline = study.outlines.find(section);
  if (outline == study.outlines.end())
    table.fail_at(
        table.has("fluid_inside") ? "fluid_inside" : "fluid_outside",
        "the section \"" + section +
            "\" is neither a pipe nor a circle, which the mass of the fluid follows from; give added_mass "
            "(kg/m)");
  fem::Fluid fluid;
  fluid.inside = table.number_or("fluid_inside", 0.0, {at_least_zero, "kg/m3"});
  if (fluid.inside > 0.0 && outline->second.bore == 0.0)
    table.fail_at("fluid_inside", "the section \"" + section + "\" has no bore; leave it out");
  if (const Value* outside = table.find("fluid_outside")) {
    const TableReader reader(*outside, table.path("fluid_outside"), {{"density", "confinement"}});
    fluid.outside = reader.number("density", {at_least_zero, "kg/m3"});
    fluid.confinement = reader.number_or("confinement", 1.0, {at_least_zero});
  }
  return fem::fluid_mass(fluid, outline->second.bore, outline->second.displaced);
}

/// Whether the two bending planes differ, so that the beam needs to know its axes.
bool needs_orientation(const fem::Section& section) {
  constexpr double equal_inertia =
      1e-9; // relative: rounding of computed inertias, far below what a user means by different
  return std::abs(section.iy - section.iz) > equal_inertia * std::max(section.iy, section.iz);
}

} // namespace

mesh::Source read_mesh(const TableReader& root, const std::filesystem::path& folder) {
  const TableReader table(root.required("mesh", "a table [mesh] with the key file"), "mesh",
                          {{"file", "element_size", "order", "scale", "merge_tolerance"}});
  mesh::Source source;
  source.file = (folder / table.text("file", "the path of a mesh or a geometry")).lexically_normal();
  source.element_size = table.optional_number("element_size", {above_zero, "m"});
  if (const auto order = table.optional_integer("order", 1)) {
    if (*order > 2)
      table.fail_at("order", "1 (straight elements) or 2 (arcs) is expected");
    source.order = static_cast<int>(*order);
  }
  source.scale = table.number_or("scale", 1.0, {above_zero});
  source.merge_tolerance = table.number_or("merge_tolerance", 0.0, {at_least_zero, "m"});
  return source;
}

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

std::map<std::string, Pipe> read_pipes(const TableReader& root) {
  std::map<std::string, Pipe> pipes;
  for (const Entry& entry : table_entries(root, "sections")) {
    if (*entry.value->table()->at("shape").string() == "pipe")
      pipes.emplace(entry.name, pipe_of(TableReader(*entry.value, entry.path,
                                                    {{"shape", "outer_diameter", "thickness"}})));
  }
  return pipes;
}

std::map<std::string, Outline> read_outlines(const TableReader& root,
                                             const std::map<std::string, fem::Section>& sections) {
  std::map<std::string, Outline> outlines;
  for (const auto& [name, pipe] : read_pipes(root)) {
    const double inner = pipe.outer_diameter - 2.0 * pipe.thickness;
    outlines[name] = {std::numbers::pi / 4.0 * inner * inner,
                      std::numbers::pi / 4.0 * pipe.outer_diameter * pipe.outer_diameter};
  }
  for (const Entry& entry : table_entries(root, "sections"))
    if (*entry.value->table()->at("shape").string() == "circle")
      outlines[entry.name] = {0.0, sections.at(entry.name).area};
  return outlines;
}

std::vector<Beams> read_beams(const TableReader& root, const Study& study) {
  std::vector<Beams> all;
  for (const Entry& entry : array_entries(root, "beams")) {
    const TableReader table(*entry.value, entry.path,
                            {{"group", "material", "section", "orientation", "added_mass",
                              "added_mass_direction", "fluid_inside", "fluid_outside"}});
    Beams beams;
    beams.group = table.text("group", "the name of a physical curve of the mesh");
    beams.material = table.text("material", "the name of a [materials.name]");
    check_named(table, "material", beams.material, study.materials);
    beams.section = table.text("section", "the name of a [sections.name]");
    check_named(table, "section", beams.section, study.sections);
    beams.orientation = table.optional_axis("orientation");
    if (!beams.orientation && needs_orientation(study.sections.at(beams.section)))
      (void)table.required("orientation", "a vector [x, y, z] in the local x-y plane: the section \"" +
                                              beams.section + "\" has different iy and iz");
    beams.added_mass =
        table.number_or("added_mass", 0.0, {at_least_zero, "kg/m"}) + read_fluid(table, beams.section, study);
    beams.added_mass_direction = table.choice(
        "added_mass_direction", fem::AddedMass::transverse,
        Choices<fem::AddedMass>{{{"transverse", fem::AddedMass::transverse}, {"all", fem::AddedMass::all}}});
    all.push_back(beams);
  }
  return all;
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
