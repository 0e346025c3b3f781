// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/contact_trial.hpp"

namespace fretwork::transient {

ContactTrial::ContactTrial(int contacts) {
  const auto count = static_cast<std::size_t>(contacts);
  states.resize(count);
  active.reserve(count);
  opened.reserve(count);
}

void ContactTrial::open_all() {
  for (const int c : active)
    states[c] = {};
  for (const int c : opened)
    states[c] = {};
  active.clear();
  opened.clear();
}

double product(const PackedContacts& contacts, const ContactTrial& trial, const kernels::Array& lanes) {
  if (lanes.empty())
    return 0.0;
  const auto width = static_cast<std::size_t>(contacts.width);
  double sum = 0.0;
  for (const int active : trial.active) {
    const auto c = static_cast<std::size_t>(active);
    const ContactState& s = trial.states[c];
    sum += s.force_y() * lanes[c] + s.force_z() * lanes[width + c];
    if (contacts.components == 3)
      sum += s.friction.x * lanes[2 * width + c];
  }
  return sum;
}

ContactRows::ContactRows(const PackedContacts& contacts)
    : contacts_(contacts), rows_(contacts), factors_(3 * static_cast<std::size_t>(contacts.count)) {}

void ContactRows::add_to(const ContactTrial& trial, double* target) {
  rows_.clear();
  const auto add = [&](int c, int component, double force) {
    factors_[rows_.size()] = force;
    rows_.add(c, component);
  };
  for (const int c : trial.active) {
    const ContactState& s = trial.states[static_cast<std::size_t>(c)];
    add(c, 0, s.force_y());
    add(c, 1, s.force_z());
    if (contacts_.in_plane[static_cast<std::size_t>(c)])
      add(c, 2, s.friction.x);
  }
  rows_.add_to(factors_.data(), target);
}

} // namespace fretwork::transient
