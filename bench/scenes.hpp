// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Tubes that rattle in loose circular supports under random forces, in their exact modes: where the automatic step is judged.
///
/// Simply supported tube of 19.05 x 1.09 mm, E = 2e11 Pa, 1 kg/m with its water, 0.5 % of damping, bending in two planes; circles of
/// 0.14 to 0.26 mm at uneven places, K_T = K_N/2, C_T by the automatic formula with the first mode at its middle, mu = 0.3. Forces along the whole length
/// in y and along a half-wave and a whole one in z, both of band-limited noise from 2 Hz on.
#pragma once
#include "transient/scene/scene.hpp"
#include <string>
#include <vector>

namespace fretwork::bench {

struct NamedScene {
  std::string name;
  transient::Scene scene;
};

/// 10 s each: 40 modes 3 supports; 60 modes 10 supports; the same at K_N = 1e8 and 1e5 N/m; 40 modes of a short tube, the highest at
/// 6.1e4 rad/s; the straight tube of tube_scene.hpp. And other numbers of supports, stiffnesses (K_N in N/m) and forces.
[[nodiscard]] std::vector<NamedScene> rattling_tubes();

} // namespace fretwork::bench
