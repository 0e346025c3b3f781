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

ContactRows::ContactRows(const PackedContacts& contacts) : contacts_(contacts) {
  row_.resize(3 * static_cast<std::size_t>(contacts.count));
  factor_.resize(3 * static_cast<std::size_t>(contacts.count));
}

void ContactRows::set(const ContactTrial& trial, double scale) {
  const double** row = row_.data();
  double* factor = factor_.data();
  for (const int c : trial.active) {
    const ContactState& s = trial.states[c];
    row[0] = contacts_.row(c, 0);
    row[1] = contacts_.row(c, 1);
    factor[0] = scale * s.force_y();
    factor[1] = scale * s.force_z();
    row += 2;
    factor += 2;
    if (contacts_.in_plane[c]) {
      *row++ = contacts_.row(c, 2);
      *factor++ = scale * s.friction.x;
    }
  }
  count_ = static_cast<std::size_t>(factor - factor_.data());
}

void ContactRows::add_to(double* target) const {
  if (count_ > 0)
    kernels::scatter(contacts_.padded_modes, static_cast<int>(count_), row_.data(), factor_.data(), target);
}

} // namespace fretwork::transient
