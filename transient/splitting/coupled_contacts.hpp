// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contacts over a step h of the splitting scheme: all that may be closed move together through equal intervals of it (contact_interval.hpp). In each
/// interval one after the other finds its forces from those of the others as they are known or expected, and again where what the others have done since
/// would make it diverge, contacts of one node once for less. Contact i moves by
///     u_i(t) = path_i(t) + r_i(t),   r_i'' = sum over k of W_ik d_k - V_ik (integral of the impulses of d_k),   d_k = f_k - held_k
/// path: of the modes, the quartic with their mean through displacements and velocities at both ends of the step as they are under the forces `held` of
/// the contacts that were closed (constant over the step); r: what the change of forces adds, by the impulse response of step_response.hpp, whose displacement and velocity
/// after a step under constant forces are exact. Within an interval V acts by over(dt) and compliance(dt). What rests stays at rest, whatever h: f = held then, and the path is constant.
///
/// W is known block by block (contact_blocks.hpp). Contacts that may be closed and share a block, directly or through others, make a group, whose
/// intervals are those of its contact that asks for the most.
#pragma once
#include "transient/contacts/contact_blocks.hpp"
#include "transient/contacts/contact_motion.hpp"
#include "transient/contacts/contact_trial.hpp"
#include "transient/splitting/contact_interval.hpp"

namespace fretwork::transient {

/// Of all contacts over a step, under the forces held.
struct StepMotion {
  const ContactMotion &start, &end;
  const kernels::Array& bow; ///< m, lanes: by how much the mean exceeds that of the cubic through both ends
};

class CoupledContacts {
public:
  /// @param contacts  must live longer   @param responses  by blocks: of the block's contact `to` by a force on its contact `from` at
  ///   from * contacts of the block + to
  /// @param step  h, s   @param parts  intervals of a step, >= 1
  CoupledContacts(const PackedContacts& contacts, ContactBlocks blocks,
                  std::vector<std::vector<ImpulseResponse>> responses, double step, int parts);

  /// From now on contact c asks for so many intervals a step, >= 1. No allocation.
  void divide(int c, int parts) { parts_[static_cast<std::size_t>(c)] = parts; }
  /// All contacts are where those of `other` are, which has another step. No allocation.
  void continue_from(const CoupledContacts& other);
  /// Contact c has borne this force before the run.
  void preload(int c, const contact::Location& at, double normal_force);
  /// Forces of a step. No allocation.
  /// @param near  contacts that may be closed in it, those with a force held among them, by increasing number   @param trial  overwritten
  void make(const StepMotion& motion, const std::vector<int>& near, ContactTrial& trial,
            ContactLosses& losses);
  /// Whether contact c moved in the step; else it was taken to stay open.
  [[nodiscard]] bool moved(int c) const { return moves_[c] != 0; }
  /// The forces of that step once more, with contacts that stayed open in it and that the forces of the others have taken into their obstacles.
  /// No allocation.   @param pushed_in  these, which did not move   @param motion, near  as of `make`, with these
  void make_again(const StepMotion& motion, const std::vector<int>& near, const std::vector<int>& pushed_in,
                  ContactTrial& trial, ContactLosses& losses);
  /// After `make`, when the modes have taken the forces: the contacts stand here. The springs of those that stayed open relax.
  void finish_step(const ContactMotion& end, ContactLosses& losses);
  /// Displacements in the middle of the step of the contacts that have moved through its intervals, into lanes. No allocation.
  void place_in_middle(double* u) const;
  /// Steps in which all contacts stay open. No allocation.
  void pass(int steps, ContactTrial& trial, ContactLosses& losses);

  /// Of contact c over the last step `make` made with it, along y z x.
  struct Force : StepForce {
    Components held; ///< N, for the next step: 0 where it is open at the end
  };
  [[nodiscard]] const Force& force(int c) const { return forces_[c]; }
  /// Whether the forces of all contacts were found in the last step; else those of some kept on changing.
  [[nodiscard]] bool converged() const { return converged_; }
  /// Energy of all springs, J.
  [[nodiscard]] double spring_energy() const { return normal_springs_ + tangential_springs_; }
  void visit(core::StateArchive& state);

private:
  /// Of the contacts that move in a step those of a block, and the group that it is part of.
  struct MovingBlock {
    std::vector<Mobility> mobility, compliance; ///< as `responses`, over an interval
    std::vector<char> close; ///< pairs of contacts, as `responses`: their mobility is much of their own
    bool has_close = false;  ///< any
    int count = 0;           ///< of such a step
    bool holds_back = false; ///< V is not 0
    std::vector<ContactBlocks::Place> contacts; ///< `block`: among moving_; `local`: in the block
    int parent = 0;            ///< a block of the same group; the block itself: it stands for the group
    int first = -1, last = -1; ///< contacts of the group that it stands for, among moving_
  };
  /// What a step changed of a contact.
  struct Before {
    int number;
    ContactPast past;
    Components held;
  };
  void find_forces(const StepMotion& motion, const std::vector<int>& near, ContactTrial& trial,
                   ContactLosses& losses);
  void clear_moving();
  void finish_tangential_springs(int steps, ContactLosses& losses);
  [[nodiscard]] int group_of(int block);
  void group();
  [[nodiscard]] Components of_lanes(const kernels::Array& lanes, int c) const {
    const auto width = static_cast<std::size_t>(contacts_.width), lane = static_cast<std::size_t>(c);
    return {lanes[lane], lanes[width + lane], contacts_.components == 3 ? lanes[2 * width + lane] : 0.0};
  }
  [[nodiscard]] FreePath path_of(int c, const StepMotion& motion) const;
  [[nodiscard]] const IntervalTable& table_of(int c, int count);
  void move(int first, ContactTrial& trial);
  void find_forces_together(int first, int index);
  double find_force(MovingContact& m, int index, int place);
  [[nodiscard]] bool has_close(const MovingContact& m) const;
  void move_in_intervals_of(int block, int count);
  void hold_back(int first, double dt);
  void pass_on(const MovingContact& m, const Components& by_force, const Components& by_growth);
  template <class Add> void hold_back_others(const MovingContact& m, double dt, const Add& add);
  template <class Add>
  void push_others(const MovingContact& m, const Components& by_force, const Components& by_growth,
                   const Add& add);

  const PackedContacts& contacts_;
  ContactBlocks blocks_;
  std::vector<std::vector<ImpulseResponse>> responses_; ///< by blocks
  double h_;
  std::vector<ContactIntervals> laws_; ///< of each contact
  std::vector<IntervalTable> tables_;  ///< of the intervals that it moved in last
  std::vector<int> parts_;             ///< that it asks for
  std::vector<ContactPast> pasts_;
  std::vector<Force> forces_;
  std::vector<MovingContact> moving_;
  std::vector<int> counts_;           ///< of intervals that these ask for
  std::vector<int> next_;             ///< of their group; -1: none
  std::vector<ContactCourse> before_; ///< of these before the interval
  std::vector<Components> found_for_; ///< m/s2: the others' changes for which their forces were found
  std::vector<char> moves_;           ///< each contact: among moving_
  std::vector<int> pushed_in_;        ///< of the step
  std::vector<Before> before_step_;
  std::vector<MovingBlock> moving_blocks_;
  std::vector<int> touched_; ///< blocks with contacts that move
  double normal_springs_ = 0.0, tangential_springs_ = 0.0;
  bool converged_ = true;
};

} // namespace fretwork::transient
