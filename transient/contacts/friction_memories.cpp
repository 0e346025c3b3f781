// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/friction_memories.hpp"
#include <algorithm>

namespace fretwork::transient {

ClosedStep closed_throughout(const contact::FrictionLaw& law, const contact::FrictionTable& table,
                             const contact::FrictionMemory& memory, contact::Friction friction,
                             contact::Vec2 dx) {
  const auto step = contact::close_step(law, table, memory, friction, dx);
  return {step.memory.spring,
          friction.slides ? contact::norm(dx) : 0.0,
          step.friction_work,
          step.damper_work,
          0.0,
          step.stored};
}

FrictionMemories::FrictionMemories(const PackedContacts& contacts)
    : contacts_(contacts), entries_(static_cast<std::size_t>(contacts.count)) {
  remembering_.reserve(entries_.size());
  closed_.reserve(entries_.size());
}

const contact::FrictionMemory& FrictionMemories::recall(int c, const contact::ContactAxes& axes,
                                                        ContactLosses& losses) {
  Entry& e = entries_[static_cast<std::size_t>(c)];
  if (!(e.left > 0.0))
    remembering_.push_back(c);
  else if (e.axes.opposite(axes))
    forget(c, losses);
  return e.friction;
}

void FrictionMemories::keep(int c, const ClosedStep& step, ContactState& state, ContactLosses& losses) {
  entries_[static_cast<std::size_t>(c)] = {{step.spring, state.slides}, state.axes, 1.0};
  springs_ += step.stored;
  state.slid = step.slid;
  state.friction_work = step.friction_work;
  state.damper_work += step.damper_work;
  losses.damping += step.damper_work + step.given_up;
  losses.friction += step.friction_work;
}

void FrictionMemories::relax(int c, const contact::FrictionTable& table, ContactLosses& losses) {
  Entry& e = entries_[static_cast<std::size_t>(c)];
  const auto step =
      contact::open_step(contacts_.supports[static_cast<std::size_t>(c)].friction, table, e.friction);
  e.friction = step.memory;
  e.left *= table.relaxation;
  springs_ -= step.damper_work;
  losses.damping += step.damper_work;
  if (e.left < contact::forgotten)
    forget(c, losses);
}

void FrictionMemories::forget(int c, ContactLosses& losses) {
  Entry& e = entries_[static_cast<std::size_t>(c)];
  const double energy =
      contacts_.supports[static_cast<std::size_t>(c)].friction.spring_energy(e.friction.spring);
  springs_ -= energy;
  losses.damping += energy;
  e = {};
}

bool FrictionMemories::was_closed(int c) const {
  return std::binary_search(closed_.begin(), closed_.end(), c);
}

void FrictionMemories::find_opened(const ContactMotion& end, ContactTrial& trial) {
  for (const int c : closed_)
    if (!acts(trial, c)) {
      trial.states[static_cast<std::size_t>(c)].departure = -end.penetration_rate(c, end.locate(c).axes());
      trial.opened.push_back(c);
    }
  closed_.assign(trial.active.begin(), trial.active.end());
}

} // namespace fretwork::transient
