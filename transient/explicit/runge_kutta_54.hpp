// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The oracle: adaptive steps of order 5, events located.
#pragma once
#include "transient/scene/scheme.hpp"
#include <memory>

namespace fretwork::transient {

/// @param tolerance  of a step's error, in the energy norm   @param longest  s, step
[[nodiscard]] std::unique_ptr<Scheme> make_runge_kutta_54(const Scene& scene, double tolerance,
                                                          double longest);

} // namespace fretwork::transient
