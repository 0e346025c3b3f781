// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the contacts of a scene remember from step to step: the tangential springs, where the contacts stood and which were closed. It
/// changes in `commit` only, once for every step that is accepted.
///
/// A memory is kept in components along x_loc and t = n x x_loc, so it turns with the normal. A normal on the other side of the last
/// one (n.n0 < 0: the opposite face) is another surface: what the last face has loaded is lost. The spring of an open contact dies out
/// by contact::open_step and is forgotten when round-off is left of it.
///
/// An action of the splitting scheme at t_n stretches the springs by dx_n = h (v- + v+)/2. Where they stick, the sum of these must be the
/// displacement of the contact. It is not by itself: a flow takes a mode of w h not small by another displacement than h times the mean of the
/// velocities at its ends, and a damped one that a steady force pushes to and fro between actions by none at all where that mean is
/// z w h^2/6 of its acceleration, so that the spring would creep. `follow` stretches them by what is missing from the action before,
///     e_n = u_n - u_{n-1} - (dx_{n-1} - (h/2) v-_{n-1}) - (h/2) v-_n;
/// sums of dx + e are displacements, but for the half steps at both ends. Of order h^2.
#pragma once
#include "transient/contact_motion.hpp"
#include "transient/contact_trial.hpp"
#include "transient/lone_contact.hpp"
#include <cstring>

namespace fretwork::transient {

/// J over a step, >= 0 but for errors of the order of the scheme.
struct ContactLosses {
  double damping =
      0.0; ///< normal and tangential dampers, what the positive part cuts, springs of open contacts
  double friction = 0.0; ///< Coulomb sliders
};

class ContactMemory {
public:
  /// @param contacts  must live longer   @param step  s, between commits
  ContactMemory(const PackedContacts& contacts, double step);

  /// Another time between commits, s. No allocation. Not with `step_alone`, which asks for more of the laws.
  void set_step(double step);
  /// The contacts stand here; nothing is loaded.
  void start(const ContactMotion& motion) { position_ = motion.u; }

  /// What contact c remembers for a surface of normal n: nothing of the opposite face.
  [[nodiscard]] contact::FrictionMemory at(int c, double ny, double nz) const {
    if (contacts_.in_lanes)
      return opposite_lane(c, ny, nz) ? contact::FrictionMemory{}
                                      : contact::FrictionMemory{{0.0, lanes_[c].spring[kernels::lane(c)]},
                                                                lanes_[c].sliding[kernels::lane(c)] != 0.0};
    const Entry& e = entries_[c];
    return opposite(e, ny, nz) ? contact::FrictionMemory{} : e.friction;
  }
  /// Friction at the last commit if contact c was closed then on the same surface, otherwise 0, N.
  [[nodiscard]] contact::Vec2 last_force(int c, double ny, double nz) const {
    if (contacts_.in_lanes)
      return {0.0, lanes_[c].left[kernels::lane(c)] == 1.0 && !opposite_lane(c, ny, nz)
                       ? lanes_[c].force[kernels::lane(c)]
                       : 0.0};
    const Entry& e = entries_[c];
    return e.left == 1.0 && !opposite(e, ny, nz) ? e.force : contact::Vec2{};
  }
  [[nodiscard]] const contact::FrictionTable& table(int c) const { return entries_[c].table; }
  /// All memories, where PackedContacts::in_lanes.
  [[nodiscard]] const kernels::MemoryLanes& lanes() const { return lanes_; }
  /// With a force at the last commit, by increasing number.
  [[nodiscard]] const std::vector<int>& closed() const { return closed_; }
  /// Displacements at the last commit, in lanes, m.
  [[nodiscard]] const kernels::Array& position() const { return position_; }
  /// Energy of all tangential springs, J.
  [[nodiscard]] double spring_energy() const { return springs_; }

  /// Accepts a step: advances the memories of the closed contacts, lets those of the others die out, fills the friction and damper work
  /// and the sliding paths of the states, and the contacts that have opened. `motion` is that of the trial. No allocation.
  ContactLosses commit(const ContactMotion& motion, ContactTrial& trial);

  /// Accepts `steps` steps at once in which all contacts are open. No allocation.
  ContactLosses pass(const ContactMotion& motion, int steps, ContactTrial& trial) {
    trial.clear();
    const bool remembers = !(lanes_.places.empty() && remembering_.empty());
    const ContactLosses losses = remembers ? fade(steps, trial) : ContactLosses{};
    stand(motion);
    return losses;
  }

