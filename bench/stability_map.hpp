// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where a fixed step is unstable, wrong, or right, and whether the step rule warns of it: small scenes whose answers are known.
///
/// bouncing: a mass on a spring (1/50 of the contact's frequency, 1/50 of its amplitude to the gap) between two stops without losses; a high mode (`mode` times the
/// contact's frequency) shares the contact. Error: of the energy, a share of it for each impact.
/// rubbing: a mass moved to and fro by a force of half the contact's frequency, pressed on a plane with friction, its tangential damper of
/// the rate `damper` times the frequency of the stuck contact. Error: of the friction power against a step of a fiftieth.
#pragma once
#include "transient/step_rule.hpp"
#include <vector>

namespace fretwork::bench {

struct MapPoint {
  double resolution = 0.0; ///< w_c h of the bouncing mass, w_t h of the rubbing one
  double error = 0.0;      ///< see above, signed; infinite where the run diverged
  bool warned = false;
};

/// @param mode  of the high mode over w_c, 0: none
[[nodiscard]] MapPoint bouncing(transient::SchemeKind scheme, double resolution, double mode);
/// @param damper  r_t / w_t
[[nodiscard]] MapPoint rubbing(transient::SchemeKind scheme, double resolution, double damper);

} // namespace fretwork::bench
