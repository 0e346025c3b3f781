// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contacts over a step h of the splitting scheme: each moves through the step by itself (contact_step.hpp), one after the other, with the forces
/// of the others as linear functions of time, until none would answer what has changed since (Gauss-Seidel sweeps). What has changed little is answered to
/// first order (force_answer.hpp). A contact moves by
///     u(t) = path(t) + r(t),   r'' = W (f - held)
/// path: of the modes, the cubic through displacements and velocities at both ends of the step as they are under the forces `held` of the contacts
/// that were closed (constant over the step); r: what the change of forces adds, with the mobility W for which W f h^2/2 is the exact displacement
/// after a step under constant forces f. What rests stays at rest, whatever h: f = held then, and the path is constant.
///
/// W is known block by block (contact_blocks.hpp). Contacts that may be closed and share a block, directly or through others, make a group;
/// groups are swept apart, to a tolerance of the largest change of a force in the step.
#pragma once
#include "transient/contacts/contact_blocks.hpp"
#include "transient/contacts/contact_motion.hpp"
#include "transient/contacts/contact_trial.hpp"
#include "transient/splitting/contact_step.hpp"

namespace fretwork::transient {

class ContactSweeps {
public:
  /// @param contacts  must live longer   @param mobility  W by blocks: of the block's contact `to` by a force on its contact `from` at
  ///   from * contacts of the block + to
  /// @param step  h, s   @param parts  of contact_step.hpp
  /// @param tolerance  by it the sweeps stop, relative to the changes of forces; of contact_step.hpp
  ContactSweeps(const PackedContacts& contacts, ContactBlocks blocks,
                std::vector<std::vector<Mobility>> mobility, double step, int parts, double tolerance);

  /// From now on contact c moves in so many intervals a step, >= 1. No allocation.
  void divide(int c, int parts);
  /// All contacts are where those of `other` are, which has another step. No allocation.
  void continue_from(const ContactSweeps& other);
  /// Contact c has borne this force before the run.
  void preload(int c, const contact::Location& at, double normal_force);
  /// Forces of a step. No allocation.
  /// @param start  motion at its start   @param end  at its end, under the forces held   @param near  contacts that may be closed in it, those
  ///   with a force held among them, by increasing number
  /// @param trial  overwritten   @return whether the sweeps converged
  bool make(const ContactMotion& start, const ContactMotion& end, const std::vector<int>& near,
            ContactTrial& trial, ContactLosses& losses);
  /// After `make`, when the modes have taken the forces: the contacts stand here.
  void finish_step(const ContactMotion& end);
  /// Steps in which all contacts stay open. No allocation.
  void pass(int steps, ContactTrial& trial, ContactLosses& losses);

  /// Of contact c over the last step `make` made with it, along y z x, N: linear in time from mean - slope to mean + slope.
  struct Force {
    Components mean, slope;
    Components held; ///< for the next step: 0 where it is open at the end
  };
  [[nodiscard]] const Force& force(int c) const { return forces_[c]; }
  /// Energy of all springs, J.
  [[nodiscard]] double spring_energy() const { return normal_springs_ + tangential_springs_; }
  void visit(core::StateArchive& state);

private:
  /// A contact in a step.
  struct Moving {
    int c;
    FreePath path; ///< without its own force, the others with those held
    Components mean,
        slope; ///< m/s2: by what the others' forces differ from those held, linear in time from mean - slope to mean + slope
    Components found_for[2];    ///< these as they were when it was moved through the step
    Components answered_for[2]; ///< and when its force was found or changed last
    ContactAct act;             ///< as it was found last
    int next;                   ///< of its group; -1: none
  };
  /// Of the contacts that move in a step those of a block, and the group that it is part of.
  struct MovingBlock {
    std::vector<ContactBlocks::Place> contacts; ///< `block`: among moving_; `local`: in the block
    int parent = 0;            ///< a block of the same group; the block itself: it stands for the group
    int first = -1, last = -1; ///< of the group that it stands for
  };
  [[nodiscard]] int group_of(int block);
  void group();
  [[nodiscard]] Components of_lanes(const kernels::Array& lanes, int c) const;
  [[nodiscard]] FreePath path_of(int c, const ContactMotion& start, const ContactMotion& end) const;
  void find(Moving& m);
  bool answer(Moving& m);
  void pass_on(Moving& m, const Components& mean, const Components& slope);
  [[nodiscard]] double force_for(const Moving& m, const Components (&since)[2]) const;
  bool sweep(int first, double change, double force);

  const PackedContacts& contacts_;
  ContactBlocks blocks_;
  std::vector<std::vector<Mobility>> mobility_; ///< by blocks
  std::vector<Mobility> own_;                   ///< of each contact by its own force
  double h_, tolerance_;
  std::vector<ContactStep> steps_;
  std::vector<int> parts_; ///< of each contact
  std::vector<ContactPast> pasts_;
  std::vector<Force> forces_;
  std::vector<Moving> moving_;
  std::vector<char> moves_; ///< each contact: among moving_
  std::vector<MovingBlock> moving_blocks_;
  std::vector<int> touched_; ///< blocks with contacts that move
  std::vector<int> loaded_;  ///< whose tangential spring bears a force
  double normal_springs_ = 0.0, tangential_springs_ = 0.0;
};

} // namespace fretwork::transient
