// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contact_solver.hpp"
#include "contact/instant_spring.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

constexpr double sweep_tolerance = 1e-6;
constexpr int most_sweeps = 60;
/// Jacobi sweeps that take longer than this converge badly, if they do.
constexpr int most_jacobi_sweeps = 12;

} // namespace

double half_window(const PackedContacts& contacts, double step) {
  const bool damped = std::any_of(contacts.supports.begin(), contacts.supports.end(),
                                  [](const contact::Support& s) { return s.normal.damping > 0.0; });
  return damped ? 0.5 * step : 0.0;
}

namespace {

kernels::SweepRule rule_of(const PackedContacts& contacts, double step) {
  const auto any = [&](const auto& has) {
    return std::any_of(contacts.supports.begin(), contacts.supports.end(), has);
  };
  const bool damped = any([](const contact::Support&s) { return s.normal.damps(); }),
             rubs = any([](const contact::Support&s) { return s.friction.active(); });
  return {step,           1.0 / step, step / 6.0,      half_window(contacts, step),
          damped || rubs, damped,     sweep_tolerance, most_jacobi_sweeps};
}

} // namespace

ContactSolver::ContactSolver(const PackedContacts& contacts, double step)
    : contacts_(contacts), rule_(rule_of(contacts, step)), laws_(kernels::law_lanes(contacts, step)),
      lanes_(contacts.width, contacts.in_lanes && rule_.implicit && !rule_.damped),
      block_(static_cast<std::size_t>(contacts.components) * static_cast<std::size_t>(contacts.stride())) {
  shut_.reserve(static_cast<std::size_t>(contacts.count));
  a_.assign(block_ * static_cast<std::size_t>(contacts.count), 0.0);
  velocity_.assign(static_cast<std::size_t>(contacts.stride()), 0.0);
}

ContactSolver::Action ContactSolver::solve(const ContactMemory& memory, ContactMotion& motion,
                                           ContactTrial& trial) {
  motion.find_near(rule_.half_window);
  return solve_near(memory, motion, trial);
}

ContactSolver::Action ContactSolver::solve_near(const ContactMemory& memory, const ContactMotion& motion,
                                                ContactTrial& trial) {
  Action action;
  trial.clear();
  shut_.clear();
  if (motion.places.first.empty())
    return action;
  if (contacts_.in_lanes && solve_in_lanes(memory, motion, trial, action))
    return action;
  meet(motion, trial);
  if (shut_.empty())
    return action;
  couple(motion);
  prepare(memory, motion);
  action.converged = sweep(memory, motion);
  close(motion, trial, action);
  return action;
}

bool ContactSolver::solve_in_lanes(const ContactMemory& memory, const ContactMotion& motion,
                                   ContactTrial& trial, Action& action) {
  const kernels::Solved solved = kernels::solve(rule_, laws_, memory.lanes(), contacts_.mobility_lanes,
                                                motion, memory.position().data(), lanes_, trial.lanes);
  if (!solved.settled)
    return false;
  trial.springs = solved.springs;
  trial.found_in_lanes = lanes_.count > 0;
  action.work = solved.work;
  action.jump = solved.jump;
  for (int k = 0; k < lanes_.count; ++k)
    show_lane(lanes_.contacts[k], trial);
  return true;
}

/// The state of a contact that takes part.
void ContactSolver::show_lane(int c, ContactTrial& trial) const {
  const kernels::StepNumbers& found = lanes_[c];
  const kernels::CommitNumbers& end = trial.lanes[c];
  const int l = kernels::lane(c);
  if (!(found.normal[l] > 0.0)) { // the damper holds the contact free of force: it is open
    trial.cut += found.cut[l];
    return;
  }
  ContactState& state = trial.states[c];
  state.normal_force = found.normal[l];
  state.instant_share = instant_share(found.normal[l], found.spring[l], found.instant[l]);
  state.ny = end.normal_y[l];
  state.nz = end.normal_z[l];
  state.approach = -found.before_n[l];
  state.damper_work = found.cut[l];
  state.friction.t = found.friction[l];
  state.displacement.t = end.displacement[l];
  state.slides = found.slides[l] != 0.0;
  trial.active.push_back(c);
}

