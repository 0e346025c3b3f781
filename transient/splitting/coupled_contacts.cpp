// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/coupled_contacts.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace fretwork::transient {
namespace {

/// Of the largest change of a force in an interval: what a contact may leave unanswered of the others' changes after its turn. At 0.1 two equal contacts of
/// one node that touch in one interval take 2 to 4 % of the energy of the impact, at 0.05 up to 1.5 %; in the many intervals that fast dampers ask for, contacts
/// that stick would gain energy.
constexpr double most_left_out = 0.02;
constexpr int most_passes = 40;
/// Likewise in the first iteration of contacts that are close to others: what is left out is always of one sign, and two of one node that stay closed would gain
/// energy by a damping ratio of 5e-5. To iterate until that is met takes 30 passes beside fast dampers.
constexpr double most_left_out_close = 1e-4;
/// Contacts are close where their common mobility is so much of their own: those of one node, not those of neighbouring supports. What the structure holds back by Y of
/// the forces of others is passed on between close ones alone: between all it takes ten supports 3 to 8 % of the time and shows in no figure.
constexpr double least_close = 0.2;

/// Pairs of contacts of a block whose mobility is so much of their own.
std::vector<char> close_pairs(const std::vector<ImpulseResponse>& responses, std::size_t count) {
  std::vector<char> close(responses.size(), 0);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < count; ++k) {
      const double by = responses[i * count + k].w.largest();
      close[i * count + k] = i != k && by * by > least_close * least_close *
                                                     responses[i * (count + 1)].w.largest() *
                                                     responses[k * (count + 1)].w.largest();
    }
  return close;
}

/// The largest component by size between directions x y z, of the contact that moves and of the one whose force moves it.
double largest_between(const Mobility& w, const std::array<bool, 3>& to, const std::array<bool, 3>& from) {
  double out = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) // x is the last of w
      if (to[static_cast<std::size_t>(i)] && from[static_cast<std::size_t>(k)])
        out = std::max(out, std::abs(w((i + 2) % 3, (k + 2) % 3)));
  return out;
}

std::array<bool, 3> friction_directions(const contact::Support& support) {
  return contact::friction_directions(support.obstacle, support.friction.along);
}

/// Adds what a force does; where no contact has one along x, along y and z alone: half of the work.
constexpr auto add_yzx = [](const Mobility& w, const Components& f, Components& to) { to = to + w * f; };
constexpr auto add_yz = [](const Mobility& w, const Components& f, Components& to) { to.yz += w.yz_of(f); };

} // namespace

