// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Friction of a step h that keeps the energy, constant over the step, from the tangential displacement dx over it, in continuous pieces
/// that Newton's method can follow (conserving_contacts.hpp), and what the tangential spring does meanwhile.
///
/// The law acts while the contact is closed, over the share s of the step in which the penetration, linear between its ends, is positive. Before a
/// contact closes its spring dies out, T_a = T exp(-(1 - s) K_T h/C_T). The mean force over the step is that at the middle of the closed part:
///     w = s (T_a - (s K_T/2 + C_T/h) dx),    |w| <= mu F_N: F = w (stick),    else: F = mu F_N w/|w| (slip)
/// with F_N the mean normal force over the step. In stick F is the exact mean of the law along a uniform motion.
///
/// The spring at the end of the closed part, with F^ = F/s, dx^ = s dx, k = s K_T h/C_T and r = exp(-k):
///     stick   T_1 = T_a - K_T dx^, its excess over mu F_N1 reduced by the share g
///     slip    T_1 = (1 - r) F^ + r T_a + g (F_1 - F^),   g = 1 + r - 2 (1 - r)/k
/// the solution of T' = -(K_T/C_T)(T - F) for a force that is linear in time, F^ in the middle and F_1 at the end. g is 1 for C_T = 0, where T is
/// the force, and k^2/6 for small k. F_1 has the length mu_d F_N1 of the end of the step. Its direction is that of C_T = 0 under a uniform motion with
/// the bound b = |F^|: straight up to the bound, then along it, phi being the angle between the trial T_a - C_T dx/h and -dx,
///     T' = -K_T (v - v_s), v_s opposite to T, |T| = b:   phi' = -(K_T |v|/b) sin phi,   tan(phi_1/2) = tan(phi_0/2) exp(-K_T |dx|/b).
/// Where the slider would move with the force it rests and T_1 is that of stick (contact/friction_law.hpp).
/// Order 2 for every C_T >= 0. Slider and damper never give energy: T_1 is shortened where they would.
/// The path with friction at its bound is that share of dx in which |T - C_T dx/h| - mu F_N, taken as linear in time, is positive.
#pragma once
#include "transient/contacts/friction_memories.hpp"

namespace fretwork::transient {

/// The part of a step in which a contact is closed.
struct ClosedPart {
  double share = 1.0;           ///< of the step, > 0, <= 1
  bool starts_open = false;     ///< closed at the end of the step only; else closed at its start
  bool slides_at_touch = false; ///< FrictionLaw::slides_at_touch, of one that starts open
};

/// Friction with its derivatives by displacement over the step, normal force and, where it is given by itself, force.
struct StepFriction {
  contact::Vec2 force;
  contact::Sym2 by_displacement;
  contact::Vec2 by_normal;
  contact::Sym2 by_force;
  contact::Vec2 by_share;
  bool slides;
};

/// Along the trial w with one coefficient: continuous.
/// @param spring  T at the start of the step, N   @param normal  mean over the step, N
[[nodiscard]] StepFriction along_trial(const contact::FrictionLaw& law, contact::Vec2 spring,
                                       double coefficient, double normal, contact::Vec2 dx, double h,
                                       ClosedPart part = {});

/// P(force - rho dx), P onto |F| <= mu_d F_N: opposite to dx, or whatever stops it. For `reference` slip.
[[nodiscard]] StepFriction opposing(const contact::FrictionLaw& law, double rho, double normal,
                                    contact::Vec2 dx, contact::Vec2 force);

/// Closes a step with the force of `along_trial`. `return_map` only.
/// @param memory  at the start of the step   @param normal, end_normal  F_N, mean over the step and at its end, N
[[nodiscard]] ClosedStep close_part(const contact::FrictionLaw& law, const contact::FrictionMemory& memory,
                                    contact::Friction friction, double normal, double end_normal,
                                    contact::Vec2 dx, double h, ClosedPart part);

} // namespace fretwork::transient
