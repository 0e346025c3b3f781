// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contact_intervals.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

constexpr int most_sweeps = 40;
/// Of the largest force of an interval: what contacts may still have to answer when its sweeps stop.
constexpr double sweep_tolerance = 1e-4;
/// Share of its clearance that a contact may move in an interval, and the most intervals that a step is cut into for it.
constexpr double longest_way = 0.5;
constexpr int most_intervals = 64;

double energy(const contact::FrictionLaw& law, contact::Vec2 spring) {
  return 0.5 * dot(spring, spring) / law.stiffness;
}

/// Of the memory `reference`: one mean force over the interval.
contact::FrictionInterval<contact::Vec2>
reference_friction(const contact::FrictionLaw& law, const contact::FrictionTable& table,
                   const contact::FrictionMemory& memory, double normal, double length,
                   const contact::TangentialPath<contact::Vec2, contact::Sym2>& path) {
  const double half = 0.5 * length;
  const contact::Sym2 answer{half * path.mobility.xx, half * path.mobility.xt, half * path.mobility.tt};
  const contact::Vec2 free = path.velocity + half * path.acceleration - answer * path.held;
  const contact::Friction friction = contact::step_friction_plane(law, table, memory, normal, free, answer);
  contact::FrictionInterval<contact::Vec2> out;
  out.displacement = length * (free + answer * friction.force);
  const contact::FrictionStep step = contact::close_step(law, table, memory, friction, out.displacement);
  out.impulse = length * friction.force;
  out.spring = step.memory.spring;
  out.sliding = friction.slides;
  out.slider_work = step.friction_work;
  if (friction.slides) {
    out.slid = norm(out.displacement);
    out.rubbed = normal * out.slid;
    out.sliding_time = length;
  }
  return out;
}

} // namespace

ContactIntervals::ContactIntervals(const PackedContacts& contacts, const kernels::Array& mobility,
                                   double step, int parts)
    : contacts_(contacts), mobility_(mobility), h_(step), usual_dt_(step / parts), dt_(0.0), parts_(parts) {
  const auto count = static_cast<std::size_t>(contacts.count);
  entries_.resize(count);
  laws_.resize(count);
  moving_.reserve(count);
  closed_.reserve(count);
  loaded_.reserve(count);
  for (kernels::Array* a : {&r_, &rate_, &push_})
    a->assign(static_cast<std::size_t>(contacts.stride()), 0.0);
  for (int c = 0; c < contacts.count; ++c)
    for (int k = 0; k < contacts.components; ++k)
      laws_[c].mobility = std::max(laws_[c].mobility, w(c, k, k));
  set_interval(usual_dt_);
}

void ContactIntervals::set_interval(double dt) {
  if (dt == dt_)
    return;
  dt_ = dt;
  for (int c = 0; c < contacts_.count; ++c) {
    Law& law = laws_[c];
    const contact::Support& support = contacts_.supports[c];
    const contact::FrictionLaw& friction = support.friction;
    const double answer = 0.5 * dt * dt * (support.normal.stiffness + friction.stiffness) +
                          dt * (support.normal.damping + friction.damping);
    law.answer = answer / (1.0 + answer * law.mobility);
    law.across = 0.0;
    for (int to = 0; to < contacts_.components; ++to)
      for (int from = 0; from < contacts_.components; ++from)
        law.across = std::max(law.across, to != from ? std::abs(w(c, to, from))
                                                     : 0.5 * std::abs(w(c, to, to) - w(c, 0, 0)));
    law.normal_share = support.normal.damping > 0.0
                           ? contact::implicit_share(support.normal.damping * law.mobility * dt)
                           : 0.5;
    if (friction.active()) {
      law.piece = contact::piece_table(friction, law.mobility, dt);
      law.table = contact::friction_table(friction, dt);
      law.left =
          friction.kind == contact::FrictionMemoryKind::return_map ? contact::spring_left(friction, dt) : 0.0;
    }
  }
}

