// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/conserving/conserving_memory.hpp"
#include <algorithm>

namespace fretwork::transient {
namespace {

/// Of a spring's force when its contact opened: round-off of the energy.
constexpr double forgotten = 1e-12;

bool opposite(double ny, double nz, double other_y, double other_z) {
  return ny * other_y + nz * other_z < 0.0;
}

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

ConservingMemory::ConservingMemory(const PackedContacts& contacts)
    : contacts_(contacts), entries_(static_cast<std::size_t>(contacts.count)) {
  remembering_.reserve(entries_.size());
  closed_.reserve(entries_.size());
}

contact::FrictionMemory ConservingMemory::at(int c, double ny, double nz) const {
  const Entry& e = entries_[static_cast<std::size_t>(c)];
  return opposite(e.ny, e.nz, ny, nz) ? contact::FrictionMemory{} : e.friction;
}

ContactLosses ConservingMemory::commit(double h, const std::vector<ContactPart>& parts,
                                       const ContactMotion& end, ContactTrial& trial) {
  ContactLosses losses{trial.cut, 0.0};
  for (const ContactPart& part : parts) {
    ContactState& state = trial.states[static_cast<std::size_t>(part.contact)];
    losses.damping += state.damper_work; // of the normal dampers
    if (contacts_.supports[static_cast<std::size_t>(part.contact)].friction.active())
      close(h, part, end, state, losses);
  }
  const auto is_closed = [&](int c) { return trial.states[static_cast<std::size_t>(c)].normal_force > 0.0; };
  for (const int c : remembering_)
    if (!is_closed(c))
      relax(h, c, losses);
  std::erase_if(remembering_, [&](int c) { return !(entries_[static_cast<std::size_t>(c)].left > 0.0); });
  for (const ContactPart& part : parts)
    trial.states[static_cast<std::size_t>(part.contact)].act_for(
        part.closed.share, !std::binary_search(closed_.begin(), closed_.end(), part.contact));
  for (const int c : closed_)
    if (!is_closed(c)) {
      const auto at = end.locate(c);
      trial.states[static_cast<std::size_t>(c)].departure = -end.sinking(c, at.ny, at.nz);
      trial.opened.push_back(c);
    }
  closed_.assign(trial.active.begin(), trial.active.end());
  return losses;
}

void ConservingMemory::close(double h, const ContactPart& part, const ContactMotion& end, ContactState& state,
                             ContactLosses& losses) {
  const int c = part.contact;
  const contact::FrictionLaw& law = contacts_.supports[static_cast<std::size_t>(c)].friction;
  Entry& e = entries_[static_cast<std::size_t>(c)];
  if (!(e.left > 0.0))
    remembering_.push_back(c);
  else if (opposite(e.ny, e.nz, state.ny, state.nz))
    forget(c, losses);
  const contact::Friction friction{state.friction, state.slides};
  const double sunk = std::max(0.0, part.end_penetration);
  const double end_force =
      sunk > 0.0 ? std::max(0.0, part.stiffness * sunk + part.damping * end.sinking(c, state.ny, state.nz))
                 : 0.0;
  const ClosedStep step = law.kind == contact::FrictionMemoryKind::reference
                              ? reference_step(law, h, e.friction, friction, state.displacement)
                              : close_part(law, e.friction, friction, state.normal_force, end_force,
                                           state.displacement, h, part.closed);
  springs_ += step.stored;
  e.friction = {step.spring, state.slides};
  e.ny = state.ny;
  e.nz = state.nz;
  e.left = 1.0;
  state.slid = step.slid;
  state.friction_work = step.friction_work;
  state.damper_work += step.damper_work;
  losses.damping += step.damper_work + step.given_up;
  losses.friction += step.friction_work;
}

void ConservingMemory::relax(double h, int c, ContactLosses& losses) {
  const contact::FrictionLaw& law = contacts_.supports[static_cast<std::size_t>(c)].friction;
  Entry& e = entries_[static_cast<std::size_t>(c)];
  const contact::FrictionTable table = contact::friction_table(law, h);
  const auto step = contact::open_step(law, table, e.friction);
  e.friction = step.memory;
  e.left *= table.relaxation;
  springs_ -= step.damper_work;
  losses.damping += step.damper_work;
  if (e.left < forgotten)
    forget(c, losses);
}

void ConservingMemory::forget(int c, ContactLosses& losses) {
  Entry& e = entries_[static_cast<std::size_t>(c)];
  const double energy =
      contact::spring_energy(contacts_.supports[static_cast<std::size_t>(c)].friction, e.friction);
  springs_ -= energy;
  losses.damping += energy;
  e = {};
}

} // namespace fretwork::transient
