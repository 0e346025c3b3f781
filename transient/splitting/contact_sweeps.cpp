// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_sweeps.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

constexpr int most_sweeps = 40;
/// Of the largest force of a step: what contacts may still have to answer when the sweeps stop.
constexpr double sweep_tolerance = 1e-3;

} // namespace

ContactSweeps::ContactSweeps(const PackedContacts& contacts, std::vector<Mobility> mobility, double step,
                             int parts)
    : contacts_(contacts), mobility_(std::move(mobility)), h_(step) {
  const auto count = static_cast<std::size_t>(contacts.count);
  pasts_.resize(count);
  forces_.resize(count);
  parts_.assign(count, parts);
  steps_.reserve(count);
  moving_.reserve(count);
  loaded_.reserve(count);
  for (int c = 0; c < contacts.count; ++c)
    steps_.emplace_back(contacts.supports[c], Components{contacts.rest_y(c), contacts.rest_z(c), 0.0},
                        mobility_[static_cast<std::size_t>(c) * (count + 1)], contacts.in_plane[c] != 0, step,
                        parts, contacts.reach[c].limit[kernels::lane(c)]);
}

void ContactSweeps::divide(int c, int parts) {
  parts_[c] = parts;
  steps_[c].divide(parts);
}

void ContactSweeps::follow(const ContactSweeps& other) {
  pasts_ = other.pasts_;
  forces_ = other.forces_;
  loaded_ = other.loaded_;
  normal_springs_ = other.normal_springs_;
  tangential_springs_ = other.tangential_springs_;
}

void ContactSweeps::visit(core::StateArchive& state) {
  state(pasts_, forces_, parts_, loaded_, normal_springs_, tangential_springs_);
  if (state.restores())
    for (std::size_t c = 0; c < steps_.size(); ++c)
      steps_[c].divide(parts_[c]);
}

void ContactSweeps::hold(int c, const contact::Location& at, double normal_force) {
  ContactPast& past = pasts_[c];
  past.axes = at.axes();
  past.closed = past.before_run = true;
  forces_[c].held = {normal_force * at.ny, normal_force * at.nz, 0.0};
}

Components ContactSweeps::of_lanes(const kernels::Array& lanes, int c) const {
  const auto width = static_cast<std::size_t>(contacts_.width), lane = static_cast<std::size_t>(c);
  return {lanes[lane], lanes[width + lane], contacts_.components == 3 ? lanes[2 * width + lane] : 0.0};
}

FreePath ContactSweeps::path_of(int c, const ContactMotion& start, const ContactMotion& end) const {
  const double per = 1.0 / h_;
  const Components u0 = of_lanes(start.u, c), v0 = of_lanes(start.w, c), v1 = of_lanes(end.w, c),
                   mean = per * (of_lanes(end.u, c) - u0);
  const Components by_held = mobility_[static_cast<std::size_t>(c) * (pasts_.size() + 1)] * forces_[c].held;
  return {u0, v0, per * (6.0 * mean - 4.0 * v0 - 2.0 * v1) - by_held,
          (6.0 * per * per) * (v0 + v1 - 2.0 * mean)};
}

bool ContactSweeps::make(const ContactMotion& start, const ContactMotion& end, const std::vector<int>& near,
                         ContactTrial& trial, StepLosses& losses) {
  trial.clear();
  moving_.clear();
  for (const int c : near) {
    trial.states[c] = {}; // also of contacts that were near and open
    Force& force = forces_[c];
    force.mean = force.slope = {};
    const FreePath path = path_of(c, start, end);
    if (!steps_[c].meets(pasts_[c], path))
      continue;
    Moving& m = moving_.emplace_back();
    m.c = c;
    m.path = path;
    m.act.mean = force.held;
  }
  for (const int c : loaded_)
    if (std::none_of(moving_.begin(), moving_.end(), [&](const Moving& m) { return m.c == c; }))
      losses.damping += steps_[c].relax(pasts_[c], h_);
  const bool settled = sweep();
  for (const Moving& m : moving_) {
    const ContactAct& act = m.act;
    pasts_[m.c] = act.past;
    forces_[m.c] = {act.mean, act.slope, act.past.closed ? act.last : Components{}};
    trial.states[m.c] = act.state;
    losses.damping += act.state.damper_work + act.relaxed;
    losses.friction += act.state.friction_work;
    if (act.state.normal_force > 0.0)
      trial.active.push_back(m.c);
    if (act.opened)
      trial.opened.push_back(m.c);
  }
  return settled;
}

/// Returns whether no contact would answer what has changed since it was found by more than the tolerance.
bool ContactSweeps::sweep() {
  double largest = 0.0;
  for (Moving& m : moving_) {
    find(m);
    largest = std::max(largest, sum_of_sizes(m.act.mean));
  }
  for (int i = 1; i < most_sweeps; ++i) {
    bool settled = true;
    for (Moving& m : moving_)
      if (unanswered(m) > sweep_tolerance * largest) {
        find(m);
        settled = false;
      }
    if (settled)
      return true;
  }
  return false;
}

/// N.
double ContactSweeps::unanswered(const Moving& m) const {
  return steps_[m.c].answer() *
         (sum_of_sizes(m.mean - m.answered[0]) + sum_of_sizes(m.slope - m.answered[1]));
}

/// One contact with the forces of all others.
void ContactSweeps::find(Moving& m) {
  FreePath path = m.path;
  path.a = path.a + (m.mean - m.slope);
  path.j = path.j + (2.0 / h_) * m.slope;
  const Components mean = m.act.mean, slope = m.act.slope;
  steps_[m.c].make(pasts_[m.c], path, forces_[m.c].held, m.act);
  m.answered[0] = m.mean;
  m.answered[1] = m.slope;
  const Components by_mean = m.act.mean - mean, by_slope = m.act.slope - slope;
  const Mobility* w = &mobility_[static_cast<std::size_t>(m.c) * pasts_.size()];
  for (Moving& other : moving_)
    if (&other != &m) {
      other.mean = other.mean + w[other.c] * by_mean;
      other.slope = other.slope + w[other.c] * by_slope;
    }
}

void ContactSweeps::settle(const ContactMotion& end) {
  normal_springs_ = tangential_springs_ = 0.0;
  for (const Moving& m : moving_) {
    if (m.act.penetrates) // also where a damper holds the contact free of force
      normal_springs_ += contacts_.supports[m.c].normal.spring_energy(-end.locate(m.c).gap);
    steps_[m.c].stretch(pasts_[m.c], of_lanes(end.u, m.c) - m.act.end);
  }
  loaded_.clear();
  for (int c = 0; c < contacts_.count; ++c)
    if (const contact::Vec2 spring = pasts_[c].friction.spring; dot(spring, spring) > 0.0) {
      loaded_.push_back(c);
      tangential_springs_ += contacts_.supports[c].friction.spring_energy(spring);
    }
}

void ContactSweeps::pass(int steps, ContactTrial& trial, StepLosses& losses) {
  trial.clear();
  normal_springs_ = tangential_springs_ = 0.0;
  auto kept = loaded_.begin();
  for (const int c : loaded_) {
    losses.damping += steps_[c].relax(pasts_[c], steps * h_);
    const contact::Vec2 spring = pasts_[c].friction.spring;
    if (dot(spring, spring) > 0.0) {
      tangential_springs_ += contacts_.supports[c].friction.spring_energy(spring);
      *kept++ = c;
    }
  }
  loaded_.erase(kept, loaded_.end());
}

} // namespace fretwork::transient
