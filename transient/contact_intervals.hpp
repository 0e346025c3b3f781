// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contacts over a step h of the splitting scheme. They move in equal intervals dt by
///     u(t) = path(t) + r(t),   r'' = W (f - held)
/// path: of the modes, the cubic through displacements and velocities at both ends of the step as they are under the forces `held` of the contacts
/// that were closed (constant over the step); r: what the change of forces adds, with the mobility W for which W f h^2/2 is the exact displacement
/// after a step under constant forces f. In each interval the forces are those of the laws (contact/normal_interval.hpp, contact/friction_interval.hpp, which
/// find events inside it), of all contacts together by Gauss-Seidel sweeps. The modes take their mean over the step and their first moment.
/// What rests stays at rest, whatever h: f = held then, and the path is constant.
/// A step in which a contact crosses much of its clearance is made in more intervals.
#pragma once
#include "contact/friction_interval.hpp"
#include "contact/normal_interval.hpp"
#include "transient/contact_motion.hpp"
#include "transient/contact_trial.hpp"

namespace fretwork::transient {

/// J over a step, >= 0 but for errors of the order of the scheme.
struct StepLosses {
  double damping =
      0.0; ///< normal and tangential dampers, what the positive part cuts, springs of open contacts
  double friction = 0.0; ///< Coulomb sliders
};

class ContactIntervals {
public:
  /// @param mobility  W, 1/kg, laid out as PackedContacts::mobility; both must live longer
  /// @param step  h, s   @param parts  intervals of a step, >= 1
  ContactIntervals(const PackedContacts& contacts, const kernels::Array& mobility, double step, int parts);

  /// Contact c has borne this force before the run.
  void hold(int c, const contact::Location& at, double normal_force);
  /// Forces of a step. No allocation.
  /// @param start  motion at its start   @param end  at its end, under the forces held   @param near  contacts that may be closed in it, those that
  ///   are in `touched` among them, by increasing number
  /// @param trial  overwritten   @return whether the sweeps settled
  bool make(const ContactMotion& start, const ContactMotion& end, const std::vector<int>& near,
            ContactTrial& trial, StepLosses& losses);
  /// After `make`, when the modes have taken the forces: the contacts stand here.
  void settle(const ContactMotion& end);
  /// Steps in which all contacts stay open. No allocation.
  void pass(int steps, ContactTrial& trial, StepLosses& losses);

  /// Contacts with a force at the end of the last step, by increasing number.
  [[nodiscard]] const std::vector<int>& closed() const { return closed_; }
  /// Of contact c over the last step `make` made with it, along y z x, N: linear in time from mean - slope to mean + slope.
  struct Force {
    double mean[3] = {}, slope[3] = {};
    double held[3] = {}; ///< for the next step: that of its last interval, 0 where it is open at the end
  };
  [[nodiscard]] const Force& force(int c) const { return entries_[c].force; }
  /// Energy of all springs, J.
  [[nodiscard]] double spring_energy() const { return normal_springs_ + tangential_springs_; }
  void visit(core::StateArchive& state) {
    state(entries_, closed_, loaded_, normal_springs_, tangential_springs_);
  }

private:
  /// What is remembered of a contact from step to step.
  struct Entry {
    contact::FrictionMemory friction;
    double ny = 0.0, nz = 0.0; ///< normal of its last force
    bool closed = false;       ///< at the end of the last step
    bool before_run = false;   ///< it has been closed since before the run: its impact is still to be counted
    double spring_at_opening = 0.0; ///< N2, square of the spring's force
    Force force;
  };
  /// What does not change.
  struct Law {
    double mobility = 0.0;       ///< 1/kg, the largest along any of its directions
    double answer = 0.0;         ///< kg: force that an acceleration of an interval is answered with
    double across = 0.0;         ///< 1/kg: acceleration along one of its directions by a force along another
    double normal_share = 0.5;   ///< beta of an interval
    contact::PieceTable piece{}; ///< of an interval
    contact::FrictionTable table{}; ///< likewise, for the memory `reference`
    double left = 0.0;              ///< of the spring of an open contact after an interval
  };
  /// A contact in a step.
  struct Moving {
    int c;
    double x0[3], v0[3], x1[3], v1[3]; ///< path at both ends of the interval, along y z x
    contact::Location from, to;        ///< where the contact is at both ends
    double ny, nz;                     ///< normal of the interval
    double push[3];                    ///< m/s2, W (f - held) of all when its force was found,
    double own_answer;                 ///< N, and what it has to answer of the change of its own force then
    double force[3], last[3];          ///< N, along y z x, over the interval and the one before
    contact::NormalInterval normal;
    contact::FrictionMemory memory; ///< at the end of the interval
    bool opened;                    ///< in some interval of the step
    contact::Vec2 friction, displacement;
    double friction_square, slider_work, damper_work, rubbed, slid, sliding_time;
  };
  /// Its motion over an interval without the change of its own force.
  struct Free {
    double moved[3], acceleration[3];
  };

  [[nodiscard]] double w(int c, int to, int from) const {
    return mobility_[static_cast<std::size_t>((c * 3 + from) * contacts_.stride() + to * contacts_.width +
                                              c)];
  }
  void set_interval(double dt);
  [[nodiscard]] int intervals(const ContactMotion& start, const ContactMotion& end,
                              const std::vector<int>& near) const;
  void follow(Moving& m, const ContactMotion& start, const ContactMotion& end, double share) const;
  void enter(int c, int parts, const ContactMotion& start, const ContactMotion& end);
  void guess(Moving& m);
  bool make_interval();
  [[nodiscard]] Free free_motion(const Moving& m) const;
  void improve(Moving& m);
  [[nodiscard]] double pushed_since(const Moving& m) const;
  double find_normal_force(Moving& m, const Free& free);
  void find_friction(Moving& m, const Free& free, double normal_change);
  void find_closed_friction(Moving& m, const Free& free, double normal_change,
                            contact::FrictionMemory memory);
  void finish(Moving& m, ContactState& state, double middle, double share);
  double relax(int c, double time);

  const PackedContacts& contacts_;
  const kernels::Array& mobility_;
  double h_, usual_dt_, dt_;
  int parts_;
  std::vector<Law> laws_;
  std::vector<Entry> entries_;
  std::vector<Moving> moving_;
  kernels::Array r_, rate_, push_;   ///< lanes: r, m; r', m/s; W (f - held), m/s2
  std::vector<int> closed_, loaded_; ///< loaded: whose tangential spring bears a force
  double normal_springs_ = 0.0, tangential_springs_ = 0.0;
};

} // namespace fretwork::transient
