// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_sweeps.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

constexpr int most_sweeps = 40;
/// Of the tolerance times the largest change of a force in a step: what contacts may still have to answer when the sweeps stop. What a slow motion leaves
/// unanswered is answered a step later, and such a delay adds up: at 1 the mean force of tubes that are jammed between bars came out 7 % low, at 0.3 1 %.
constexpr double unanswered = 0.3;
/// Tolerances of the largest change of a force up to which a contact in one state answers to first order, since it was found: such answers err by a share.
constexpr double most_tolerances = 10.0;
/// Of the largest force of a step: what need not be answered in any case, such as the round-off of contacts at rest.
constexpr double negligible = 1e-6;
/// Of the answer of a contact that is closed throughout a step: that of one which is closed for a moment, at least.
constexpr double least_answer = 0.2;

} // namespace

ContactSweeps::ContactSweeps(const PackedContacts& contacts, ContactBlocks blocks,
                             std::vector<std::vector<Mobility>> mobility, double step, int parts,
                             double tolerance)
    : contacts_(contacts), blocks_(std::move(blocks)), mobility_(std::move(mobility)), h_(step),
      tolerance_(tolerance) {
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
  for (int c = 0; c < contacts.count; ++c) {
    for (const auto& [block, local] : blocks_.places[c]) {
      const Mobility& part =
          mobility_[block][static_cast<std::size_t>(local) * (blocks_.contacts[block].size() + 1)];
      for (int to = 0; to < 3; ++to)
        for (int from = 0; from < 3; ++from)
          own_[c].add(to, from, part(to, from));
    }
    steps_.emplace_back(contacts.supports[c], Components{contacts.rest_y(c), contacts.rest_z(c), 0.0},
                        own_[c], contacts.in_plane[c] != 0, step, parts,
                        contacts.reach[c].limit[kernels::lane(c)], tolerance);
  }
}

void ContactSweeps::divide(int c, int parts) {
  parts_[c] = parts;
  steps_[c].divide(parts);
}

void ContactSweeps::continue_from(const ContactSweeps& other) {
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

void ContactSweeps::preload(int c, const contact::Location& at, double normal_force) {
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
  const Components by_held = own_[c] * forces_[c].held;
  return {u0, v0, per * (6.0 * mean - 4.0 * v0 - 2.0 * v1) - by_held,
          (6.0 * per * per) * (v0 + v1 - 2.0 * mean)};
}

bool ContactSweeps::make(const ContactMotion& start, const ContactMotion& end, const std::vector<int>& near,
                         ContactTrial& trial, ContactLosses& losses) {
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
  }
  for (const int c : loaded_)
    if (!moves_[c])
      losses.damping += steps_[c].relax(pasts_[c], h_);
  group();
  double change = 0.0, force = 0.0; // N, the largest
  for (Moving& m : moving_) {
    find(m);
    change = std::max(change, sum_of_sizes(m.act.mean - forces_[m.c].held) + sum_of_sizes(m.act.slope));
    force = std::max(force, sum_of_sizes(m.act.mean));
  }
  bool converged = true;
  for (const int b : touched_)
    if (moving_blocks_[b].parent == b)
      converged = sweep(moving_blocks_[b].first, change, force) && converged;
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
  return converged;
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

/// Further sweeps of a group, by its first contact.
/// @param change, force  N: the largest change of a force in the step, and the largest force
/// @return whether no contact would answer what has changed since by more than is enough
bool ContactSweeps::sweep(int first, double change, double force) {
  const double enough = std::max(unanswered * tolerance_ * change, negligible * force);
  const double one_state = std::min(most_tolerances * tolerance_, std::sqrt(tolerance_)) * change,
               other = tolerance_ * change;
  for (int sweep = 1; sweep < most_sweeps; ++sweep) {
    bool converged = true;
    for (int i = first; i >= 0; i = moving_[i].next) {
      Moving& m = moving_[i];
      if (!(force_for(m, m.answered_for) > enough))
        continue;
      converged = false;
      const double most = steps_[m.c].in_one_state(m.act) ? one_state : other;
      if (!(force_for(m, m.found_for) < most) || !answer(m))
        find(m);
    }
    if (converged)
      return true;
  }
  return false;
}

/// N: about what a contact would answer to what has changed since.
double ContactSweeps::force_for(const Moving& m, const Components (&since)[2]) const {
  return std::max(least_answer, m.act.state.closed) * steps_[m.c].apparent_mass() *
         (sum_of_sizes(m.mean - since[0]) + sum_of_sizes(m.slope - since[1]) / 3.0);
}

/// One contact with the forces of all others that share a block with it.
void ContactSweeps::find(Moving& m) {
  FreePath path = m.path;
  path.a = path.a + (m.mean - m.slope);
  path.j = path.j + (2.0 / h_) * m.slope;
  const Components mean = m.act.mean, slope = m.act.slope;
  steps_[m.c].make(pasts_[m.c], path, forces_[m.c].held, m.act);
  m.found_for[0] = m.mean;
  m.found_for[1] = m.slope;
  pass_on(m, mean, slope);
}

/// To what has changed since it was found, to first order. Returns whether that is near.
bool ContactSweeps::answer(Moving& m) {
  const Components mean = m.act.mean, slope = m.act.slope;
  if (!steps_[m.c].answer(m.mean - m.answered_for[0], m.slope - m.answered_for[1], m.act))
    return false;
  pass_on(m, mean, slope);
  return true;
}

/// Its force was another before.
void ContactSweeps::pass_on(Moving& m, const Components& mean, const Components& slope) {
  m.answered_for[0] = m.mean;
  m.answered_for[1] = m.slope;
  const Components by_mean = m.act.mean - mean, by_slope = m.act.slope - slope;
  for (const auto& [block, local] : blocks_.places[m.c]) {
    const Mobility* w = &mobility_[block][static_cast<std::size_t>(local) * blocks_.contacts[block].size()];
    for (const auto& [i, to] : moving_blocks_[block].contacts)
      if (Moving& other = moving_[i]; &other != &m) {
        other.mean = other.mean + w[to] * by_mean;
        other.slope = other.slope + w[to] * by_slope;
      }
  }
}

void ContactSweeps::finish_step(const ContactMotion& end) {
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

void ContactSweeps::pass(int steps, ContactTrial& trial, ContactLosses& losses) {
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