void ContactIntervals::hold(int c, const contact::Location& at, double normal_force) {
  Entry& e = entries_[c];
  e.ny = at.ny;
  e.nz = at.nz;
  e.closed = e.before_run = true;
  e.force.held[0] = normal_force * at.ny;
  e.force.held[1] = normal_force * at.nz;
  closed_.push_back(c);
}

/// How many intervals a step takes in which no contact may pass its clearance unseen.
int ContactIntervals::intervals(const ContactMotion& start, const ContactMotion& end,
                                const std::vector<int>& near) const {
  double most = 0.0;
  for (const int c : near) {
    const double clearance = contacts_.reach[c].limit[kernels::lane(c)];
    if (!(clearance > 0.0))
      continue;
    const auto y = static_cast<std::size_t>(c), z = static_cast<std::size_t>(contacts_.width + c);
    const double speed2 = std::max(start.w[y] * start.w[y] + start.w[z] * start.w[z],
                                   end.w[y] * end.w[y] + end.w[z] * end.w[z]);
    most = std::max(most, speed2 / (clearance * clearance));
  }
  const double needed = std::ceil(h_ * std::sqrt(most) / longest_way);
  return needed > parts_ ? static_cast<int>(std::min<double>(needed, std::max(most_intervals, parts_)))
                         : parts_;
}

/// The path at a share of the step.
void ContactIntervals::follow(Moving& m, const ContactMotion& start, const ContactMotion& end,
                              double share) const {
  const double s = share, s2 = s * s, s3 = s2 * s;
  const double u1 = 3.0 * s2 - 2.0 * s3, u0 = 1.0 - u1, w0 = h_ * (s - 2.0 * s2 + s3), w1 = h_ * (s3 - s2);
  const double d = 6.0 * (s - s2) / h_, d0 = 1.0 - 4.0 * s + 3.0 * s2, d1 = 3.0 * s2 - 2.0 * s;
  for (int k = 0; k < contacts_.components; ++k) {
    const auto lane = static_cast<std::size_t>(k * contacts_.width + m.c);
    m.x1[k] = u0 * start.u[lane] + u1 * end.u[lane] + w0 * start.w[lane] + w1 * end.w[lane];
    m.v1[k] = d * (end.u[lane] - start.u[lane]) + d0 * start.w[lane] + d1 * end.w[lane];
  }
}

/// A contact takes part in the step: one that is closed, or that its path takes to its obstacle.
void ContactIntervals::enter(int c, int parts, const ContactMotion& start, const ContactMotion& end) {
  Moving& m = moving_.emplace_back();
  m.c = c;
  m.opened = false;
  m.x1[2] = m.v1[2] = 0.0;
  const auto gap_at = [&](int node) {
    follow(m, start, end, static_cast<double>(node) / parts);
    m.to = contact::locate(contacts_.supports[c].obstacle, m.x1[0] + contacts_.rest_y(c),
                           m.x1[1] + contacts_.rest_z(c));
    return m.to.gap;
  };
  if (!entries_[c].closed && gap_at(0) > 0.0) {
    int node = 1;
    while (node <= parts && gap_at(node) > 0.0)
      ++node;
    if (node > parts) {
      moving_.pop_back();
      return;
    }
  }
  (void)gap_at(0);
  std::copy_n(entries_[c].force.held, 3, m.force);
  std::copy_n(m.force, 3, m.last);
}

/// First forces of an interval: those of the last two continued.
void ContactIntervals::guess(Moving& m) {
  double by[3];
  for (int k = 0; k < 3; ++k) {
    by[k] = m.force[k] - m.last[k];
    m.last[k] = m.force[k];
    m.force[k] += by[k];
  }
  if (by[0] != 0.0 || by[1] != 0.0 || by[2] != 0.0)
    kernels::answer(contacts_.stride(), contacts_.components,
                    &mobility_[static_cast<std::size_t>(m.c * 3 * contacts_.stride())], by, push_.data());
}

