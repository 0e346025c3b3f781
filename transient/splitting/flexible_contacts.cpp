// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/flexible_contacts.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace fretwork::transient {
namespace {

/// Each place found at the start is nearer by the share of R F_N in the obstacle's radius: to the last digit, or nearly so.
constexpr int most_places = 50;

/// s: how long before and after an action contacts may close that it has to see: those with C_N.
double half_window(const PackedContacts& contacts, double step) {
  const bool any = std::any_of(contacts.supports.begin(), contacts.supports.end(),
                               [](const contact::Support& s) { return s.normal.damping > 0.0; });
  return any ? 0.5 * step : 0.0;
}

/// Of a symmetric matrix.
double largest_eigenvalue(const Eigen::Matrix2d& m) {
  return 0.5 * (m(0, 0) + m(1, 1)) + std::hypot(0.5 * (m(0, 0) - m(1, 1)), m(0, 1));
}

} // namespace

FlexibleContacts::FlexibleContacts(const PackedContacts& contacts, const Eigen::MatrixXd& residual,
                                   double step)
    : contacts_(contacts), h_(step), half_window_(half_window(contacts, step)), mixing_(3 * contacts.count),
      mixed_(3 * contacts.count), swept_(3 * contacts.count) {
  constexpr std::array<Eigen::Index, 3> stored = {1, 2, 0}; // of blocks y, z, x
  const auto count = static_cast<std::size_t>(contacts.count);
  r_.resize(3 * contacts.count, 3 * contacts.count);
  for (Eigen::Index row = 0; row < r_.rows(); ++row)
    for (Eigen::Index column = 0; column < r_.cols(); ++column)
      r_(row, column) = residual(row / 3 * 3 + stored[static_cast<std::size_t>(row % 3)],
                                 column / 3 * 3 + stored[static_cast<std::size_t>(column % 3)]);
  a_ = Eigen::MatrixXd::Zero(3 * contacts.count, 3 * contacts.count);
  for (int from = 0; from < contacts.count; ++from)
    for (int to = 0; to < contacts.count; ++to)
      for (int k = 0; k < contacts.components; ++k)
        for (int l = 0; l < contacts.components; ++l)
          a_(3 * to + k, 3 * from + l) = 0.5 * step * contacts.mobility(to, k, from, l);
  active_.reserve(count);
  speed_.assign(3 * count, 0.0);
  active_deflection_ = speed_;
  for (kernels::Array* a :
       {&modal_u_, &mean_rate_, &now_, &last_, &before_, &extrapolated_, &deflection_, &last_deflection_,
        &deflection_before_, &own_deflection_, &last_own_deflection_, &own_deflection_before_})
    a->assign(static_cast<std::size_t>(contacts.stride()), 0.0);
}

double FlexibleContacts::start(ContactMotion& motion) {
  static_ = true;
  for (int i = 0; i < most_places; ++i) { // the normals turn with the places that the forces give
    (void)act(nullptr, motion);
    const bool converged = now_ == last_;
    for (int twice = 0; twice < 2; ++twice)
      accept();
    if (converged)
      break;
    motion.u = modal_u_;
  }
  for (std::size_t lane = 0; lane < now_.size(); ++lane)
    motion.u[lane] = modal_u_[lane] + deflection_[lane];
  static_ = false;
  actions_ = 0;
  return 0.5 * std::inner_product(now_.begin(), now_.end(), deflection_.begin(), 0.0);
}

FlexibleContacts::Action FlexibleContacts::solve(const ContactMemory& memory, ContactMotion& motion,
                                                 ContactTrial& trial) {
  Action action;
  trial.clear();
  action.converged = act(&memory, motion);
  close(trial, action);
  std::sort(trial.active.begin(), trial.active.end());
  return action;
}

