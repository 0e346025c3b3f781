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
  shut_.reserve(count);
  speed_.assign(3 * count, 0.0);
  give_ = speed_;
  for (kernels::Array* a : {&bare_, &flown_, &now_, &last_, &before_, &guess_, &given_, &given_last_,
                            &given_before_, &own_, &own_last_, &own_before_})
    a->assign(static_cast<std::size_t>(contacts.stride()), 0.0);
}

double FlexibleContacts::start(ContactMotion& motion) {
  still_ = true;
  for (int i = 0; i < most_places; ++i) { // the normals turn with the places that the forces give
    (void)act(nullptr, motion);
    const bool settled = now_ == last_;
    for (int twice = 0; twice < 2; ++twice)
      accept();
    if (settled)
      break;
    motion.u = bare_;
  }
  for (std::size_t lane = 0; lane < now_.size(); ++lane)
    motion.u[lane] = bare_[lane] + given_[lane];
  still_ = false;
  actions_ = 0;
  return 0.5 * std::inner_product(now_.begin(), now_.end(), given_.begin(), 0.0);
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

/// Finds the forces and moves the contacts. Returns whether the sweeps settled.
bool FlexibleContacts::act(const ContactMemory* memory, ContactMotion& motion) {
  shut_.clear();
  std::fill(now_.begin(), now_.end(), 0.0);
  std::fill(given_.begin(), given_.end(), 0.0);
  bare_ = motion.u;
  if (memory)
    for (std::size_t lane = 0; lane < bare_.size(); ++lane)
      flown_[lane] = (bare_[lane] - (memory->position()[lane] - given_last_[lane])) / h_;
  differentiate();
  if (quiet_) { // and not what `start` or another run has left
    std::fill(guess_.begin(), guess_.end(), 0.0);
    std::fill(own_.begin(), own_.end(), 0.0);
  } else
    foretell(motion);
  const bool near = motion.find_near(half_window_);
  if (!near && quiet_)
    return true;
  for (int c = 0; c < contacts_.count; ++c)
    if ((near && motion.near(c)) || last_[c] != 0.0 || last_[contacts_.width + c] != 0.0)
      take(c, motion);
  bool settled = true;
  do {
    build(motion);
    settled = sweep(memory, motion);
    move(motion);
  } while (recruit(motion));
  return settled;
}

void FlexibleContacts::accept() {
  before_.swap(last_);
  given_before_.swap(given_last_);
  last_ = now_;
  given_last_ = given_;
  const auto none = [](const kernels::Array& force) {
    return std::all_of(force.begin(), force.end(), [](double f) { return f == 0.0; });
  };
  quiet_ = none(last_) && none(before_);
  own_before_.swap(own_last_);
  std::fill(own_last_.begin(), own_last_.end(), 0.0);
  for (const Shut& s : shut_) {
    const double own = s.residual(0, 0) * s.force[0];
    own_last_[s.contact] = s.axes.y(own, 0.0);
    own_last_[contacts_.width + s.contact] = s.axes.z(own, 0.0);
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
void FlexibleContacts::foretell(ContactMotion& motion) {
  const int width = contacts_.width;
  for (int c = 0; c < contacts_.count; ++c) {
    const bool closed = last_[c] != 0.0 || last_[width + c] != 0.0;
    const bool twice = closed && (before_[c] != 0.0 || before_[width + c] != 0.0);
    for (int k = 0; k < contacts_.components; ++k) {
      const int lane = k * width + c;
      guess_[lane] = last_[lane] + (twice ? last_[lane] - before_[lane] : 0.0);
      own_[lane] = own_last_[lane] + (twice ? own_last_[lane] - own_before_[lane] : 0.0);
    }
  }
  give(guess_, given_);
  for (std::size_t lane = 0; lane < given_.size(); ++lane)
    given_[lane] -= own_[lane];
  for (std::size_t lane = 0; lane < given_.size(); ++lane)
    motion.u[lane] += given_[lane];
}

/// Gap of a contact where it stands in `motion`, by the normal there; of an obstacle in parts by that where its own normal force takes it back to: deeper
/// another part may be nearest.
contact::Location FlexibleContacts::face_at(int c, ContactMotion& motion) const {
  if (!contacts_.has_parts[c])
    return motion.locate(c);
  double &y = motion.u[c], &z = motion.u[contacts_.width + c];
  const double deep_y = y, deep_z = z, own_y = own_[c], own_z = own_[contacts_.width + c];
  y += own_y;
  z += own_z;
  auto at = motion.locate(c);
  at.gap -= at.axes().normal(own_y, own_z);
  y = deep_y;
  z = deep_z;
  return at;
}

/// A contact where it stands in `motion`, moved there by `given_`.
void FlexibleContacts::take(int c, ContactMotion& motion) {
  const contact::Support& support = contacts_.supports[c];
  const int width = contacts_.width;
  const auto at = face_at(c, motion);
  Shut& s = shut_.emplace_back();
  s.contact = c;
  s.friction = !still_ && support.friction.active();
  s.in_plane = contacts_.in_plane[c] != 0;
  s.deeper = largest_eigenvalue(r_.block<2, 2>(3 * c, 3 * c));
  s.axes = at.axes();
  s.bare = -at.gap + s.axes.normal(given_[c], given_[width + c]);
  const double reach = half_window_ * motion.sinking(c, s.axes);
  s.closed =
      still_ ? 0.0 : contact::closed_share(-at.gap - reach, -at.gap + reach); // as the last forces leave it
  face(s, motion);
  along(s, guess_, s.force);
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
void FlexibleContacts::along(const Shut& s, const kernels::Array& lanes, double* to) const {
  const int width = contacts_.width, c = s.contact;
  const double y = lanes[c], z = lanes[width + c];
  to[0] = s.axes.normal(y, z);
  to[1] = s.axes.tangent(y, z);
  to[2] = contacts_.components > 2 ? lanes[2 * width + c] : 0.0;
}

/// What a contact has along its directions before the action, and what its own forces do.
void FlexibleContacts::face(Shut& s, const ContactMotion& motion) const {
  s.approach = motion.sinking(s.contact, s.axes);
  s.flown = -s.axes.normal(flown_[s.contact], flown_[contacts_.width + s.contact]);
  along(s, motion.w, s.velocity);
  along(s, given_last_, s.last);
  along(s, given_before_, s.before);
  Eigen::Matrix3d d;
  d << s.axes.ny, s.axes.nz, 0.0, s.axes.nz, -s.axes.ny, 0.0, 0.0, 0.0, 1.0;
  s.mobility = d * a_.block<3, 3>(3 * s.contact, 3 * s.contact) * d.transpose();
  s.residual = d * r_.block<3, 3>(3 * s.contact, 3 * s.contact) * d.transpose();
  const contact::NormalLaw& law = contacts_.supports[s.contact].normal;
  s.normal = law;
  s.normal.damping *= s.closed;
  if (still_)
    s.normal.dissipation = 0.0;
}

/// Takes the contacts that the forces found have closed. Returns whether there are any.
bool FlexibleContacts::recruit(ContactMotion& motion) {
  const std::size_t before = shut_.size();
  if (before == static_cast<std::size_t>(contacts_.count) || !motion.find_near(half_window_))
    return false;
  for (int c = 0; c < contacts_.count; ++c) {
    const bool taken = std::any_of(shut_.begin(), shut_.end(), [c](const Shut& s) { return s.contact == c; });
    if (taken || !motion.near(c))
      continue;
    take(c, motion);
    if (!(motion.locate(c).gap < 0.0) && !(shut_.back().normal.damping > 0.0))
      shut_.pop_back();
  }
  return shut_.size() > before;
}

/// What the forces of the shut contacts do.
void FlexibleContacts::build(const ContactMotion& motion) {
  for (std::size_t i = 0; i < shut_.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::size_t row = 3 * i + static_cast<std::size_t>(k);
      speed_[row] = k < contacts_.components ? motion.w[k * contacts_.width + shut_[i].contact] : 0.0;
      give_[row] = 0.0;
    }
  for (const Shut& s : shut_)
    push(s.contact, force(s));
}

/// All contacts to where the forces found take them.
void FlexibleContacts::move(ContactMotion& motion) {
  std::fill(now_.begin(), now_.end(), 0.0);
  for (const Shut& s : shut_) {
    const Eigen::Vector3d f = force(s);
    for (int a = 0; a < contacts_.components; ++a)
      now_[a * contacts_.width + s.contact] = f(a);
  }
  give(now_, given_);
  for (std::size_t lane = 0; lane < given_.size(); ++lane)
    motion.u[lane] = bare_[lane] + given_[lane];
}

void FlexibleContacts::give(const kernels::Array& force, kernels::Array& displacement) const {
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
  for (std::size_t i = 0; i < shut_.size(); ++i) {
    const Shut& s = shut_[i];
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
      const double speed = component(speed_, i, k), give = component(give_, i, k);
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