bool ContactIntervals::make(const ContactMotion& start, const ContactMotion& end,
                            const std::vector<int>& near, ContactTrial& trial, StepLosses& losses) {
  trial.clear();
  moving_.clear();
  for (kernels::Array* a : {&r_, &rate_, &push_})
    std::fill(a->begin(), a->end(), 0.0);
  const int parts = intervals(start, end, near);
  set_interval(parts == parts_ ? usual_dt_ : h_ / parts);
  for (const int c : near) {
    enter(c, parts, start, end);
    trial.states[c] = {}; // also of contacts that were near and open
    Force& force = entries_[c].force;
    std::fill_n(force.mean, 3, 0.0);
    std::fill_n(force.slope, 3, 0.0);
  }
  for (const int c : loaded_)
    if (std::none_of(moving_.begin(), moving_.end(), [&](const Moving& m) { return m.c == c; }))
      losses.damping += relax(c, h_);
  bool settled = true;
  for (int k = 0; k < parts; ++k) {
    for (Moving& m : moving_) {
      std::copy_n(m.x1, 3, m.x0);
      std::copy_n(m.v1, 3, m.v0);
      m.from = m.to;
      follow(m, start, end, k + 1 < parts ? static_cast<double>(k + 1) / parts : 1.0);
      if (k > 0 && moving_.size() > 1)
        guess(m);
    }
    settled = make_interval() && settled;
    const double share = 1.0 / parts;
    for (Moving& m : moving_)
      finish(m, trial.states[m.c], (k + 0.5) * share, share);
    for (std::size_t lane = 0; lane < r_.size(); ++lane) {
      r_[lane] += dt_ * rate_[lane] + 0.5 * dt_ * dt_ * push_[lane];
      rate_[lane] += dt_ * push_[lane];
    }
  }
  closed_.clear();
  for (const Moving& m : moving_) {
    Entry& e = entries_[m.c];
    for (int k = 0; k < 3; ++k)
      e.force.held[k] = e.closed ? m.force[k] : 0.0;
    const ContactState& state = trial.states[m.c];
    losses.damping += state.damper_work;
    losses.friction += state.friction_work;
    if (state.normal_force > 0.0)
      trial.active.push_back(m.c);
    if (m.opened)
      trial.opened.push_back(m.c);
    if (e.closed)
      closed_.push_back(m.c);
  }
  return settled;
}

/// Forces of an interval. Returns whether they settled: whether no contact would answer what has changed since it was asked by more than the
/// tolerance.
bool ContactIntervals::make_interval() {
  double largest = 0.0;
  for (Moving& m : moving_) {
    improve(m);
    largest = std::max(largest, std::abs(m.force[0]) + std::abs(m.force[1]) + std::abs(m.force[2]));
  }
  for (int sweep = 1; sweep < most_sweeps; ++sweep) {
    bool settled = true;
    for (Moving& m : moving_)
      if (m.own_answer + laws_[m.c].answer * pushed_since(m) > sweep_tolerance * largest) {
        improve(m);
        settled = false;
      }
    if (settled)
      return true;
  }
  return false;
}

/// Change of the accelerations by other contacts since contact m was asked, m/s2.
double ContactIntervals::pushed_since(const Moving& m) const {
  double sum = 0.0;
  for (int k = 0; k < contacts_.components; ++k)
    sum += std::abs(push_[static_cast<std::size_t>(k * contacts_.width + m.c)] - m.push[k]);
  return sum;
}

