// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Friction of a step h that keeps the energy, constant over the step, from the tangential displacement dx over it: the law at the mean
/// displacement dx/2 and the mean velocity dx/h, in continuous pieces that Newton's method can follow (conserving_contacts.hpp).
#pragma once
#include "contact/friction_law.hpp"

namespace fretwork::transient {

/// Friction with its derivatives by displacement over the step, normal force and, where it is given by itself, force.
struct Rubbing {
  contact::Vec2 force;
  contact::Sym2 by_displacement;
  contact::Vec2 by_normal;
  contact::Sym2 by_force;
  bool slides;
};

/// Along the trial with one coefficient: continuous.
/// @param spring  T at the start of the step, N
[[nodiscard]] Rubbing along_trial(contact::FrictionLaw law, contact::Vec2 spring, double coefficient,
                                  double normal, contact::Vec2 dx, double h);

/// P(force - rho dx), P onto |F| <= mu_d F_N: opposite to dx, or whatever stops it.
[[nodiscard]] Rubbing opposing(const contact::FrictionLaw& law, double rho, double normal, contact::Vec2 dx,
                               contact::Vec2 force);

} // namespace fretwork::transient
