// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Zones of the tests of turbulence.
#pragma once
#include "core/error.hpp"
#include "flow/patches.hpp"
#include <cmath>
#include <numbers>
#include <string>

namespace fretwork::flow {

inline constexpr double pi = std::numbers::pi;

/// What a call says when it refuses its input; "" where it does not.
template <class F> std::string message_of(F call) {
  try {
    call();
  } catch (const core::Error& e) {
    return e.what();
  }
  return {};
}

/// Uniform flow along [0, length] with shapes sin(m pi s/length), m = 1 to `modes`, in `axes` axes.
inline TurbulentZone pinned_zone(double length, double correlation_length, Eigen::Index patches, int modes,
                                 int axes = 1) {
  TurbulentZone zone;
  zone.name = "span";
  const PatchGrid grid = cut_into_patches(0.0, length, length / static_cast<double>(patches));
  zone.s = grid.s;
  zone.ds = grid.ds;
  const auto all = [&](double value) { return Eigen::VectorXd::Constant(zone.s.size(), value); };
  zone.velocity = all(1.5);
  zone.density = all(740.0);
  zone.void_fraction = all(0.0);
  zone.viscosity = all(1.2e-7);
  zone.diameter = all(0.01905);
  zone.correlation_length = correlation_length;
  Eigen::MatrixXd shapes(modes, zone.s.size());
  for (int m = 0; m < modes; ++m)
    shapes.row(m) = (zone.s.array() * ((m + 1) * pi / length)).sin();
  for (int a = 0; a < axes; ++a)
    zone.axes.push_back({shapes, 1.0});
  return zone;
}

/// A spectrum of the same value at all frequencies, N^2/m^2/Hz.
inline Spectrum white(double value) { return TableSpectrum{{1.0}, {value}, true}; }

} // namespace fretwork::flow