ContactIntervals::Free ContactIntervals::free_motion(const Moving& m) const {
  const double* held = entries_[m.c].force.held;
  Free free{};
  for (int k = 0; k < contacts_.components; ++k) {
    const auto lane = static_cast<std::size_t>(k * contacts_.width + m.c);
    double others = push_[lane];
    for (int j = 0; j < contacts_.components; ++j)
      others -= w(m.c, k, j) * (m.force[j] - held[j]);
    free.moved[k] = m.x1[k] - m.x0[k] + dt_ * rate_[lane] + 0.5 * dt_ * dt_ * others;
    free.acceleration[k] = (m.v1[k] - m.v0[k]) / dt_ + others;
  }
  return free;
}

/// One contact with all others held.
void ContactIntervals::improve(Moving& m) {
  const Free free = free_motion(m);
  const double change = find_normal_force(m, free);
  const double normal = m.normal.force;
  double force[3] = {normal * m.ny, normal * m.nz, 0.0};
  if (contacts_.supports[m.c].friction.active()) {
    find_friction(m, free, change);
    force[0] += m.friction.t * m.nz;
    force[1] -= m.friction.t * m.ny;
    force[2] = m.friction.x;
  }
  double by[3], all = 0.0;
  for (int k = 0; k < 3; ++k) {
    by[k] = force[k] - m.force[k];
    m.force[k] = force[k];
    all += std::abs(by[k]);
  }
  if (all > 0.0)
    kernels::answer(contacts_.stride(), contacts_.components,
                    &mobility_[static_cast<std::size_t>(m.c * 3 * contacts_.stride())], by, push_.data());
  m.own_answer = laws_[m.c].answer * laws_[m.c].across * all;
  for (int k = 0; k < contacts_.components; ++k)
    m.push[k] = push_[static_cast<std::size_t>(k * contacts_.width + m.c)];
}

/// Normal force of the interval. Returns its change from the one that is held.
double ContactIntervals::find_normal_force(Moving& m, const Free& free) {
  const int c = m.c;
  const contact::Support& support = contacts_.supports[c];
  const double* held = entries_[c].force.held;
  const auto y = static_cast<std::size_t>(c), z = static_cast<std::size_t>(contacts_.width + c);
  const double wyy = w(c, 0, 0), wyz = w(c, 0, 1), wzz = w(c, 1, 1), half = 0.5 * dt_ * dt_;
  // where the force that it has leads: the gap is linear about there
  const double own_y = m.force[0] - held[0], own_z = m.force[1] - held[1];
  const double way_y = free.moved[0] + half * (wyy * own_y + wyz * own_z),
               way_z = free.moved[1] + half * (wyz * own_y + wzz * own_z);
  m.to = contact::locate(support.obstacle, m.x0[0] + r_[y] + way_y + contacts_.rest_y(c),
                         m.x0[1] + r_[z] + way_z + contacts_.rest_z(c));
  double start = -m.from.gap, ny = m.to.ny, nz = m.to.nz;
  double end = -m.to.gap;
  const double turned = ny * m.from.ny + nz * m.from.nz;
  if (start > 0.0 && end > 0.0 && turned > 0.0) {
    const double per = 1.0 / std::sqrt(2.0 * (1.0 + turned));
    ny = per * (ny + m.from.ny);
    nz = per * (nz + m.from.nz);
  } else if (start > 0.0 && end <= 0.0) {
    ny = m.from.ny;
    nz = m.from.nz;
    if (turned <= 0.0)
      end = start - (ny * way_y + nz * way_z);
  } else if (turned <= 0.0) {
    start = end + ny * way_y + nz * way_z; // from another face
  }
  m.ny = ny;
  m.nz = nz;
  const double wnn = wyy * ny * ny + 2.0 * wyz * ny * nz + wzz * nz * nz;
  const double held_n = held[0] * ny + held[1] * nz, own_n = own_y * ny + own_z * nz;
  const double share = laws_[c].normal_share;
  const bool from_there =
      m.from.gap < 0.0 &&
      turned > 0.0; // where the normal is its own: N at a node is to be the same from both sides
  const double at_y = from_there ? m.from.ny : ny, at_z = from_there ? m.from.nz : nz;
  const double acceleration = wnn * held_n - (ny * free.acceleration[0] + nz * free.acceleration[1]);
  const contact::NormalPath path{
      start, end + half * wnn * (own_n + held_n) + (share - 0.5) * dt_ * dt_ * acceleration,
      -(at_y * (m.v0[0] + rate_[y]) + at_z * (m.v0[1] + rate_[z])), acceleration};
  m.normal = contact::normal_over_interval(support.normal, dt_, wnn, share, path);
  m.damper_work = m.normal.damper_work;
  m.to.gap = -m.normal.end;
  return m.normal.force - held_n;
}

