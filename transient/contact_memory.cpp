// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contact_memory.hpp"
#include <algorithm>

namespace fretwork::transient {

ContactMemory::ContactMemory(const PackedContacts& contacts, double step)
    : contacts_(contacts), lanes_(contacts.width), laws_(kernels::law_lanes(contacts, step)),
      acting_(contacts.lane_count()) {
  const auto count = static_cast<std::size_t>(contacts.count);
  entries_.resize(count);
  for (std::size_t c = 0; c < count; ++c)
    entries_[c].table = contact::friction_table(contacts.supports[c].friction, step);
  remembering_.reserve(count);
  closed_.reserve(count);
  ahead_.resize(count);
  position_.assign(static_cast<std::size_t>(contacts.stride()), 0.0);
}

void ContactMemory::set_step(double step) {
  for (int c = 0; c < contacts_.count; ++c) {
    auto& table = entries_[static_cast<std::size_t>(c)].table;
    table = contact::friction_table(contacts_.supports[c].friction, step);
    laws_[c].relaxation[kernels::lane(c)] = table.relaxation; // all that a commit takes of the step
  }
}

ContactLosses ContactMemory::commit(const ContactMotion& motion, ContactTrial& trial) {
  ContactLosses losses{trial.cut, 0.0};
  for (const int c : trial.active) {
    ContactState& state = trial.states[c];
    losses.damping += state.damper_work; // of the normal dampers
    state.slid = state.slides ? norm(state.displacement) : 0.0;
  }
  if (contacts_.in_lanes)
    commit_lanes(motion, trial, losses);
  else
    commit_each(trial, losses);
  for (const int c : closed_)
    if (!(trial.states[c].normal_force > 0.0)) {
      const auto at = motion.locate(c);
      trial.states[c].approach = motion.sinking(c, at.ny, at.nz);
      trial.opened.push_back(c);
    }
  closed_.assign(trial.active.begin(), trial.active.end());
  stand(motion);
  return losses;
}

/// Springs die out.
ContactLosses ContactMemory::fade(int steps, ContactTrial& trial) {
  ContactLosses losses;
  if (!lanes_.places.empty()) {
    const kernels::CommitSums sums = kernels::fade(contacts_.lane_count(), steps, laws_, lanes_);
    losses.damping += sums.damping;
    springs_ += sums.stored;
  }
  for (int i = 0; i < steps && !remembering_.empty(); ++i)
    commit_each(trial, losses);
  return losses;
}

void ContactMemory::follow(const ContactMotion& motion, double half_step) {
  if (contacts_.in_lanes) {
    if (!closed_.empty())
      springs_ += kernels::follow(contacts_.lane_count(), laws_, lanes_, motion.u.data(), position_.data(),
                                  motion.w.data(), half_step);
    return;
  }
  for (const int c : closed_) {
    const contact::FrictionLaw& law = contacts_.supports[c].friction;
    Entry& e = entries_[c];
    if (!law.active() || e.friction.sliding)
      continue;
    const contact::Vec2 moved =
        motion.tangential(c, e.ny, e.nz, motion.u) - motion.tangential(c, e.ny, e.nz, position_);
    springs_ -= contact::spring_energy(law, e.friction);
    e.friction.spring =
        e.friction.spring - law.stiffness * (moved - ahead_[c] - half_step * motion.slip(c, e.ny, e.nz));
    springs_ += contact::spring_energy(law, e.friction);
  }
}

void ContactMemory::leave(const ContactMotion& motion, const ContactTrial& trial, double half_step) {
  if (contacts_.in_lanes) {
    if (!trial.active.empty())
      kernels::leave(motion.places, laws_, trial.lanes, lanes_, motion.w.data(), half_step);
    return;
  }
  for (const int c : trial.active) {
    const ContactState& state = trial.states[c];
    if (contacts_.supports[c].friction.active())
      ahead_[c] = state.displacement - half_step * motion.slip(c, state.ny, state.nz);
  }
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

void ContactMemory::commit_lanes(const ContactMotion& motion, ContactTrial& trial, ContactLosses& losses) {
  if (trial.active.empty() && lanes_.places.empty())
    return;
  kernels::CommitLanes& step = trial.lanes;
  if (!trial.found_in_lanes) {
    acting_.first.clear();
    for (int c = 0; c < contacts_.width; ++c)
      step[c].closed[kernels::lane(c)] = 0.0;
    for (const int c : trial.active) {
      acting_.add_contact(c);
      const ContactState& s = trial.states[c];
      kernels::CommitNumbers& to = step[c];
      const int l = kernels::lane(c);
      to.closed[l] = 1.0;
      to.normal_y[l] = s.ny;
      to.normal_z[l] = s.nz;
      to.force[l] = s.friction.t;
      to.displacement[l] = s.displacement.t;
      to.slides[l] = s.slides ? 1.0 : 0.0;
    }
  }
  const kernels::CommitSums sums =
      kernels::commit(trial.found_in_lanes ? motion.places : acting_, laws_, step, lanes_);
  for (const int c : trial.active) {
    trial.states[c].friction_work = step[c].friction_work[kernels::lane(c)];
    trial.states[c].damper_work += step[c].damper_work[kernels::lane(c)];
  }
  losses.friction += sums.friction;
  losses.damping += sums.damping;
  springs_ += sums.stored;
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
  if (e.left < kernels::forgotten)
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
