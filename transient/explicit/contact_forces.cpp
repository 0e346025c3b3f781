// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/explicit/contact_forces.hpp"

namespace fretwork::transient {
namespace {

void add_friction(const PackedContacts& contacts, const ContactMemory& memory, const ContactMotion& motion,
                  int c, ContactState& state) {
  const contact::FrictionLaw& law = contacts.supports[c].friction;
  const contact::FrictionMemory past = memory.friction().at(c, state.axes);
  const contact::Vec2 velocity = motion.slip(c, state.axes);
  state.displacement =
      motion.tangential(c, state.axes, motion.u) - motion.tangential(c, state.axes, memory.position());
  const auto friction =
      contacts.in_plane[c]
          ? contact::evaluate(law, past, state.normal_force, state.displacement, velocity)
          : contact::evaluate_line(law, past, state.normal_force, state.displacement.t, velocity.t);
  state.friction = friction.force;
  state.slides = friction.slides;
}

} // namespace

void evaluate_contacts(const PackedContacts& contacts, const ContactMemory& memory, double step,
                       ContactMotion& motion, ContactTrial& trial) {
  trial.clear();
  if (!motion.find_near(0.0))
    return;
  for (int c = 0; c < contacts.count; ++c) {
    if (!motion.near(c))
      continue;
    const contact::Support& support = contacts.supports[c];
    const auto at = motion.locate(c);
    const double p = -at.gap, rate = motion.penetration_rate(c, at.axes());
    if (!(p >= 0.0))
      continue;
    const double spring = support.normal.stiffness * p;
    trial.springs += support.normal.spring_energy(p);
    const double normal = contact::normal_force(support.normal, p, rate);
    const double loss = (normal - spring) * rate * step;
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
      add_friction(contacts, memory, motion, c, state);
    trial.active.push_back(c);
  }
}

} // namespace fretwork::transient
