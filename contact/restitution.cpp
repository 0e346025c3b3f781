// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/restitution.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <string_view>

namespace fretwork::contact {

namespace {

void check_positive(std::string_view name, double value, std::string_view unit) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw core::Error(fmt::format("{} = {:g} {} makes no sense; give a number > 0", name, value, unit));
}

void check_restitution(double e) {
  if (!(e > 0.0) || e > 1.0)
    throw core::Error(
        fmt::format("restitution = {:g} is not the share of its speed that a body keeps in an impact; give a "
                    "number > 0 (0 would ask for an infinite damper) and at most 1",
                    e));
}

/// The place between lo and hi where `is_below` turns from true to false: halved until no number lies
/// between.
template <class Predicate> double bisect(double lo, double hi, Predicate is_below) {
  for (double middle = lo + 0.5 * (hi - lo); lo < middle && middle < hi; middle = lo + 0.5 * (hi - lo))
    (is_below(middle) ? lo : hi) = middle;
  return lo;
}

/// -ln e = 2 xi phi. Both forms of phi keep their digits near xi = 1, where 1 - xi is exact.
double loss_exponent(double xi) {
  const double below = 1.0 - xi;
  double phi = 1.0;
  if (below > 0.0) {
    const double w = std::sqrt(below * (1.0 + xi));
    phi = std::atan2(w, xi) / w;
  } else if (below < 0.0) {
    const double w = std::sqrt(-below) * std::sqrt(1.0 + xi); // two roots: the square of xi may overflow
    phi = std::log1p(w - below) / w;
  }
  return 2.0 * xi * phi;
}

/// u - ln(1 + u), u > -1: what Hunt and Crossley's law conserves is this of d p' plus d^2 (K_N/m) p^2/2.
/// Near 0, where the difference cancels, by the series of the logarithm in r = u/(2 + u).
double excess(double u) {
  const double r = u / (2.0 + u), r2 = r * r;
  if (r2 > 1.0 / 9.0)
    return u - std::log1p(u);
  double sum = 0.0, power = 1.0;
  for (int k = 3; power > 1e-17; k += 2, power *= r2) // relative to the first term: below round-off
    sum += power / k;
  return 2.0 * r2 * (1.0 / (1.0 - r) - r * sum);
}

} // namespace

double ratio_of_restitution(double e) {
  check_restitution(e);
  // pi/2 >= phi >= 1 for xi <= 1; above, with xi = cosh s, the exponent 2 s/tanh s lies between 2 s and 2 s +
  // 2
  const double exponent = -std::log(e), half = 0.5 * exponent;
  const double lo = half < 1.0 ? exponent / std::numbers::pi : std::cosh(half - 1.0);
  const double hi = half < 1.0 ? half : std::cosh(half);
  return bisect(lo, hi, [=](double xi) { return loss_exponent(xi) < exponent; });
}

double damping_of_restitution(double e, double stiffness, double mass) {
  check_positive("stiffness", stiffness, "N/m");
  check_positive("mass", mass, "kg");
  return 2.0 * ratio_of_restitution(e) * std::sqrt(stiffness * mass);
}

double restitution_of_dissipation(double x) {
  if (!(x > 0.0))
    return 1.0;
  // with w = e x the law reads excess(x) = excess(-w), which has its root between x/(1 + x) and min(x, 1)
  const double goal = excess(x);
  return bisect(x / (1.0 + x), std::min(x, 1.0), [=](double w) { return excess(-w) < goal; }) / x;
}

double dissipation_of_restitution(double e, double speed) {
  check_restitution(e);
  check_positive("speed of impact", speed, "m/s");
  if (e == 1.0)
    return 0.0;
  // from 1/(1 + x) < e < 1/x
  return bisect((1.0 - e) / e, 1.0 / e, [=](double x) { return excess(-e * x) < excess(x); }) / speed;
}

double wall_stiffness(double young_modulus, double outer_diameter, double thickness) {
  check_positive("Young's modulus", young_modulus, "Pa");
  check_positive("outer diameter", outer_diameter, "m");
  check_positive("wall thickness", thickness, "m");
  if (thickness >= 0.5 * outer_diameter)
    throw core::Error(
        fmt::format("wall thickness = {:g} m leaves no tube of outer diameter {:g} m; give less "
                    "than half the diameter",
                    thickness, outer_diameter));
  const double slenderness = thickness / outer_diameter;
  return 1.9 * young_modulus * thickness * slenderness * std::sqrt(slenderness);
}

} // namespace fretwork::contact
