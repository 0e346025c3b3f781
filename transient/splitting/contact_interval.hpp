// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One contact over an interval dt of a step of the splitting scheme. It moves by
///     u(t) = path(t) + r(t),   r'' = W (f - held) + what the others' forces differ from those held - what the modes hold back of all these by V
/// path: of the modes under the forces held; f: its force. At its mean position, under the force that is expected of it, stand its normal and the mean of its
/// penetration, a cubic in time (doc/schemes.md, Turning normal). An open contact closes where this becomes positive, a closed one opens where
/// its force ends; its laws (contact/normal_interval.hpp, contact/friction_interval.hpp) hold between.
#pragma once
#include "contact/friction_interval.hpp"
#include "contact/normal_interval.hpp"
#include "contact/support.hpp"
#include "contact/turning_normal.hpp"
#include "transient/scene/scheme.hpp"
#include "transient/splitting/components.hpp"
#include "transient/splitting/passage.hpp"
#include <array>

namespace fretwork::transient {

/// Motion over a step: u + v t + a t^2/2 + j t^3/6 + b t^2 (1 - x)^2/2,   x = t/h. The last part, with displacement and velocity 0 at both ends, has the mean
/// b h^2/60.
struct FreePath {
  Components u, v, a, j;
  Components b = {};
  double per_step = 0.0; ///< 1/h
  [[nodiscard]] Components displacement(double time) const {
    const double left = 1.0 - per_step * time;
    return u + time * (v + 0.5 * time * (a + (time / 3.0) * j + (left * left) * b));
  }
  [[nodiscard]] Components velocity(double time) const {
    const double x = per_step * time;
    return v + time * (a + 0.5 * time * j + ((1.0 - x) * (1.0 - 2.0 * x)) * b);
  }
  /// Mean over an interval about the middle at `time`, a share of the step long.
  [[nodiscard]] Components acceleration(double time, double share) const {
    const double x = per_step * time;
    return a + time * j + (1.0 - 6.0 * x * (1.0 - x) + 0.5 * share * share) * b;
  }
  /// m: what the mean of an interval, a share of the step long, exceeds that of the cubic with these by.
  [[nodiscard]] Components lift(double length, double share) const {
    const double by = share * length;
    return (by * by / 60.0) * b;
  }
  /// Slope of the acceleration there, which gives the interval its displacement.
  [[nodiscard]] Components jerk(double time) const {
    return j + (6.0 * per_step * (2.0 * per_step * time - 1.0)) * b;
  }
};

/// What is remembered of a contact from step to step.
struct ContactPast {
  contact::FrictionMemory friction;
  contact::ContactAxes axes; ///< of its last force
  bool closed = false;
  bool before_run = false; ///< it has been closed since before the run: its impact is still to be counted
  double spring_at_opening = 0.0; ///< N2, square of the spring's force
  Components rise;                ///< N/s, of its force in its last interval, where it was closed throughout
};

/// A force over a step, N: mean + slope x + b_0 (3 x^2 - 1)/2 + b_1 (5 x^3 - 3 x)/2 with x from -1 to 1, its part by Legendre's polynomials up to degree 3.
struct StepForce {
  Components mean, slope;
  std::array<Components, 2> bends;
};

/// What a contact has done in a step so far: all that ContactIntervals::find_force adds to from interval to interval. Whoever puts it back finds the
/// forces of the interval again.
struct ContactCourse {
  StepForce force;         ///< over the step
  ContactState state;      ///< over the step
  ContactPast past;        ///< now
  double relaxed = 0.0;    ///< J, given up by its tangential spring while it was open
  bool opened = false;     ///< within the step
  bool penetrates = false; ///< it may be in its obstacle at the end, free of force or not
};

/// Intervals of a step in which a contact meets a corner of its obstacle, at most.
inline constexpr int most_at_corner = 128;

/// A contact on its way through a step.
struct MovingContact {
  int number = 0;           ///< of the contact
  bool throughout = false;  ///< it has been closed throughout the interval
  bool is_close = false;    ///< another contact moves with it that shares much of its mobility
  double penetration = 0.0; ///< m, the largest at the ends of the interval
  FreePath path;            ///< of the modes, under the forces held
  ForcePiece piece;         ///< of the interval; of no length: the contact is open
  ContactCourse course;
  Components response, rate; ///< m, m/s: r and r' at the start of the next interval
  Components middle;         ///< m: r in the middle of the step
  Components others_lift,
      others_lift_growth; ///< m: Y times mean and growth, over an interval, of the forces of others that are close
  Components others,
      others_growth; ///< m/s2: by what the forces of the others differ from those held, mean and growth over an interval
  Components held_back,
      held_back_rate; ///< m/s2, m/s3: at the start of the next interval, of the acceleration by the forces since the start of the step
  /// N: of an interval, as they are expected or found: the mean, and how much a linear force with its mean and first moment grows
  Components force, growth;
  Components last;                         ///< N: its force at the end of an interval
  Components by_force, by_growth, by_held; ///< m/s2: W force, W growth, W held
  Components held;                         ///< N
  /// m/s2, over the next interval: what all but its own force there, and what is held, accelerate it by; mean and growth.
  [[nodiscard]] Components others_over(double dt) const {
    return others - held_back - (0.5 * dt) * held_back_rate;
  }
  [[nodiscard]] Components others_growth_over(double dt) const { return others_growth - dt * held_back_rate; }
};

/// What the laws need of an interval of a given length.
struct IntervalTable {
  int count = 0;                  ///< intervals of a step
  double length = 0.0;            ///< dt, s
  double share = 1.0;             ///< of a step
  Mobility w;                     ///< 1/kg, over(dt)
  Mobility compliance;            ///< m/N, Y
  double mobility = 0.0;          ///< 1/kg, the largest along any direction
  double friction_mobility = 0.0; ///< 1/kg, the largest along those in which friction acts
  double growing = 0.0;           ///< N s/m, c' of normal_interval.hpp
  double sliding_mass =
      0.0; ///< kg: force for an acceleration of 1 m/s2 over it, of a contact that slides; of one that sticks:
  double mass_across = 0.0, mass_along = 0.0; ///< across x_loc and along it
  double spring_left = 0.0;                   ///< share of an open contact's spring after the interval
  contact::PieceTables pieces{};
  contact::FrictionTable reference{}; ///< of that memory
};
/// 1/s: damping times mobility, along the normal and tangential.
struct DamperRates {
  double normal = 0.0, tangential = 0.0;
  double by_penetration = 0.0; ///< 1/(m s): of Hunt and Crossley's dampers, K_N d times mobility
  [[nodiscard]] double normal_at(double penetration) const { return normal + by_penetration * penetration; }
};

class ContactIntervals {
public:
  /// @param support  must live longer   @param rest  of the contact without displacement, m
  /// @param in_plane  friction acts along x too   @param step  h, s   @param clearance  m, that is not to be passed unseen
  /// @param rates  of all contacts whose forces move it
  ContactIntervals(const contact::Support& support, const Components& rest, const ImpulseResponse& own,
                   bool in_plane, double step, double clearance, const DamperRates& rates);