CoupledContacts::CoupledContacts(const PackedContacts& contacts, ContactBlocks blocks,
                                 std::vector<std::vector<ImpulseResponse>> responses, double step, int parts)
    : contacts_(contacts), blocks_(std::move(blocks)), responses_(std::move(responses)), h_(step) {
  const auto count = static_cast<std::size_t>(contacts.count);
  pasts_.resize(count);
  forces_.resize(count);
  tables_.resize(count);
  parts_.assign(count, parts);
  laws_.reserve(count);
  moving_.reserve(count);
  counts_.reserve(count);
  next_.reserve(count);
  before_.resize(count);
  found_for_.resize(count);
  moves_.assign(count, 0);
  pushed_in_.reserve(count);
  before_step_.reserve(count);
  moving_blocks_.resize(blocks_.size());
  touched_.reserve(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    moving_blocks_[b].contacts.reserve(blocks_.contacts[b].size());
    moving_blocks_[b].mobility.resize(responses_[b].size());
    moving_blocks_[b].compliance.resize(responses_[b].size());
    moving_blocks_[b].holds_back = std::any_of(responses_[b].begin(), responses_[b].end(),
                                               [](const ImpulseResponse& g) { return g.v.largest() > 0.0; });
    moving_blocks_[b].close = close_pairs(responses_[b], blocks_.contacts[b].size());
    moving_blocks_[b].has_close = std::any_of(moving_blocks_[b].close.begin(), moving_blocks_[b].close.end(),
                                              [](char c) { return c != 0; });
    move_in_intervals_of(static_cast<int>(b), parts);
  }
  for (int c = 0; c < contacts.count; ++c) {
    ImpulseResponse own;
    DamperRates rates;
    const std::array<bool, 3> directions = friction_directions(contacts.supports[c]);
    for (const auto& [block, local] : blocks_.places[c]) {
      const auto size = blocks_.contacts[block].size();
      for (std::size_t from = 0; from < size; ++from) {
        const contact::Support& other = contacts.supports[blocks_.contacts[block][from]];
        const ImpulseResponse& response = responses_[block][from * size + static_cast<std::size_t>(local)];
        const double coupling = response.w.largest();
        rates.normal += other.normal.damping * coupling;
        rates.by_penetration += other.normal.stiffness * other.normal.dissipation * coupling;
        if (other.friction.active())
          rates.tangential +=
              other.friction.damping * largest_between(response.w, directions, friction_directions(other));
      }
      const ImpulseResponse& part = responses_[block][static_cast<std::size_t>(local) * (size + 1)];
      own.w += part.w;
      own.v += part.v;
    }
    laws_.emplace_back(contacts.supports[c], Components{contacts.rest_y(c), contacts.rest_z(c), 0.0}, own,
                       contacts.in_plane[c] != 0, step, contacts.reach[c].limit[kernels::lane(c)], rates);
  }
}

void CoupledContacts::continue_from(const CoupledContacts& other) {
  pasts_ = other.pasts_;
  forces_ = other.forces_;
  normal_springs_ = other.normal_springs_;
  tangential_springs_ = other.tangential_springs_;
}

void CoupledContacts::visit(core::StateArchive& state) {
  state(pasts_, forces_, parts_, normal_springs_, tangential_springs_);
}

void CoupledContacts::preload(int c, const contact::Location& at, double normal_force) {
  ContactPast& past = pasts_[c];
  past.axes = at.axes();
  past.closed = past.before_run = true;
  forces_[c].held = {normal_force * at.ny, normal_force * at.nz, 0.0};
}

FreePath CoupledContacts::path_of(int c, const StepMotion& motion) const {
  const double per = 1.0 / h_;
  const Components u0 = of_lanes(motion.start.u, c), v0 = of_lanes(motion.start.w, c),
                   v1 = of_lanes(motion.end.w, c), mean = per * (of_lanes(motion.end.u, c) - u0);
  return {u0,
          v0,
          per * (6.0 * mean - 4.0 * v0 - 2.0 * v1),
          (6.0 * per * per) * (v0 + v1 - 2.0 * mean),
          (60.0 * per * per) * of_lanes(motion.bow, c),
          per};
}

const IntervalTable& CoupledContacts::table_of(int c, int count) {
  IntervalTable& of = tables_[c];
  if (of.count != count)
    of = laws_[c].table(count);
  return of;
}

void CoupledContacts::make(const StepMotion& motion, const std::vector<int>& near, ContactTrial& trial,
                           ContactLosses& losses) {
  pushed_in_.clear();
  find_forces(motion, near, trial, losses);
}

void CoupledContacts::make_again(const StepMotion& motion, const std::vector<int>& near,
                                 const std::vector<int>& pushed_in, ContactTrial& trial,
                                 ContactLosses& losses) {
  for (const Before& before : before_step_) {
    pasts_[before.number] = before.past;
    forces_[before.number].held = before.held;
  }
  pushed_in_.insert(pushed_in_.end(), pushed_in.begin(), pushed_in.end());
  losses = {};
  find_forces(motion, near, trial, losses);
}

