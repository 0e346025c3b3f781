// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/lone_contact.hpp"
#include "transient/lane_laws.hpp"

namespace fretwork::transient::kernels {
namespace {

template <class>
FRETWORK_INLINE LoneStep step_alone_on(int i, const SweepRule& rule, const LawLanes& laws,
                                       MemoryLanes& memories, const MotionLanes& motion, const double* last,
                                       bool closed, NormalPush& push, ContactState& state) {
  const NearLanes near(motion, last);
  const int l = lane(i), width = motion.places.all.width;
  const LawNumbers& law = laws[i];
  MemoryNumbers& memory = memories[i];
  const double h = rule.step, half_step = 0.5 * h, ny = near.ny[i], nz = near.nz[i];
  LoneStep step;
  const Laws<double> c = laws_at<double>(i, width, rule, laws, memories, near);
  if (!apart(c)) {
    step.found = false;
    return step;
  }
  if (closed)
    step.followed =
        follow_step<double>(i, width, law, memory, near.displacement, near.last, near.velocity, half_step);
  step.held = held(memory, l, ny, nz);
  step.slid = same_face(memory, l, ny, nz) * memory.sliding[l] != 0.0;
  const Alone found = solve_alone(c, rule, law, l, step.held);
  // an open contact, which its damper may hold free of force, shows nothing
  const double n = found.normal, t = found.friction, acts = n > 0.0 ? 1.0 : 0.0;
  step.springs = 0.5 * law.stiffness[l] * c.depth * c.depth;
  step.work = found.work;
  step.jump = found.jump;
  step.cut = (1.0 - acts) * found.loss;
  step.normal_damping = acts * found.loss;
  step.mean_slip = law.along[l] * found.v_t;
  const NormalPush now{rounded(n * ny), rounded(n * nz)};
  step.force_y = now.y + rounded(t * nz); // as ContactRows::set has them after a restart
  step.force_z = now.z - rounded(t * ny);

  // SlidingPaths::correct; law.yy is (h/2) W
  double moved = acts * h * step.mean_slip;
  if (found.slides > 0.0 && (push.y != 0.0 || push.z != 0.0)) {
    const double y = (h / 3.0) * (now.y - push.y), z = (h / 3.0) * (now.z - push.z);
    moved -= law.along[l] * (nz * (law.yy[l] * y + law.yz[l] * z) - ny * (law.yz[l] * y + law.zz[l] * z));
  }
  push = now;

  // two copies of the law, each for what is known
  const Kept<double> kept =
      n > 0.0 && law.mu_static[l] > 0.0
          ? remember_step<double>(law, memory, l, {1.0, ny, nz, t, moved, found.slides})
          : remember_step<double>(law, memory, l, {0.0, ny, nz, t, moved, found.slides});
  memory.ahead[l] =
      moved - half_step * tangential<double>(law, memory, l, near.velocity[i], near.velocity[width + i]);
  step.remembers = kept.left != 0.0;
  step.stored = kept.stored;
  step.friction = kept.slider;
  step.damping = found.loss + kept.damping;

  state.normal_force = n;
  state.ny = acts * ny;
  state.nz = acts * nz;
  state.friction = {0.0, t};
  state.displacement = {0.0, moved};
  state.slid = found.slides * magnitude(moved);
  state.friction_work = kept.slider;
  state.damper_work = acts * (found.loss + kept.damper);
  state.approach = acts * -c.v_n;
  state.slides = found.slides > 0.0;
  state.pressing_share = 1.0;
  state.instant_share = 1.0;
  if (n > 0.0 && c.instant != c.spring)
    state.instant_share = clipped(1.0 + (c.instant - c.spring) / n);
  return step;
}

} // namespace

FRETWORK_KERNEL(LoneStep, step_alone,
                (int contact, const SweepRule& rule, const LawLanes& laws, MemoryLanes& memories,
                 const MotionLanes& motion, const double* last, bool closed, NormalPush& push,
                 ContactState& state),
                (contact, rule, laws, memories, motion, last, closed, push, state))

} // namespace fretwork::transient::kernels
