// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Coulomb friction with a tangential spring and damper and memory. All vectors have two components in the
/// contact's tangent plane, along x_loc and t = n x x_loc: a memory kept in these components turns with the
/// normal when the contact point moves round its obstacle.
///
/// `return_map`: a Kelvin-Voigt element (K_T, C_T) in series with a Coulomb slider. The memory T is the force
/// of the spring.
///     trial = T - C_T v;  bound = (sliding ? mu_d : mu_s) F_N
///     |trial| <= bound: F = trial (stick)          else: F = mu_d F_N trial/|trial| (slip)
///     stick: T' = -K_T v;  slip and open: T' = -(K_T/C_T)(T - F), F = 0 when open.
///   In stick it is the reference's law; in slip T relaxes to F instead of being set to it, so that the force
///   is continuous in time and every scheme converges to the same result.
/// `reference`: R5.06.03 eq. 3.2-3 and 3.2-4 to the letter. F0, d0 = force and position at which the contact
/// last slid (0 when open):
///     trial = F0 - K_T (d - d0) - C_T v;   |trial| > bound: F = -mu_d F_N v/|v| (v = 0: along the trial);
///     open: memory 0.
///   The spring is set, so its energy jumps by (|F|^2 - |T|^2)/(2 K_T) in a slip that no work pays for. It is
///   booked with the damper, whose work is negative where |F| > |T|: where C_T v tips a contact into slip or
///   the normal force of a slip rises.
///
/// Friction along x_loc alone, or across it alone (`along`): every function takes what moves in the other
/// direction as 0, so that force and memory stay exactly 0 there.
/// The memory changes only when a step is accepted: every function here is pure.
#pragma once
#include "contact/plane.hpp"

namespace fretwork::contact {

enum class FrictionMemoryKind { return_map, reference };

/// Friction at an instant, N. V: Vec2, or a number along t.
template <class V> struct BoundedForce {
  V force;
  bool slides;
};

struct FrictionLaw {
  double stiffness = 0.0;  ///< K_T, N/m, > 0 with friction
  double damping = 0.0;    ///< C_T, N s/m, >= 0
  double mu_static = 0.0;  ///< >= mu_dynamic
  double mu_dynamic = 0.0; ///< >= 0; 0: no friction
  FrictionMemoryKind kind = FrictionMemoryKind::return_map;
  Vec2 along{1.0, 1.0}; ///< directions in which friction acts, 1 or 0 each: (1, 1) the tangent plane, (1, 0)
                        ///< along x_loc only, (0, 1) across it only

