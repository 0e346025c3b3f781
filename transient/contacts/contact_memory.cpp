// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/contact_memory.hpp"
#include <algorithm>

namespace fretwork::transient {

ContactMemory::ContactMemory(const PackedContacts& contacts, double step) : contacts_(contacts) {
  const auto count = static_cast<std::size_t>(contacts.count);
  entries_.resize(count);
  for (std::size_t c = 0; c < count; ++c)
    entries_[c].table = contact::friction_table(contacts.supports[c].friction, step);
  remembering_.reserve(count);
  closed_.reserve(count);
  position_.assign(static_cast<std::size_t>(contacts.stride()), 0.0);
}

void ContactMemory::set_step(double step) {
  for (int c = 0; c < contacts_.count; ++c)
    entries_[static_cast<std::size_t>(c)].table =
        contact::friction_table(contacts_.supports[c].friction, step);
}

ContactLosses ContactMemory::commit(const ContactMotion& motion, ContactTrial& trial) {
  ContactLosses losses{trial.cut, 0.0};
  for (const int c : trial.active) {
    ContactState& state = trial.states[c];
    losses.damping += state.damper_work; // of the normal dampers
    state.slid = state.slides ? norm(state.displacement) : 0.0;
  }
  commit_each(trial, losses);
  for (const int c : trial.active)
    trial.states[c].act_throughout(!std::binary_search(closed_.begin(), closed_.end(), c));
  for (const int c : closed_)
    if (!(trial.states[c].normal_force > 0.0)) {
      const auto at = motion.locate(c);
      trial.states[c].departure = -motion.sinking(c, at.ny, at.nz);
      trial.opened.push_back(c);
    }
  closed_.assign(trial.active.begin(), trial.active.end());
  position_ = motion.u;
  return losses;
}

void ContactMemory::commit_each(ContactTrial& trial, ContactLosses& losses) {
  for (const int c : trial.active)
    if (contacts_.supports[c].friction.active())
      close(c, trial.states[c], losses);
  for (const int c : remembering_)
    if (!(trial.states[c].normal_force > 0.0))
      relax(c, losses);
  std::erase_if(remembering_, [&](int c) { return !(entries_[c].left > 0.0); });
}

void ContactMemory::close(int c, ContactState& state, ContactLosses& losses) {
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  Entry& e = entries_[c];
  if (!(e.left > 0.0))
    remembering_.push_back(c);
  else if (opposite(e, state.ny, state.nz))
    forget(c, losses);
  const auto step =
      contact::close_step(law, e.table, e.friction, {state.friction, state.slides}, state.displacement);
  springs_ += step.stored;
  e.friction = step.memory;
  e.force = state.friction;
  e.ny = state.ny;
  e.nz = state.nz;
  e.left = 1.0;
  state.friction_work = step.friction_work;
  state.damper_work += step.damper_work;
  losses.damping += step.damper_work;
  losses.friction += step.friction_work;
}

void ContactMemory::relax(int c, ContactLosses& losses) {
  Entry& e = entries_[c];
  const auto step = contact::open_step(contacts_.supports[c].friction, e.table, e.friction);
  e.friction = step.memory;
  e.left *= e.table.relaxation;
  springs_ -= step.damper_work;
  losses.damping += step.damper_work;
  if (e.left < contact::forgotten)
    forget(c, losses);
}

void ContactMemory::forget(int c, ContactLosses& losses) {
  Entry& e = entries_[c];
  const double energy = contact::spring_energy(contacts_.supports[c].friction, e.friction);
  springs_ -= energy;
  losses.damping += energy;
  e.friction = {};
  e.force = {};
  e.left = 0.0;
}

} // namespace fretwork::transient
