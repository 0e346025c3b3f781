// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The step of a contact that is near its obstacle while no other is or was closed, as most are in which contacts act: what kernels::follow,
/// solve, commit and leave (contact_lanes.hpp) and SlidingPaths::correct do for it, in registers. The laws are the same functions
/// (lane_laws.hpp).
#pragma once
#include "transient/contact_lanes.hpp"
#include "transient/scheme.hpp"

namespace fretwork::transient::kernels {

/// N, F_N n in local axes; 0: no force.
struct NormalPush {
  double y = 0.0, z = 0.0;
};

struct LoneStep {
  bool found = true; ///< otherwise friction acts on the normal force: nothing is found, nothing has changed
  bool remembers = false;              ///< whether something is remembered of the contact after the step
  bool slid = false;                   ///< at the commit before
  double springs = 0.0;                ///< J, energy of the normal spring
  double work = 0.0, jump = 0.0;       ///< J, of ContactSolver::Action
  double cut = 0.0;                    ///< J, of ContactTrial
  double followed = 0.0, stored = 0.0; ///< J, what the tangential spring gains by following and by the commit
  double friction = 0.0;               ///< J, slider
  double damping = 0.0;                ///< J, normal and tangential dampers
  double normal_damping = 0.0;         ///< J, of these the normal one
  double held = 0.0;                   ///< N, of the tangential spring before the commit
  double force_y = 0.0, force_z = 0.0; ///< N, on the node
  double mean_slip = 0.0;              ///< m/s, tangential, mean of those before and after the action
};
/// Follows the contact, if it was `closed` at the last commit, finds its forces for the step, and commits them.
/// @param motion  before the action   @param last  displacements at the last action   @param push  of the last action; becomes that of this one
/// @param state  overwritten
extern const Kernel<LoneStep(int contact, const SweepRule& rule, const LawLanes& laws, MemoryLanes& memories,
                             const MotionLanes& motion, const double* last, bool closed, NormalPush& push,
                             ContactState& state)>
    step_alone;

} // namespace fretwork::transient::kernels
