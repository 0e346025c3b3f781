// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Stiffness and inertia of a beam per unit of its length.
#pragma once
#include "fem/model.hpp"

namespace fretwork::fem {

struct BeamConstants {
  double axial;           ///< E A, N
  double torsion;         ///< G J, N m2
  double bending_y;       ///< E Iy, N m2
  double bending_z;       ///< E Iz, N m2
  double mass_axial;      ///< kg/m
  double mass_transverse; ///< kg/m
  double inertia_x;       ///< density times polar inertia, kg m
};

[[nodiscard]] BeamConstants beam_constants(const BeamProperty& property);

} // namespace fretwork::fem