/// Friction of the interval under its normal force.
void ContactIntervals::find_friction(Moving& m, const Free& free, double normal_change) {
  const contact::FrictionLaw& law = contacts_.supports[m.c].friction;
  const Entry& e = entries_[m.c];
  m.friction = m.displacement = {};
  m.friction_square = m.slider_work = m.rubbed = m.slid = m.sliding_time = 0.0;
  m.memory = e.friction;
  if (e.ny * m.ny + e.nz * m.nz < 0.0 && m.normal.force > 0.0) { // another surface
    m.memory = {};
    m.damper_work += energy(law, e.friction.spring);
  }
  if (m.normal.force > 0.0) {
    find_closed_friction(m, free, normal_change, m.memory);
    return;
  }
  m.memory.sliding = false;
  if (dot(m.memory.spring, m.memory.spring) > 0.0) {
    m.damper_work += (1.0 - laws_[m.c].left * laws_[m.c].left) * energy(law, m.memory.spring);
    m.memory.spring = laws_[m.c].left * m.memory.spring;
  }
}

void ContactIntervals::find_closed_friction(Moving& m, const Free& free, double normal_change,
                                            contact::FrictionMemory memory) {
  const int c = m.c;
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  const Law& own = laws_[c];
  const double* held = entries_[c].force.held;
  const bool by_reference =
      law.kind == contact::FrictionMemoryKind::reference; // which knows no parts of an interval
  const bool whole = by_reference || (m.normal.from == 0.0 && m.normal.to == 1.0);
  const double ny = m.ny, nz = m.nz, from = whole ? 0.0 : m.normal.from * dt_;
  const double length = whole ? dt_ : (m.normal.to - m.normal.from) * dt_;
  const auto left = [&](double time) { return contact::spring_left(law, time); };
  double stored = energy(law, memory.spring);
  if (from > 0.0) {
    memory.sliding = false;
    if (stored > 0.0) {
      const double rest = left(from);
      memory.spring = rest * memory.spring;
      m.damper_work += (1.0 - rest * rest) * stored;
      stored *= rest * rest;
    }
  }
  // along t = (nz, -ny), by the modes, other contacts and the change of its own normal force
  const double wyy = w(c, 0, 0), wyz = w(c, 0, 1), wzz = w(c, 1, 1);
  const double across = (wyy - wzz) * ny * nz + wyz * (nz * nz - ny * ny);
  const double wtt = wyy * nz * nz - 2.0 * wyz * ny * nz + wzz * ny * ny;
  const double half = 0.5 * dt_ * dt_;
  struct Line {
    double moved, acceleration, held;
  };
  const auto velocity = [&](const Line& l) { return l.moved / dt_ + (from - 0.5 * dt_) * l.acceleration; };
  const Line t{nz * free.moved[0] - ny * free.moved[1] + half * across * normal_change,
               nz * free.acceleration[0] - ny * free.acceleration[1] + across * normal_change,
               nz * held[0] - ny * held[1]};
  const auto close = [&](const auto& f, contact::Vec2 impulse, contact::Vec2 by, contact::Vec2 spring) {
    m.friction = (1.0 / dt_) * impulse;
    m.displacement = by;
    m.memory = {spring, f.sliding};
    m.slider_work = f.slider_work;
    m.rubbed = f.rubbed;
    m.slid = f.slid;
    m.sliding_time = f.sliding_time;
    // what goes into the element and is neither stored nor taken by the slider
    m.damper_work += stored - energy(law, spring) - m.slider_work - dot((1.0 / length) * impulse, by);
  };
  if (contacts_.in_plane[c]) {
    const double wxn = ny * w(c, 0, 2) + nz * w(c, 1, 2), wxt = nz * w(c, 0, 2) - ny * w(c, 1, 2);
    const Line x{free.moved[2] + half * wxn * normal_change, free.acceleration[2] + wxn * normal_change,
                 held[2]};
    const contact::Vec2 along = law.along;
    const contact::TangentialPath<contact::Vec2, contact::Sym2> path{
        {along.x * velocity(x), along.t * velocity(t)},
        {along.x * x.acceleration, along.t * t.acceleration},
        {along.x * x.held, along.t * t.held},
        {along.x * w(c, 2, 2), along.x * along.t * wxt, along.t * wtt}};
    const auto f = by_reference ? reference_friction(law, own.table, memory, m.normal.force, length, path)
                                : contact::friction_over_interval(law, own.piece, own.mobility, memory.spring,
                                                                  memory.sliding, length, m.normal.first,
                                                                  m.normal.last, path);
    close(f, f.impulse, f.displacement, f.spring);
  } else {
    const contact::TangentialPath<double, double> path{
        law.along.t * velocity(t), law.along.t * t.acceleration, law.along.t * t.held, law.along.t * wtt};
    if (by_reference) {
      const auto f = reference_friction(
          law, own.table, memory, m.normal.force, length,
          {{0.0, path.velocity}, {0.0, path.acceleration}, {0.0, path.held}, {0.0, 0.0, path.mobility}});
      close(f, f.impulse, f.displacement, f.spring);
    } else {
      const auto f =
          contact::friction_over_interval(law, own.piece, own.mobility, memory.spring.t, memory.sliding,
                                          length, m.normal.first, m.normal.last, path);
      close(f, {0.0, f.impulse}, {0.0, f.displacement}, {0.0, f.spring});
    }
  }
  m.friction_square = dt_ / length * dot(m.friction, m.friction);
  if (m.normal.to < 1.0) {
    const double rest = by_reference ? 0.0 : left(dt_ - from - length);
    m.damper_work += (1.0 - rest * rest) * energy(law, m.memory.spring);
    m.memory = {rest * m.memory.spring, false};
  }
}

