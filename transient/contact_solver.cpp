// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contact_solver.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

/// Share of the step over which the penetration is averaged with the velocity before the action. Between 0
/// (mean force too high) and 1 (too low) at w_c h near 1; below w_c h = 0.4 its effect is less than 1 %.
constexpr double window = 0.7;
constexpr double sweep_tolerance = 1e-6;
/// The ratio of the changes of two sweeps foretells the next ones only where they fall clearly.
constexpr double falling = 0.5;
constexpr int most_sweeps = 60;

} // namespace

ContactSolver::ContactSolver(const PackedContacts& contacts, double step)
    : contacts_(contacts), h_(step), size_(static_cast<std::size_t>(contacts.components)) {
  const auto count = static_cast<std::size_t>(contacts.count);
  shut_.reserve(count);
  a_.resize(size_ * count * size_ * count);
  for (std::vector<double>* x : {&force_, &free_, &velocity_})
    x->resize(size_ * count);
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
  project(motion);
  guess(memory);
  action.converged = sweep(memory);
  for (std::size_t i = 0; i < shut_.size(); ++i)
    close(i, trial, action);
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
  Shut& shut = shut_.emplace_back();
  shut.contact = c;
  shut.ny = at.ny;
  shut.nz = at.nz;
  shut.mean = mean;
  shut.approach = rate;
  shut.per_normal = 1.0 / (support.normal.stiffness * mean);
  shut.friction = support.friction.active();
  if (shut.friction) {
    shut.per_friction = shut.per_normal / support.friction.mu_static;
    shut.memory = memory.at(c, at.ny, at.nz);
  }
}

/// s0 and A of the shut contacts.
void ContactSolver::project(const ContactMotion& motion) {
  const std::size_t count = shut_.size(), width = static_cast<std::size_t>(contacts_.width);
  row_ = size_ * count;
  for (std::size_t i = 0; i < count; ++i) {
    const Shut& s = shut_[i];
    const double* w = &motion.w[static_cast<std::size_t>(s.contact)];
    double* free = &free_[size_ * i];
    free[0] = -s.approach;
    free[1] = s.nz * w[0] - s.ny * w[width];
    if (size_ == 3)
      free[2] = w[2 * width];
    for (std::size_t j = 0; j <= i; ++j)
      project(s, shut_[j], &a_[size_ * (i * row_ + j)]);
  }
  for (std::size_t r = 0; r < row_; ++r)
    for (std::size_t k = 0; k < r; ++k)
      a_[k * row_ + r] = a_[r * row_ + k];
}

/// Velocities of one contact along its directions by unit forces along those of another, times h/2: a block of A.
void ContactSolver::project(const Shut& to, const Shut& from, double* block) const {
  const int width = contacts_.width, stride = contacts_.stride();
  const double* y = contacts_.column(from.contact) + to.contact; // by a force along y of `from`; then z, x
  const double* z = y + stride;
  const double half = 0.5 * h_;
  const double ny = half * from.ny, nz = half * from.nz;
  const double by_n[2] = {ny * y[0] + nz * z[0], ny * y[width] + nz * z[width]};
  const double by_t[2] = {nz * y[0] - ny * z[0], nz * y[width] - ny * z[width]};
  block[0] = to.ny * by_n[0] + to.nz * by_n[1];
  block[1] = to.ny * by_t[0] + to.nz * by_t[1];
  block[row_] = to.nz * by_n[0] - to.ny * by_n[1];
  block[row_ + 1] = to.nz * by_t[0] - to.ny * by_t[1];
  if (size_ < 3)
    return;
  const double* x = z + stride;
  block[2] = half * (to.ny * x[0] + to.nz * x[width]);
  block[row_ + 2] = half * (to.nz * x[0] - to.ny * x[width]);
  block[2 * row_] = ny * y[2 * width] + nz * z[2 * width];
  block[2 * row_ + 1] = nz * y[2 * width] - ny * z[2 * width];
  block[2 * row_ + 2] = half * x[2 * width];
}

/// The normal forces of each contact alone, and the friction of the last step within its bound.
void ContactSolver::guess(const ContactMemory& memory) {
  std::copy_n(free_.begin(), row_, velocity_.begin());
  std::fill_n(force_.begin(), row_, 0.0);
  for (std::size_t i = 0; i < shut_.size(); ++i) {
    const Shut& s = shut_[i];
    const contact::Support& support = contacts_.supports[s.contact];
    const std::size_t at = size_ * i;
    const double normal = contact::step_normal(support.normal, s.mean, s.approach, a_[at * row_ + at]);
    const contact::Vec2 last = s.friction ? memory.last_force(s.contact, s.ny, s.nz) : contact::Vec2{};
    const double bound = support.friction.mu_dynamic * normal, length = contact::norm(last);
    const double share = length > bound ? bound / length : 1.0;
    const double by[3] = {normal, share * last.t, share * last.x};
    change(i, by);
  }
}

