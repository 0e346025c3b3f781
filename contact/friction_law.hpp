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
#include "contact/vec2.hpp"

namespace fretwork::contact {

enum class FrictionMemoryKind { return_map, reference };

struct FrictionLaw {
  double stiffness = 0.0;  ///< K_T, N/m, > 0 with friction
  double damping = 0.0;    ///< C_T, N s/m, >= 0
  double mu_static = 0.0;  ///< >= mu_dynamic
  double mu_dynamic = 0.0; ///< >= 0; 0: no friction
  FrictionMemoryKind kind = FrictionMemoryKind::return_map;
  Vec2 along{1.0, 1.0}; ///< directions in which friction acts, 1 or 0 each: (1, 1) the tangent plane, (1, 0)
                        ///< along x_loc only, (0, 1) across it only

  [[nodiscard]] bool active() const { return mu_static > 0.0; }
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
  const double trial = memory.spring.t - law.stiffness * dx - law.damping * velocity;
  const double bound = (memory.sliding ? law.mu_dynamic : law.mu_static) * normal_force;
  if (std::abs(trial) <= bound)
    return {{0.0, trial}, false};
  const double along = law.kind == FrictionMemoryKind::reference && velocity != 0.0 ? -velocity : trial;
  return {{0.0, std::copysign(law.mu_dynamic * normal_force, along)}, true};
}

/// F of `evaluate` and its derivatives, for schemes that solve for the end of a step. With P = I - e e^T, e
/// the direction of the force, all masked by `along`:
///     stick                 dF/dx = -K_T I, dF/dv = -C_T I, dF/dF_N = 0
///     slip along the trial  dF/dx = -K_T s P, dF/dv = -C_T s P, s = mu_d F_N/|trial|;  dF/dF_N = mu_d e
///     slip along -v         dF/dx = 0, dF/dv = -(mu_d F_N/|v|) P;  dF/dF_N = mu_d e
/// At the bound, where F bends (mu_s = mu_d) or jumps, those of the side that `evaluate` takes.
struct FrictionSlopes {
  Friction friction;
  Sym2 by_displacement; ///< N/m
  Sym2 by_velocity;     ///< N s/m
  Vec2 by_normal_force;
};
[[nodiscard]] FrictionSlopes friction_slopes(const FrictionLaw& law, const FrictionMemory& memory,
                                             double normal_force, Vec2 dx, Vec2 velocity);

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

/// Energy of the tangential spring, J.
[[nodiscard]] inline double spring_energy(const FrictionLaw& law, const FrictionMemory& memory) {
  return law.stiffness > 0.0 ? 0.5 * dot(memory.spring, memory.spring) / law.stiffness : 0.0;
}

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

/// The same where nothing moves along x_loc (the memory, the velocity and the coupling are 0 there): a scalar
/// problem with F on a line. Made once a step, asked for many normal forces and free velocities.
class LineStep {
public:
  LineStep() = default;
  LineStep(const FrictionLaw& law, const FrictionTable& table, const FrictionMemory& memory, double mobility)
      : spring_(memory.spring.t), gradient_(law.along.t * table.gradient), mobility_(mobility),
        share_(1.0 / (1.0 + gradient_ * mobility)), mu_(memory.sliding ? law.mu_dynamic : law.mu_static),
        mu_slip_(law.mu_dynamic), along_velocity_(law.kind == FrictionMemoryKind::reference) {}

  [[nodiscard]] Friction friction(double normal_force, double free_velocity) const {
    const double stick = (spring_ - gradient_ * free_velocity) * share_;
    if (std::abs(stick) <= mu_ * normal_force)
      return {{0.0, stick}, false};
    const double bound = mu_slip_ * normal_force;
    if (!along_velocity_ || free_velocity == 0.0)
      return {{0.0, std::copysign(bound, stick)}, true};
    const double speed = std::abs(free_velocity); // over the mobility: what brings the node to rest
    return {{0.0, std::copysign(speed < mobility_ * bound ? speed / mobility_ : bound, -free_velocity)},
            true};
  }

private:
  double spring_ = 0.0, gradient_ = 0.0, mobility_ = 0.0, share_ = 1.0, mu_ = 0.0, mu_slip_ = 0.0;
  bool along_velocity_ = false;
};

[[nodiscard]] inline Friction step_friction_line(const FrictionLaw& law, const FrictionTable& table,
                                                 const FrictionMemory& memory, double normal_force,
                                                 double free_velocity, double mobility) {
  return LineStep(law, table, memory, mobility).friction(normal_force, free_velocity);
}

} // namespace fretwork::contact