  [[nodiscard]] bool active() const { return mu_static > 0.0; }
  [[nodiscard]] double coefficient(bool sliding) const { return sliding ? mu_dynamic : mu_static; }
  /// Of a contact that touches: it slides at once where spring and damper would bear more than the bound, and then up to the dynamic bound.
  /// Without damper its spring is slack: it sticks.   @param normal_force  N, at the touch   @param trial  N, the trial's size
  [[nodiscard]] bool slides_at_touch(double normal_force, double trial) const {
    return damping > 0.0 && trial > mu_static * normal_force;
  }
  /// In the directions in which friction acts.
  [[nodiscard]] Vec2 masked(Vec2 v) const { return {along.x * v.x, along.t * v.t}; }
  [[nodiscard]] Sym2 masked(const Sym2& a) const {
    return {along.x * a.xx, along.x * along.t * a.xt, along.t * a.tt};
  }
  /// N: what spring and damper would bear in stick, T the spring's force as the node has stretched it. V: Vec2, or a number along t.
  template <class V> [[nodiscard]] V trial(V spring, V velocity) const { return spring - damping * velocity; }
  /// A trial within its bound, mu F_N: the trial itself, or in slip the bound mu_d F_N along it.   @param coefficient  mu
  template <class V>
  [[nodiscard]] BoundedForce<V> bounded(V trial, double coefficient, double normal_force) const {
    const double length = norm(trial);
    if (length <= coefficient * normal_force)
      return {trial, false};
    return {with_length(mu_dynamic * normal_force, trial, length), true};
  }
  /// Energy of a spring that bears T, J.
  template <class V> [[nodiscard]] double spring_energy(V spring) const {
    return stiffness > 0.0 ? 0.5 * dot(spring, spring) / stiffness : 0.0;
  }
  /// J: what the damper takes as a contact that stuck begins to slide and its spring drops from mu_s F_N to mu_d F_N, in the limit
  /// C_T -> 0, at once; the slider moves under mu_d F_N meanwhile. 0 with a damper, under which the spring does not drop at once.
  [[nodiscard]] double damper_work_at_slip_onset(double normal_force) const {
    return damping > 0.0 ? 0.0 : spring_energy((mu_static - mu_dynamic) * normal_force);
  }
};

/// What a contact remembers of its tangential past.
struct FrictionMemory {
  Vec2 spring; ///< N: T of return_map, F0 of reference
  bool sliding = false;
};

/// Friction over one step.
struct FrictionStep {
  FrictionMemory memory;      ///< at the end of the step, to be committed
  Vec2 slip;                  ///< m: displacement of the slider (0 in stick)
  double friction_work = 0.0; ///< J >= 0, dissipated by the slider
  double stored = 0.0;        ///< J, what the spring's energy grew by
  double damper_work = 0.0; ///< J, dissipated by C_T and given up by the spring of an open contact; >= 0 but
                            ///< for the jumps of `reference`
};

struct Friction {
  Vec2 force; ///< N, on the node
  bool slides;
};

/// The law at one instant: what explicit schemes use. `dx` is the tangential displacement since the memory
/// was committed, m.
[[nodiscard]] Friction evaluate(const FrictionLaw& law, const FrictionMemory& memory, double normal_force,
                                Vec2 dx, Vec2 velocity);

/// The same where nothing moves along x_loc: F on a line.
[[nodiscard]] inline Friction evaluate_line(const FrictionLaw& law, const FrictionMemory& memory,
                                            double normal_force, double dx, double velocity) {
  dx *= law.along.t;
  velocity *= law.along.t;
  const double trial = law.trial(memory.spring.t - law.stiffness * dx, velocity);
  const auto [force, slides] = law.bounded(trial, law.coefficient(memory.sliding), normal_force);
  if (slides && law.kind == FrictionMemoryKind::reference && velocity != 0.0)
    return {{0.0, std::copysign(force, -velocity)}, true};
  return {{0.0, force}, slides};
}

/// What a law needs of a step of length h, made once.
struct FrictionTable {
  double gradient;   ///< G h = K_T h/2 + C_T, N s/m: the mean force of a sticking step is T - G h times its
                     ///< mean velocity
  double relaxation; ///< exp(-K_T h/C_T): what is left after h of the spring's distance to its goal (0
                     ///< without damper)
  double compliance; ///< 1/K_T, m/N (0 without friction)
};
[[nodiscard]] FrictionTable friction_table(const FrictionLaw& law, double h);

/// Closes a step in which the mean force was `force` and the displacement `dx`: advances the memory and
/// shares out the energy.
[[nodiscard]] FrictionStep close_step(const FrictionLaw& law, const FrictionTable& table,
                                      const FrictionMemory& memory, Friction friction, Vec2 dx);

/// An open contact over a step: the spring's force dies out through the damper (return_map) or is forgotten
/// (reference).
[[nodiscard]] FrictionStep open_step(const FrictionLaw& law, const FrictionTable& table,
                                     const FrictionMemory& memory);

/// A spring that has relaxed to this share of what it bore when its contact opened is forgotten: round-off of its energy.
inline constexpr double forgotten = 1e-12;

/// Implicit friction of one contact over a step: the mean velocity answers the force, v = free_velocity + A F
/// (A = (h/2) W_tt, symmetric, >= 0). Stick: (I + G h A) F = T - G h free_velocity. Slip: F of length
/// mu_d F_N along the trial T - G h v; with M = I + G h A and b = T - G h free_velocity that is
/// (M + s I) F = b for the s >= 0 at which |F| is the bound, found by Newton's method on 1/|F|. For
/// `reference` the slip force is opposite to v: with M = A and b = -free_velocity the same equation; where
/// less than the bound brings the node to rest, that force (a larger one would drive the node backwards).
using Mobility = Sym2; ///< m/s per N
/// The f of given length with (M + s I) f = b for some s >= 0 (0 where even s = 0 leaves |f| below it: then along b).
[[nodiscard]] Vec2 force_of_length(double length, const Mobility& m, Vec2 b);
[[nodiscard]] Friction step_friction_plane(const FrictionLaw& law, const FrictionTable& table,
                                           const FrictionMemory& memory, double normal_force,
                                           Vec2 free_velocity, const Mobility& mobility);

/// The same where nothing moves along x_loc (the memory, the velocity and the coupling are 0 there): a scalar problem with F on a line.
[[nodiscard]] Friction step_friction_line(const FrictionLaw& law, const FrictionTable& table,
                                          const FrictionMemory& memory, double normal_force,
                                          double free_velocity, double mobility);

} // namespace fretwork::contact