/// Returns whether the forces settled.
bool ContactSolver::sweep(const ContactMemory& memory) {
  const bool coupled = std::any_of(shut_.begin(), shut_.end(), [&](const Shut& s) {
    return s.friction || contacts_.supports[s.contact].normal.damps();
  });
  if (!coupled)
    return true;
  double last = 0.0;
  for (int k = 0; k < most_sweeps; ++k) {
    double largest = 0.0;
    for (std::size_t i = 0; i < shut_.size(); ++i)
      largest = std::max(largest, improve(i, memory.table(shut_[i].contact)));
    const bool foretold = largest <= falling * last;
    if (largest <= sweep_tolerance || (foretold && largest * largest <= sweep_tolerance * (last - largest)))
      return true;
    last = largest;
  }
  return false;
}

/// One contact solved with all others held. Returns the largest change of its forces, relative to what it can bear.
double ContactSolver::improve(std::size_t i, const contact::FrictionTable& table) {
  Shut& s = shut_[i];
  const contact::Support& support = contacts_.supports[s.contact];
  const std::size_t at = size_ * i;
  const double *n = &a_[at * row_ + at], *t = n + row_; // own block of A
  const double *v = &velocity_[at], *f = &force_[at];
  double by[3] = {0.0, 0.0, 0.0};
  if (support.normal.damps())
    by[0] = contact::step_normal(support.normal, s.mean, n[0] * f[0] - v[0], n[0]) - f[0];
  double largest = s.per_normal * std::abs(by[0]);
  if (s.friction) {
    const double normal = f[0] + by[0];
    const double along_t = v[1] + n[1] * by[0] - t[1] * f[1]; // velocities without this contact's friction
    contact::Friction friction;
    if (contacts_.in_plane[s.contact]) {
      const double* x = t + row_;
      const contact::Vec2 free{v[2] + n[2] * by[0] - x[2] * f[2] - x[1] * f[1], along_t - t[2] * f[2]};
      friction =
          contact::step_friction_plane(support.friction, table, s.memory, normal, free, {x[2], t[2], t[1]});
      by[2] = friction.force.x - f[2];
    } else {
      friction = contact::step_friction_line(support.friction, table, s.memory, normal, along_t, t[1]);
    }
    s.slides = friction.slides;
    by[1] = friction.force.t - f[1];
    largest = std::max(largest, s.per_friction * (std::abs(by[1]) + std::abs(by[2])));
  }
  change(i, by);
  return largest;
}

/// Adds to the forces of a contact; all velocities answer.
void ContactSolver::change(std::size_t i, const double* by) {
  for (std::size_t k = 0; k < size_; ++k)
    force_[size_ * i + k] += by[k];
  const double* __restrict n = &a_[size_ * i * row_], * __restrict t = n + row_;
  double* __restrict v = velocity_.data(); // apart from A
  if (size_ == 2) {
    for (std::size_t r = 0; r < row_; ++r)
      v[r] += by[0] * n[r] + by[1] * t[r];
    return;
  }
  const double* __restrict x = t + row_;
  for (std::size_t r = 0; r < row_; ++r)
    v[r] += by[0] * n[r] + by[1] * t[r] + by[2] * x[r];
}

/// Forces found: what the contact did over the step.
void ContactSolver::close(std::size_t i, ContactTrial& trial, Action& action) const {
  const Shut& s = shut_[i];
  const contact::Support& support = contacts_.supports[s.contact];
  const double *f = &force_[size_ * i], *v = &velocity_[size_ * i], *before = &free_[size_ * i];
  const double loss = -h_ * (f[0] - support.normal.stiffness * s.mean) * v[0];
  for (std::size_t k = 0; k < size_; ++k) {
    action.work += h_ * f[k] * v[k];
    action.jump += h_ * f[k] * (v[k] - before[k]);
  }
  if (!(f[0] > 0.0)) { // the damper holds the contact free of force: it is open
    trial.cut += loss;
    return;
  }
  ContactState& state = trial.states[s.contact];
  state.normal_force = f[0];
  state.ny = s.ny;
  state.nz = s.nz;
  state.approach = s.approach;
  state.damper_work = loss;
  if (s.friction) {
    const contact::Vec2 along = support.friction.along;
    const bool in_plane = contacts_.in_plane[s.contact];
    state.friction = {in_plane ? f[2] : 0.0, f[1]};
    state.displacement = {in_plane ? h_ * along.x * v[2] : 0.0, h_ * along.t * v[1]};
    state.slides = s.slides;
  }
  trial.active.push_back(s.contact);
}

} // namespace fretwork::transient
