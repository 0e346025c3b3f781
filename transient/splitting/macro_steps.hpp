// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Which scenes `splitting` may make several steps of at once while no contact can meet its obstacle (splitting.cpp).
#pragma once
#include "transient/scene/scene.hpp"

namespace fretwork::transient {

/// Contacts act where they touch and nowhere before (no normal damper); their displacements follow from modes
/// that no damping matrix couples, their gaps bend nowhere upwards: not outside of a round body.
[[nodiscard]] bool allows_macro_steps(const Scene& scene);

} // namespace fretwork::transient
