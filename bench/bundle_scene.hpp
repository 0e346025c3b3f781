// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A bundle: straight tubes in a square array, each in its own supports, neighbours touching at two mid-spans.
#pragma once
#include "transient/scene/scene.hpp"

namespace fretwork::bench {

struct BundleScene {
  int tubes = 25;      ///< in rows of the root of their number, rounded up
  int modes = 40;      ///< of each tube
  int supports = 8;    ///< of each tube
  bool joined = true;  ///< with contacts between neighbouring tubes, two a pair
  bool by_tube = true; ///< contacts say which tubes they touch; false: they stand on the modes of all
  double gap = 2e-4;   ///< m, between tubes
  double duration = 1.0;
};

/// The tubes of tube_scene, each driven by forces of its own size, 0.6 to 1.4 of the nominal ones (van der Corput's sequence), so that no
/// two move alike. 5 x 5 tubes have 80 contacts between them, 10 x 10 have 360.
[[nodiscard]] transient::Scene bundle_scene(const BundleScene& bundle);

} // namespace fretwork::bench
