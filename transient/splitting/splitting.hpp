// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The default scheme: exact motion of the modes under the forces of contacts, which move in intervals of a step.
#pragma once
#include "transient/scene/scheme.hpp"
#include <memory>

namespace fretwork::transient {

/// @param fastest  rad/s: faster modes that contacts move are made heavier (modes/mass_scaling.hpp); 0: none
/// @param longest  the most steps that are made at once while no contact can meet its obstacle
/// @param parts  intervals in which contacts move within a step
[[nodiscard]] std::unique_ptr<Scheme> make_splitting(const Scene& scene, double step, double fastest = 0.0,
                                                     int longest = 1, int parts = 1);

} // namespace fretwork::transient
