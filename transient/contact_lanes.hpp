// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contacts of a step in vector lanes: ContactSolver and ContactMemory where friction acts along one tangent (nothing moves along
/// x_loc) and every memory is return_map. The laws are those of contact/normal_law.hpp and contact/friction_law.hpp (step_normal,
/// step_friction_line, close_step, open_step), written without branches; a test holds the two against each other.
///
/// The forces are found by Jacobi sweeps: all contacts at once, each with its own block of A solved exactly; a contact that is shut alone,
/// its normal force untouched by its friction, needs one. Without normal dampers normal forces do not answer velocities: the sweeps are over
/// frictions alone, with the block of A that ties them. Where the sweeps do not halve the error (contacts that move almost together),
/// Gauss-Seidel sweeps of ContactSolver take over.
#pragma once
#include "core/state_archive.hpp"
#include "transient/kernels.hpp"

namespace fretwork::transient {
struct PackedContacts;
}

namespace fretwork::transient::kernels {

/// Laws, one contact a lane; 0 in lanes without friction.
struct LawLanes {
  LawLanes() = default;
  /// @param step  s
  LawLanes(const PackedContacts& contacts, double step);
  Array stiffness, damping, dissipation;  ///< K_N; C_N; d
  Array yy, yz, zz;                       ///< (h/2) W of the contact itself, m/s per N
  Array tangential, compliance, gradient; ///< K_T, 1/K_T, G h: of contact::FrictionTable
  Array relaxation;                       ///< e^-a
  Array mu_static, mu_dynamic, along;     ///< along: 1 or 0
  Array per_mu;                           ///< 1/mu_static
};

/// A spring that has relaxed to this share of what it had when its contact opened is forgotten (round-off of the energy).
inline constexpr double forgotten = 1e-12;

/// Memories, one contact a lane: contact::FrictionMemory and what goes with it.
struct MemoryLanes {
  Array spring, sliding;    ///< N; 1 or 0
  Array force;              ///< N, friction of the commit that left this
  Array normal_y, normal_z; ///< then
  Array left; ///< share of the spring's force left since the contact opened; 0: nothing remembered
  std::vector<int> places, next; ///< Places where something is remembered; room for those after a commit
  void visit(core::StateArchive& state) { state(spring, sliding, force, normal_y, normal_z, left, places); }
};

/// The unknowns of a step, one contact a lane.
struct StepLanes {
  /// @param ties_tangents  with room for `ties`
  StepLanes(int width, bool ties_tangents);
  Array shut;                       ///< 1 or 0: takes part
  Array spring, damping, share;     ///< F_K, c, 1/(1 + c nn)
  Array nn, nt, tt;                 ///< own block of A
  Array bound, share_t, tangential; ///< mu, 1/(1 + G h tt), T
  Array per_normal, per_friction;   ///< 1/N
  Array normal, friction, slides;   ///< F_N, F_t, N; 1 or 0
  Array by_y, by_z, by_t;           ///< N, changes of the forces in a sweep, along y, z and t
  Array first;                      ///< N, frictions that the sweeps begin from
  Array v_y, v_z, v_t;              ///< s, m/s
  Array ties;                       ///< A_tt, column by column of the contacts that take part, m/s per N
  Array before_n, before_t;         ///< s0, m/s
  Array cut;                        ///< J over the step, by the normal damper
  std::vector<int> contacts;        ///< the first `count` are those that take part
  int count = 0;
};

/// W = B B^T in lanes. Of each contact: velocities of all along y by a unit force along y, along z by one along z, and where the planes
/// are coupled along z by y and along y by z, 1/kg.
struct MobilityLanes {
  Array columns;
  bool coupled = false; ///< some force along y moves some contact along z
};

/// Marks of the near contacts (1 or 0), gaps, normals, velocities before the action, displacements and those at the last action of all
/// contacts, in lanes.
struct NearLanes {
  const double *near, *gap, *ny, *nz, *vy, *vz, *uy, *uz, *last_uy, *last_uz;
};

/// A step found, and what its commit makes of it.
struct CommitLanes {
  explicit CommitLanes(int width);
  Array closed, normal_y, normal_z, force, displacement, slides; ///< in: 1 or 0; n; F_t, N; m; 1 or 0
  Array friction_work, damper_work;                              ///< out, J: of the closed
  void visit(core::StateArchive& state) { state(closed, normal_y, normal_z, force, displacement, slides); }
};

/// How contacts are solved.
struct SweepRule {
  double step;        ///< s
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
/// Which contacts of the places are shut, and their forces for the step: `step` and the first row of `out`, there only.
extern const Kernel<Solved(const Places& places, const SweepRule& rule, const LawLanes& law,
                           const MemoryLanes& memory, const MobilityLanes& mobility, const NearLanes& near,
                           StepLanes& step, CommitLanes& out)>
    solve;

struct CommitSums {
  double friction = 0.0; ///< J, sliders
  double damping = 0.0;  ///< J, tangential dampers, springs that die out or are forgotten
  double stored = 0.0;   ///< J, change of the energy of the springs
};
/// @param acting  where contacts may be closed in `step`: elsewhere all are open, whatever stands there
extern const Kernel<CommitSums(const Places& acting, const LawLanes& law, CommitLanes& step,
                               MemoryLanes& memory)>
    commit;

/// The largest change of a sweep is small, or what it foretells from the one of the sweep before is.
/// The ratio of the changes of two sweeps foretells the next ones only where they fall clearly.
[[nodiscard]] inline bool settled(double largest, double last, double tolerance, double caution) {
  const bool foretold = largest <= 0.5 * last;
  return largest <= tolerance || (foretold && largest * largest <= caution * tolerance * (last - largest));
}

} // namespace fretwork::transient::kernels
