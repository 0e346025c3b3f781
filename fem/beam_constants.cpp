// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/beam_constants.hpp"

namespace fretwork::fem {

BeamConstants beam_constants(const BeamProperty& property) {
  const auto& [young, poisson, density] = property.material;
  const Section& s = property.section;
  const double lineic = density * s.area;
  return {young * s.area,
          young / (2.0 * (1.0 + poisson)) * s.torsion_constant,
          young * s.iy,
          young * s.iz,
          lineic + (property.added_mass_direction == AddedMass::all ? property.added_mass : 0.0),
          lineic + property.added_mass,
          density * s.polar_inertia};
}

} // namespace fretwork::fem
