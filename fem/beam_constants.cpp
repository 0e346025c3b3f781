// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/beam_constants.hpp"
#include <cmath>

namespace fretwork::fem {
namespace {

double fluid_mass_of(const BeamProperty& property) {
  const auto outline = outline_of(property.section);
  return outline ? fluid_mass(property.fluid, outline->bore, outline->displaced) : 0.0;
}

BeamConstants uniform_constants(const BeamProperty& property) {
  const auto& [young, poisson, density] = property.material;
  const Section& s = property.section;
  const double shear_modulus = young / (2.0 * (1.0 + poisson)), lineic = density * s.area,
               added = property.added_mass + fluid_mass_of(property),
               turning = s.rotary_inertia ? density : 0.0;
  const auto k = shear_coefficients(s, poisson);
  return {.axial = young * s.area,
          .shear_y = k ? 1.0 / (k->y * shear_modulus * s.area) : 0.0,
          .shear_z = k ? 1.0 / (k->z * shear_modulus * s.area) : 0.0,
          .torsion = shear_modulus * s.torsion_constant,
          .bending_y = young * s.iy,
          .bending_z = young * s.iz,
          .mass_axial = lineic + (property.added_mass_direction == AddedMass::all ? added : 0.0),
          .mass_transverse = lineic + added,
          .inertia_x = density * s.polar_inertia,
          .inertia_y = turning * s.iy,
          .inertia_z = turning * s.iz};
}

} // namespace

BeamProperty property_at(const BeamProperty& property, double along) {
  BeamProperty here = property;
  here.taper.reset();
  if (!property.taper)
    return here;
  const Taper& far = *property.taper;
  const auto mix = [along](double a, double b) { return std::lerp(a, b, along); };
  here.section = between(property.section, far.section, along);
  here.added_mass = mix(property.added_mass, far.added_mass);
  here.axial_force = mix(property.axial_force, far.axial_force.value_or(property.axial_force));
  here.fluid = {mix(property.fluid.inside, far.fluid.inside), mix(property.fluid.outside, far.fluid.outside),
                mix(property.fluid.confinement, far.fluid.confinement)};
  return here;
}

double axial_force(const BeamProperty& property, const std::array<double, 2>& along) {
  return property_at(property, 0.5 * (along[0] + along[1])).axial_force;
}

BeamConstants beam_constants(const BeamProperty& property, double along) {
  return uniform_constants(property.taper ? property_at(property, along) : property);
}

} // namespace fretwork::fem
