// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_sweeps.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

constexpr int most_sweeps = 40;
/// Of the largest force of a step: what contacts may still have to answer when the sweeps stop.
constexpr double sweep_tolerance = 1e-3;
/// Forces at the start, which contacts with residual flexibility share: sweeps and their tolerance, of the largest.
constexpr int most_sweeps_at_start = 100000;
constexpr double tolerance_at_start = 1e-13;

Response block_of(const Eigen::MatrixXd& residual, int to, int from) {
  constexpr int row[] = {1, 2, 0}; // of y z x
  Response out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      out.w[i][j] = residual(3 * to + row[i], 3 * from + row[j]);
  return out;
}

} // namespace

ContactSweeps::ContactSweeps(const PackedContacts& contacts, ContactBlocks blocks,
                             std::vector<std::vector<Response>> mobility, const Eigen::MatrixXd& residual,
                             double step, int parts)
    : contacts_(contacts), blocks_(std::move(blocks)), mobility_(std::move(mobility)), h_(step) {
  const auto count = static_cast<std::size_t>(contacts.count);
  pasts_.resize(count);
  forces_.resize(count);
  parts_.assign(count, parts);
  steps_.reserve(count);
  moving_.reserve(count);
  loaded_.reserve(count);
  moves_.assign(count, 0);
  moving_blocks_.resize(blocks_.size());
  touched_.reserve(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    moving_blocks_[b].contacts.reserve(blocks_.contacts[b].size());
  own_.resize(count);
  if (residual.size() > 0) {
    shifts_.resize(count);
    followed_.resize(count);
    for (int to = 0; to < contacts.count; ++to)
      for (int from = 0; from < contacts.count; ++from)
        residual_.push_back(block_of(residual, to, from));
  }
  for (int c = 0; c < contacts.count; ++c) {
    for (const auto& [block, local] : blocks_.places[c]) {
      const Response& part =
          mobility_[block][static_cast<std::size_t>(local) * (blocks_.contacts[block].size() + 1)];
      for (int to = 0; to < 3; ++to)
        for (int from = 0; from < 3; ++from)
          own_[c].w[to][from] += part.w[to][from];
    }
    steps_.emplace_back(contacts.supports[c], Components{contacts.rest_y(c), contacts.rest_z(c), 0.0},
                        own_[c], residual_.empty() ? Response{} : this->residual(c, c),
                        contacts.in_plane[c] != 0, step, parts, contacts.reach[c].limit[kernels::lane(c)]);
  }
}

void ContactSweeps::divide(int c, int parts) {
  parts_[c] = parts;
  steps_[c].divide(parts);
}

void ContactSweeps::follow(const ContactSweeps& other) {
  pasts_ = other.pasts_;
  forces_ = other.forces_;
  loaded_ = other.loaded_;
  shifts_ = other.shifts_;
  followed_ = other.followed_;
  normal_springs_ = other.normal_springs_;
  tangential_springs_ = other.tangential_springs_;
}

void ContactSweeps::visit(core::StateArchive& state) {
  state(pasts_, forces_, parts_, loaded_, followed_, normal_springs_, tangential_springs_);
  if (state.restores() && !residual_.empty())
    find_shifts();
  if (state.restores())
    for (std::size_t c = 0; c < steps_.size(); ++c)
      steps_[c].divide(parts_[c]);
}

/// From now on contact c holds this force, along these axes.
void ContactSweeps::hold(int c, const contact::ContactAxes& axes, const Components& force) {
  Components& held = forces_[c].held;
  if (!residual_.empty()) {
    const SeriesLaws& laws = steps_[c].laws();
    for (int to = 0; to < contacts_.count; ++to)
      if (to != c)
        shifts_[to] = shifts_[to] + residual(to, c) * (force - held);
    shifts_[c] = shifts_[c] + (laws.beyond(axes, force) - laws.beyond(pasts_[c].axes, held));
  }
  held = force;
  pasts_[c].axes = axes;
}

void ContactSweeps::find_shifts() {
  std::fill(shifts_.begin(), shifts_.end(), Components{});
  for (int from = 0; from < contacts_.count; ++from)
    if (const Components& held = forces_[from].held; sum_of_sizes(held) > 0.0)
      for (int to = 0; to < contacts_.count; ++to)
        shifts_[to] = shifts_[to] + (to == from ? steps_[from].laws().beyond(pasts_[from].axes, held)
                                                : residual(to, from) * held);
}

void ContactSweeps::add_shifts(ContactMotion& motion) const {
  for (std::size_t c = 0; c < shifts_.size(); ++c) {
    motion.u[c] += shifts_[c].y;
    motion.u[static_cast<std::size_t>(contacts_.width) + c] += shifts_[c].z;
    if (contacts_.components == 3)
      motion.u[2 * static_cast<std::size_t>(contacts_.width) + c] += shifts_[c].x;
  }
}

Components ContactSweeps::deflection(int c) const {
  return residual_.empty() ? Components{} : steps_[c].laws().within(pasts_[c].axes, forces_[c].mean);
}

contact::Location ContactSweeps::locate_shifted(const ContactMotion& motion, int c) const {
  const Components u = of_lanes(motion.u, c) + (residual_.empty() ? Components{} : shifts_[c]);
  return contact::locate(contacts_.supports[c].obstacle, u.y + contacts_.rest_y(c),
                         u.z + contacts_.rest_z(c));
}

double ContactSweeps::hold_at_start(ContactMotion& motion, std::vector<int>& pressed) {
  double largest = 0.0, changed = 0.0;
  int sweep = 0;
  do {
    largest = changed = 0.0;
    for (int c = 0; c < contacts_.count; ++c) {
      const contact::Location at = locate_shifted(motion, c);
      const contact::ContactAxes axes = at.axes();
      const double force = at.gap < 0.0 ? contact::normal_force(steps_[c].laws().normal(axes), -at.gap,
                                                                motion.sinking(c, axes))
                                        : 0.0;
      pasts_[c].closed = pasts_[c].before_run = force > 0.0;
      const Components held{force * at.ny, force * at.nz, 0.0};
      changed = std::max(changed, sum_of_sizes(held - forces_[c].held));
      largest = std::max(largest, force);
      hold(c, force > 0.0 ? axes : contact::ContactAxes{}, held);
    }
  } while (!residual_.empty() && changed > tolerance_at_start * largest && ++sweep < most_sweeps_at_start);
  pressed.clear();
  double springs = 0.0;
  for (int c = 0; c < contacts_.count; ++c) {
    const contact::Location at = locate_shifted(motion, c);
    springs += steps_[c].laws().normal(at.axes()).spring_energy(-at.gap);
    if (!residual_.empty())
      springs += 0.5 * dot(forces_[c].held, shifts_[c]);
    if (pasts_[c].closed)
      pressed.push_back(c);
  }
  add_shifts(motion);
  followed_ = shifts_;
  return springs;
}

Components ContactSweeps::of_lanes(const kernels::Array& lanes, int c) const {
  const auto width = static_cast<std::size_t>(contacts_.width), lane = static_cast<std::size_t>(c);
  return {lanes[lane], lanes[width + lane], contacts_.components == 3 ? lanes[2 * width + lane] : 0.0};
}

FreePath ContactSweeps::path_of(int c, const ContactMotion& start, const ContactMotion& end) const {
  const double per = 1.0 / h_;
  const Components u0 = of_lanes(start.u, c), v0 = of_lanes(start.w, c), v1 = of_lanes(end.w, c),
                   mean = per * (of_lanes(end.u, c) - u0);
  const Components by_held = own_[c] * forces_[c].held;
  return {u0, v0, per * (6.0 * mean - 4.0 * v0 - 2.0 * v1) - by_held,
          (6.0 * per * per) * (v0 + v1 - 2.0 * mean)};
}

bool ContactSweeps::make(const ContactMotion& start, const ContactMotion& end, const std::vector<int>& near,
                         ContactTrial& trial, StepLosses& losses) {
  trial.clear();
  for (const Moving& m : moving_)
    moves_[m.c] = 0;
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
    moves_[c] = 1;
    m.path = path;
    m.act.mean = force.held;
    if (!residual_.empty())
      m.beyond.mean = steps_[c].laws().beyond(pasts_[c].axes, force.held);
  }
  for (const int c : loaded_)
    if (!moves_[c])
      losses.damping += steps_[c].relax(pasts_[c], h_);
  group();
  double largest = 0.0;
  for (Moving& m : moving_) {
    find(m);
    largest = std::max(largest, sum_of_sizes(m.act.mean));
  }
  bool settled = true;
  for (const int b : touched_)
    if (moving_blocks_[b].parent == b)
      settled = sweep(moving_blocks_[b].first, largest) && settled;
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
  if (!residual_.empty()) {
    for (Moving& m : moving_)
      m.shifted = followed_[m.c] = shifts_[m.c] + m.given.shift.mean + m.given.shift.slope;
    find_shifts();
  }
  return settled;
}

