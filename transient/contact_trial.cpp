// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contact_trial.hpp"

namespace fretwork::transient {

ContactTrial::ContactTrial(int contacts) {
  const auto count = static_cast<std::size_t>(contacts);
  states.resize(count);
  active.reserve(count);
  opened.reserve(count);
}

void ContactTrial::clear() {
  for (const int c : active)
    states[c] = {};
  for (const int c : opened)
    states[c] = {};
  active.clear();
  opened.clear();
  springs = cut = 0.0;
}

ContactRows::ContactRows(const PackedContacts& contacts) : contacts_(contacts) {
  row_.reserve(3 * static_cast<std::size_t>(contacts.count));
  factor_.reserve(3 * static_cast<std::size_t>(contacts.count));
}

void ContactRows::set(const ContactTrial& trial, double scale) {
  row_.clear();
  factor_.clear();
  for (const int c : trial.active) {
    const ContactState& s = trial.states[c];
    const double force[3] = {s.normal_force * s.ny + s.friction.t * s.nz,
                             s.normal_force * s.nz - s.friction.t * s.ny, s.friction.x};
    const int components = contacts_.in_plane[c] ? 3 : 2;
    for (int k = 0; k < components; ++k) {
      row_.push_back(contacts_.row(c, k));
      factor_.push_back(scale * force[k]);
    }
  }
}

void ContactRows::add_to(double* target) const {
  if (!row_.empty())
    kernels::scatter(contacts_.padded_modes, static_cast<int>(row_.size()), row_.data(), factor_.data(),
                     target);
}

double ContactRows::of_mode(Eigen::Index mode) const {
  double sum = 0.0;
  for (std::size_t r = 0; r < row_.size(); ++r)
    sum += factor_[r] * row_[r][mode];
  return sum;
}

} // namespace fretwork::transient
