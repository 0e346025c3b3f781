// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contact_solver.hpp"
#include <cmath>

namespace fretwork::transient {
namespace {

/// Share of the step over which the penetration is averaged with the velocity before the action. Between 0
/// (mean force too high) and 1 (too low) at w_c h near 1; below w_c h = 0.4 its effect is less than 1 %.
constexpr double window = 0.7;
/// Sweeps stop when no force changes by more than this share of its bound: far below the law's own accuracy.
constexpr double sweep_tolerance = 1e-6;
constexpr int most_sweeps = 60;

} // namespace

ContactSolver::ContactSolver(const PackedContacts& contacts, double step) : contacts_(contacts), h_(step) {
  working_.resize(static_cast<std::size_t>(contacts.count));
  shut_.reserve(static_cast<std::size_t>(contacts.count));
  before_.assign(static_cast<std::size_t>(contacts.stride()), 0.0);
}

ContactSolver::Action ContactSolver::solve(const ContactMemory& memory, ContactMotion& motion,
                                           ContactTrial& trial) {
  Action action;
  trial.clear();
  shut_.clear();
  if (!motion.find_near(0.5 * window * h_))
    return action;
  for (int c = 0; c < contacts_.count; ++c)
    if (motion.near(c))
      meet(c, memory, motion, trial);
  if (shut_.empty())
    return action;
  before_ = motion.w;
  action.converged = sweep(memory, motion, trial);
  for (const int c : shut_)
    close(c, motion, trial, action);
  return action;
}

/// A contact near its obstacle: its place, and whether it is shut in this step.
void ContactSolver::meet(int c, const ContactMemory& memory, const ContactMotion& motion,
                         ContactTrial& trial) {
  const contact::Support& support = contacts_.supports[c];
  const auto at = motion.locate(c);
  const double p = -at.gap, rate = motion.sinking(c, at.ny, at.nz);
  const double reach = 0.5 * window * h_ * rate;
  const double mean = contact::mean_penetration(p - reach, p + reach);
  if (p > 0.0)
    trial.springs += 0.5 * support.normal.stiffness * p * p;
  if (!(mean > 0.0))
    return;
  ContactState& state = trial.states[c];
  state.ny = at.ny;
  state.nz = at.nz;
  state.approach = rate;
  Working& work = working_[c];
  work.mean = mean;
  const double half = 0.5 * h_;
  const double yy = contacts_.own_mobility(c, 0, 0), yz = contacts_.own_mobility(c, 0, 1),
               zz = contacts_.own_mobility(c, 1, 1);
  work.damped = half * (at.ny * at.ny * yy + 2.0 * at.ny * at.nz * yz + at.nz * at.nz * zz);
  if (support.friction.active()) { // t = (nz, -ny)
    const double xy = contacts_.own_mobility(c, 2, 0), xz = contacts_.own_mobility(c, 2, 1);
    work.slip.xx = half * contacts_.own_mobility(c, 2, 2);
    work.slip.xt = half * (at.nz * xy - at.ny * xz);
    work.slip.tt = half * (at.nz * at.nz * yy - 2.0 * at.ny * at.nz * yz + at.ny * at.ny * zz);
    work.memory = memory.at(c, at.ny, at.nz);
  }
  shut_.push_back(c);
}

/// The forces of all shut contacts, by sweeps over w = B v- + (h/2) W f. Returns whether they settled.
bool ContactSolver::sweep(const ContactMemory& memory, ContactMotion& motion, ContactTrial& trial) {
  bool coupled = false;
  for (const int c : shut_) {
    const contact::Support& support = contacts_.supports[c];
    ContactState& state = trial.states[c];
    const double normal =
        contact::step_normal(support.normal, working_[c].mean, state.approach, working_[c].damped);
    const contact::Vec2 guess = memory.last_force(c, state.ny, state.nz);
    const double bound = support.friction.mu_dynamic * normal, size = contact::norm(guess);
    change(c, normal, size > bound ? (bound / size) * guess : guess, motion, state);
    coupled = coupled || support.friction.active() || support.normal.damps();
  }
  if (!coupled)
    return true;
  for (int i = 0; i < most_sweeps; ++i) {
    bool settled = true;
    for (const int c : shut_)
      settled = improve(c, memory.table(c), motion, trial.states[c]) && settled;
    if (settled)
      return true;
  }
  return false;
}

/// One contact solved with all others held. Returns whether its forces stayed within the tolerance.
bool ContactSolver::improve(int c, const contact::FrictionTable& table, ContactMotion& motion,
                            ContactState& state) {
  const contact::Support& support = contacts_.supports[c];
  const Working& work = working_[c];
  double normal = 0.0;
  if (support.normal.damps()) {
    const double rate = motion.sinking(c, state.ny, state.nz) + work.damped * state.normal_force;
    normal = contact::step_normal(support.normal, work.mean, rate, work.damped) - state.normal_force;
  }
  const bool normal_settled = std::abs(normal) <= sweep_tolerance * support.normal.stiffness * work.mean;
  if (!support.friction.active()) {
    if (normal != 0.0)
      change(c, normal, {}, motion, state);
    return normal_settled;
  }
  const contact::Friction friction = friction_of(c, table, motion, state, state.normal_force + normal);
  state.slides = friction.slides;
  const contact::Vec2 tangential = friction.force - state.friction;
  change(c, normal, tangential, motion, state);
  const double limit = sweep_tolerance * support.friction.mu_static * support.normal.stiffness * work.mean;
  return normal_settled && contact::dot(tangential, tangential) <= limit * limit;
}

/// Friction of one contact under a normal force, all other forces held.
contact::Friction ContactSolver::friction_of(int c, const contact::FrictionTable& table,
                                             const ContactMotion& motion, const ContactState& state,
                                             double normal_force) const {
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  const Working& work = working_[c];
  const contact::Mobility& a = work.slip;
  const contact::Vec2 slip = motion.slip(c, state.ny, state.nz), f = state.friction;
  if (!contacts_.in_plane[c])
    return contact::step_friction_line(law, table, work.memory, normal_force, slip.t - a.tt * f.t, a.tt);
  const contact::Vec2 free{slip.x - a.xx * f.x - a.xt * f.t, slip.t - a.xt * f.x - a.tt * f.t};
  return contact::step_friction_plane(law, table, work.memory, normal_force, free, a);
}

/// Adds to the force of a contact; all velocities answer.
void ContactSolver::change(int c, double normal, contact::Vec2 tangential, ContactMotion& motion,
                           ContactState& state) const {
  state.normal_force += normal;
  state.friction = state.friction + tangential;
  const double half = 0.5 * h_;
  const double force[3] = {half * (normal * state.ny + tangential.t * state.nz),
                           half * (normal * state.nz - tangential.t * state.ny), half * tangential.x};
  kernels::answer(contacts_.stride(), contacts_.column(c), force, motion.w.data());
}

/// Force found: what the contact did over the step.
void ContactSolver::close(int c, const ContactMotion& motion, ContactTrial& trial, Action& action) const {
  const contact::Support& support = contacts_.supports[c];
  ContactState& state = trial.states[c];
  const double sinking = h_ * motion.sinking(c, state.ny, state.nz);
  const double loss = (state.normal_force - support.normal.stiffness * working_[c].mean) * sinking;
  if (!(state.normal_force > 0.0)) { // the damper holds the contact free of force: it is open
    trial.cut += loss;
    state = {};
    return;
  }
  state.damper_work = loss;
  if (support.friction.active())
    state.displacement = h_ * motion.slip(c, state.ny, state.nz);
  action.work += contact::dot(state.friction, state.displacement) - state.normal_force * sinking;
  action.jump += jump(c, motion, state);
  trial.active.push_back(c);
}

/// h f.(w - B v-) of one contact; over all contacts (h^2/2) f.W.f.
double ContactSolver::jump(int c, const ContactMotion& motion, const ContactState& s) const {
  const auto change = [&](int component) {
    return motion.w[component * contacts_.width + c] - before_[component * contacts_.width + c];
  };
  const double along_x = contacts_.in_plane[c] ? s.friction.x * change(2) : 0.0;
  return h_ * ((s.normal_force * s.ny + s.friction.t * s.nz) * change(0) +
               (s.normal_force * s.nz - s.friction.t * s.ny) * change(1) + along_x);
}

} // namespace fretwork::transient
