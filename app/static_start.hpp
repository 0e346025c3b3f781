// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// transient.start = "static": a scene starts in equilibrium (transient/statics/static_start.hpp).
#pragma once
#include "app/build_scene.hpp"

namespace fretwork::app {

/// Sets the initial displacements of a scene and notes what presses; initial velocities stay.
/// @param bases  of its structures, in their order
/// @throws core::Error naming the motion that nothing holds; core::ComputationError where no equilibrium was found
void start_in_equilibrium(const std::vector<const modal::Basis*>& bases,
                          const std::vector<PlacedContact>& contacts, BuiltScene& built);

} // namespace fretwork::app
