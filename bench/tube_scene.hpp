// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A simply supported straight tube on equally spaced circular supports, in its exact modes: the scene of the
/// transient benchmarks.
#pragma once
#include "transient/scene/scene.hpp"

namespace fretwork::bench {

struct TubeScene {
  int modes = 41;      ///< bending modes in two planes alternately (an odd last one: torsion)
  int supports = 8;    ///< at equal distances
  double length = 9.0; ///< m
  double friction = 0.3;
  double normal_stiffness = 1e6;
  double tangential_damping = 100.0;
  double gap = 2e-4;      ///< m; very large: never closed
  double duration = 10.0; ///< s
};

/// Tube of 19.05 x 1.09 mm, E = 2e11 Pa, 12000 kg/m3, 1 % damping; 20 N at 37 Hz in y at all mid-spans, 15 N
/// at 53 Hz in z at every second one. The defaults are examples/straight_tube with exact modes.
[[nodiscard]] transient::Scene tube_scene(const TubeScene& tube);

} // namespace fretwork::bench
