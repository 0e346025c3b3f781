// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/cross_section.hpp"
#include "wear/root.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>

namespace fretwork::wear {

namespace {

/// f - sin f cos f = (x - sin x)/2 with x = 2 f. The series has 1e-17 at x = 1 with 8 terms.
double half_angle_less_sine(double f) {
  const double x = 2.0 * f;
  if (x > 1.0)
    return 0.5 * (x - std::sin(x));
  double sum = 0.0;
  for (int k = 9; k >= 2; --k) // x^3/6 (1 - x^2/(4 5) (1 - x^2/(6 7) (1 - ...
    sum = x * x / (2.0 * k * (2.0 * k + 1.0)) * (1.0 - sum);
  return x * x * x / 12.0 * (1.0 - sum);
}

/// Where the circles of tube and hole cut.
struct Cut {
  double e;        ///< m, between the centres
  double x;        ///< m, half of the chord
  double h_t, h_s; ///< m, of the chord from the centre of tube and hole
};

Cut cut(double radius, double clearance, double depth) {
  const double hole = radius + clearance, e = clearance + depth;
  const double below = depth * (2.0 * hole + depth) / (2.0 * e);
  const double above = (2.0 * clearance + depth) * (2.0 * radius - depth) / (2.0 * e);
  return {e, std::sqrt(below * above), radius - below, radius - below + e};
}

[[maybe_unused]] bool in_range(double radius, double clearance, double depth) {
  return radius > 0.0 && clearance >= 0.0 && depth >= 0.0 && depth <= radius;
}

} // namespace

double segment_area(double radius, double depth) {
  assert(in_range(radius, 0.0, depth));
  return radius * radius * half_angle_less_sine(2.0 * std::asin(std::sqrt(0.5 * depth / radius)));
}

double crescent_half_angle(double radius, double clearance, double depth) {
  assert(in_range(radius, clearance, depth));
  if (!(depth > 0.0))
    return 0.0;
  const Cut at = cut(radius, clearance, depth);
  return std::atan2(at.x, at.h_s);
}

double crescent_area(double radius, double clearance, double depth) {
  assert(in_range(radius, clearance, depth));
  if (!(depth > 0.0))
    return 0.0;
  const double hole = radius + clearance;
  const auto [e, x, h_t, h_s] = cut(radius, clearance, depth);
  const double a_h = std::atan2(x, h_s);
  if (depth * radius < clearance * clearance)
    return radius * radius * half_angle_less_sine(std::atan2(x, h_t)) -
           hole * hole * half_angle_less_sine(a_h);
  const double b = std::atan2(2.0 * e * x, radius * radius + hole * hole - e * e);
  return radius * radius * b - clearance * (radius + hole) * a_h + x * e;
}

double land_area(double radius, double clearance, double depth, double from, double to) {
  assert(in_range(radius, clearance, depth) && from <= to);
  const double edge = crescent_half_angle(radius, clearance, depth);
  const double hole = radius + clearance, e = clearance + depth;
  const auto above_hole = [=](double psi) { // rho^2 - R_h^2
    const double s = e * std::sin(psi), half = std::sin(0.5 * psi);
    const double root = std::sqrt(std::max(0.0, radius * radius - s * s));
    const double rise = depth - 2.0 * e * half * half - s * s / (radius + root);
    return rise * (rise + 2.0 * hole);
  };
  return 0.5 * integral(above_hole, std::max(from, -edge), std::min(to, edge));
}

double depth_of_half_angle(double radius, double clearance, double angle) {
  const double hole = radius + clearance, across = hole * std::sin(angle);
  if (!(std::cos(angle) > 0.0) || std::abs(across) >= radius)
    return 2.0 * radius;
  return hole * std::cos(angle) - std::sqrt(radius * radius - across * across) - clearance;
}

} // namespace fretwork::wear
