// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/contact_memory.hpp"

namespace fretwork::transient {

ContactMemory::ContactMemory(const PackedContacts& contacts, double step)
    : contacts_(contacts), friction_(contacts) {
  for (int c = 0; c < contacts.count; ++c)
    tables_.push_back(contact::friction_table(contacts.supports[static_cast<std::size_t>(c)].friction, step));
  position_.assign(static_cast<std::size_t>(contacts.stride()), 0.0);
}

ContactLosses ContactMemory::commit(const ContactMotion& motion, ContactTrial& trial) {
  ContactLosses losses{trial.cut, 0.0};
  for (const int c : trial.active) {
    ContactState& state = trial.states[static_cast<std::size_t>(c)];
    losses.damping += state.damper_work; // of the normal dampers
    state.slid = state.slides ? norm(state.displacement) : 0.0;
    const contact::FrictionLaw& law = contacts_.supports[static_cast<std::size_t>(c)].friction;
    if (law.active()) {
      const auto step = contact::close_step(law, table(c), friction_.meet(c, state.axes, losses),
                                            {state.friction, state.slides}, state.displacement);
      friction_.keep(c, state.axes, step.memory, step.stored);
      state.friction_work = step.friction_work;
      state.damper_work += step.damper_work;
      losses.damping += step.damper_work;
      losses.friction += step.friction_work;
    }
    state.act_throughout(!friction_.was_closed(c));
  }
  friction_.relax_open(
      trial, [&](int c) -> const auto& { return table(c); }, losses);
  friction_.end(motion, trial);
  position_ = motion.u;
  return losses;
}

} // namespace fretwork::transient
