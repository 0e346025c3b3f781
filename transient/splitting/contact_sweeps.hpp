// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contacts over a step h of the splitting scheme: each moves through the step by itself (contact_step.hpp), one after the other, with the forces
/// of the others as linear functions of time, until none would answer what has changed since (Gauss-Seidel sweeps). A contact moves by
///     u(t) = path(t) + r(t),   r'' = W (f - held)
/// path: of the modes, the cubic through displacements and velocities at both ends of the step as they are under the forces `held` of the contacts
/// that were closed (constant over the step); r: what the change of forces adds, with the mobility W for which W f h^2/2 is the exact displacement
/// after a step under constant forces f. What rests stays at rest, whatever h: f = held then, and the path is constant.
///
/// With residual flexibility R (Scene::residual) contacts stand at u + sum of R f. Of its own each has that in series with its laws (SeriesLaws), the rest
/// of the sum moves it: that of the forces held is part of the motion that is given, that of f - held, linear in time, part of r.
///
/// W is known block by block (contact_blocks.hpp). Contacts that may be closed and share a block, directly or through others, make a group;
/// groups are swept apart, to a tolerance of the largest force of the step.
#pragma once
#include "transient/contacts/contact_blocks.hpp"
#include "transient/contacts/contact_motion.hpp"
#include "transient/contacts/contact_trial.hpp"
#include "transient/splitting/contact_step.hpp"

namespace fretwork::transient {

/// J over a step, >= 0 but for errors of the order of the scheme.
struct StepLosses {
  double damping =
      0.0; ///< normal and tangential dampers, what the positive part cuts, springs of open contacts
  double friction = 0.0; ///< Coulomb sliders
};

class ContactSweeps {
public:
  /// @param contacts  must live longer   @param mobility  W by blocks: of the block's contact `to` by a force on its contact `from` at
  ///   from * contacts of the block + to
  /// @param step  h, s   @param parts  of contact_step.hpp
  /// @param residual  R as Scene::residual; all contacts are in one block then
  ContactSweeps(const PackedContacts& contacts, ContactBlocks blocks,
                std::vector<std::vector<Response>> mobility, const Eigen::MatrixXd& residual, double step,
                int parts);

  /// From now on contact c moves in so many intervals a step, >= 1. No allocation.
  void divide(int c, int parts);
  /// All contacts are where those of `other` are, which has another step. No allocation.
  void follow(const ContactSweeps& other);
  /// Contacts that are pressed where they stand have been so before the run: they hold their normal forces. Moves those of `motion` by `add_shifts`.
  /// @param pressed  overwritten   @return energy of their springs, J
  double hold_at_start(ContactMotion& motion, std::vector<int>& pressed);
  /// Moves contacts by the residual flexibility under the forces held, as far as their laws do not. No allocation.
  void add_shifts(ContactMotion& motion) const;
  /// m: by how much more, in the mean over the last step that `make` made with the contact.
  [[nodiscard]] Components deflection(int c) const;
  /// Forces of a step. No allocation.
  /// @param start  motion at its start   @param end  at its end, under the forces held   @param near  contacts that may be closed in it, those
  ///   with a force held among them, by increasing number
  /// @param trial  overwritten   @return whether the sweeps settled
  bool make(const ContactMotion& start, const ContactMotion& end, const std::vector<int>& near,
            ContactTrial& trial, StepLosses& losses);
  /// After `make`, when the modes have taken the forces: the contacts stand here.
  void settle(const ContactMotion& end);
  /// Steps in which all contacts stay open. No allocation.
  void pass(int steps, ContactTrial& trial, StepLosses& losses);

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
  /// A quantity over a step, linear in time from mean - slope to mean + slope.
  struct Line {
    Components mean, slope;
    void add(const Response& r, const Line& l) {
      mean = mean + r * l.mean;
      slope = slope + r * l.slope;
    }
  };
  /// What forces give a contact in a step, by what they differ from those held.
  struct Given {
    Line acceleration; ///< m/s2, of the others
    Line shift;        ///< m, of all beyond its own laws
  };
  /// A contact in a step.
  struct Moving {
    int c;
    FreePath path;         ///< without its own force, the others with those held
    Given given, answered; ///< now, and when its force was found
    Line beyond;           ///< m: part of its own force in the shift
    Components shifted;    ///< m: at the end of the step, with that of the forces held
    ContactAct act;        ///< as it was found last
    int next;              ///< of its group; -1: none
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
  [[nodiscard]] const Response& residual(int to, int from) const {
    return residual_[static_cast<std::size_t>(to) * parts_.size() + static_cast<std::size_t>(from)];
  }
  void hold(int c, const contact::ContactAxes& axes, const Components& force);
  void find_shifts();
  [[nodiscard]] contact::Location locate_shifted(const ContactMotion& motion, int c) const;
  void shift_all(Moving& m, const Line& by);
  void find(Moving& m);
  [[nodiscard]] double unanswered(const Moving& m) const;
  bool sweep(int first, double largest);

  const PackedContacts& contacts_;
  ContactBlocks blocks_;
  std::vector<std::vector<Response>> mobility_; ///< by blocks
  std::vector<Response> own_;                   ///< of each contact by its own force
  std::vector<Response> residual_;              ///< `to` by `from`, row by row; empty: none
  std::vector<Components> shifts_,
      followed_; ///< m, with residual flexibility: by the forces held, beyond what the laws hold; as far as tangential springs have followed it
  double h_;
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
