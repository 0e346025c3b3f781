// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Stiffness and inertia of a beam per unit of its length.
#pragma once
#include "fem/model.hpp"

namespace fretwork::fem {

struct BeamConstants {
  double axial;           ///< E A, N
  double shear_y;         ///< 1 / (k_y G A), 1/N; 0 where the section does not shear
  double shear_z;         ///< 1 / (k_z G A)
  double torsion;         ///< G J, N m2
  double bending_y;       ///< E Iy, N m2
  double bending_z;       ///< E Iz, N m2
  double mass_axial;      ///< kg/m
  double mass_transverse; ///< kg/m
  double inertia_x;       ///< density times polar inertia, kg m
  double inertia_y;       ///< density times iy, kg m; 0 without rotary inertia
  double inertia_z;       ///< density times iz
};

/// @param along  where on the way of the property's taper, 0 to 1; of no meaning without one
[[nodiscard]] BeamConstants beam_constants(const BeamProperty& property, double along = 0.0);

/// The same without a taper, as it is at `along`.
[[nodiscard]] BeamProperty property_at(const BeamProperty& property, double along);

/// N, of a beam: that at its middle.   @param along  of its ends
[[nodiscard]] double axial_force(const BeamProperty& property, const std::array<double, 2>& along);

} // namespace fretwork::fem