  [[nodiscard]] IntervalTable table(int count) const;
  /// How many intervals of a step a contact needs at least: for its speed, for a damper that grows with the penetration, and where it meets a corner or
  /// another side.
  /// @param parts  that it has anyway
  [[nodiscard]] int least_count(int parts, const ContactPast& past, const FreePath& path) const;
  /// Whether it can have a force in the step.   @param count  of places at which it is looked for
  [[nodiscard]] bool may_close(const ContactPast& past, const FreePath& path, int count) const;
  /// At the start of a step.   @param held  N
  void begin(MovingContact& m, const Components& held, const IntervalTable& table) const;
  /// The accelerations by its own force, which has been found or is expected.
  static void apply_own_force(MovingContact& m, const IntervalTable& table);
  /// Its force over the interval `index` of the step, the others' given. No allocation.
  void find_force(MovingContact& m, const IntervalTable& table, int index) const;
  /// Keeps r a time after the start of the interval, under all forces as they were found, as that of the middle of the step.
  static void keep_middle(MovingContact& m, const IntervalTable& table, double time);
  /// To the end of the interval, under all forces as they were found. Those of the others are expected to grow on.
  void move(MovingContact& m, const IntervalTable& table) const;
  /// N: about what its force would change by for a further acceleration, m/s2.
  [[nodiscard]] double force_change(const MovingContact& m, const IntervalTable& table,
                                    const Components& by) const;
  /// N: what the modes bear of its force over the next step before its forces there are found: it goes on as it ends. Of forces of dampers that stop contacts,
  /// normal ones and those of friction that sticks, the mean does: they stop them early in a step, and the linear force of that impulse ends opposite to it.
  [[nodiscard]] Components held(const MovingContact& m) const {
    if (!m.course.past.closed)
      return {};
    const bool friction_stops = stops(rates_.tangential) && !m.course.past.friction.sliding,
               normal_stops = stops(rates_.normal_at(m.penetration));
    return friction_stops || normal_stops ? with_means(m, normal_stops, friction_stops) : m.last;
  }
  /// What is expected of its force in the next interval: it grows on where the contact has been closed throughout, and stays else.
  static void extrapolate(MovingContact& m, const IntervalTable& table);
  /// An open contact forgets over so many whole steps. Returns what its spring dissipates, J.
  double relax(ContactPast& past, int steps) const;
  /// A spring that sticks is stretched by what the modes moved, not by what the step took them to move: it would creep.
  /// @param missed  m, what they moved further
  void correct_spring_drift(ContactPast& past, const Components& missed) const;

private:
  /// r h of dampers that stop a contact early in a step, above.
  static constexpr double stopping = 1.0;

