// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Obstacles that move by themselves while the modes are counted from the base: a contact's node moves by
///     u = b q + imposed s(t),    u' = b q' + imposed s'(t)
/// from its obstacle, in the contact's local axes. An obstacle that stays in space while the base moves by s along d has
/// imposed = d. What it does on the structure is work from outside: each second, with the force f on the node, -f.(imposed s').
#pragma once
#include "signals/prescribed_motion.hpp"
#include "transient/contacts/contact_motion.hpp"
#include "transient/contacts/contact_trial.hpp"

namespace fretwork::transient {

/// By how much and how fast imposed motions move the contacts at an instant, lanes of PackedContacts. Empty: not at all.
struct ImposedMotion {
  kernels::Array u, w; ///< m, m/s
  void add_to(double* displacement, double* velocity) const {
    for (std::size_t lane = 0; lane < u.size(); ++lane) {
      displacement[lane] += u[lane];
      velocity[lane] += w[lane];
    }
  }
  void add_to(ContactMotion& motion) const { add_to(motion.u.data(), motion.w.data()); }
};

class ObstacleMotion {
public:
  /// @param contacts  those of the scene, must live longer
  ObstacleMotion(const Scene& scene, const PackedContacts& contacts);
  /// Room for `at`: empty where nothing moves.
  [[nodiscard]] ImposedMotion workspace() const;
  /// At a time. No allocation.
  void at(double time, ImposedMotion& imposed) const;
  /// The contacts where modes q, v have them at a time, `imposed` included. No allocation.
  void place(double time, const double* q, const double* v, ImposedMotion& imposed,
             ContactMotion& motion) const;
  /// What `at` gives for contact c alone, added to its lanes of a motion. No allocation.
  void add(double time, int c, ContactMotion& motion) const;

private:
  /// move(lanes, displacement, velocity) for all that moves contacts.
  template <class Move> void each(double time, const Move& move) const;

  const PackedContacts& contacts_;
  std::vector<signals::MotionSignal> signals_;
  kernels::Array imposed_; ///< lanes of each motion, one after the other
};

} // namespace fretwork::transient
