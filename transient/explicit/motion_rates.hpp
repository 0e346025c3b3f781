// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The motion as one differential equation y' = f(t, y), for schemes that know nothing of contacts. A state y holds
///     q, v   modal displacements and velocities
///     s      contact by contact: T_x, T_t (N, the spring of the friction), friction work, damper work (J);
///            then the work of the loads and of moving obstacles (obstacle_motion.hpp), the integral of |its power|, the work of the
///            modal damping (J); with forces of motion (core/motion_forces.hpp) their work (J) and their states z
/// each padded to kernels::lanes, with the rates
///     q' = v,   v' = loads + B^T f - C v - k q + K_x q + C_x v + G z,   z' = R z + E v   (C the full damping matrix where there is one)
///     T' = -(K_T/C_T)(T - F)                     return_map with C_T > 0: -K_T v in stick, towards F in slip, dies out when open
///     T' = -K_T v while closed                   without C_T, and `reference`: in slip set to F by `commit`, once for every accepted
///                                                step; 0 when open
/// Powers of the friction element (T, C_T, slider): the spring and damper stretch at s' = (T - F)/C_T, the damper takes C_T s'^2, the
/// slider -F.(v - s'); of a spring that is set in `commit`, the element's whole power -F.v is shared out there.
///
/// Forces are those of the laws (normal_law.hpp, friction_law.hpp), or `located`: each contact keeps the branch of its regime (friction of `reference` excepted), smooth
/// across its bounds, so that a scheme sees smooth rates and finds by `margin` where a regime ends. A closed contact keeps its face, too: where
/// the opposite one is nearer, its penetration is negative and its regime over. A contact that opens does so at the force 0: what the state
/// at the event has above it is an error of the step, and does not count as a force that closes the contact again.
#pragma once
#include "transient/contacts/contact_motion.hpp"
#include "transient/contacts/contact_trial.hpp"
#include "transient/contacts/obstacle_motion.hpp"
#include "vibration/load_sum.hpp"
#include <cmath>
#include <limits>

namespace fretwork::transient {

/// The branch of its laws that a contact is on.
struct Regime {
  bool closed = false; ///< with a normal force
  bool slides = false;
  contact::ContactAxes axes; ///< of the face on which it is or was last closed
  double excess =
      0.0; ///< N: the least margin, if positive, of the accepted states since it has opened at an event
};

/// How far a contact is inside its laws' branches, N. Regimes end where a margin passes zero.
struct Margins {
  double normal; ///< > 0: closed; min(K_N p, K_N p + c p'), of an open contact less Regime::excess
  double
      friction; ///< > 0: slides; |trial| - bound. Without friction, and in stick of `reference`, -1; in its slip 1.
};

class MotionRates {
public:
  /// @param step  s: loads stand for a step about an instant (LoadSum); 0: for the instant itself
  MotionRates(const Scene& scene, double step);

  [[nodiscard]] int modes() const { return contacts_.padded_modes; }
  [[nodiscard]] int size() const {
    return 2 * modes() + kernels::padded(4 * contacts_.count + 3 + motion_values());
  }
  [[nodiscard]] const PackedContacts& contacts() const { return contacts_; }

  /// The state at t = 0, whose regimes are those of the laws.
  void start(double* y);
  /// Instants at and after `time` see the loads as they come to it from before: of a jump there the value before it.
  void take_loads_before(double time) { last_instant_ = std::nextafter(time, 0.0); }
  /// No allocation.
  void rate(double time, const double* y, double* rate);
  /// Accepts the state that `rate` was called for last: sets the springs that are set once a step, forgets those of the opposite face and
  /// takes over the regimes that are not located.
  void commit(double* y);
  /// Modal force of the loads at an instant, n values.
  void load_at(double time, double* force) { loads_.observe(time, force); }

  /// Adds the forces of a state that depend on its motion, n values.
  void add_motion_forces(const double* y, double* force) const;

