// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One contact: obstacle, normal law and friction law together.
#pragma once
#include "contact/friction_law.hpp"
#include "contact/normal_law.hpp"
#include "contact/obstacle.hpp"
#include <array>

namespace fretwork::contact {

struct Support {
  Obstacle obstacle;
  NormalLaw normal;
  FrictionLaw friction;
};

/// Automatic tangential damping, N s/m: of the mode of stiffness k (N/m), mass m (kg) and damping ratio xi
/// seen at the contact in a tangent direction, the damper that takes the stuck contact's oscillation to
/// critical damping,
///     C_T = 2 sqrt((k + K_T) m) - 2 xi sqrt(k m).
/// Source: R5.06.03 section 6.5.
[[nodiscard]] double automatic_tangential_damping(double tangential_stiffness, double mode_stiffness,
                                                  double mode_mass, double mode_damping);

/// Directions x y z in which friction can act, of those in which the law lets it (`along`): x_loc, and across it all that a tangent can take, not the normal of
/// a plane.
[[nodiscard]] std::array<bool, 3> friction_directions(const Obstacle& obstacle, Vec2 along);

} // namespace fretwork::contact
