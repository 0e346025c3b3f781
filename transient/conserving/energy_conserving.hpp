// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Implicit, by discrete gradients: the energy balance closes to round-off.
#pragma once
#include "transient/scene/scheme.hpp"
#include <memory>

namespace fretwork::transient {

[[nodiscard]] std::unique_ptr<Scheme> make_energy_conserving(const Scene& scene, double step);

} // namespace fretwork::transient