  // Of the state that `rate` was called for last:
  [[nodiscard]] const ContactTrial& trial() const { return trial_; }
  [[nodiscard]] const ContactMotion& motion() const { return motion_; }
  [[nodiscard]] Energy energy(const double* y) const;
  /// Kinetic, strain and friction springs' energy, J.
  [[nodiscard]] double moving_energy(const double* y) const;
  /// sum (v^2 + k q^2) + |T|^2/K_T + K_N |u|^2 of closed contacts, J: how large a difference of two states is. No allocation.
  [[nodiscard]] double norm2(const double* difference);
  /// What contact c's dampers and slider have taken up to a state, J.
  [[nodiscard]] double friction_work(const double* y, int c) const { return springs(y)[4 * c + 2]; }
  [[nodiscard]] double damper_work(const double* y, int c) const { return springs(y)[4 * c + 3]; }
  /// Of that, energy of springs that the opposite face has forgotten, J: no impact lost it.
  [[nodiscard]] double forgotten(int c) const { return memory_[static_cast<std::size_t>(c)].forgotten; }

  /// Whether there is friction whose spring is set in `commit`, which changes the rates.
  [[nodiscard]] bool sets_springs() const;

  /// What carries contact c at a time, added to its lanes of a motion that has been gathered. No allocation.
  void carry(double time, int c, ContactMotion& motion) const { obstacles_.add(time, c, motion); }

  // Regimes:
  void locate_regimes(bool located) { located_ = located; }
  [[nodiscard]] Regime regime(int c) const { return regimes_[c]; }
  /// For the state that `rate` was called for last, as `set_regime`: contact c closes on a face, which without a gap need not be where the
  /// error of that state has it.
  void close(int c, const contact::ContactAxes& face);
  void set_regime(int c, bool closed, bool slides);
  /// The margins of contact c where `motion` has it, `spring` the T of the state.
  [[nodiscard]] Margins margin(int c, const ContactMotion& motion, contact::Vec2 spring) const;
  /// The regime that the laws give to contact c there.
  [[nodiscard]] Regime regime_of_laws(int c, const ContactMotion& motion, contact::Vec2 spring) const;
  [[nodiscard]] contact::Vec2 spring(const double* y, int c) const {
    return {springs(y)[4 * c], springs(y)[4 * c + 1]};
  }

  void visit(core::StateArchive& state) { state(motion_, trial_, regimes_, memory_, located_, position_); }

private:
  struct Memory {
    contact::Vec2 spring;      ///< N, T at the last commit
    contact::ContactAxes axes; ///< when it was last closed
    bool slid = false;         ///< then, at the last commit
    double forgotten = 0.0;    ///< J, of springs of opposite faces, part of the damper work
  };
  struct Normal {
    double penetration, rate, force;
  };
  [[nodiscard]] const double* springs(const double* y) const { return y + 2 * modes(); }
  [[nodiscard]] bool rated(int c) const;
  [[nodiscard]] bool touches(int c) const;
  /// N, of a contact that touches.   @param state  with its axes and its displacement since the last commit
  [[nodiscard]] contact::Vec2 stretched_since_touch(int c, const ContactState& state) const;
  [[nodiscard]] bool locates_friction(int c) const;
  [[nodiscard]] double closing_force(int c, const ContactMotion& motion, const contact::Location& at) const;
  [[nodiscard]] contact::Location face_of(int c, const ContactMotion& motion) const;
  [[nodiscard]] Normal normal_of(int c, const ContactMotion& motion, const contact::Location& at) const;
  [[nodiscard]] contact::Vec2 used_spring(int c, contact::Vec2 spring,
                                          const contact::ContactAxes& axes) const;
  void structure(const double* y, double* rate);
  [[nodiscard]] int motion_values() const {
    return system_.motion.empty() ? 0 : 1 + static_cast<int>(system_.motion.states());
  }
  void move_fluid(const double* y, double* rate);
  void act(const double* s, double* rate);
  bool press(int c, contact::Vec2 spring, double* rate);
  void rub(int c, contact::Vec2 spring, ContactState& state, double* rate) const;
  void set_spring(int c, double* s);

  vibration::System system_;
  vibration::LoadSum loads_;
  double smeared_;
  double last_instant_ = std::numeric_limits<double>::infinity(); ///< s, of loads
  PackedContacts contacts_;
  ContactMotion motion_, difference_;
  ObstacleMotion obstacles_;
  ImposedMotion imposed_;
  ContactTrial trial_;
  ContactRows rows_;
  std::vector<Regime> regimes_;
  std::vector<Memory> memory_;
  bool located_ = false, loaded_ = false;
  kernels::Array q0_, v0_, k_, c_, load_, position_;
};

} // namespace fretwork::transient