/// Finds the forces and moves the contacts. Returns whether the sweeps converged.
bool FlexibleContacts::act(const ContactMemory* memory, ContactMotion& motion) {
  active_.clear();
  std::fill(now_.begin(), now_.end(), 0.0);
  std::fill(deflection_.begin(), deflection_.end(), 0.0);
  modal_u_ = motion.u;
  if (memory)
    for (std::size_t lane = 0; lane < modal_u_.size(); ++lane)
      mean_rate_[lane] = (modal_u_[lane] - (memory->position()[lane] - last_deflection_[lane])) / h_;
  differentiate();
  if (inactive_) { // and not what `start` or another run has left
    std::fill(extrapolated_.begin(), extrapolated_.end(), 0.0);
    std::fill(own_deflection_.begin(), own_deflection_.end(), 0.0);
  } else
    extrapolate(motion);
  const bool near = motion.find_near(half_window_);
  if (!near && inactive_)
    return true;
  for (int c = 0; c < contacts_.count; ++c)
    if ((near && motion.near(c)) || last_[c] != 0.0 || last_[contacts_.width + c] != 0.0)
      activate(c, motion);
  bool converged = true;
  do {
    build(motion);
    converged = sweep(memory, motion);
    move(motion);
  } while (extend_active_set(motion));
  return converged;
}

void FlexibleContacts::accept() {
  before_.swap(last_);
  deflection_before_.swap(last_deflection_);
  last_ = now_;
  last_deflection_ = deflection_;
  const auto none = [](const kernels::Array& force) {
    return std::all_of(force.begin(), force.end(), [](double f) { return f == 0.0; });
  };
  inactive_ = none(last_) && none(before_);
  own_deflection_before_.swap(last_own_deflection_);
  std::fill(last_own_deflection_.begin(), last_own_deflection_.end(), 0.0);
  for (const ActiveContact& s : active_) {
    const double own = s.residual(0, 0) * s.force[0];
    last_own_deflection_[s.contact] = s.axes.y(own, 0.0);
    last_own_deflection_[contacts_.width + s.contact] = s.axes.z(own, 0.0);
  }
  ++actions_;
}

/// The derivative of the parabola through f_k and the last two, of which the start is one in the first two steps.
void FlexibleContacts::differentiate() {
  rate_ = actions_ == 0   ? Rate{2.0 / h_, -2.0 / h_, 0.0}
          : actions_ == 1 ? Rate{5.0 / 3.0 / h_, -3.0 / h_, 4.0 / 3.0 / h_}
                          : Rate{1.5 / h_, -2.0 / h_, 0.5 / h_};
  half_step_ = actions_ == 0   ? Rate{1.0, -1.0, 0.0}
               : actions_ == 1 ? Rate{1.0, -2.0, 1.0}
                               : Rate{1.0, -1.5, 0.5};
}

/// The force of this step, by the last two where the contact was closed in both, and where that takes the contacts, but for what each
/// normal force does to its own contact.
void FlexibleContacts::extrapolate(ContactMotion& motion) {
  const int width = contacts_.width;
  for (int c = 0; c < contacts_.count; ++c) {
    const bool closed = last_[c] != 0.0 || last_[width + c] != 0.0;
    const bool twice = closed && (before_[c] != 0.0 || before_[width + c] != 0.0);
    for (int k = 0; k < contacts_.components; ++k) {
      const int lane = k * width + c;
      extrapolated_[lane] = last_[lane] + (twice ? last_[lane] - before_[lane] : 0.0);
      own_deflection_[lane] = last_own_deflection_[lane] +
                              (twice ? last_own_deflection_[lane] - own_deflection_before_[lane] : 0.0);
    }
  }
  apply_compliance(extrapolated_, deflection_);
  for (std::size_t lane = 0; lane < deflection_.size(); ++lane)
    deflection_[lane] -= own_deflection_[lane];
  for (std::size_t lane = 0; lane < deflection_.size(); ++lane)
    motion.u[lane] += deflection_[lane];
}

