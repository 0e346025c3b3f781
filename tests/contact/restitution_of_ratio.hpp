// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Restitution of a free mass that meets the normal law of the reference, in closed form (contact/restitution.hpp).
#pragma once
#include <cmath>

namespace fretwork::tests {

/// e of xi = C_N/(2 sqrt(K_N m)) >= 0. Near xi = 1 both factors below the roots are exact.
inline double restitution_of_ratio(double xi) {
  if (xi == 1.0)
    return std::exp(-2.0);
  const double root = std::sqrt(std::abs(1.0 - xi)) * std::sqrt(1.0 + xi); // the square of xi may overflow
  return std::exp(-2.0 * xi * (xi < 1.0 ? std::acos(xi) : std::acosh(xi)) / root);
}

} // namespace fretwork::tests
