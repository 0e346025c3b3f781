// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/largest_impact.hpp"
#include <algorithm>

namespace fretwork::post {

LargestImpact::LargestImpact(std::size_t contacts, double from) : from_(from), contacts_(contacts) {
  for (Contact& contact : contacts_) {
    contact.ring.resize(points);
    contact.kept.reserve(points);
  }
}

void LargestImpact::Contact::keep() {
  const std::size_t held = std::min<std::uint64_t>(count, points);
  kept.resize(held);
  for (std::size_t i = 0; i < held; ++i)
    kept[i] = ring[(count - held + i) % points];
}

void LargestImpact::Contact::add(const ForcePoint& point) {
  ring[count++ % points] = point;
  if (still > 0 && --still == 0)
    keep();
}

void LargestImpact::step(const transient::Record& record) {
  if (record.time < from_)
    return;
  const double start = record.time - 0.5 * record.step, end = record.time + 0.5 * record.step;
  for (const int c : record.active) {
    const transient::ContactState& state = record.states[static_cast<std::size_t>(c)];
    Contact& contact = contacts_[static_cast<std::size_t>(c)];
    if (!contact.closed)
      contact.add({start, 0.0, 0.0});
    contact.closed = true;
    contact.add({record.time, state.normal_force, norm(state.friction)});
    if (state.peak > contact.largest) {
      contact.largest = state.peak;
      contact.still = points / 2;
    }
  }
  for (const int c : record.opened) {
    const transient::ContactState& state = record.states[static_cast<std::size_t>(c)];
    Contact& contact = contacts_[static_cast<std::size_t>(c)];
    if (state.touches > 0 && state.opened_at < state.closed_at)
      continue; // it closed again
    if (contact.closed)
      contact.add({state.normal_force > 0.0 ? end : start, 0.0, 0.0});
    contact.closed = false;
  }
}

std::vector<std::vector<ForcePoint>> LargestImpact::histories() const {
  std::vector<std::vector<ForcePoint>> out;
  for (Contact contact : contacts_) {
    if (contact.still > 0)
      contact.keep();
    out.push_back(std::move(contact.kept));
  }
  return out;
}

} // namespace fretwork::post
