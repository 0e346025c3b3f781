// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/weight.hpp"

namespace fretwork::fem {
namespace {

/// A fluid of which fluid_mass() is rho_i A_i - rho_e A_e.
Fluid buoyant(const Fluid& fluid) { return {fluid.inside, fluid.outside, -1.0}; }

/// Masses that weigh but for the fluids.
BeamProperty without_fluid(BeamProperty property) {
  property.fluid = {};
  if (property.taper)
    property.taper->fluid = {};
  return property;
}

/// Nothing but the fluids, less what they displace, in every direction.
BeamProperty fluid_alone(BeamProperty property) {
  property.material.density = 0.0;
  property.added_mass = 0.0;
  property.added_mass_direction = AddedMass::all;
  property.fluid = buoyant(property.fluid);
  if (property.taper) {
    property.taper->added_mass = 0.0;
    property.taper->fluid = buoyant(property.taper->fluid);
  }
  return property;
}

bool in_vacuum(const BeamProperty& property) {
  const auto none = [](const Fluid& fluid) { return fluid.inside == 0.0 && fluid.outside == 0.0; };
  return none(property.fluid) && (!property.taper || none(property.taper->fluid));
}

} // namespace

Eigen::VectorXd weight(const Model& model, const Vec3& gravity) {
  const Eigen::VectorXd fall = translation_field(model, gravity);
  Model part = model;
  for (BeamProperty& property : part.properties)
    property = without_fluid(property);
  Eigen::VectorXd out = mass_times(part, fall);
  part.masses.clear();
  std::erase_if(part.beams, [&](const Beam& beam) {
    return in_vacuum(model.properties[static_cast<std::size_t>(beam.property)]);
  });
  if (part.beams.empty())
    return out;
  for (std::size_t i = 0; i < model.properties.size(); ++i)
    part.properties[i] = fluid_alone(model.properties[i]);
  out += mass_times(part, fall);
  return out;
}

Vector12 weight(const Model& model, const Beam& beam, const Vec3& gravity) {
  const BeamProperty& whole = model.properties[static_cast<std::size_t>(beam.property)];
  Vector12 fall;
  fall << gravity, Vec3::Zero(), gravity, Vec3::Zero();
  const auto of = [&](const BeamProperty& property) -> Vector12 {
    return BeamElement(model.node(beam.a), model.node(beam.b), property, beam.middle, beam.along).mass() *
           fall;
  };
  return in_vacuum(whole) ? of(without_fluid(whole)) : of(without_fluid(whole)) + of(fluid_alone(whole));
}

} // namespace fretwork::fem
