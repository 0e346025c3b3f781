// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contact forces that act at one instant for a whole step h, all contacts together: displacements are continuous and the velocity
/// jumps from v- to v+,
///     v+ = v- + h B^T f,    w = B (v- + v+)/2 = B v- + (h/2) W f,    W = B B^T
///     normal    F_N = <F_K(p) + (s C_N + d F_K) p'(w)>+, p > 0 or s C_N > 0: explicit in position, implicit in velocity
///               F_K: contact::InstantSpring, by the mean of p' since the last action: at rest v- is what the forces take back, those of
///               other contacts too, and no approach; s: share of the step in which p -+ h p'/2 (p' from v-) is closed
///     friction  step_friction with the mean velocity w, implicit
/// Along the directions (n, t, x_loc) of the contacts, with the forces F of those that are shut and the velocities s of all,
///     s = s0 + A F,    s0 = d.B v-,    A = (h/2) d W d^T
/// solved by Gauss-Seidel sweeps, one contact at a time with the laws' own step forms, or by Jacobi sweeps, all at once in vector lanes
/// (contact_lanes.hpp), where these can be used and converge well; both from the friction of the last step. The sweeps stop when what is still to come (largest change r/(1 - r), r the ratio of the changes of two sweeps) is below 1e-6 of the largest
/// force the contact can bear, a thousandth of what the step itself leaves at its finest.
#pragma once
#include "transient/contact_memory.hpp"
#include <algorithm>

namespace fretwork::transient {

/// s: how long before and after an action contacts may close that it has to see: those with C_N.
[[nodiscard]] double half_window(const PackedContacts& contacts, double step);
/// ContactState::instant_share of a contact with the force `force` (> 0) whose spring bears `spring` over the step and `instant` at its
/// instant, N.
[[nodiscard]] inline double instant_share(double force, double spring, double instant) {
  return instant == spring ? 1.0 : std::max(0.0, 1.0 + (instant - spring) / force);
}

class ContactSolver {
public:
  /// @param contacts  must live longer   @param step  s
  ContactSolver(const PackedContacts& contacts, double step);

  struct Action {
    double work = 0.0; ///< J, on the modes: h f.w
    double jump = 0.0; ///< J, h f.(w - B v-) = (h^2/2) f.W.f
    bool converged = true;
  };
  /// Forces at the displacements and velocities v- of `motion`. The memory is read only. No allocation.
  /// @param trial  overwritten
  Action solve(const ContactMemory& memory, ContactMotion& motion, ContactTrial& trial);
  /// The same where the near contacts are found already.
  Action solve_near(const ContactMemory& memory, const ContactMotion& motion, ContactTrial& trial);
  /// s: how long before and after the action contacts may close that `solve` looks for.
  [[nodiscard]] double window() const { return rule_.half_window; }
  /// How contacts are solved in lanes.
  [[nodiscard]] const kernels::SweepRule& rule() const { return rule_; }

private:
  /// A contact that takes part in the step.
  struct Shut {
    int contact = 0;
    bool friction = false, in_plane = false, slides = false;
    double depth = 0.0;        ///< m: p where closed, else 0
    double closed = 0.0;       ///< share of the step with penetration
    double approach = 0.0;     ///< p' before the action, m/s
    double instant = 0.0;      ///< N, of contact::InstantSpring
    double force[3] = {};      ///< N, along n, t, x_loc
    double before[3] = {};     ///< m/s, s0
    double nn = 0.0, nt = 0.0; ///< own block of A
    contact::Mobility slip;    ///< own block of A in the tangent plane
    double nx = 0.0;           ///< own block of A
    contact::NormalStep normal;
    contact::LineStep line; ///< where friction acts on a line
    double per_normal = 0.0,
           per_friction = 0.0; ///< 1/N: one over the forces that changes are measured against
  };
  /// Returns whether the sweeps in lanes settled; if not, nothing is found yet.
  bool solve_in_lanes(const ContactMemory& memory, const ContactMotion& motion, ContactTrial& trial,
                      Action& action);
  void show_lane(int c, ContactTrial& trial) const;
  void meet(const ContactMotion& motion, ContactTrial& trial);
  void couple(const ContactMotion& motion);
  void prepare(const ContactMemory& memory, const ContactMotion& motion);
  [[nodiscard]] bool sweep(const ContactMemory& memory, const ContactMotion& motion);
  [[nodiscard]] double improve(std::size_t i, const ContactMemory& memory, const ContactMotion& motion);
  contact::Friction friction_in_plane(const Shut& s, double normal, const double* by,
                                      const ContactMemory& memory, const ContactMotion& motion) const;
  void change(std::size_t i, const double* by);
  void close(const ContactMotion& motion, ContactTrial& trial, Action& action) const;

  const PackedContacts& contacts_;
  kernels::SweepRule rule_;
  std::vector<Shut> shut_;
  kernels::LawLanes laws_;
  kernels::StepLanes lanes_;
  kernels::Array a_;        ///< A, of shut contact i from i * block_ on
  kernels::Array velocity_; ///< s, in lanes
  std::size_t block_;
};

} // namespace fretwork::transient