  struct Motion;
  struct NormalForce;
  [[nodiscard]] bool stops(double rate) const { return rate * h_ > stopping; }
  [[nodiscard]] contact::Location locate(const Components& u) const {
    return contact::locate(obstacle_, u.y() + rest_.y(), u.z() + rest_.z());
  }
  /// kg: force of a spring and a damper for an acceleration of 1 m/s2 over an interval
  [[nodiscard]] static double apparent_mass(double length, double mobility, double stiffness, double damping);
  /// N: its last force, the normal part and friction at their means where asked for.
  [[nodiscard]] static Components with_means(const MovingContact& m, bool of_normal, bool of_friction);
  [[nodiscard]] int intervals_at_side(int parts, double way) const;
  [[nodiscard]] int intervals_for_dampers(const FreePath& path) const;
  [[nodiscard]] bool may_turn(const ContactPast& past, const FreePath& path, double way) const;
  [[nodiscard]] bool meets_corner(const FreePath& path) const;
  [[nodiscard]] bool rolls_round(const Motion& a, double dt) const;
  [[nodiscard]] double curvature(const Components& u) const {
    return contact::curvature(obstacle_, u.y() + rest_.y(), u.z() + rest_.z());
  }
  /// J: what its normal spring gives up between two penetrations while no force acts.
  [[nodiscard]] double released(double from, double to) const {
    return normal_.spring_energy(from) - normal_.spring_energy(to);
  }
  /// The spring of an open contact keeps this share. Returns what it dissipates, J.
  double relax_to(ContactPast& past, double share) const;
  /// Share of the spring of a contact that has been open for so long, s.
  [[nodiscard]] double spring_left(double time) const;
  [[nodiscard]] Motion motion_of(const MovingContact& m, const IntervalTable& table, int index) const;
  [[nodiscard]] static double touch_after(const Motion& a, double guess, double dt);
  [[nodiscard]] double time_of_closing(const Motion& a, bool closed, double dt) const;
  [[nodiscard]] static double deepest_of(double p0, double v0, double p1, double v1, double time);
  [[nodiscard]] NormalForce find_normal_force(const Motion& a, bool closed, const IntervalTable& table) const;
  void record(Passage passage, const NormalForce& n, const IntervalTable& table, int index,
              ContactCourse& course) const;
  void add_force(Passage passage, const Motion& motion, const NormalForce& n, const IntervalTable& table,
                 int index, MovingContact& m) const;
  static void rotate_force(const Motion& a, const NormalForce& n, double dt, MovingContact& m);
  void find_friction(Passage passage, const Motion& a, const NormalForce& n, const IntervalTable& table,
                     MovingContact& m) const;
  template <class V, class Friction>
  void set_friction(ForcePiece& piece, const contact::FrictionMemory& start, const Friction& f,
                    V velocity) const;
  template <class Path, class Friction>
  void add_friction(const Motion& a, const NormalForce& n, const IntervalTable& table, const Friction& f,
                    const Path& path, MovingContact& m) const;

  const contact::Obstacle& obstacle_;
  const contact::NormalLaw normal_;
  const contact::FrictionLaw friction_;
  Components rest_;
  ImpulseResponse own_;
  bool in_plane_, has_corners_, has_sides_;
  double h_, clearance_;
  double spring_left_; ///< share of an open contact's spring after a step
  DamperRates rates_;
  bool beside_fast_structure_; ///< it has friction, and modes as fast as the step
};

} // namespace fretwork::transient
