// SPDX-License-Identifier: GPL-3.0-or-later
// What a step that is accepted leaves in the contacts.
#include "transient/conserving/conserving_contacts.hpp"

namespace fretwork::transient {

ContactLosses ConservingContacts::commit(double h, const ContactMotion& end, FrictionMemories& memory,
                                         ContactTrial& trial) const {
  const auto table = [&](int c) {
    return contact::friction_table(contacts_.supports[static_cast<std::size_t>(c)].friction, h);
  };
  const auto close_contact = [&](std::size_t k, const contact::FrictionMemory& past) {
    const auto& [c, closed, end_penetration] = parts_[k];
    const contact::Support& support = contacts_.supports[static_cast<std::size_t>(c)];
    const ContactState& state = trial.states[static_cast<std::size_t>(c)];
    const contact::Friction friction{state.friction, state.slides};
    if (support.friction.kind == contact::FrictionMemoryKind::reference)
      return closed_throughout(support.friction, table(c), past, friction, state.displacement);
    const double end_force =
        contact::normal_force(support.normal, end_penetration, end.penetration_rate(c, state.axes));
    return close_part(support.friction, past, friction, state.normal_force, end_force, state.displacement, h,
                      closed);
  };
  return memory.commit(
      end, trial, close_contact, [&](std::size_t k) { return parts_[k].closed.share; }, table);
}

} // namespace fretwork::transient
