// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What forces on contacts do to their motion within a step of the splitting scheme: W and V of coupled_contacts.hpp, for which displacement and velocity
/// after one step from rest under constant forces are exact.
#pragma once
#include "transient/contacts/contact_blocks.hpp"
#include "transient/modes/linear_flow.hpp"
#include "transient/splitting/components.hpp"

namespace fretwork::transient {

/// By blocks: of the block's contact `to` by a force on its contact `from`, at from * contacts of the block + to.
/// @param components  2, or 3 where friction acts along x_loc   @param step  h, s
[[nodiscard]] std::vector<std::vector<ImpulseResponse>> step_response(const Scene& scene,
                                                                      const ContactBlocks& blocks,
                                                                      int components, LinearFlow& modes,
                                                                      double step);

} // namespace fretwork::transient
