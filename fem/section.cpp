// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/section.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cassert>
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

/// J / (a b^3), a >= b: 1/3 - 64/pi^5 (b/a) sum over odd n of tanh(n pi a / (2 b)) / n^5 (Timoshenko and
/// Goodier, Theory of Elasticity, 3rd edition, section 109). With tanh x = 1 - 2/(e^2x + 1) the sum is
/// 31/32 zeta(5) less terms that fall as e^(-n pi a/b): up to n = 11 they leave 1e-20.
double rectangle_torsion_factor(double a, double b) {
  constexpr double all_ones = 31.0 / 32.0 * 1.0369277551433699263;
  double sum = 0.0;
  for (int n = 11; n >= 1; n -= 2) // small terms first
    sum -= 2.0 / ((std::exp(n * pi * a / b) + 1.0) * std::pow(n, 5));
  return 1.0 / 3.0 - 64.0 / std::pow(pi, 5) * (b / a) * (all_ones + sum);
}

/// Sizes (or constants) on the way to those of another section, of which only they count.
struct Mix {
  const Section &from, &to;
  double share;
  [[nodiscard]] double operator()(double a, double b) const { return std::lerp(a, b, share); }
  Section operator()(std::monostate) const {
    const Mix& mix = *this;
    return {mix(from.area, to.area), mix(from.iy, to.iy), mix(from.iz, to.iz),
            mix(from.torsion_constant, to.torsion_constant), mix(from.polar_inertia, to.polar_inertia)};
  }
  Section operator()(const Pipe& a) const {
    const Pipe& b = std::get<Pipe>(to.shape);
    return pipe_section((*this)(a.outer_diameter, b.outer_diameter), (*this)(a.thickness, b.thickness));
  }
  Section operator()(const Circle& a) const {
    return circle_section((*this)(a.diameter, std::get<Circle>(to.shape).diameter));
  }
  Section operator()(const Rectangle& a) const {
    const Rectangle& b = std::get<Rectangle>(to.shape);
    return rectangle_section((*this)(a.height_y, b.height_y), (*this)(a.height_z, b.height_z));
  }
};

ShearCoefficients round_shear(double inner_to_outer, double nu) {
  const double m2 = inner_to_outer * inner_to_outer, sum = (1.0 + m2) * (1.0 + m2);
  const double k = 6.0 * (1.0 + nu) * sum / ((7.0 + 6.0 * nu) * sum + (20.0 + 12.0 * nu) * m2);
  return {k, k};
}

double inner_diameter(const Pipe& pipe) { return pipe.outer_diameter - 2.0 * pipe.thickness; }

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
  return {area, polar / 2.0, polar / 2.0, polar, polar, Pipe{outer_diameter, thickness}};
}

Section circle_section(double diameter) {
  require_positive(diameter, "circle", "diameter");
  const double polar = disc_polar(diameter);
  return {pi * diameter * diameter / 4.0, polar / 2.0, polar / 2.0, polar, polar, Circle{diameter}};
}

Section rectangle_section(double height_y, double height_z) {
  require_positive(height_y, "rectangle", "height_y");
  require_positive(height_z, "rectangle", "height_z");
  const double a = std::max(height_y, height_z);
  const double b = std::min(height_y, height_z);
  const double iy = height_y * std::pow(height_z, 3) / 12.0;
  const double iz = height_z * std::pow(height_y, 3) / 12.0;
  return {height_y * height_z,          iy, iz, a * b * b * b * rectangle_torsion_factor(a, b), iy + iz,
          Rectangle{height_y, height_z}};
}

std::optional<ShearCoefficients> shear_coefficients(const Section& section, double poisson_ratio) {
  if (const auto* given = std::get_if<ShearCoefficients>(&section.shear))
    return *given;
  if (std::holds_alternative<std::monostate>(section.shear))
    return std::nullopt;
  struct Formulas {
    double nu;
    std::optional<ShearCoefficients> operator()(std::monostate) const { return std::nullopt; }
    std::optional<ShearCoefficients> operator()(const Pipe& pipe) const {
      return round_shear(inner_diameter(pipe) / pipe.outer_diameter, nu);
    }
    std::optional<ShearCoefficients> operator()(const Circle&) const { return round_shear(0.0, nu); }
    std::optional<ShearCoefficients> operator()(const Rectangle&) const {
      const double k = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
      return ShearCoefficients{k, k};
    }
  };
  return std::visit(Formulas{poisson_ratio}, section.shape);
}

std::optional<Outline> outline_of(const Section& section) {
  const auto disc = [](double diameter) { return pi / 4.0 * diameter * diameter; };
  if (const auto* pipe = std::get_if<Pipe>(&section.shape))
    return Outline{disc(inner_diameter(*pipe)), disc(pipe->outer_diameter)};
  if (const auto* circle = std::get_if<Circle>(&section.shape))
    return Outline{0.0, disc(circle->diameter)};
  return std::nullopt;
}

std::optional<double> outer_radius(const Section& section) {
  if (const auto* pipe = std::get_if<Pipe>(&section.shape))
    return 0.5 * pipe->outer_diameter;
  if (const auto* circle = std::get_if<Circle>(&section.shape))
    return 0.5 * circle->diameter;
  return std::nullopt;
}

std::optional<double> outer_fibre_stress(const Section& section, double n, double my, double mz) {
  const double traction = std::abs(n) / section.area;
  if (const auto radius = outer_radius(section))
    return traction + *radius * std::hypot(my / section.iy, mz / section.iz);
  if (const auto* bar = std::get_if<Rectangle>(&section.shape)) // at a corner
    return traction +
           0.5 * (std::abs(my) * bar->height_z / section.iy + std::abs(mz) * bar->height_y / section.iz);
  return std::nullopt;
}

bool same_kind(const Section& a, const Section& b) {
  return a.shape.index() == b.shape.index() && a.shear.index() == b.shear.index() &&
         a.rotary_inertia == b.rotary_inertia;
}

Section between(const Section& a, const Section& b, double share) {
  assert(same_kind(a, b));
  const Mix mix{a, b, share};
  Section section = std::visit(mix, a.shape);
  section.rotary_inertia = a.rotary_inertia;
  section.shear = a.shear;
  if (auto* given = std::get_if<ShearCoefficients>(&section.shear)) {
    const ShearCoefficients& to = std::get<ShearCoefficients>(b.shear);
    *given = {mix(given->y, to.y), mix(given->z, to.z)};
  }
  return section;
}

} // namespace fretwork::fem
