// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/conserving/conserving_memory.hpp"

namespace fretwork::transient {
namespace {

/// What became of the tangential spring and what slider and damper took, by the law's own step form.
ClosedStep reference_step(const contact::FrictionLaw& law, double h, const contact::FrictionMemory& memory,
                          contact::Friction friction, contact::Vec2 dx) {
  const auto step = contact::close_step(law, contact::friction_table(law, h), memory, friction, dx);
  return {step.memory.spring,
          friction.slides ? contact::norm(dx) : 0.0,
          step.friction_work,
          step.damper_work,
          0.0,
          step.stored};
}

} // namespace

ContactLosses ConservingMemory::commit(double h, const std::vector<ContactPart>& parts,
                                       const ContactMotion& end, ContactTrial& trial) {
  ContactLosses losses{trial.cut, 0.0};
  for (const ContactPart& part : parts) {
    ContactState& state = trial.states[static_cast<std::size_t>(part.contact)];
    losses.damping += state.damper_work; // of the normal dampers
    if (contacts_.supports[static_cast<std::size_t>(part.contact)].friction.active())
      close(h, part, end, state, losses);
    state.act_for(part.closed.share, !friction_.was_closed(part.contact));
  }
  const auto table = [&](int c) {
    return contact::friction_table(contacts_.supports[static_cast<std::size_t>(c)].friction, h);
  };
  friction_.relax_open(trial, table, losses);
  friction_.end(end, trial);
  return losses;
}

void ConservingMemory::close(double h, const ContactPart& part, const ContactMotion& end, ContactState& state,
                             ContactLosses& losses) {
  const contact::Support& support = contacts_.supports[static_cast<std::size_t>(part.contact)];
  const contact::FrictionMemory& memory = friction_.meet(part.contact, state.axes, losses);
  const contact::Friction friction{state.friction, state.slides};
  const double end_force = contact::normal_force(support.normal, part.end_penetration,
                                                 end.penetration_rate(part.contact, state.axes));
  const ClosedStep step = support.friction.kind == contact::FrictionMemoryKind::reference
                              ? reference_step(support.friction, h, memory, friction, state.displacement)
                              : close_part(support.friction, memory, friction, state.normal_force, end_force,
                                           state.displacement, h, part.closed);
  friction_.keep(part.contact, state.axes, {step.spring, state.slides}, step.stored);
  state.slid = step.slid;
  state.friction_work = step.friction_work;
  state.damper_work += step.damper_work;
  losses.damping += step.damper_work + step.given_up;
  losses.friction += step.friction_work;
}

} // namespace fretwork::transient