void CoupledContacts::find_forces(const StepMotion& motion, const std::vector<int>& near, ContactTrial& trial,
                                  ContactLosses& losses) {
  trial.clear();
  before_step_.clear();
  converged_ = true;
  clear_moving();
  counts_.clear();
  for (const int c : near) {
    trial.states[c] = {}; // also of contacts that were near and open
    Force& force = forces_[c];
    static_cast<StepForce&>(force) = {};
    const FreePath path = path_of(c, motion);
    const int count = laws_[c].least_count(parts_[c], pasts_[c], path);
    if (!laws_[c].may_close(pasts_[c], path, count) &&
        std::find(pushed_in_.begin(), pushed_in_.end(), c) == pushed_in_.end())
      continue;
    moves_[c] = 1;
    counts_.push_back(count);
    MovingContact& m = moving_.emplace_back();
    m.number = c;
    m.path = path;
    m.course.past = pasts_[c];
  }
  group();
  for (const int b : touched_)
    if (moving_blocks_[b].parent == b)
      move(moving_blocks_[b].first, trial);
  for (const MovingContact& m : moving_) {
    before_step_.push_back({m.number, pasts_[m.number], forces_[m.number].held});
    pasts_[m.number] = m.course.past;
    forces_[m.number] = {m.course.force, laws_[m.number].held(m)};
    trial.states[m.number] = m.course.state;
    losses.damping += m.course.state.damper_work + m.course.relaxed;
    losses.friction += m.course.state.friction_work;
    if (m.course.state.normal_force > 0.0)
      trial.active.push_back(m.number);
    if (m.course.opened)
      trial.opened.push_back(m.number);
  }
}

/// The block that stands for the group of a block.
int CoupledContacts::group_of(int block) {
  while (moving_blocks_[block].parent != block)
    block = moving_blocks_[block].parent = moving_blocks_[moving_blocks_[block].parent].parent;
  return block;
}

/// The groups of the contacts that move.
void CoupledContacts::group() {
  for (const int b : touched_) {
    moving_blocks_[b].contacts.clear();
    moving_blocks_[b].first = moving_blocks_[b].last = -1;
  }
  touched_.clear();
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    const auto& places = blocks_.places[moving_[i].number];
    for (const auto& [block, local] : places) {
      if (moving_blocks_[block].contacts.empty()) {
        touched_.push_back(block);
        moving_blocks_[block].parent = block;
      }
      moving_blocks_[block].contacts.push_back({static_cast<int>(i), local});
      moving_blocks_[group_of(block)].parent = group_of(places.front().block);
    }
  }
  next_.assign(moving_.size(), -1);
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    MovingBlock& group = moving_blocks_[group_of(blocks_.places[moving_[i].number].front().block)];
    (group.first < 0 ? group.first : next_[group.last]) = static_cast<int>(i);
    group.last = static_cast<int>(i);
  }
}

/// A group through the intervals of the step, by its first contact.
void CoupledContacts::move(int first, ContactTrial& trial) {
  int count = 1;
  for (int i = first; i >= 0; i = next_[i])
    count = std::max(count, counts_[i]);
  const bool coupled = next_[first] >= 0;
  bool holds_back = false;
  for (int i = first; i >= 0; i = next_[i])
    for (const auto& place : blocks_.places[moving_[i].number]) {
      if (coupled)
        move_in_intervals_of(place.block, count);
      holds_back = holds_back || moving_blocks_[place.block].holds_back;
    }
  for (int i = first; i >= 0; i = next_[i]) {
    MovingContact& m = moving_[i];
    const Components held = forces_[m.number].held;
    laws_[m.number].begin(m, held, table_of(m.number, count));
    if (coupled) {
      m.is_close = has_close(m);
      pass_on(m, m.force - held, m.growth);
    }
  }
  for (int index = 0; index < count; ++index) {
    if (coupled)
      find_forces_together(first, index);
    else
      laws_[moving_[first].number].find_force(moving_[first], tables_[moving_[first].number], index);
    for (int i = first; i >= 0; i = next_[i]) {
      MovingContact& m = moving_[i];
      if (m.piece.to > m.piece.from)
        trial.pieces.push_back(m.piece);
      if (index == count / 2)
        ContactIntervals::keep_middle(m, tables_[m.number], (0.5 * count - index) * tables_[m.number].length);
      laws_[m.number].move(m, tables_[m.number]);
    }
    if (holds_back && index + 1 < count)
      hold_back(first, h_ / count);
    for (int i = first; i >= 0; i = next_[i]) { // the others take it that all forces grow on
      MovingContact& m = moving_[i];
      const Components grown = m.force + m.growth, growth = m.growth;
      ContactIntervals::extrapolate(m, tables_[m.number]);
      if (coupled && !m.throughout)
        pass_on(m, m.force - grown, m.growth - growth);
    }
  }
}

