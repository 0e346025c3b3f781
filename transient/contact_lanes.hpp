// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contacts of a step in vector lanes: ContactSolver and ContactMemory where friction acts along one tangent (nothing moves along
/// x_loc) and every memory is return_map. The laws are those of contact/normal_law.hpp and contact/friction_law.hpp (step_normal,
/// step_friction_line, close_step, open_step), written without branches; a test holds the two against each other.
///
/// The forces are found by Jacobi sweeps: all contacts at once, each with its own block of A solved exactly (a contact that is near
/// alone makes the whole step of `splitting` by itself where no other was closed: lone_contact.hpp). Without normal dampers normal forces do not answer velocities: the sweeps are over
/// frictions alone, with the block of A that ties them. Where the sweeps do not halve the error (contacts that move almost together),
/// Gauss-Seidel sweeps of ContactSolver take over.
#pragma once
#include "transient/reach_lanes.hpp"

namespace fretwork::transient {
struct PackedContacts;
}

namespace fretwork::transient::kernels {

/// Laws; 0 without friction.
struct alignas(alignment) LawNumbers {
  Numbers stiffness, damping, dissipation;  ///< K_N; C_N; d
  Numbers yy, yz, zz;                       ///< (h/2) W of the contact itself, m/s per N
  Numbers tangential, compliance, gradient; ///< K_T, 1/K_T, G h: of contact::FrictionTable
  Numbers relaxation;                       ///< e^-a
  Numbers mu_static, mu_dynamic, along;     ///< along: 1 or 0
  Numbers per_mu;                           ///< 1/mu_static
};
using LawLanes = LaneTable<LawNumbers>;
/// @param step  s
[[nodiscard]] LawLanes law_lanes(const PackedContacts& contacts, double step);

/// A spring that has relaxed to this share of what it had when its contact opened is forgotten (round-off of the energy).
inline constexpr double forgotten = 1e-12;

/// Memories: contact::FrictionMemory and what goes with it.
struct alignas(alignment) MemoryNumbers {
  Numbers spring, sliding;    ///< N; 1 or 0
  Numbers force;              ///< N, friction of the commit that left this
  Numbers normal_y, normal_z; ///< then
  Numbers left;  ///< share of the spring's force left since the contact opened; 0: nothing remembered
  Numbers ahead; ///< m, dx - (h/2) v- of the last action (contact_memory.hpp)
};
struct MemoryLanes : LaneTable<MemoryNumbers> {
  /// @param width  contacts, padded
  explicit MemoryLanes(int width);
  PlaceList places, next; ///< Places where something is remembered; room for those after a commit
  void visit(core::StateArchive& state) {
    LaneTable::visit(state);
    state(places);
  }
};

/// The unknowns of a step.
struct alignas(alignment) StepNumbers {
  Numbers shut;                       ///< 1 or 0: takes part
  Numbers spring, damping, share;     ///< F_K, c, 1/(1 + c nn)
  Numbers instant;                    ///< N, of contact::InstantSpring
  Numbers nn, nt, tt;                 ///< own block of A
  Numbers bound, share_t, tangential; ///< mu, 1/(1 + G h tt), T
  Numbers per_normal, per_friction;   ///< 1/N
  Numbers normal, friction, slides;   ///< F_N, F_t, N; 1 or 0
  Numbers by_y, by_z, by_t;           ///< N, changes of the forces in a sweep, along y, z and t
  Numbers first;                      ///< N, frictions that the sweeps begin from
  Numbers v_y, v_z, v_t;              ///< s, m/s
  Numbers before_n, before_t;         ///< s0, m/s
  Numbers cut;                        ///< J over the step, by the normal damper
};
struct StepLanes : LaneTable<StepNumbers> {
  /// @param ties_tangents  with room for `ties`
  StepLanes(int width, bool ties_tangents);
  Array ties;                ///< A_tt, column by column of the contacts that take part, m/s per N
  std::vector<int> contacts; ///< the first `count` are those that take part
  int count = 0;
};

/// W = B B^T in lanes. Of each contact: velocities of all along y by a unit force along y, along z by one along z, and where the planes
/// are coupled along z by y and along y by z, 1/kg.
struct MobilityLanes {
  Array columns;
  bool coupled = false; ///< some force along y moves some contact along z
};

/// A step found, and what its commit makes of it.
struct alignas(alignment) CommitNumbers {
  Numbers closed, normal_y, normal_z, force, displacement, slides; ///< in: 1 or 0; n; F_t, N; m; 1 or 0
  Numbers friction_work, damper_work;                              ///< out, J: of the closed
};
using CommitLanes = LaneTable<CommitNumbers>;

/// How contacts are solved.
struct SweepRule {
  double step;        ///< s
  double per_step;    ///< 1/s: divisions take long
  double step_sixth;  ///< s
  double half_window; ///< s, closed shares are taken over it to both sides
  bool implicit;      ///< some law depends on velocities: one sweep is not enough
  bool damped;        ///< some normal law has a damper: normal forces answer velocities
  double tolerance;   ///< of the forces, relative to what a contact can bear
  int most;           ///< sweeps
};
struct Solved {
  double springs = 0.0;          ///< J, energy of the normal springs
  double work = 0.0, jump = 0.0; ///< J, of ContactSolver::Action
  bool settled = true;           ///< otherwise nothing is found yet but `springs`
};
/// Which of the near contacts are shut, and their forces for the step: `steps` and what `commits` takes in, at their places only.
/// @param motion  before the action   @param last  displacements at the last one
extern const Kernel<Solved(const SweepRule& rule, const LawLanes& laws, const MemoryLanes& memories,
                           const MobilityLanes& mobility, const MotionLanes& motion, const double* last,
                           StepLanes& steps, CommitLanes& commits)>
    solve;

struct CommitSums {
  double friction = 0.0; ///< J, sliders
  double damping = 0.0;  ///< J, tangential dampers, springs that die out or are forgotten
  double stored = 0.0;   ///< J, change of the energy of the springs
};
/// @param acting  where contacts may be closed in `commits`: elsewhere all are open, whatever stands there
extern const Kernel<CommitSums(const Places& acting, const LawLanes& laws, CommitLanes& commits,
                               MemoryLanes& memories)>
    commit;
/// The same of so many steps in which all contacts are open.
extern const Kernel<CommitSums(const LaneCount& contacts, int steps, const LawLanes& laws,
                               MemoryLanes& memories)>
    fade;

/// The same of one step and all contacts but one, whose memory has advanced already.
extern const Kernel<CommitSums(const LaneCount& contacts, int contact, const LawLanes& laws,
                               MemoryLanes& memories)>
    fade_beside;

/// ContactMemory::follow: vectors of all contacts, blocks of `width` lanes along y and z, displacements now and at the last commit and
/// velocities. Returns the change of the energy of the springs, J.
extern const Kernel<double(const LaneCount& contacts, const LawLanes& laws, MemoryLanes& memories,
                           const double* u, const double* last_u, const double* w, double half_step)>
    follow;
/// ContactMemory::leave of the near contacts.
extern const Kernel<void(const Places& near, const LawLanes& laws, const CommitLanes& commits,
                         MemoryLanes& memories, const double* w, double half_step)>
    leave;

/// The largest change of a sweep is small, or what it foretells from the one of the sweep before is.
/// The ratio of the changes of two sweeps foretells the next ones only where they fall clearly.
[[nodiscard]] inline bool settled(double largest, double last, double tolerance, double caution) {
  const bool foretold = largest <= 0.5 * last;
  return largest <= tolerance || (foretold && largest * largest <= caution * tolerance * (last - largest));
}

} // namespace fretwork::transient::kernels
