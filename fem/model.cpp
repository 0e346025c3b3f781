// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/model.hpp"
#include "core/error.hpp"
#include "fem/beam_constants.hpp"
#include "fem/beam_element.hpp"
#include "fem/disjoint_sets.hpp"
#include "fem/gauss.hpp"
#include "fem/lumped.hpp"
#include "fem/ties.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::fem {
namespace {

constexpr std::array<const char*, dofs_per_node> dof_names{"ux", "uy", "uz", "rx", "ry", "rz"};

const BeamProperty& property_of(const Model& model, const Beam& beam) {
  return model.properties[static_cast<std::size_t>(beam.property)];
}

void require(bool fine, const std::string& object, const char* name, double value, const char* cure) {
  if (!fine || !std::isfinite(value))
    throw core::Error(fmt::format("{}: {} = {:g} makes no sense; give {}", object, name, value, cure));
}

void check_section(const Section& s, double poisson_ratio, const std::string& what) {
  require(s.area > 0.0, what, "area", s.area, "a value > 0 (m2)");
  require(s.iy > 0.0, what, "iy", s.iy, "a value > 0 (m4)");
  require(s.iz > 0.0, what, "iz", s.iz, "a value > 0 (m4)");
  require(s.torsion_constant > 0.0, what, "torsion_constant", s.torsion_constant, "a value > 0 (m4)");
  require(s.polar_inertia >= 0.0, what, "polar_inertia", s.polar_inertia, "a value >= 0 (m4)");
  if (const auto k = shear_coefficients(s, poisson_ratio)) {
    require(k->y > 0.0, what, "shear_coefficient_y", k->y, "a value > 0");
    require(k->z > 0.0, what, "shear_coefficient_z", k->z, "a value > 0");
  } else if (!std::holds_alternative<std::monostate>(s.shear)) {
    throw core::Error(what + ": there is no formula for the shear of a section without a shape; give "
                             "shear_coefficient_y and shear_coefficient_z");
  }
}

void check_added(double added_mass, const Fluid& fluid, const Section& section, const std::string& what) {
  require(added_mass >= 0.0, what, "added_mass", added_mass, "a value >= 0 (kg/m)");
  require(fluid.inside >= 0.0, what, "fluid_inside", fluid.inside, "a value >= 0 (kg/m3)");
  require(fluid.outside >= 0.0, what, "fluid_outside density", fluid.outside, "a value >= 0 (kg/m3)");
  require(fluid.confinement >= 0.0, what, "fluid_outside confinement", fluid.confinement, "a value >= 0");
  if ((fluid.inside > 0.0 || fluid.outside > 0.0) && !outline_of(section))
    throw core::Error(what +
                      ": its section is neither a pipe nor a circle, which the mass of the fluid follows "
                      "from; give added_mass (kg/m)");
}

void check_properties(const Model& model) {
  for (std::size_t i = 0; i < model.properties.size(); ++i) {
    const BeamProperty& p = model.properties[i];
    const std::string what = fmt::format("beam property {}", i);
    require(p.material.young_modulus > 0.0, what, "young_modulus", p.material.young_modulus,
            "a value > 0 (Pa)");
    require(p.material.poisson_ratio > -1.0 && p.material.poisson_ratio < 0.5, what, "poisson_ratio",
            p.material.poisson_ratio, "a value between -1 and 0.5");
    require(p.material.density >= 0.0, what, "density", p.material.density, "a value >= 0 (kg/m3)");
    require(true, what, "axial_force", p.axial_force, "a finite value (N)");
    check_section(p.section, p.material.poisson_ratio, what);
    check_added(p.added_mass, p.fluid, p.section, what);
    if (!p.taper)
      continue;
    require(true, what, "axial_force at the far end", p.taper->axial_force.value_or(0.0),
            "a finite value (N)");
    check_section(p.taper->section, p.material.poisson_ratio, what);
    check_added(p.taper->added_mass, p.taper->fluid, p.taper->section, what);
    if (!same_kind(p.section, p.taper->section))
      throw core::Error(what + ": its two sections differ in shape, in shear or in rotary_inertia; a taper "
                               "changes sizes only");
  }
}

void check_lumped(const Model& model) {
  for (const LumpedMass& m : model.masses) {
    const std::string what = "mass at " + place(model.node(m.node));
    require(m.mass >= 0.0, what, "mass", m.mass, "a value >= 0 (kg)");
    for (const double j : m.inertia)
      require(j >= 0.0, what, "inertia", j, "values >= 0 (kg m2)");
  }
  for (const Spring& s : model.springs) {
    const std::string what = "spring at " + place(model.node(s.node));
    for (const double k : s.stiffness)
      require(k >= 0.0, what, "stiffness", k, "values >= 0 (N/m, N m/rad)");
    for (const double c : s.damping)
      require(c >= 0.0, what, "damping", c, "values >= 0 (N s/m, N m s/rad)");
  }
}

/// What is restrained needs no tie: it connects nothing.
bool ties_free_dofs(const Model& model, const Tie& tie) {
  return (tie.dofs & ~model.fixed[static_cast<std::size_t>(tie.node)]) != 0;
}

void check_ties(const Model& model, const std::vector<Index>& first) {
  for (Index node = 0; node < static_cast<Index>(model.nodes.size()); ++node)
    for (int d = 0; d < dofs_per_node; ++d) {
      const Index other = first[static_cast<std::size_t>(node * dofs_per_node + d)] / dofs_per_node;
      if (model.is_fixed(node, d) != model.is_fixed(other, d))
        throw core::Error(fmt::format(
            "tie of the nodes at {} and {}: {} is restrained at one and free at the "
            "other; restrain it at both",
            place(model.node(node)), place(model.node(other)), dof_names[static_cast<std::size_t>(d)]));
    }
}

/// What is on the diagonals of M and of the beams' K; tied dofs have theirs in the first.
struct Diagonals {
  std::vector<double> mass, stiffness;
};

Diagonals diagonals(const Model& model, const std::vector<Index>& first) {
  Diagonals d{std::vector<double>(first.size()), std::vector<double>(first.size())};
  const auto row_of = [&](Index node, int i) {
    return static_cast<std::size_t>(first[static_cast<std::size_t>(node * dofs_per_node + i)]);
  };
  for (const Beam& beam : model.beams) {
    const BeamElement element(model, beam);
    const Vector12 mass = element.mass().diagonal(), stiffness = element.stiffness().diagonal();
    for (int i = 0; i < 2 * dofs_per_node; ++i) {
      const std::size_t row = row_of(i < dofs_per_node ? beam.a : beam.b, i % dofs_per_node);
      d.mass[row] += mass[i];
      d.stiffness[row] += stiffness[i];
    }
  }
  for (const LumpedMass& body : model.masses) {
    const Matrix6 m = lumped_mass_matrix(body);
    for (int i = 0; i < dofs_per_node; ++i)
      d.mass[row_of(body.node, i)] += m(i, i);
  }
  return d;
}

/// A free dof without mass makes no mode: on a node of beams it follows the others statically, elsewhere it
/// is a mistake.
void check_mass(const Model& model, const std::vector<Index>& first) {
  const Diagonals d = diagonals(model, first);
  for (std::size_t node = 0; node < model.nodes.size(); ++node)
    for (int dof = 0; dof < dofs_per_node; ++dof) {
      const std::size_t row = node * dofs_per_node + static_cast<std::size_t>(dof);
      if (model.is_fixed(static_cast<Index>(node), dof) || d.mass[row] > 0.0 || d.stiffness[row] > 0.0 ||
          first[row] != static_cast<Index>(row))
        continue;
      const auto name = dof_names[static_cast<std::size_t>(dof)];
      throw core::Error(
          fmt::format("node {} at {}: {} is free but nothing there has {}; restrain it ([[restraints]] "
                      "fixed = [\"{}\"]) or give the node {}",
                      node, place(model.nodes[node]), name, dof < 3 ? "mass" : "rotary inertia", name,
                      dof < 3 ? "a mass ([[masses]])" : "an inertia ([[masses]] inertia)"));
    }
}

void number_equations(const Model& model, const std::vector<Index>& first, Structure& structure) {
  structure.equation.reserve(structure.nodes.size() * dofs_per_node);
  for (const Index node : structure.nodes)
    for (int dof = 0; dof < dofs_per_node; ++dof) {
      const Index row = node * dofs_per_node + dof, tied = first[static_cast<std::size_t>(row)];
      if (model.is_fixed(node, dof))
        structure.equation.push_back(-1);
      else if (tied == row)
        structure.equation.push_back(structure.equations++);
      else // of an earlier node, which has its number
        structure.equation.push_back(structure.equation[static_cast<std::size_t>(
            position_of(structure, tied / dofs_per_node) * dofs_per_node + dof)]);
    }
}

} // namespace

