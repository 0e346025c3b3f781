// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/explicit/end_record.hpp"
#include <algorithm>
#include <utility>

namespace fretwork::transient {

EndRecord::EndRecord(const MotionRates& rates)
    : contacts_(rates.contacts()), next_(rates), shown_(rates),
      past_(static_cast<std::size_t>(contacts_.count)) {}

void EndRecord::prepare(const MotionRates& rates, const double* y, double time) {
  prepare_all(rates, y, time, y);
}

void EndRecord::prepare_part(const MotionRates& rates, const double* y, double time, double length,
                             const double* until) {
  prepare_all(rates, y, time, until);
  for (const int c : next_.trial.active) {
    ContactState& state = next_.trial.states[c];
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
  s.trial.active.clear();
  s.trial.opened.clear();
  for (int c = 0; c < contacts_.count; ++c)
    prepare_contact(rates, until, c, shown_.trial.states[c].normal_force > 0.0);
}

void EndRecord::prepare_contact(const MotionRates& rates, const double* until, int c, bool was_active) {
  Past& past = past_[c];
  ContactState& state = next_.trial.states[c];
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
    next_.trial.active.push_back(c);
    return;
  }
  state = {};
  if (!was_active && !rates.regime(c).closed)
    return;
  const contact::ContactAxes here = rates.motion().locate(c).axes(), face = rates.regime(c).axes;
  const double rate = rates.motion().penetration_rate(c, face.opposite(here) ? here.reversed() : here);
  if (was_active) {
    past.carried_friction = friction;
    past.carried_damper = damper;
    state.departure = -rate;
    next_.trial.opened.push_back(c);
  } else {
    past.entry = rate;
    past.entered = true;
  }
}

void EndRecord::publish() {
  std::swap(next_, shown_);
  record_.time = shown_.time;
  record_.energy = shown_.energy;
  show(record_, contacts_, shown_.q.data(), shown_.u.data(), shown_.trial);
}

} // namespace fretwork::transient