/// Whether a contact moves with one that is close to it.
bool CoupledContacts::has_close(const MovingContact& m) const {
  for (const auto& [block, local] : blocks_.places[m.number]) {
    const MovingBlock& of = moving_blocks_[block];
    if (!of.has_close)
      continue;
    const std::size_t from = static_cast<std::size_t>(local) * blocks_.contacts[block].size();
    for (const auto& [i, to] : of.contacts)
      if (of.close[from + static_cast<std::size_t>(to)])
        return true;
  }
  return false;
}

/// Contacts of a block that move together, through so many intervals of the step.
void CoupledContacts::move_in_intervals_of(int block, int count) {
  MovingBlock& of = moving_blocks_[block];
  if (of.count == count)
    return;
  of.count = count;
  for (std::size_t i = 0; i < of.mobility.size(); ++i) {
    of.mobility[i] = responses_[block][i].over(h_ / count);
    if (of.close[i])
      of.compliance[i] = responses_[block][i].compliance(h_ / count);
  }
}

/// At the end of an interval: what the modes hold back by V, of the velocity that the forces have given in it, and of the acceleration from now on.
void CoupledContacts::hold_back(int first, double dt) {
  for (int i = first; i >= 0; i = next_[i])
    moving_[i].held_back = moving_[i].held_back + dt * moving_[i].held_back_rate;
  for (int i = first; i >= 0; i = next_[i]) {
    if (contacts_.components == 3)
      hold_back_others(moving_[i], dt, add_yzx);
    else
      hold_back_others(moving_[i], dt, add_yz);
  }
}
template <class Add>
void CoupledContacts::hold_back_others(const MovingContact& m, double dt, const Add& add) {
  const Components force = dt * (m.force - forces_[m.number].held), growth = dt * m.growth;
  if (!(sum_of_sizes(force) + sum_of_sizes(growth) > 0.0))
    return;
  const Components bent = dt * (0.5 * force - (1.0 / 12.0) * growth),
                   moved = (dt * dt / 12.0) * (0.5 * growth - force);
  for (const auto& [block, local] : blocks_.places[m.number]) {
    const ImpulseResponse* by =
        &responses_[block][static_cast<std::size_t>(local) * blocks_.contacts[block].size()];
    for (const auto& [k, to] : moving_blocks_[block].contacts) {
      MovingContact& other = moving_[k];
      add(by[to].v, bent, other.held_back);
      add(by[to].v, force, other.held_back_rate);
      add(by[to].v, moved, other.rate);
    }
  }
}

/// The contacts of a group in an interval: one after the other, and those again whose force what the others have done since would change by a
/// share of all changes that would let them diverge. Without strong dampers, and up to w_c dt = 1, that is so in at most 9 % of the intervals (tubes of bench_statistics).
void CoupledContacts::find_forces_together(int first, int index) {
  double change = 0.0; // N, the largest
  for (int i = first; i >= 0; i = next_[i]) {
    MovingContact& m = moving_[i];
    before_[i] = m.course;
    change = std::max(change, find_force(m, index, i));
  }
  for (int pass = 1; pass < most_passes; ++pass) {
    bool again = false;
    for (int i = first; i >= 0; i = next_[i]) {
      MovingContact& m = moving_[i];
      if (!(laws_[m.number].force_change(m, tables_[m.number], m.others - found_for_[i]) >
            (m.is_close && pass == 1 ? most_left_out_close : most_left_out) * change))
        continue;
      again = true;
      m.course = before_[i];
      ContactIntervals::apply_own_force(m, tables_[m.number]);
      (void)find_force(m, index, i);
    }
    if (!again)
      return;
  }
  converged_ = false;
}

