// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contact forces at an instant: what explicit schemes use.
///     F_N = normal_force(p, p'),   F_T = evaluate(memory at the last commit, dx, v_t)
/// with dx the tangential displacement since the last commit. The memory is read only: an evaluation may be made at any state, as often
/// as a scheme needs.
#pragma once
#include "transient/contacts/contact_memory.hpp"

namespace fretwork::transient {

/// Forces of all contacts at the displacements and velocities of `motion`.
/// @param step  s, the time that the trial's works stand for   @param trial  overwritten. No allocation.
void evaluate_contacts(const PackedContacts& contacts, const ContactMemory& memory, double step,
                       ContactMotion& motion, ContactTrial& trial);

} // namespace fretwork::transient