/// Gap of a contact where it stands in `motion`, by the normal there; of an obstacle in parts by that where its own normal force takes it back to: deeper
/// another part may be nearest.
contact::Location FlexibleContacts::locate_active(int c, ContactMotion& motion) const {
  if (!contacts_.has_parts[c])
    return motion.locate(c);
  double &y = motion.u[c], &z = motion.u[contacts_.width + c];
  const double deep_y = y, deep_z = z, own_y = own_deflection_[c],
               own_z = own_deflection_[contacts_.width + c];
  y += own_y;
  z += own_z;
  auto at = motion.locate(c);
  at.gap -= at.axes().normal(own_y, own_z);
  y = deep_y;
  z = deep_z;
  return at;
}

/// A contact where it stands in `motion`, moved there by `deflection_`.
void FlexibleContacts::activate(int c, ContactMotion& motion) {
  const contact::Support& support = contacts_.supports[c];
  const int width = contacts_.width;
  const auto at = locate_active(c, motion);
  ActiveContact& s = active_.emplace_back();
  s.contact = c;
  s.friction = !static_ && support.friction.active();
  s.in_plane = contacts_.in_plane[c] != 0;
  s.compliance = largest_eigenvalue(r_.block<2, 2>(3 * c, 3 * c));
  s.axes = at.axes();
  s.modal_penetration = -at.gap + s.axes.normal(deflection_[c], deflection_[width + c]);
  const double reach = half_window_ * motion.penetration_rate(c, s.axes);
  s.closed =
      static_ ? 0.0 : contact::closed_share(-at.gap - reach, -at.gap + reach); // as the last forces leave it
  rotate_axes(s, motion);
  to_local(s, extrapolated_, s.force);
  s.force[0] = std::max(0.0, s.force[0]);
  if (!s.friction || s.force[0] == 0.0)
    s.force[1] = s.force[2] = 0.0;
  if (!s.friction)
    return;
  const contact::FrictionLaw& law = support.friction;
  const double k = law.stiffness, damping = law.damping, scale = 0.5 * k * h_ + damping; // G h
  s.rate = law.kind == contact::FrictionMemoryKind::reference
               ? rate_
               : Rate{(k * half_step_.now + damping * rate_.now) / scale,
                      (k * half_step_.last + damping * rate_.last) / scale,
                      (k * half_step_.before + damping * rate_.before) / scale};
}

/// Components along n, t, x_loc.
void FlexibleContacts::to_local(const ActiveContact& s, const kernels::Array& lanes, double* to) const {
  const int width = contacts_.width, c = s.contact;
  const double y = lanes[c], z = lanes[width + c];
  to[0] = s.axes.normal(y, z);
  to[1] = s.axes.tangent(y, z);
  to[2] = contacts_.components > 2 ? lanes[2 * width + c] : 0.0;
}

/// What a contact has along its directions before the action, and what its own forces do.
void FlexibleContacts::rotate_axes(ActiveContact& s, const ContactMotion& motion) const {
  s.approach = motion.penetration_rate(s.contact, s.axes);
  s.mean_rate = -s.axes.normal(mean_rate_[s.contact], mean_rate_[contacts_.width + s.contact]);
  to_local(s, motion.w, s.velocity);
  to_local(s, last_deflection_, s.last);
  to_local(s, deflection_before_, s.before);
  Eigen::Matrix3d d;
  d << s.axes.ny, s.axes.nz, 0.0, s.axes.nz, -s.axes.ny, 0.0, 0.0, 0.0, 1.0;
  s.mobility = d * a_.block<3, 3>(3 * s.contact, 3 * s.contact) * d.transpose();
  s.residual = d * r_.block<3, 3>(3 * s.contact, 3 * s.contact) * d.transpose();
  const contact::NormalLaw& law = contacts_.supports[s.contact].normal;
  s.normal = law;
  s.normal.damping *= s.closed;
  if (static_)
    s.normal.dissipation = 0.0;
}

