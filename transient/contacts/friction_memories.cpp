// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/friction_memories.hpp"
#include <algorithm>

namespace fretwork::transient {

FrictionMemories::FrictionMemories(const PackedContacts& contacts)
    : contacts_(contacts), entries_(static_cast<std::size_t>(contacts.count)) {
  remembering_.reserve(entries_.size());
  closed_.reserve(entries_.size());
}

const contact::FrictionMemory& FrictionMemories::meet(int c, const contact::ContactAxes& axes,
                                                      ContactLosses& losses) {
  Entry& e = entries_[static_cast<std::size_t>(c)];
  if (!(e.left > 0.0))
    remembering_.push_back(c);
  else if (e.axes.opposite(axes))
    forget(c, losses);
  return e.friction;
}

void FrictionMemories::keep(int c, const contact::ContactAxes& axes, const contact::FrictionMemory& memory,
                            double stored) {
  entries_[static_cast<std::size_t>(c)] = {memory, axes, 1.0};
  springs_ += stored;
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

void FrictionMemories::end(const ContactMotion& end, ContactTrial& trial) {
  for (const int c : closed_)
    if (!acts(trial, c)) {
      trial.states[static_cast<std::size_t>(c)].departure = -end.penetration_rate(c, end.locate(c).axes());
      trial.opened.push_back(c);
    }
  closed_.assign(trial.active.begin(), trial.active.end());
}

} // namespace fretwork::transient
