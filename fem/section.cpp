// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/section.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::fem {
namespace {

using std::numbers::pi;

void require_positive(double value, const char* shape, const char* name) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw core::Error(
        fmt::format("{} section: {} = {:g} m makes no section; give a length > 0", shape, name, value));
}

/// J of a disc of this diameter; iy = iz = J / 2.
double disc_polar(double diameter) { return pi * std::pow(diameter, 4) / 32.0; }

/// J / (a b^3), a >= b: 1/3 - 64/pi^5 (b/a) sum over odd n of tanh(n pi a / (2 b)) / n^5, times 1 (Timoshenko
/// and Goodier, Theory of Elasticity, 3rd edition, section 109). The terms fall as n^-5: 200 of them leave
/// 1e-13.
double rectangle_torsion_factor(double a, double b) {
  constexpr int terms = 200;
  double sum = 0.0;
  for (int n = 2 * terms - 1; n >= 1; n -= 2) // small terms first
    sum += std::tanh(n * pi * a / (2.0 * b)) / std::pow(n, 5);
  return 1.0 / 3.0 - 64.0 / std::pow(pi, 5) * (b / a) * sum;
}

} // namespace

Section pipe_section(double outer_diameter, double thickness) {
  require_positive(outer_diameter, "pipe", "outer_diameter");
  require_positive(thickness, "pipe", "thickness");
  const double inner = outer_diameter - 2.0 * thickness;
  if (inner < 0.0)
    throw core::Error(
        fmt::format("pipe section: thickness = {:g} m is more than half of outer_diameter = {:g} m; give "
                    "a wall that fits, or shape = \"circle\" for a solid bar",
                    thickness, outer_diameter));
  // area as a product, so that a thin wall keeps all its digits
  const double area = pi * thickness * (outer_diameter - thickness);
  const double polar = area * (outer_diameter * outer_diameter + inner * inner) / 8.0;
  return {area, polar / 2.0, polar / 2.0, polar, polar};
}

Section circle_section(double diameter) {
  require_positive(diameter, "circle", "diameter");
  const double polar = disc_polar(diameter);
  return {pi * diameter * diameter / 4.0, polar / 2.0, polar / 2.0, polar, polar};
}

Section rectangle_section(double height_y, double height_z) {
  require_positive(height_y, "rectangle", "height_y");
  require_positive(height_z, "rectangle", "height_z");
  const double a = std::max(height_y, height_z);
  const double b = std::min(height_y, height_z);
  const double iy = height_y * std::pow(height_z, 3) / 12.0;
  const double iz = height_z * std::pow(height_y, 3) / 12.0;
  return {height_y * height_z, iy, iz, a * b * b * b * rectangle_torsion_factor(a, b), iy + iz};
}

} // namespace fretwork::fem
