// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The default scheme: exact motion of the modes under the forces of contacts, which move in intervals of a step.
#pragma once
#include "transient/scene/scheme.hpp"
#include <memory>

namespace fretwork::transient {

struct SplittingOptions {
  double fastest =
      0.0; ///< rad/s: faster modes that contacts move are made heavier (modes/mass_scaling.hpp); 0: none
  int longest = 1; ///< the most steps that are made at once while no contact can meet its obstacle
  int parts = 1;   ///< intervals in which contacts move within a step
};
/// Times as many of these that replays may ask for.
inline constexpr int most_refined = 16;
[[nodiscard]] std::unique_ptr<Scheme> make_splitting(const Scene& scene, double step,
                                                     const SplittingOptions& options = {});

} // namespace fretwork::transient
