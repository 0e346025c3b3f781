// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The cheapest scene that rattles: 1 kg on springs of 40 Hz in a hole with friction, band-limited random forces in both planes.
#pragma once
#include "transient/scene/scene.hpp"
#include <cstdint>
#include <numbers>

namespace fretwork::bench {

struct RattlingMass {
  static constexpr double w = 2.0 * std::numbers::pi * 40.0; ///< rad/s
  double duration;                                           ///< s
  double damping = 0.05;                                     ///< ratio
  double force = 20.0;                                       ///< N, rms, in each plane
  double clearance = 1e-4;                                   ///< m
};

/// @param draw  of the forces
[[nodiscard]] transient::Scene rattling_mass(const RattlingMass& mass, std::uint64_t draw);

} // namespace fretwork::bench
