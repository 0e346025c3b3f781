// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One contact over a step h of the splitting scheme, the forces of all others given. It moves by
///     u'' = a + j t + W F
/// a + j t: its acceleration along y, z, x without its own force; W: its mobility; F: its force, of the laws over intervals (contact/normal_interval.hpp,
/// contact/friction_interval.hpp). While the contact is open the time of its touch is found on that motion; from there to the end of the step it moves in
/// equal intervals. The modes take the mean of F over the step and its first moment.
#pragma once
#include "contact/friction_interval.hpp"
#include "contact/normal_interval.hpp"
#include "contact/support.hpp"
#include "transient/scheme.hpp"

namespace fretwork::transient {

/// A vector along y z x.
struct Components {
  double y = 0.0, z = 0.0, x = 0.0;
};
inline Components operator+(const Components& a, const Components& b) {
  return {a.y + b.y, a.z + b.z, a.x + b.x};
}
inline Components operator-(const Components& a, const Components& b) {
  return {a.y - b.y, a.z - b.z, a.x - b.x};
}
inline Components operator*(double s, const Components& a) { return {s * a.y, s * a.z, s * a.x}; }
inline double sum_of_sizes(const Components& c) { return std::abs(c.y) + std::abs(c.z) + std::abs(c.x); }

/// Acceleration of one contact by a force on another, or on itself: W, 1/kg, rows and columns y z x.
struct Mobility {
  double w[3][3] = {};
  [[nodiscard]] Components operator*(const Components& f) const {
    return {w[0][0] * f.y + w[0][1] * f.z + w[0][2] * f.x, w[1][0] * f.y + w[1][1] * f.z + w[1][2] * f.x,
            w[2][0] * f.y + w[2][1] * f.z + w[2][2] * f.x};
  }
};

/// Motion of a contact over a step without its own force: u + v t + a t^2/2 + j t^3/6.
struct FreePath {
  Components u, v, a, j;
};

/// What is remembered of a contact from step to step.
struct ContactPast {
  contact::FrictionMemory friction;
  double ny = 0.0, nz = 0.0; ///< normal of its last force
  bool closed = false;       ///< at the end of the last step
  bool before_run = false;   ///< it has been closed since before the run: its impact is still to be counted
  double spring_at_opening = 0.0; ///< N2, square of the spring's force
};

/// What a contact does in a step.
struct ContactAct {
  Components mean, slope;  ///< N: its force is linear in time from mean - slope to mean + slope
  Components last;         ///< N: in its last interval
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
  /// @param clearance  m, that is not to be passed unseen
  ContactStep(const contact::Support& support, const Components& rest, const Mobility& mobility,
              bool in_plane, double step, int parts, double clearance);

  /// From now on the contact moves in so many intervals, >= 1, where it is closed throughout a step. No allocation.
  void divide(int parts);
  /// Whether the contact can have a force in the step.
  [[nodiscard]] bool meets(const ContactPast& past, const FreePath& path) const;
  /// @param guess  N, its force at the start   @param act  overwritten. No allocation.
  void make(const ContactPast& past, const FreePath& path, const Components& guess, ContactAct& act) const;
  /// An open contact forgets over `time`. Returns what its spring gives up, J.
  double relax(ContactPast& past, double time) const;
  /// A spring that sticks is stretched by what the modes moved, not by what the step took them to move: it would creep.
  /// @param missed  m, what they moved further
  void stretch(ContactPast& past, const Components& missed) const;
  /// Energy of the tangential spring, J.
  [[nodiscard]] double spring_energy(const ContactPast& past) const;
  /// N: by how much its force can change for an acceleration of 1 m/s2 over the step.
  [[nodiscard]] double answer() const { return answer_; }

private:
  /// What the laws need of an interval of a given length.
  struct Interval {
    double length = 0.0;            ///< s
    double answer = 0.0;            ///< kg: force for an acceleration of 1 m/s2 over it
    double normal_share = 0.5;      ///< beta of normal_interval.hpp
    contact::PieceTable piece{};    ///< of friction_interval.hpp
    contact::FrictionTable table{}; ///< of the memory `reference`
  };
  struct Motion;  ///< where the contact is and what acts on it
  struct Pressed; ///< an interval with its forces
  [[nodiscard]] Interval interval(double length) const;
  [[nodiscard]] contact::Location locate(const Components& u) const {
    return contact::locate(obstacle_, u.y + rest_.y, u.z + rest_.z);
  }
  [[nodiscard]] int looks(const Components& velocity, double time) const;
  bool find_touch(Motion& m, ContactAct& act) const;
  void open(const Motion& m, ContactAct& act) const;
  [[nodiscard]] double pause(const Motion& m) const;
  void leave(Motion& m, double time, ContactAct& act) const;
  void press(const Motion& m, const ContactPast& past, const Interval& of, Pressed& p) const;
  void find_normal_force(const Motion& m, const Components& guessed, const Interval& of, Pressed& p) const;
  void find_friction(const Motion& m, const ContactPast& past, const Interval& of, Pressed& p) const;
  void find_closed_friction(const Motion& m, const Interval& of, Pressed& p) const;
  void book(Motion& m, const Interval& of, const Pressed& p, ContactAct& act) const;

  const contact::Obstacle& obstacle_;
  const contact::NormalLaw normal_;
  const contact::FrictionLaw friction_;
  Components rest_;
  Mobility w_;
  bool in_plane_;
  double h_;
  double mobility_; ///< 1/kg, the largest along any direction
  double across_;   ///< 1/kg: acceleration along one of its directions by a force along another
  double clearance_;
  double answer_; ///< kg, as `answer`
  Interval usual_;
};

} // namespace fretwork::transient