/// One of them. Returns by how much its force is another than it was, N.
double CoupledContacts::find_force(MovingContact& m, int index, int place) {
  const Components force = m.force, growth = m.growth;
  found_for_[place] = m.others;
  laws_[m.number].find_force(m, tables_[m.number], index);
  pass_on(m, m.force - force, m.growth - growth);
  return sum_of_sizes(m.force - force);
}

/// To all others that share a block with it.
void CoupledContacts::pass_on(const MovingContact& m, const Components& by_force,
                              const Components& by_growth) {
  if (!(sum_of_sizes(by_force) + sum_of_sizes(by_growth) > 0.0))
    return;
  if (contacts_.components == 3)
    push_others(m, by_force, by_growth, add_yzx);
  else
    push_others(m, by_force, by_growth, add_yz);
}
template <class Add>
void CoupledContacts::push_others(const MovingContact& m, const Components& by_force,
                                  const Components& by_growth, const Add& add) {
  for (const auto& [block, local] : blocks_.places[m.number]) {
    const MovingBlock& of = moving_blocks_[block];
    const std::size_t from = static_cast<std::size_t>(local) * blocks_.contacts[block].size();
    for (const auto& [i, to] : of.contacts) {
      MovingContact& other = moving_[i];
      if (&other == &m)
        continue;
      const Mobility& w = of.mobility[from + static_cast<std::size_t>(to)];
      add(w, by_force, other.others);
      add(w, by_growth, other.others_growth);
      if (of.close[from + static_cast<std::size_t>(to)]) {
        const Mobility& y = of.compliance[from + static_cast<std::size_t>(to)];
        add(y, by_force, other.others_lift);
        add(y, by_growth, other.others_lift_growth);
      }
    }
  }
}

void CoupledContacts::finish_step(const ContactMotion& end, ContactLosses& losses) {
  normal_springs_ = 0.0;
  for (const MovingContact& m : moving_) {
    if (m.course.penetrates) // also where a damper holds the contact free of force
      normal_springs_ += contacts_.supports[m.number].normal.spring_energy(-end.locate(m.number).gap);
    laws_[m.number].correct_spring_drift(pasts_[m.number],
                                         of_lanes(end.u, m.number) - m.path.displacement(h_) - m.response);
  }
  finish_tangential_springs(1, losses);
}

void CoupledContacts::place_in_middle(double* u) const {
  for (const MovingContact& m : moving_) {
    const Components at = m.path.displacement(0.5 * h_) + m.middle;
    u[m.number] = at.y();
    u[contacts_.width + m.number] = at.z();
    if (contacts_.components == 3)
      u[2 * contacts_.width + m.number] = at.x;
  }
}

void CoupledContacts::pass(int steps, ContactTrial& trial, ContactLosses& losses) {
  trial.clear();
  clear_moving();
  normal_springs_ = 0.0;
  finish_tangential_springs(steps, losses);
}

void CoupledContacts::clear_moving() {
  for (const MovingContact& m : moving_)
    moves_[m.number] = 0;
  moving_.clear();
}

/// Those of contacts that stayed open relax; the energy of all.
void CoupledContacts::finish_tangential_springs(int steps, ContactLosses& losses) {
  tangential_springs_ = 0.0;
  for (int c = 0; c < contacts_.count; ++c) {
    const contact::Vec2& spring = pasts_[c].friction.spring;
    if (!(dot(spring, spring) > 0.0))
      continue;
    if (!moves_[c])
      losses.damping += laws_[c].relax(pasts_[c], steps);
    tangential_springs_ += contacts_.supports[c].friction.spring_energy(spring);
  }
}

} // namespace fretwork::transient
