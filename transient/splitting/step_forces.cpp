// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/step_forces.hpp"
#include <algorithm>

namespace fretwork::transient {

StepForces::StepForces(const PackedContacts& contacts)
    : components_(contacts.components), rows_(contacts),
      held_(static_cast<std::size_t>(contacts.padded_modes), 0.0) {
  for (auto& f : factors_)
    f.resize(3 * static_cast<std::size_t>(contacts.count));
}

void StepForces::add(int c, int component, double held, double mean, double slope) {
  if (mean == 0.0 && slope == 0.0 && held == 0.0)
    return;
  factors_[0][rows_.size()] = held;
  factors_[1][rows_.size()] = mean;
  factors_[2][rows_.size()] = slope;
  rows_.add(c, component);
  any_held_ = any_held_ || held != 0.0;
  any_slope_ = any_slope_ || slope != 0.0;
}

void StepForces::assemble(const CoupledContacts& coupled, const std::vector<int>& contacts,
                          vibration::ModalForce* found) {
  any_held_ = any_slope_ = false;
  rows_.clear();
  for (const int c : contacts) {
    const CoupledContacts::Force& f = coupled.force(c);
    add(c, 0, f.held.y(), f.mean.y(), f.slope.y());
    add(c, 1, f.held.z(), f.mean.z(), f.slope.z());
    if (components_ == 3)
      add(c, 2, f.held.x, f.mean.x, f.slope.x);
  }
  RowScatter::Targets targets{};
  std::size_t count = 0;
  const auto sum = [&](std::size_t which, kernels::Array& to, bool any) {
    std::fill(to.begin(), to.end(), 0.0);
    if (any)
      targets[count++] = {factors_[which].data(), to.data()};
  };
  if (any_held_)
    sum(0, held_, true);
  if (found) {
    sum(1, found->mean, true);
    sum(2, found->slope, any_slope_);
  }
  if (count > 0)
    rows_.add_to(targets, static_cast<int>(count));
}

} // namespace fretwork::transient
