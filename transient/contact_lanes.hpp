// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contacts of a step in vector lanes: ContactSolver and ContactMemory where friction acts along one tangent (nothing moves along
/// x_loc) and every memory is return_map. The laws are those of contact/normal_law.hpp and contact/friction_law.hpp (step_normal,
/// step_friction_line, close_step, open_step), written without branches; a test holds the two against each other.
///
/// The forces are found by Jacobi sweeps: all contacts at once, each with its own block of A solved exactly. Where these do not halve
/// the error a sweep (contacts that move almost together), Gauss-Seidel sweeps go on from there.
#pragma once
#include "core/state_archive.hpp"
#include "transient/packed_contacts.hpp"

namespace fretwork::transient::kernels {

/// Laws, one contact a lane; 0 in lanes without friction.
struct LawLanes {
  LawLanes() = default;
  /// @param step  s
  LawLanes(const PackedContacts& contacts, double step);
  Array stiffness, damping, dissipation;  ///< K_N; C_N; K_N d
  Array yy, yz, zz;                       ///< (h/2) W of the contact itself, m/s per N
  Array tangential, compliance, gradient; ///< K_T, 1/K_T, G h: of contact::FrictionTable
  Array relaxation;                       ///< e^-a
  Array mu_static, mu_dynamic, along;     ///< along: 1 or 0
};

/// A spring that has relaxed to this share of what it had when its contact opened is forgotten (round-off of the energy).
inline constexpr double forgotten = 1e-12;

/// Memories, one contact a lane: contact::FrictionMemory and what goes with it.
struct MemoryLanes {
  Array spring, sliding;    ///< N; 1 or 0
  Array force;              ///< N, friction of the commit that left this
  Array normal_y, normal_z; ///< then
  Array left; ///< share of the spring's force left since the contact opened; 0: nothing remembered
  void visit(core::StateArchive& state) { state(spring, sliding, force, normal_y, normal_z, left); }
};

/// The unknowns of a step, one contact a lane.
struct StepLanes {
  explicit StepLanes(int width);
  Array shut;                         ///< 1 or 0: takes part
  Array spring, damping, share;       ///< K_N P, c(P), 1/(1 + c nn)
  Array nn, nt, tt;                   ///< own block of A
  Array bound, share_t, tangential;   ///< mu, 1/(1 + G h tt), T
  Array per_normal, per_friction;     ///< 1/N
  Array normal, friction, slides;     ///< F_N, F_t, N; 1 or 0
  Array before_n, before_t, v_n, v_t; ///< s0 and s, m/s
};

/// Which contacts are shut, their laws for the step, first forces. v_n and v_t stay those before the action. Returns the energy of the
/// normal springs, J.
double prepare(int width, const LawLanes& law, const MemoryLanes& memory, const double* gap, const double* ny,
               const double* nz, const double* wy, const double* wz, double half_window, StepLanes& step);

/// One Jacobi sweep over all lanes: changes of the forces in `by_n` and `by_t`; forces follow, velocities do not. Returns the largest
/// change, relative to what a contact can bear.
double improve(int width, const LawLanes& law, StepLanes& step, double* by_n, double* by_t);

/// v_n, v_t += what the forces `by_n`, `by_t` of `count` contacts change; a: `respond` of each, one after the other.
void answer(int width, int count, const int* contacts, const double* a, const double* by_n,
            const double* by_t, double* v_n, double* v_t);

/// A step committed, in lanes.
struct CommitLanes {
  explicit CommitLanes(int width);
  Array closed, normal_y, normal_z, force, displacement, slides; ///< in: 1 or 0; n; F_t, N; m; 1 or 0
  Array friction_work, damper_work;                              ///< out, J: of the closed
  void visit(core::StateArchive& state) { state(closed, normal_y, normal_z, force, displacement, slides); }
};
struct CommitSums {
  double friction = 0.0;  ///< J, sliders
  double damping = 0.0;   ///< J, tangential dampers, springs that die out or are forgotten
  double stored = 0.0;    ///< J, change of the energy of the springs
  bool remembers = false; ///< some contact has a memory left
};
CommitSums commit(int width, const LawLanes& law, CommitLanes& step, MemoryLanes& memory);

} // namespace fretwork::transient::kernels
