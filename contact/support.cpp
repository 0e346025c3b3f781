// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/support.hpp"
#include <cmath>

namespace fretwork::contact {

double automatic_tangential_damping(double tangential_stiffness, double mode_stiffness, double mode_mass,
                                    double mode_damping) {
  return 2.0 * std::sqrt((mode_stiffness + tangential_stiffness) * mode_mass) -
         2.0 * mode_damping * std::sqrt(mode_stiffness * mode_mass);
}

std::array<bool, 3> friction_directions(const Obstacle& obstacle, Vec2 along) {
  const auto [y, z] = normal_directions(obstacle);
  return {along.x > 0.0, along.t > 0.0 && (!y || z), along.t > 0.0 && (!z || y)};
}

} // namespace fretwork::contact