/// Takes the contacts that the forces found have closed. Returns whether there are any.
bool FlexibleContacts::extend_active_set(ContactMotion& motion) {
  const std::size_t before = active_.size();
  if (before == static_cast<std::size_t>(contacts_.count) || !motion.find_near(half_window_))
    return false;
  for (int c = 0; c < contacts_.count; ++c) {
    const bool taken =
        std::any_of(active_.begin(), active_.end(), [c](const ActiveContact& s) { return s.contact == c; });
    if (taken || !motion.near(c))
      continue;
    activate(c, motion);
    if (!(motion.locate(c).gap < 0.0) && !(active_.back().normal.damping > 0.0))
      active_.pop_back();
  }
  return active_.size() > before;
}

/// What the forces of the active contacts do.
void FlexibleContacts::build(const ContactMotion& motion) {
  for (std::size_t i = 0; i < active_.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::size_t row = 3 * i + static_cast<std::size_t>(k);
      speed_[row] = k < contacts_.components ? motion.w[k * contacts_.width + active_[i].contact] : 0.0;
      active_deflection_[row] = 0.0;
    }
  for (const ActiveContact& s : active_)
    add_force(s.contact, force(s));
}

/// All contacts to where the forces found take them.
void FlexibleContacts::move(ContactMotion& motion) {
  std::fill(now_.begin(), now_.end(), 0.0);
  for (const ActiveContact& s : active_) {
    const Eigen::Vector3d f = force(s);
    for (int a = 0; a < contacts_.components; ++a)
      now_[a * contacts_.width + s.contact] = f(a);
  }
  apply_compliance(now_, deflection_);
  for (std::size_t lane = 0; lane < deflection_.size(); ++lane)
    motion.u[lane] = modal_u_[lane] + deflection_[lane];
}

void FlexibleContacts::apply_compliance(const kernels::Array& force, kernels::Array& displacement) const {
  std::fill(displacement.begin(), displacement.end(), 0.0);
  const int width = contacts_.width, components = contacts_.components;
  for (int from = 0; from < contacts_.count; ++from)
    for (int l = 0; l < components; ++l) {
      const double f = force[l * width + from];
      if (f == 0.0)
        continue;
      for (int to = 0; to < contacts_.count; ++to)
        for (int k = 0; k < components; ++k)
          displacement[k * width + to] += r_(3 * to + k, 3 * from + l) * f;
    }
}

/// Forces found: what the contacts do over the step.
void FlexibleContacts::close(ContactTrial& trial, Action& action) const {
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const ActiveContact& s = active_[i];
    const int c = s.contact;
    const double rate = normal_rate(i);
    const double p = s.alone - s.residual(0, 0) * s.force[0], spring = s.normal.stiffness * p;
    trial.springs += s.normal.spring_energy(p);
    if (!s.acts())
      continue;
    const double loss = h_ * (s.force[0] - spring) * rate;
    if (!(s.force[0] > 0.0)) { // the damper holds the contact free of force: it is open
      trial.cut += loss;
      continue;
    }
    ContactState& state = trial.states[c];
    state.normal_force = s.force[0];
    state.axes = s.axes;
    state.approach = s.approach;
    state.damper_work = loss;
    double moved[3] = {}; // over the step
    for (int k = 0; k < 3; ++k) {
      const double speed = component(speed_, i, k), give = component(active_deflection_, i, k);
      action.work += h_ * s.force[k] * speed;
      action.jump += h_ * s.force[k] * (speed - s.velocity[k]);
      trial.springs += 0.5 * s.force[k] * give;
      moved[k] = h_ * (speed + rate_.now * give + rate_.last * s.last[k] + rate_.before * s.before[k]);
    }
    if (s.friction) {
      state.friction = {s.force[2], s.force[1]};
      const contact::Vec2 along = contacts_.supports[c].friction.along;
      state.displacement = {s.in_plane ? along.x * moved[2] : 0.0, along.t * moved[1]};
      state.slides = s.slides;
    }
    trial.active.push_back(c);
  }
}

} // namespace fretwork::transient
