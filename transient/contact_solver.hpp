// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contact forces that act at one instant for a whole step h, all contacts together: displacements are continuous and the velocity
/// jumps from v- to v+,
///     v+ = v- + h B^T f,    w = B (v- + v+)/2 = B v- + (h/2) W f,    W = B B^T
///     normal    p -+ theta h p'/2: mean penetration P over the step, its open part counted as 0 (theta =
///     0.7; p' from v-)
///               F_N = <K_N P + c(P) p'(w)>+     explicit in position, implicit in velocity
///     friction  step_friction with the mean velocity w, implicit
/// Found by Gauss-Seidel sweeps on w.
#pragma once
#include "transient/contact_memory.hpp"

namespace fretwork::transient {

class ContactSolver {
public:
  /// @param contacts  must live longer   @param step  s
  ContactSolver(const PackedContacts& contacts, double step);

  struct Action {
    double work = 0.0; ///< J, on the modes: h f.w
    double jump = 0.0; ///< J, h f.(w - B v-) = (h^2/2) f.W.f
    bool converged = true;
  };
  /// Forces at the displacements and velocities v- of `motion`, whose velocities become w. The memory is read only. No allocation.
  Action solve(const ContactMemory& memory, ContactMotion& motion, ContactTrial& trial);

private:
  /// What a shut contact needs in the step besides its state.
  struct Working {
    double mean = 0.0;      ///< mean penetration P, m
    double damped = 0.0;    ///< (h/2) n.W.n
    contact::Mobility slip; ///< (h/2) W in the tangent plane
    contact::FrictionMemory memory;
  };
  void meet(int c, const ContactMemory& memory, const ContactMotion& motion, ContactTrial& trial);
  [[nodiscard]] bool sweep(const ContactMemory& memory, ContactMotion& motion, ContactTrial& trial);
  [[nodiscard]] bool improve(int c, const contact::FrictionTable& table, ContactMotion& motion,
                             ContactState& state);
  [[nodiscard]] contact::Friction friction_of(int c, const contact::FrictionTable& table,
                                              const ContactMotion& motion, const ContactState& state,
                                              double normal_force) const;
  void change(int c, double normal, contact::Vec2 tangential, ContactMotion& motion,
              ContactState& state) const;
  void close(int c, const ContactMotion& motion, ContactTrial& trial, Action& action) const;
  [[nodiscard]] double jump(int c, const ContactMotion& motion, const ContactState& state) const;

  const PackedContacts& contacts_;
  double h_;
  std::vector<Working> working_;
  std::vector<int> shut_; ///< contacts that take part in this step
  kernels::Array before_; ///< velocities v-, in lanes
};

} // namespace fretwork::transient