/// The contacts near their obstacles: which of them are shut in this step.
void ContactSolver::meet(const ContactMotion& motion, ContactTrial& trial) {
  for (int c = 0; c < contacts_.count; ++c) {
    if (!motion.near(c))
      continue;
    const contact::Support& support = contacts_.supports[c];
    const double p = -motion.gaps[c], rate = motion.sinking(c, motion.normal_y[c], motion.normal_z[c]);
    const double reach = rule_.half_window * rate, closed = contact::closed_share(p - reach, p + reach);
    if (p > 0.0)
      trial.springs += 0.5 * support.normal.stiffness * p * p;
    else if (!(closed * support.normal.damping > 0.0))
      continue;
    Shut& shut = shut_.emplace_back();
    shut.contact = c;
    shut.depth = std::max(0.0, p);
    shut.closed = closed;
    shut.approach = rate;
  }
}

/// s0 and A.
void ContactSolver::couple(const ContactMotion& motion) {
  const int directions = contacts_.components;
  kernels::project(contacts_.width, directions, motion.normal_y.data(), motion.normal_z.data(),
                   motion.w.data(), velocity_.data());
  for (std::size_t i = 0; i < shut_.size(); ++i) {
    const int c = shut_[i].contact;
    kernels::respond(contacts_.width, directions, contacts_.column(c), motion.normal_y[c], motion.normal_z[c],
                     0.5 * rule_.step, motion.normal_y.data(), motion.normal_z.data(), &a_[block_ * i]);
  }
}

/// The laws of the shut contacts for this step, and first forces: the normal force of each alone, the friction of the last step within
/// its bound.
void ContactSolver::prepare(const ContactMemory& memory, const ContactMotion& motion) {
  const int width = contacts_.width, stride = contacts_.stride();
  for (std::size_t i = 0; i < shut_.size(); ++i) {
    Shut& s = shut_[i];
    const int c = s.contact;
    const contact::Support& support = contacts_.supports[c];
    const double* own = &a_[block_ * i + static_cast<std::size_t>(c)];
    for (int k = 0; k < contacts_.components; ++k)
      s.before[k] = velocity_[k * width + c];
    s.nn = own[0];
    s.nt = own[width];
    const contact::NormalLaw& law = support.normal;
    const double moved = motion.normal_y[c] * (motion.u[c] - memory.position()[c]) +
                         motion.normal_z[c] * (motion.u[width + c] - memory.position()[width + c]);
    const auto [spring, instant] = s.depth > 0.0 ? contact::InstantSpring(law.stiffness, s.nn, rule_.step)
                                                       .push(s.depth, -moved / rule_.step, s.approach)
                                                 : contact::InstantSpring::Push{0.0, 0.0};
    s.instant = instant;
    s.normal = contact::NormalStep(spring, s.closed * law.damping + law.dissipation * spring, s.nn);
    s.per_normal = 1.0 / s.normal.spring_and_damper(s.approach);
    s.friction = support.friction.active();
    if (!s.friction)
      continue;
    s.slip.tt = own[stride + width];
    s.in_plane = contacts_.in_plane[c] != 0;
    if (s.in_plane) {
      s.nx = own[2 * width];
      s.slip.xt = own[stride + 2 * width];
      s.slip.xx = own[2 * stride + 2 * width];
    } else {
      s.line = contact::LineStep(support.friction, memory.table(c),
                                 memory.at(c, motion.normal_y[c], motion.normal_z[c]), s.slip.tt);
    }
    s.per_friction = s.per_normal / support.friction.mu_static;
  }
  for (std::size_t i = 0; i < shut_.size(); ++i) {
    const Shut& s = shut_[i];
    double by[3] = {s.normal.force(s.approach), 0.0, 0.0};
    if (s.friction) {
      const contact::Vec2 last =
          memory.last_force(s.contact, motion.normal_y[s.contact], motion.normal_z[s.contact]);
      const double bound = contacts_.supports[s.contact].friction.mu_dynamic * by[0];
      const double length = s.in_plane ? contact::norm(last) : std::abs(last.t);
      const double share = length > bound ? bound / length : 1.0;
      by[1] = share * last.t;
      by[2] = share * last.x;
    }
    change(i, by);
  }
}