  /// Between flow and action: e_n to the springs of contacts that stick. `motion` is that before the action. No allocation.
  void follow(const ContactMotion& motion, double half_step);
  /// After the commit of an action, with the motion before it: what the next `follow` starts from. No allocation.
  void leave(const ContactMotion& motion, const ContactTrial& trial, double half_step);
  /// Whether contact c may make its step by itself: no other was closed at the last commit.
  [[nodiscard]] bool only(int c) const {
    return contacts_.in_lanes && (closed_.empty() || (closed_.size() == 1 && closed_.front() == c));
  }
  /// Follows contact c, finds its forces for the step and commits it. Where this cannot be done by itself only the trial has changed, which is of
  /// no use then. No allocation.
  /// @param push  of its last action; becomes that of this one
  kernels::LoneStep step_alone(int c, const ContactMotion& motion, const kernels::SweepRule& rule,
                               kernels::NormalPush& push, ContactTrial& trial);
  void visit(core::StateArchive& state) {
    state(entries_, lanes_, laws_, remembering_, closed_, position_, ahead_, springs_);
  }

private:
  struct Entry {
    contact::FrictionMemory friction;
    contact::Vec2 force;       ///< N, of the commit that left this
    double ny = 0.0, nz = 0.0; ///< normal then
    double left = 0.0; ///< share of the spring's force left since the contact opened; 0: nothing remembered
    contact::FrictionTable table{};
  };
  [[nodiscard]] static bool opposite(const Entry& e, double ny, double nz) {
    return e.left > 0.0 && e.ny * ny + e.nz * nz < 0.0;
  }
  [[nodiscard]] bool opposite_lane(int c, double ny, double nz) const {
    return lanes_[c].normal_y[kernels::lane(c)] * ny + lanes_[c].normal_z[kernels::lane(c)] * nz < 0.0;
  }
  ContactLosses fade(int steps, ContactTrial& trial);
  /// The contacts stand here at the last commit. A pack at a time: calls take longer than a few packs.
  void stand(const ContactMotion& motion) {
    const std::size_t stride = position_.size();
    const double* from = motion.u.data();
    double* to = position_.data();
    for (std::size_t i = 0; i < stride; i += kernels::lanes)
      std::memcpy(to + i, from + i, kernels::lanes * sizeof(double));
  }
  void commit_each(ContactTrial& trial, ContactLosses& losses);
  void commit_lanes(const ContactMotion& motion, ContactTrial& trial, ContactLosses& losses);
  void close(int c, ContactState& state, ContactLosses& losses);
  void relax(int c, ContactLosses& losses);
  void forget(int c, ContactLosses& losses);

  const PackedContacts& contacts_;
  std::vector<Entry> entries_; ///< their tables always, the rest where not in lanes
  kernels::MemoryLanes lanes_;
  kernels::LawLanes laws_;
  kernels::Places acting_;       ///< of a step whose contacts were not found in lanes
  std::vector<int> remembering_; ///< contacts with left > 0
  std::vector<int> closed_;      ///< with a force at the last commit
  kernels::Array position_;
  std::vector<contact::Vec2> ahead_; ///< m, dx - (h/2) v- of the last action, where not in lanes
  double springs_ = 0.0;
};

// Here, as the call of each step takes longer than what it does.
inline kernels::LoneStep ContactMemory::step_alone(int c, const ContactMotion& motion,
                                                   const kernels::SweepRule& rule, kernels::NormalPush& push,
                                                   ContactTrial& trial) {
  if (!(trial.opened.empty() && trial.active.size() == 1 && trial.active.front() == c)) {
    trial.clear();
    trial.active.push_back(c);
  }
  ContactState& state = trial.states[static_cast<std::size_t>(c)];
  const bool was_closed = !closed_.empty();
  kernels::LoneStep step =
      kernels::step_alone(c, rule, laws_, lanes_, motion, position_.data(), was_closed, push, state);
  if (!step.found)
    return step;
  trial.springs = step.springs;
  trial.cut = step.cut;
  trial.found_in_lanes = false;
  const kernels::PlaceList& places = lanes_.places;
  const bool listed = step.remembers ? acting_.all.few() && places.size() == 1 && places.front() == c
                                     : places.empty(); // as it is to be, and no other is remembered
  if (!listed) {
    const kernels::CommitSums others = kernels::fade_beside(acting_.all, c, laws_, lanes_);
    step.damping += others.damping;
    step.stored += others.stored;
  }
  springs_ += step.followed + step.stored;
  if (!(state.normal_force > 0.0)) {
    trial.active.clear();
    if (was_closed) {
      const auto at = motion.locate(c);
      state.approach = motion.sinking(c, at.ny, at.nz);
      trial.opened.push_back(c);
    }
    closed_.clear();
  } else if (!was_closed) {
    closed_.push_back(c);
  }
  stand(motion);
  return step;
}

} // namespace fretwork::transient
