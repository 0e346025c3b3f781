// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/step_forces.hpp"
#include <algorithm>

namespace fretwork::transient {

StepForces::StepForces(const PackedContacts& contacts, bool bends)
    : components_(contacts.components), takes_bends_(bends), rows_(contacts),
      held_(static_cast<std::size_t>(contacts.padded_modes), 0.0), bends_{held_, held_} {
  for (auto& f : factors_)
    f.resize(3 * static_cast<std::size_t>(contacts.count));
}

void StepForces::add(int c, int component, const Factors& of) {
  const auto& [held, mean, slope, second, third] = of;
  if (mean == 0.0 && slope == 0.0 && held == 0.0)
    return;
  for (std::size_t k = 0; k < of.size(); ++k)
    factors_[k][rows_.size()] = of[k];
  rows_.add(c, component);
  any_held_ = any_held_ || held != 0.0;
  any_slope_ = any_slope_ || slope != 0.0;
  any_bend_ = any_bend_ || (takes_bends_ && (second != 0.0 || third != 0.0));
}

void StepForces::assemble(const CoupledContacts& coupled, const std::vector<int>& contacts,
                          vibration::ModalForce* found) {
  any_held_ = any_slope_ = any_bend_ = false;
  rows_.clear();
  for (const int c : contacts) {
    const CoupledContacts::Force& f = coupled.force(c);
    const auto& [b0, b1] = f.bends;
    add(c, 0, {f.held.y(), f.mean.y(), f.slope.y(), b0.y(), b1.y()});
    add(c, 1, {f.held.z(), f.mean.z(), f.slope.z(), b0.z(), b1.z()});
    if (components_ == 3)
      add(c, 2, {f.held.x, f.mean.x, f.slope.x, b0.x, b1.x});
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
    for (std::size_t k = 0; any_bend_ && k < bends_.size(); ++k)
      sum(3 + k, bends_[k], true);
  }
  if (count > 0)
    rows_.add_to(targets, static_cast<int>(count));
}

} // namespace fretwork::transient