std::vector<Vec3> positions(const Model& model, const Structure& structure) {
  std::vector<Vec3> out;
  for (const Index node : structure.nodes)
    out.push_back(model.node(node));
  return out;
}

std::string place(const Vec3& point) {
  return fmt::format("({:g}, {:g}, {:g})", point.x(), point.y(), point.z());
}

Index position_of(const Structure& structure, Index node) {
  const auto found = std::lower_bound(structure.nodes.begin(), structure.nodes.end(), node);
  return found != structure.nodes.end() && *found == node
             ? static_cast<Index>(found - structure.nodes.begin())
             : -1;
}

std::vector<Structure> structures(const Model& model) {
  assert(model.fixed.size() == model.nodes.size());
  check_properties(model);
  check_lumped(model);
  const std::vector<Index> first = first_tied(model);
  check_ties(model, first);
  check_mass(model, first);
  DisjointSets sets(model.nodes.size());
  for (const Beam& beam : model.beams)
    sets.join(beam.a, beam.b);
  for (const Spring& spring : model.springs)
    if (spring.other >= 0)
      sets.join(spring.node, spring.other);
  for (const Tie& tie : model.ties)
    if (ties_free_dofs(model, tie))
      sets.join(tie.node, tie.other);

  std::size_t count = 0;
  const std::vector<std::size_t> part_of = sets.labels(count);
  std::vector<Structure> parts(count);
  for (std::size_t node = 0; node < model.nodes.size(); ++node)
    parts[part_of[node]].nodes.push_back(static_cast<Index>(node));
  const auto part = [&](Index node) -> Structure& { return parts[part_of[static_cast<std::size_t>(node)]]; };
  for (std::size_t i = 0; i < model.beams.size(); ++i)
    part(model.beams[i].a).beams.push_back(static_cast<Index>(i));
  for (std::size_t i = 0; i < model.masses.size(); ++i)
    part(model.masses[i].node).masses.push_back(static_cast<Index>(i));
  for (std::size_t i = 0; i < model.springs.size(); ++i)
    part(model.springs[i].node).springs.push_back(static_cast<Index>(i));
  for (std::size_t i = 0; i < model.ties.size(); ++i)
    if (ties_free_dofs(model, model.ties[i]))
      part(model.ties[i].node).ties.push_back(static_cast<Index>(i));
  for (Structure& structure : parts)
    number_equations(model, first, structure);
  return parts;
}

double total_mass(const Model& model) {
  double sum = 0.0;
  for (const Beam& beam : model.beams) {
    const double length = BeamAxis(model.node(beam.a), model.node(beam.b), beam.middle).length();
    for (const auto& [share, weight] : gauss_points)
      sum += weight * length *
             beam_constants(property_of(model, beam), std::lerp(beam.along[0], beam.along[1], share))
                 .mass_transverse;
  }
  for (const LumpedMass& m : model.masses)
    sum += m.mass;
  return sum;
}

} // namespace fretwork::fem
