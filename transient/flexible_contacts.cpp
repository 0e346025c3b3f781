// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/flexible_contacts.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace fretwork::transient {
namespace {

constexpr double window = 0.7; ///< of contact_solver.cpp
/// Largest change of a sweep, relative to the largest force there is.
constexpr double sweep_tolerance = 1e-9;
/// Contacts beside each other share most of their flexibility (0.9 of it: a factor 0.8 a sweep).
constexpr int most_sweeps = 300;
/// Each place found at the start is nearer by the share of R F_N in the obstacle's radius: to the last digit, or nearly so.
constexpr int most_places = 50;

using Directions = std::array<std::array<double, 3>, 3>;
/// n, t, x_loc over y, z, x_loc.
Directions directions(double ny, double nz) { return {{{ny, nz, 0.0}, {nz, -ny, 0.0}, {0.0, 0.0, 1.0}}}; }

} // namespace

FlexibleContacts::FlexibleContacts(const PackedContacts& contacts, const Eigen::MatrixXd& residual,
                                   double step)
    : contacts_(contacts), h_(step) {
  constexpr std::array<Eigen::Index, 3> stored = {1, 2, 0}; // of blocks y, z, x
  const auto count = static_cast<std::size_t>(contacts.count);
  r_.resize(3 * contacts.count, 3 * contacts.count);
  for (Eigen::Index row = 0; row < r_.rows(); ++row)
    for (Eigen::Index column = 0; column < r_.cols(); ++column)
      r_(row, column) = residual(row / 3 * 3 + stored[static_cast<std::size_t>(row % 3)],
                                 column / 3 * 3 + stored[static_cast<std::size_t>(column % 3)]);
  shut_.reserve(count);
  mobility_.assign(9 * count * count, 0.0);
  residual_ = mobility_;
  speed_.assign(3 * count, 0.0);
  give_ = speed_;
  for (kernels::Array* a : {&bare_, &now_, &last_, &before_, &guess_, &given_, &given_last_, &given_before_,
                            &own_, &own_last_, &own_before_})
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

ContactSolver::Action FlexibleContacts::solve(const ContactMemory& memory, ContactMotion& motion,
                                              ContactTrial& trial) {
  ContactSolver::Action action;
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
  differentiate();
  if (!quiet_)
    foretell(motion);
  const bool near = motion.find_near(0.5 * window * h_);
  if (!near && quiet_)
    return true;
  for (int c = 0; c < contacts_.count; ++c)
    if ((near && motion.near(c)) || last_[c] != 0.0 || last_[contacts_.width + c] != 0.0)
      take(c, motion);
  bool settled = true;
  do {
    build();
    settled = sweep(memory);
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
  for (std::size_t i = 0; i < shut_.size(); ++i) {
    const Shut& s = shut_[i];
    const double own = at(residual_, 3 * i, 3 * i) * s.force[0];
    own_last_[s.contact] = s.ny * own;
    own_last_[contacts_.width + s.contact] = s.nz * own;
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

/// A contact where it stands in `motion`, moved there by `given_`.
void FlexibleContacts::take(int c, const ContactMotion& motion) {
  const contact::Support& support = contacts_.supports[c];
  const int width = contacts_.width;
  const auto at = motion.locate(c);
  const Directions d = directions(at.ny, at.nz);
  Shut& s = shut_.emplace_back();
  s.contact = c;
  s.normal = still_ ? contact::NormalLaw{support.normal.stiffness} : support.normal;
  s.friction = !still_ && support.friction.active();
  s.in_plane = contacts_.in_plane[c] != 0;
  s.ny = at.ny;
  s.nz = at.nz;
  s.approach = motion.sinking(c, at.ny, at.nz);
  s.reach = still_ ? 0.0 : 0.5 * window * h_ * s.approach;
  s.normal.damping *=
      contact::closed_share(-at.gap - s.reach, -at.gap + s.reach); // as the last forces leave it
  s.bare = -at.gap + at.ny * given_[c] + at.nz * given_[width + c];
  const auto along = [&](const kernels::Array& lanes, double* to) {
    for (std::size_t k = 0; k < 3; ++k) {
      to[k] = 0.0;
      for (int a = 0; a < contacts_.components; ++a)
        to[k] += d[k][static_cast<std::size_t>(a)] * lanes[a * width + c];
    }
  };
  along(motion.w, s.velocity);
  along(given_last_, s.last);
  along(given_before_, s.before);
  along(guess_, s.force);
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

/// Takes the contacts that the forces found have closed. Returns whether there are any.
bool FlexibleContacts::recruit(ContactMotion& motion) {
  const std::size_t before = shut_.size();
  if (before == static_cast<std::size_t>(contacts_.count) || !motion.find_near(0.5 * window * h_))
    return false;
  for (int c = 0; c < contacts_.count; ++c) {
    const bool taken = std::any_of(shut_.begin(), shut_.end(), [c](const Shut& s) { return s.contact == c; });
    if (taken || !motion.near(c))
      continue;
    take(c, motion);
    const Shut& s = shut_.back();
    const double p = -motion.locate(c).gap;
    if (!(contact::mean_penetration(p - s.reach, p + s.reach) > 0.0))
      shut_.pop_back();
  }
  return shut_.size() > before;
}

/// A and R along the directions of the shut contacts, and what their forces do.
void FlexibleContacts::build() {
  const int width = contacts_.width, stride = contacts_.stride();
  const auto components = static_cast<std::size_t>(contacts_.components);
  for (std::size_t i = 0; i < shut_.size(); ++i)
    for (std::size_t j = 0; j < shut_.size(); ++j) {
      const Shut &to = shut_[i], &from = shut_[j];
      const Directions di = directions(to.ny, to.nz), dj = directions(from.ny, from.nz);
      const double* column = contacts_.column(from.contact);
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) {
          double a = 0.0, r = 0.0;
          for (std::size_t m = 0; m < components; ++m)
            for (std::size_t n = 0; n < components; ++n) {
              const double share = di[k][m] * dj[l][n];
              const int row = static_cast<int>(m), other = static_cast<int>(n);
              a += share * column[other * stride + row * width + to.contact];
              r += share * r_(3 * to.contact + row, 3 * from.contact + other);
            }
          at(mobility_, 3 * i + k, 3 * j + l) = 0.5 * h_ * a;
          at(residual_, 3 * i + k, 3 * j + l) = r;
        }
    }
  for (std::size_t i = 0; i < shut_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      speed_[3 * i + k] = shut_[i].velocity[k];
      give_[3 * i + k] = 0.0;
    }
  for (std::size_t i = 0; i < shut_.size(); ++i)
    for (int k = 0; k < 3; ++k)
      change(i, k, std::exchange(shut_[i].force[k], 0.0));
}

/// Adds to a force; all velocities and displacements answer.
void FlexibleContacts::change(std::size_t i, int component, double by) {
  if (by == 0.0)
    return;
  shut_[i].force[component] += by;
  const std::size_t column = 3 * i + static_cast<std::size_t>(component);
  for (std::size_t row = 0; row < 3 * shut_.size(); ++row) {
    speed_[row] += at(mobility_, row, column) * by;
    give_[row] += at(residual_, row, column) * by;
  }
}

bool FlexibleContacts::sweep(const ContactMemory* memory) {
  for (int k = 0; k < most_sweeps; ++k) {
    double changed = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < shut_.size(); ++i) {
      changed = std::max(changed, improve(i, memory));
      largest = std::max(largest, shut_[i].force[0]);
    }
    if (changed <= sweep_tolerance * largest)
      return true;
  }
  return false;
}

/// p' at the instant of the action.
double FlexibleContacts::normal_rate(std::size_t i) const {
  const Shut& s = shut_[i];
  return -(speed_[3 * i] + rate_.now * give_[3 * i] + rate_.last * s.last[0] + rate_.before * s.before[0]);
}

/// One contact solved with all others held. Returns the largest change of its forces, N.
double FlexibleContacts::improve(std::size_t i, const ContactMemory* memory) {
  Shut& s = shut_[i];
  const std::size_t n = 3 * i;
  const double own = at(residual_, n, n), mobility = at(mobility_, n, n) + rate_.now * own;
  const double p = s.bare - (give_[n] - own * s.force[0]);
  s.mean = contact::mean_penetration(p - s.reach, p + s.reach);
  const double normal =
      s.mean > 0.0
          ? contact::series_force(s.normal, s.mean, normal_rate(i) + mobility * s.force[0], mobility, own)
          : 0.0;
  double changed = std::abs(normal - s.force[0]);
  change(i, 0, normal - s.force[0]);
  if (!s.friction || !memory)
    return changed;
  const contact::Friction found = normal > 0.0 ? friction(i, *memory) : contact::Friction{{}, false};
  s.slides = found.slides;
  const double by_t = found.force.t - s.force[1], by_x = found.force.x - s.force[2];
  change(i, 1, by_t);
  change(i, 2, by_x);
  return std::max({changed, std::abs(by_t), std::abs(by_x)});
}

contact::Friction FlexibleContacts::friction(std::size_t i, const ContactMemory& memory) const {
  const Shut& s = shut_[i];
  const std::size_t t = 3 * i + 1, x = t + 1;
  const auto mobility = [&](std::size_t row, std::size_t column) {
    return at(mobility_, row, column) + s.rate.now * at(residual_, row, column);
  };
  const auto velocity = [&](std::size_t row, std::size_t k) {
    return speed_[row] + s.rate.now * give_[row] + s.rate.last * s.last[k] + s.rate.before * s.before[k];
  };
  const contact::FrictionLaw& law = contacts_.supports[s.contact].friction;
  const auto& table = memory.table(s.contact);
  const auto past = memory.at(s.contact, s.ny, s.nz);
  const double tt = mobility(t, t);
  if (!s.in_plane)
    return contact::step_friction_line(law, table, past, s.force[0], velocity(t, 1) - tt * s.force[1], tt);
  const double xx = mobility(x, x), xt = mobility(x, t);
  const contact::Vec2 free{velocity(x, 2) - xx * s.force[2] - xt * s.force[1],
                           velocity(t, 1) - xt * s.force[2] - tt * s.force[1]};
  return contact::step_friction_plane(law, table, past, s.force[0], free, {xx, xt, tt});
}

/// All contacts to where the forces found take them.
void FlexibleContacts::move(ContactMotion& motion) {
  std::fill(now_.begin(), now_.end(), 0.0);
  for (const Shut& s : shut_) {
    const Directions d = directions(s.ny, s.nz);
    for (std::size_t a = 0; a < static_cast<std::size_t>(contacts_.components); ++a)
      for (std::size_t k = 0; k < 3; ++k)
        now_[a * static_cast<std::size_t>(contacts_.width) + static_cast<std::size_t>(s.contact)] +=
            s.force[k] * d[k][a];
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
void FlexibleContacts::close(ContactTrial& trial, ContactSolver::Action& action) const {
  for (std::size_t i = 0; i < shut_.size(); ++i) {
    const Shut& s = shut_[i];
    const int c = s.contact;
    const std::size_t n = 3 * i;
    const double rate = normal_rate(i);
    const double p = s.bare - give_[n],
                 spring = s.normal.stiffness * (s.mean - at(residual_, n, n) * s.force[0]);
    if (p > 0.0)
      trial.springs += 0.5 * s.normal.stiffness * p * p;
    if (!(s.mean > 0.0))
      continue;
    const double loss = h_ * (s.force[0] - spring) * rate;
    if (!(s.force[0] > 0.0)) { // the damper holds the contact free of force: it is open
      trial.cut += loss;
      continue;
    }
    ContactState& state = trial.states[c];
    state.normal_force = s.force[0];
    state.ny = s.ny;
    state.nz = s.nz;
    state.approach = s.approach;
    state.damper_work = loss;
    double moved[3] = {}; // over the step
    for (std::size_t k = 0; k < 3; ++k) {
      action.work += h_ * s.force[k] * speed_[n + k];
      action.jump += h_ * s.force[k] * (speed_[n + k] - s.velocity[k]);
      trial.springs += 0.5 * s.force[k] * give_[n + k];
      moved[k] = h_ * (speed_[n + k] + rate_.now * give_[n + k] + rate_.last * s.last[k] +
                       rate_.before * s.before[k]);
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