/// The block that stands for the group of a block.
int ContactSweeps::group_of(int block) {
  while (moving_blocks_[block].parent != block)
    block = moving_blocks_[block].parent = moving_blocks_[moving_blocks_[block].parent].parent;
  return block;
}

/// The groups of the contacts that move, each by increasing contacts.
void ContactSweeps::group() {
  for (const int b : touched_) {
    moving_blocks_[b].contacts.clear();
    moving_blocks_[b].first = moving_blocks_[b].last = -1;
  }
  touched_.clear();
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    const auto& places = blocks_.places[moving_[i].c];
    for (const auto& [block, local] : places) {
      if (moving_blocks_[block].contacts.empty()) {
        touched_.push_back(block);
        moving_blocks_[block].parent = block;
      }
      moving_blocks_[block].contacts.push_back({static_cast<int>(i), local});
      moving_blocks_[group_of(block)].parent = group_of(places.front().block);
    }
  }
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    Moving& m = moving_[i];
    m.next = -1;
    MovingBlock& group = moving_blocks_[group_of(blocks_.places[m.c].front().block)];
    (group.first < 0 ? group.first : moving_[group.last].next) = static_cast<int>(i);
    group.last = static_cast<int>(i);
  }
}

/// Further sweeps of a group, by its first contact and the largest force of the step. Returns whether none would answer what has changed since it was found by more than the tolerance.
bool ContactSweeps::sweep(int first, double largest) {
  for (int sweep = 1; sweep < most_sweeps; ++sweep) {
    bool settled = true;
    for (int i = first; i >= 0; i = moving_[i].next)
      if (unanswered(moving_[i]) > sweep_tolerance * largest) {
        find(moving_[i]);
        settled = false;
      }
    if (settled)
      return true;
  }
  return false;
}

