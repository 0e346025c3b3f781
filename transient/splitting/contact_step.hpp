// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One contact over a step h of the splitting scheme, the forces of all others given. It moves by
///     u'' = a + j t + W F
/// a + j t: its acceleration along y, z, x without its own force; W: its mobility; F: its force, of the laws over intervals (contact/normal_interval.hpp,
/// contact/friction_interval.hpp). While the contact is open the time of its touch is found on that motion; from there to the end of the step it moves in
/// intervals, equal ones but where the contact opens or its normal turns far. The modes take the mean of F over the step and its first moment.
#pragma once
#include "transient/scene/scheme.hpp"
#include "transient/splitting/contact_interval.hpp"

namespace fretwork::transient {

/// Motion of a contact over a step without its own force: u + v t + a t^2/2 + j t^3/6.
struct FreePath {
  Components u, v, a, j;
};

/// What a contact does in a step.
struct ContactAct {
  Components mean, slope;  ///< N: its force is linear in time from mean - slope to mean + slope
  Components last;         ///< N: at the end of its last interval
  Components end;          ///< m: where it is at the end
  bool penetrates = false; ///< there, though it may be free of force
  double relaxed = 0.0;    ///< J, given up by its tangential spring while it was open
  bool opened = false;     ///< within the step
  ContactState state;
  ContactPast past; ///< at the end
};

class ContactStep {
public:
  /// @param support  must live longer   @param rest  of the contact without displacement, m
  /// @param in_plane  friction acts along x too   @param step  h, s   @param parts  intervals of a step in which the contact is closed, >= 1
  /// @param clearance  m, that is not to be passed unseen   @param tolerance  of contact_interval.hpp
  ContactStep(const contact::Support& support, const Components& rest, const Mobility& mobility,
              bool in_plane, double step, int parts, double clearance, double tolerance);

  /// From now on the contact moves in so many intervals, >= 1, where it is closed throughout a step. No allocation.
  void divide(int parts);
  /// Whether the contact can have a force in the step.
  [[nodiscard]] bool meets(const ContactPast& past, const FreePath& path) const;
  /// @param guess  N, its force at the start   @param act  overwritten. No allocation.
  void make(const ContactPast& past, const FreePath& path, const Components& guess, ContactAct& act) const;
  /// Whether the contact was closed once at most, and stuck or slid one way while it was: such a contact answers changes in proportion.
  [[nodiscard]] bool in_one_state(const ContactAct& act) const;
  /// The force of a contact that has been found where the others move it otherwise than it was found for: to first order (force_answer.hpp), without what W
  /// moves across. Of its state the normal force, friction in proportion to it and their squares and works follow; the rest stays as found. No allocation.
  /// @param mean, slope  m/s2, of what has changed since, linear in time from mean - slope to mean + slope
  /// @return false: the change is too large for it, or friction has the memory `reference`; nothing has been changed
  [[nodiscard]] bool answer(const Components& mean, const Components& slope, ContactAct& act) const;
  /// An open contact forgets over `time`. Returns what its spring dissipates, J.
  double relax(ContactPast& past, double time) const { return intervals_.relax(past, time); }
  /// A spring that sticks is stretched by what the modes moved, not by what the step took them to move: it would creep.
  /// @param missed  m, what they moved further
  void stretch(ContactPast& past, const Components& missed) const;
  /// N: by how much its force can change for an acceleration of 1 m/s2 over the step.
  [[nodiscard]] double apparent_mass() const { return apparent_mass_; }

private:
  [[nodiscard]] int gap_samples(const Components& velocity, double time) const;
  bool find_touch(ContactPath& m, ContactAct& act) const;
  void open(const ContactPath& m, ContactAct& act) const;
  [[nodiscard]] double pause(const ContactPath& m) const;
  void leave(ContactPath& m, double time, ContactAct& act) const;
  void finish_interval(ContactPath& m, const IntervalTable& of, const IntervalForces& p,
                       ContactAct& act) const;

  const contact::NormalLaw normal_;
  const contact::FrictionLaw friction_;
  bool in_plane_;
  double h_, clearance_;
  ContactIntervals intervals_;
  double apparent_mass_; ///< kg, as `apparent_mass`
};

} // namespace fretwork::transient
