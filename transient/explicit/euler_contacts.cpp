// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/explicit/euler_contacts.hpp"

namespace fretwork::transient {

EulerContacts::EulerContacts(const PackedContacts& contacts, double step)
    : contacts_(contacts), step_(step), memory_(contacts),
      position_(static_cast<std::size_t>(contacts.stride()), 0.0) {
  for (const contact::Support& support : contacts.supports)
    tables_.push_back(contact::friction_table(support.friction, step));
}

void EulerContacts::add_friction(const ContactMotion& motion, int c, double closed,
                                 ContactState& state) const {
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  const contact::FrictionMemory past = memory_.at(c, state.axes);
  const contact::Vec2 velocity = motion.slip(c, state.axes);
  const bool damped = law.damping > 0.0 || law.kind != contact::FrictionMemoryKind::return_map;
  state.displacement = (damped ? 1.0 : closed) * (motion.tangential(c, state.axes, motion.u) -
                                                  motion.tangential(c, state.axes, position_));
  const auto friction =
      contacts_.in_plane[c]
          ? contact::evaluate(law, past, state.normal_force, state.displacement, velocity)
          : contact::evaluate_line(law, past, state.normal_force, state.displacement.t, velocity.t);
  state.friction = friction.force;
  state.slides = friction.slides;
}

void EulerContacts::evaluate(ContactMotion& motion, ContactTrial& trial) const {
  trial.clear();
  if (!motion.find_near(0.0))
    return;
  for (int c = 0; c < contacts_.count; ++c) {
    if (!motion.near(c))
      continue;
    const contact::Support& support = contacts_.supports[c];
    const auto at = motion.locate(c);
    const double p = -at.gap, rate = motion.penetration_rate(c, at.axes());
    if (!(p >= 0.0))
      continue;
    const double spring = support.normal.stiffness * p;
    trial.springs += support.normal.spring_energy(p);
    const double normal = contact::normal_force(support.normal, p, rate);
    const double loss = (normal - spring) * rate * step_;
    if (!(normal > 0.0)) {
      trial.cut += loss;
      continue;
    }
    ContactState& state = trial.states[c];
    state.normal_force = normal;
    state.axes = at.axes();
    state.approach = rate;
    state.damper_work = loss;
    if (support.friction.active())
      add_friction(motion, c, memory_.was_closed(c) || !(rate * step_ > p) ? 1.0 : p / (rate * step_), state);
    trial.active.push_back(c);
  }
}

ContactLosses EulerContacts::commit(const ContactMotion& motion, ContactTrial& trial) {
  const auto close = [&](std::size_t k, const contact::FrictionMemory& memory) {
    const auto c = static_cast<std::size_t>(trial.active[k]);
    const ContactState& state = trial.states[c];
    return closed_throughout(contacts_.supports[c].friction, tables_[c], memory,
                             {state.friction, state.slides}, state.displacement);
  };
  const auto losses = memory_.commit(
      motion, trial, close, [](std::size_t) { return 1.0; },
      [&](int c) { return tables_[static_cast<std::size_t>(c)]; });
  position_ = motion.u;
  return losses;
}

} // namespace fretwork::transient
