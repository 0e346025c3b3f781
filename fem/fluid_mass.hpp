// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The mass per length that still fluid adds to a tube that moves across its axis:
///     m = rho_i A_i + Cm rho_e A_e.
/// Inside, the fluid moves with the tube: A_i is the area of the bore. Outside, A_e = pi D^2/4 is the area that the
/// tube displaces, and Cm the confinement: 1 in unbounded fluid, (R^2 + r^2)/(R^2 - r^2) for a tube of radius r in
/// the middle of a hole of radius R, and from 1.3 to 2.5 among the tubes of a bundle.
/// Limits: dense, still fluid, displacements small against D. Along the axis no fluid is moved.
/// Source: Blevins, Formulas for Natural Frequency and Mode Shape, chapter 14; Chen, Flow-Induced Vibration of
/// Circular Cylindrical Structures, chapter 2.
#pragma once

namespace fretwork::fem {

/// Fluid inside and outside of a round tube.
struct Fluid {
  double inside = 0.0;      ///< kg/m3, >= 0
  double outside = 0.0;     ///< kg/m3, >= 0
  double confinement = 1.0; ///< Cm >= 0
  bool operator==(const Fluid&) const = default;
};

/// @param bore, displaced  m2, A_i and A_e
/// @return kg/m
[[nodiscard]] constexpr double fluid_mass(const Fluid& fluid, double bore, double displaced) {
  return fluid.inside * bore + fluid.confinement * fluid.outside * displaced;
}

} // namespace fretwork::fem