/// The interval is over: its forces are those of the contact.
void ContactIntervals::finish(Moving& m, ContactState& state, double middle, double share) {
  Entry& e = entries_[m.c];
  const auto y = static_cast<std::size_t>(m.c), z = static_cast<std::size_t>(contacts_.width + m.c);
  const bool rubs = contacts_.supports[m.c].friction.active(), pressed = m.normal.force > 0.0;
  const bool stays = pressed && m.normal.to == 1.0;
  state.damper_work += m.damper_work;
  if (pressed) {
    if (!e.closed || m.normal.from > 0.0 || e.before_run) {
      ++state.touches;
      e.before_run = false;
      state.closed_at = middle + (m.normal.from - 0.5) * share;
      state.approach = -(m.ny * (m.v0[0] + rate_[y]) + m.nz * (m.v0[1] + rate_[z]));
    }
    const double closed = m.normal.to - m.normal.from;
    state.normal_force += share * m.normal.force;
    state.normal_square += share * m.normal.square();
    state.closed += share * closed;
    state.peak = std::max({state.peak, m.normal.first, m.normal.last});
    e.ny = state.ny = m.ny;
    e.nz = state.nz = m.nz;
    for (int k = 0; k < 3; ++k) {
      e.force.mean[k] += share * m.force[k];
      e.force.slope[k] += 6.0 * share * (middle - 0.5) * m.force[k];
    }
    if (rubs) {
      state.friction = state.friction + share * m.friction;
      state.friction_square += share * m.friction_square;
      state.displacement = state.displacement + m.displacement;
      state.slid += m.slid;
      state.rubbed += m.rubbed;
      state.friction_work += m.slider_work;
      state.sliding += m.sliding_time / h_;
      state.slides = m.sliding_time > 0.0;
    }
  }
  if ((e.closed || pressed) && !stays) {
    m.opened = true;
    state.opened_at = middle + ((pressed ? m.normal.to : 0.0) - 0.5) * share;
    state.departure =
        m.ny * (m.v1[0] + rate_[y] + dt_ * push_[y]) + m.nz * (m.v1[1] + rate_[z] + dt_ * push_[z]);
  }
  e.closed = stays;
  if (!rubs)
    return;
  e.friction = m.memory;
  if (pressed)
    e.spring_at_opening = dot(e.friction.spring, e.friction.spring);
}

