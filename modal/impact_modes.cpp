// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/impact_modes.hpp"
#include <cassert>
#include <cmath>
#include <numbers>

namespace fretwork::modal {
namespace {

/// First root of cos(x) cosh(x) = 1.
constexpr double clamped_root = 4.730040744862704;

} // namespace

double point_receptance(double bending, double mass, BeamPoint point) {
  assert(bending > 0.0 && mass > 0.0);
  const double along = 1.0 / (2.0 * std::numbers::sqrt2 * std::pow(bending, 0.25) * std::pow(mass, 0.75));
  switch (point) {
  case BeamPoint::interior:
    return along;
  case BeamPoint::end:
    return 4.0 * along;
  }
  return along;
}

double contact_frequency(double stiffness, double receptance) {
  return std::pow(stiffness * receptance, 2.0 / 3.0);
}

double clamped_span_frequency(double length, double bending, double mass) {
  const double wave_number = clamped_root / length;
  return wave_number * wave_number * std::sqrt(bending / mass);
}

double contact_frequencies_needed(double error, bool static_modes) {
  assert(error > 0.0 && error <= 0.1);
  return static_modes ? 3.0 * std::pow(0.01 / error, 2.0 / 7.0) : 7.0 * std::pow(0.01 / error, 2.0 / 3.0);
}

double modes_needed_up_to(double contact_frequency, double span_frequency, double error, bool static_modes) {
  const double root = std::sqrt(contact_frequencies_needed(error, static_modes) * contact_frequency) +
                      std::sqrt(span_frequency);
  return root * root;
}

} // namespace fretwork::modal
