// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The tangential springs of all contacts from step to step and which contacts were closed, for schemes whose contacts act over whole steps: they
/// say what a step makes of the spring of a closed contact, all else is here. It changes in `commit` only, once for every step that is accepted.
///
/// A memory is kept in components along x_loc and t = n x x_loc, so it turns with the normal. On the opposite face it is lost: another
/// surface. The spring of an open contact dies out by contact::open_step and is forgotten when round-off is left of it.
#pragma once
#include "transient/contacts/contact_motion.hpp"
#include "transient/contacts/contact_trial.hpp"

namespace fretwork::transient {

/// What a step in which a contact is closed has done to its spring.
struct ClosedStep {
  contact::Vec2 spring;       ///< N, at the end of the step
  double slid = 0.0;          ///< m, path of the node while the friction is at its bound
  double friction_work = 0.0; ///< J, by the slider, >= 0
  double damper_work = 0.0;   ///< J, by C_T, >= 0
  double given_up = 0.0;      ///< J, by the spring while the contact is open
  double stored = 0.0;        ///< J, what the spring's energy grew by
};
/// Of a contact that is closed throughout: contact::close_step.
[[nodiscard]] ClosedStep closed_throughout(const contact::FrictionLaw& law,
                                           const contact::FrictionTable& table,
                                           const contact::FrictionMemory& memory, contact::Friction friction,
                                           contact::Vec2 dx);

class FrictionMemories {
public:
  /// @param contacts  must live longer
  explicit FrictionMemories(const PackedContacts& contacts);

  /// What contact c remembers for a surface of these axes: nothing of the opposite face.
  [[nodiscard]] contact::FrictionMemory at(int c, const contact::ContactAxes& axes) const {
    const Entry& e = entries_[static_cast<std::size_t>(c)];
    return e.axes.opposite(axes) ? contact::FrictionMemory{} : e.friction;
  }
  /// At the end of the last step.
  [[nodiscard]] bool was_closed(int c) const;
  /// Energy of all springs, J.
  [[nodiscard]] double spring_energy() const { return springs_; }

  /// Accepts a step: advances the memories of the closed contacts, lets those of the others die out, fills the friction and damper work
  /// and the sliding paths of the states, and the contacts that have opened. No allocation.
  /// @param end  motion at the end of the step   @param close(k, memory)  a ClosedStep of contact trial.active[k], which has friction
  /// @param share(k)  of the step in which it is closed   @param table(c)  friction_table of contact c over the step
  template <class Close, class Share, class Table>
  ContactLosses commit(const ContactMotion& end, ContactTrial& trial, const Close& close, const Share& share,
                       const Table& table) {
    ContactLosses losses{trial.cut, 0.0};
    for (std::size_t k = 0; k < trial.active.size(); ++k) {
      const int c = trial.active[k];
      ContactState& state = trial.states[static_cast<std::size_t>(c)];
      losses.damping += state.damper_work; // of the normal dampers
      if (contacts_.supports[static_cast<std::size_t>(c)].friction.active())
        keep(c, close(k, recall(c, state.axes, losses)), state, losses);
      state.act_for(share(k), !was_closed(c));
    }
    for (const int c : remembering_)
      if (!acts(trial, c))
        relax(c, table(c), losses);
    std::erase_if(remembering_, [&](int c) { return !(entries_[static_cast<std::size_t>(c)].left > 0.0); });
    find_opened(end, trial);
    return losses;
  }
  void visit(core::StateArchive& state) { state(entries_, remembering_, closed_, springs_); }

private:
  struct Entry {
    contact::FrictionMemory friction;
    contact::ContactAxes axes; ///< at the last step with a force; none: nothing remembered
    double left = 0.0; ///< share of the spring's force left since the contact opened; 0: nothing remembered
  };
  [[nodiscard]] static bool acts(const ContactTrial& trial, int c) {
    return trial.states[static_cast<std::size_t>(c)].normal_force > 0.0;
  }
  /// What a closed contact remembers; what the opposite face has loaded is lost.
  const contact::FrictionMemory& recall(int c, const contact::ContactAxes& axes, ContactLosses& losses);
  void keep(int c, const ClosedStep& step, ContactState& state, ContactLosses& losses);
  /// The contacts that have opened are handed to the trial with the speed at which they leave.
  void find_opened(const ContactMotion& end, ContactTrial& trial);
  void relax(int c, const contact::FrictionTable& table, ContactLosses& losses);
  void forget(int c, ContactLosses& losses);

  const PackedContacts& contacts_;
  std::vector<Entry> entries_;
  std::vector<int> remembering_; ///< contacts with left > 0
  std::vector<int> closed_;      ///< with a force at the last step, by increasing number
  double springs_ = 0.0;
};

} // namespace fretwork::transient