/// Returns whether the forces settled.
bool ContactSolver::sweep(const ContactMemory& memory, const ContactMotion& motion) {
  if (!rule_.implicit)
    return true;
  double last = 0.0;
  for (int k = 0; k < most_sweeps; ++k) {
    double largest = 0.0;
    for (std::size_t i = 0; i < shut_.size(); ++i)
      largest = std::max(largest, improve(i, memory, motion));
    if (kernels::settled(largest, last, sweep_tolerance, 1.0))
      return true;
    last = largest;
  }
  return false;
}

/// One contact solved with all others held. Returns the largest change of its forces, relative to what it can bear.
double ContactSolver::improve(std::size_t i, const ContactMemory& memory, const ContactMotion& motion) {
  Shut& s = shut_[i];
  const double* v = &velocity_[static_cast<std::size_t>(s.contact)];
  double by[3] = {};
  by[0] = s.normal.force(s.nn * s.force[0] - v[0]) - s.force[0];
  double largest = s.per_normal * std::abs(by[0]);
  if (s.friction) {
    const double normal = s.force[0] + by[0];
    contact::Friction friction;
    if (s.in_plane) {
      friction = friction_in_plane(s, normal, by, memory, motion);
      by[2] = friction.force.x - s.force[2];
    } else {
      // the velocity without this contact's friction
      friction = s.line.friction(normal, v[contacts_.width] + s.nt * by[0] - s.slip.tt * s.force[1]);
    }
    s.slides = friction.slides;
    by[1] = friction.force.t - s.force[1];
    largest = std::max(largest, s.per_friction * (std::abs(by[1]) + std::abs(by[2])));
  }
  change(i, by);
  return largest;
}

contact::Friction ContactSolver::friction_in_plane(const Shut& s, double normal, const double* by,
                                                   const ContactMemory& memory,
                                                   const ContactMotion& motion) const {
  const int c = s.contact, width = contacts_.width;
  const double* v = &velocity_[static_cast<std::size_t>(c)];
  const contact::Vec2 free{v[2 * width] + s.nx * by[0] - s.slip.xx * s.force[2] - s.slip.xt * s.force[1],
                           v[width] + s.nt * by[0] - s.slip.xt * s.force[2] - s.slip.tt * s.force[1]};
  return contact::step_friction_plane(contacts_.supports[c].friction, memory.table(c),
                                      memory.at(c, motion.normal_y[c], motion.normal_z[c]), normal, free,
                                      s.slip);
}

/// Adds to the forces of a contact; all velocities answer.
void ContactSolver::change(std::size_t i, const double* by) {
  for (int k = 0; k < 3; ++k)
    shut_[i].force[k] += by[k];
  kernels::answer(contacts_.stride(), contacts_.components, &a_[block_ * i], by, velocity_.data());
}

/// Forces found: what the contacts did over the step.
void ContactSolver::close(const ContactMotion& motion, ContactTrial& trial, Action& action) const {
  const int width = contacts_.width;
  for (const Shut& s : shut_) {
    const int c = s.contact;
    const double v[3] = {velocity_[c], velocity_[width + c],
                         contacts_.components == 3 ? velocity_[2 * width + c] : 0.0};
    const double loss = -rule_.step * (s.force[0] - s.normal.spring()) * v[0];
    for (int k = 0; k < 3; ++k) {
      action.work += rule_.step * s.force[k] * v[k];
      action.jump += rule_.step * s.force[k] * (v[k] - s.before[k]);
    }
    if (!(s.force[0] > 0.0)) { // the damper holds the contact free of force: it is open
      trial.cut += loss;
      continue;
    }
    ContactState& state = trial.states[c];
    state.normal_force = s.force[0];
    state.instant_share = instant_share(s.force[0], s.normal.spring(), s.instant);
    state.ny = motion.normal_y[c];
    state.nz = motion.normal_z[c];
    state.approach = s.approach;
    state.damper_work = loss;
    if (s.friction) {
      const contact::Vec2 along = contacts_.supports[c].friction.along;
      state.friction = {s.force[2], s.force[1]};
      state.displacement = {s.in_plane ? rule_.step * along.x * v[2] : 0.0, rule_.step * along.t * v[1]};
      state.slides = s.slides;
    }
    trial.active.push_back(c);
  }
}

} // namespace fretwork::transient