void ContactIntervals::settle(const ContactMotion& end) {
  normal_springs_ = tangential_springs_ = 0.0;
  for (const Moving& m : moving_) {
    Entry& e = entries_[m.c];
    const contact::Support& support = contacts_.supports[m.c];
    if (m.to.gap < 0.0) // also where a damper holds the contact free of force
      if (const double gap = end.locate(m.c).gap; gap < 0.0)
        normal_springs_ += 0.5 * support.normal.stiffness * gap * gap;
    const contact::FrictionLaw& law = support.friction;
    if (!e.closed || !law.active() || e.friction.sliding ||
        law.kind == contact::FrictionMemoryKind::reference)
      continue;
    // A spring that sticks is stretched by what the modes moved, not by what they were taken to move: it would creep.
    double missed[3] = {};
    for (int k = 0; k < contacts_.components; ++k) {
      const auto lane = static_cast<std::size_t>(k * contacts_.width + m.c);
      missed[k] = end.u[lane] - (m.x1[k] + r_[lane]);
    }
    e.friction.spring.t -= law.along.t * law.stiffness * (m.nz * missed[0] - m.ny * missed[1]);
    if (contacts_.in_plane[m.c])
      e.friction.spring.x -= law.along.x * law.stiffness * missed[2];
  }
  loaded_.clear();
  for (int c = 0; c < contacts_.count; ++c)
    if (const contact::Vec2 spring = entries_[c].friction.spring; dot(spring, spring) > 0.0) {
      loaded_.push_back(c);
      tangential_springs_ += energy(contacts_.supports[c].friction, spring);
    }
}

/// An open contact forgets. Returns what its spring gives up, J.
double ContactIntervals::relax(int c, double time) {
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  contact::FrictionMemory& memory = entries_[c].friction;
  const double left =
      law.kind == contact::FrictionMemoryKind::return_map ? contact::spring_left(law, time) : 0.0;
  const double before = energy(law, memory.spring);
  memory.spring = left * memory.spring;
  if (dot(memory.spring, memory.spring) <=
      contact::forgotten * contact::forgotten * entries_[c].spring_at_opening)
    memory.spring = {};
  return before - energy(law, memory.spring);
}

void ContactIntervals::pass(int steps, ContactTrial& trial, StepLosses& losses) {
  trial.clear();
  closed_.clear();
  normal_springs_ = 0.0;
  if (loaded_.empty())
    return;
  tangential_springs_ = 0.0;
  auto kept = loaded_.begin();
  for (const int c : loaded_) {
    losses.damping += relax(c, steps * h_);
    const contact::Vec2 spring = entries_[c].friction.spring;
    if (dot(spring, spring) > 0.0) {
      tangential_springs_ += energy(contacts_.supports[c].friction, spring);
      *kept++ = c;
    }
  }
  loaded_.erase(kept, loaded_.end());
}

} // namespace fretwork::transient
