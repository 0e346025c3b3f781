// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/explicit/end_record.hpp"
#include <algorithm>
#include <utility>

namespace fretwork::transient {

EndRecord::EndRecord(const MotionRates& rates) : width_(rates.contacts().width) {
  const auto count = static_cast<std::size_t>(rates.contacts().count);
  next_.q.assign(static_cast<std::size_t>(rates.modes()), 0.0);
  next_.u.assign(rates.motion().u.size(), 0.0);
  next_.states.resize(count);
  shown_ = next_;
  for (Sheet* sheet : {&next_, &shown_}) {
    sheet->active.reserve(count);
    sheet->opened.reserve(count);
  }
  past_.resize(count);
  record_.contacts = rates.contacts().count;
}

void EndRecord::prepare(const MotionRates& rates, const double* y, double time) {
  prepare_all(rates, y, time, y);
}

void EndRecord::prepare_part(const MotionRates& rates, const double* y, double time, double length,
                             const double* until) {
  prepare_all(rates, y, time, until);
  for (const int c : next_.active) {
    ContactState& state = next_.states[c];
    state.displacement = length * rates.motion().slip(c, state.axes);
    state.slid = state.slides ? norm(state.displacement) : 0.0;
    state.wear_work = state.normal_force * state.slid;
  }
}

void EndRecord::prepare_all(const MotionRates& rates, const double* y, double time, const double* until) {
  Sheet& s = next_;
  s.time = time;
  std::copy_n(y, s.q.size(), s.q.begin());
  std::copy(rates.motion().u.begin(), rates.motion().u.end(), s.u.begin());
  s.energy = rates.energy(y);
  s.energy.initial = first_ ? s.energy.stored : shown_.energy.initial;
  s.energy.scale += s.energy.initial;
  first_ = false;
  s.active.clear();
  s.opened.clear();
  for (int c = 0; c < record_.contacts; ++c)
    prepare_contact(rates, until, c, shown_.states[c].normal_force > 0.0);
}

void EndRecord::prepare_contact(const MotionRates& rates, const double* until, int c, bool was_active) {
  Past& past = past_[c];
  ContactState& state = next_.states[c];
  const double friction = rates.friction_work(until, c) - past.friction,
               damper = rates.damper_work(until, c) - rates.forgotten(c) - past.damper;
  past.friction += friction;
  past.damper += damper;
  const bool entered = std::exchange(past.entered, false);
  if (const ContactState& now = rates.trial().states[c]; now.normal_force > 0.0 && rates.regime(c).closed) {
    state = now;
    state.friction_work = friction + std::exchange(past.carried_friction, 0.0);
    state.damper_work = damper + std::exchange(past.carried_damper, 0.0);
    if (entered)
      state.approach = past.entry;
    state.act_throughout(!was_active);
    next_.active.push_back(c);
    return;
  }
  state = {};
  if (!was_active && !rates.regime(c).closed)
    return;
  const auto at = rates.motion().locate(c);
  const double rate = rates.motion().penetration_rate(c, at.axes());
  if (was_active) {
    past.carried_friction = friction;
    past.carried_damper = damper;
    state.departure = -rate;
    next_.opened.push_back(c);
  } else {
    past.entry = rate;
    past.entered = true;
  }
}

void EndRecord::publish() {
  std::swap(next_, shown_);
  record_.time = shown_.time;
  record_.q = shown_.q.data();
  record_.uy = shown_.u.data();
  record_.uz = shown_.u.data() + width_;
  record_.states = shown_.states;
  record_.active = shown_.active;
  record_.opened = shown_.opened;
  record_.energy = shown_.energy;
}

} // namespace fretwork::transient