/// N.
double ContactSweeps::unanswered(const Moving& m) const {
  const auto change = [](const Line& now, const Line& then) {
    return sum_of_sizes(now.mean - then.mean) + sum_of_sizes(now.slope - then.slope);
  };
  const double out = steps_[m.c].answer() * change(m.given.acceleration, m.answered.acceleration);
  return residual_.empty() ? out : out + steps_[m.c].stiffness() * change(m.given.shift, m.answered.shift);
}

/// One contact with the forces of all others that share a block with it.
void ContactSweeps::find(Moving& m) {
  FreePath path = m.path;
  const Line &acceleration = m.given.acceleration, &shift = m.given.shift;
  path.a = path.a + (acceleration.mean - acceleration.slope);
  path.j = path.j + (2.0 / h_) * acceleration.slope;
  const ContactPast* past = &pasts_[m.c];
  ContactPast stretched;
  if (!residual_.empty()) {
    const Components jump = shift.mean - shift.slope;
    path.u = path.u + jump;
    path.v = path.v + (2.0 / h_) * shift.slope;
    stretched = *past;
    steps_[m.c].displace(stretched, shifts_[m.c] + jump - followed_[m.c]);
    past = &stretched;
  }
  const Line before{m.act.mean, m.act.slope};
  steps_[m.c].make(*past, path, forces_[m.c].held, m.act);
  m.answered = m.given;
  const Line by{m.act.mean - before.mean, m.act.slope - before.slope};
  for (const auto& [block, local] : blocks_.places[m.c]) {
    const Response* w = &mobility_[block][static_cast<std::size_t>(local) * blocks_.contacts[block].size()];
    for (const auto& [i, to] : moving_blocks_[block].contacts)
      if (Moving& other = moving_[i]; &other != &m) {
        other.given.acceleration.add(w[to], by);
      }
  }
  if (!residual_.empty())
    shift_all(m, by);
}

/// All contacts that move, by the change of the force of one.
void ContactSweeps::shift_all(Moving& m, const Line& by) {
  for (Moving& other : moving_)
    if (&other != &m)
      other.given.shift.add(residual(other.c, m.c), by);
  const SeriesLaws& laws = steps_[m.c].laws();
  const Line beyond{laws.beyond(m.act.state.axes, m.act.mean), laws.beyond(m.act.state.axes, m.act.slope)};
  Line& shift = m.given.shift;
  shift.mean = shift.mean + (beyond.mean - m.beyond.mean);
  shift.slope = shift.slope + (beyond.slope - m.beyond.slope);
  m.beyond = beyond;
}

void ContactSweeps::settle(const ContactMotion& end) {
  normal_springs_ = tangential_springs_ = 0.0;
  for (const Moving& m : moving_) {
    if (m.act.penetrates) { // also where a damper holds the contact free of force
      const contact::Location at = end.locate(m.c);
      normal_springs_ += steps_[m.c].laws().normal(at.axes()).spring_energy(-at.gap);
    }
    if (!residual_.empty())
      normal_springs_ += 0.5 * dot(forces_[m.c].held, shifts_[m.c]);
    Components missed = of_lanes(end.u, m.c) - m.act.end;
    if (!residual_.empty())
      missed = missed + (m.shifted - shifts_[m.c]);
    steps_[m.c].stretch(pasts_[m.c], missed);
  }
  loaded_.clear();
  for (int c = 0; c < contacts_.count; ++c)
    if (const contact::Vec2 spring = pasts_[c].friction.spring; dot(spring, spring) > 0.0) {
      loaded_.push_back(c);
      tangential_springs_ += steps_[c].laws().friction().spring_energy(spring);
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
      tangential_springs_ += steps_[c].laws().friction().spring_energy(spring);
      *kept++ = c;
    }
  }
  loaded_.erase(kept, loaded_.end());
}

} // namespace fretwork::transient
