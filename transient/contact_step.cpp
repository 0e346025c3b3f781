// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contact_step.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

/// Share of its clearance that a contact may move between two looks for its obstacle, and the most looks a step.
constexpr double longest_way = 0.5;
constexpr int most_looks = 64;
/// Of a step: what is shorter is none.
constexpr double shortest = 1e-9;
/// Of the time between two looks: how well a touch is found.
constexpr double touch_tolerance = 1e-12;
constexpr int most_iterations = 40;
/// Of the usual length: intervals below it take the gap of the position for their rates.
constexpr double short_interval = 0.3;
/// Of an interval: time in which a contact that has opened is out at least.
constexpr double shortest_way_out = 1e-3;
/// Where normal and tangential motion are coupled an interval is made again until its force stands to this share.
constexpr double repeat_tolerance = 1e-6;
constexpr int most_repeats = 20;
/// Touches and openings that are found in a step: more are none that a step could follow.
constexpr int most_events = 200;

double energy(const contact::FrictionLaw& law, contact::Vec2 spring) {
  return 0.5 * dot(spring, spring) / law.stiffness;
}

double dot(double ny, double nz, const Components& c) { return ny * c.y + nz * c.z; }

/// Of the memory `reference`: one mean force over the interval.
contact::FrictionInterval<contact::Vec2>
reference_friction(const contact::FrictionLaw& law, const contact::FrictionTable& table,
                   const contact::FrictionMemory& memory, double normal, double length,
                   const contact::TangentialPath<contact::Vec2, contact::Sym2>& path) {
  const double half = 0.5 * length;
  const contact::Sym2 answer{half * path.mobility.xx, half * path.mobility.xt, half * path.mobility.tt};
  const contact::Vec2 free = path.velocity + half * path.acceleration;
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

struct ContactStep::Motion {
  double t = 0.0;
  Components u, v, a, j;
  Components force;     ///< N, of the last interval: the first guess of the next
  contact::Location at; ///< its gap is that of the laws while the contact is closed
  [[nodiscard]] Components displacement(double time) const {
    return time * (v + 0.5 * time * (a + (time / 3.0) * j));
  }
  [[nodiscard]] Components velocity(double time) const { return v + time * (a + 0.5 * time * j); }
  /// With a further constant acceleration.
  void move(double time, const Components& by) {
    u = u + displacement(time) + 0.5 * time * time * by;
    v = velocity(time) + time * by;
    a = a + time * j;
    t += time;
  }
};

struct ContactStep::Pressed {
  double ny, nz;        ///< normal of the interval
  contact::Location to; ///< at its end
  contact::NormalInterval normal;
  contact::FrictionMemory memory; ///< at its end
  contact::Vec2 friction, displacement;
  double friction_square = 0.0, slider_work = 0.0, damper_work = 0.0, rubbed = 0.0, slid = 0.0,
         sliding_time = 0.0;
  Components force; ///< N
};

ContactStep::ContactStep(const contact::Support& support, const Components& rest, const Mobility& mobility,
                         bool in_plane, double step, int parts, double clearance)
    : obstacle_(support.obstacle), normal_(support.normal), friction_(support.friction), rest_(rest),
      w_(mobility), in_plane_(in_plane), h_(step), mobility_(0.0), across_(0.0), clearance_(clearance) {
  const auto& w = w_.w;
  for (int to = 0; to < 3; ++to) {
    mobility_ = std::max(mobility_, w[to][to]);
    for (int from = 0; from < to; ++from)
      across_ = std::max({across_, std::abs(w[to][from]), std::abs(w[from][to])});
  }
  across_ = std::max(across_, 0.5 * std::abs(w[1][1] - w[0][0]));
  divide(parts);
  answer_ = interval(step).answer;
}

void ContactStep::divide(int parts) { usual_ = interval(h_ / parts); }

ContactStep::Interval ContactStep::interval(double length) const {
  Interval of;
  of.length = length;
  const double answer = 0.5 * length * length * (normal_.stiffness + friction_.stiffness) +
                        length * (normal_.damping + friction_.damping);
  of.answer = answer / (1.0 + answer * mobility_);
  of.normal_share =
      normal_.damping > 0.0 ? contact::implicit_share(normal_.damping * mobility_ * length) : 0.5;
  if (friction_.active()) {
    of.piece = contact::piece_table(friction_, mobility_, length);
    if (friction_.kind == contact::FrictionMemoryKind::reference)
      of.table = contact::friction_table(friction_, length);
  }
  return of;
}

/// How often an open contact is to be looked at in so much time.
int ContactStep::looks(const Components& velocity, double time) const {
  const double speed = std::sqrt(velocity.y * velocity.y + velocity.z * velocity.z);
  const double by_time = time / usual_.length;
  const double by_way = clearance_ > 0.0 ? speed * time / (longest_way * clearance_) : 0.0;
  return static_cast<int>(std::ceil(std::clamp(std::max(by_time, by_way), 1.0, 1.0 * most_looks)));
}

bool ContactStep::meets(const ContactPast& past, const FreePath& path) const {
  if (past.closed)
    return true;
  const Motion m{0.0, path.u, path.v, path.a, path.j, {}, {}};
  const int count = looks(path.v, h_);
  for (int i = count; i >= 0; --i)
    if (locate(m.u + m.displacement(h_ * i / count)).gap <= 0.0)
      return true;
  return false;
}

double ContactStep::relax(ContactPast& past, double time) const {
  contact::Vec2& spring = past.friction.spring;
  past.friction.sliding = false;
  if (!(dot(spring, spring) > 0.0))
    return 0.0;
  const double left =
      friction_.kind == contact::FrictionMemoryKind::return_map ? contact::spring_left(friction_, time) : 0.0;
  const double before = energy(friction_, spring);
  spring = left * spring;
  if (dot(spring, spring) <= contact::forgotten * contact::forgotten * past.spring_at_opening)
    spring = {};
  return before - energy(friction_, spring);
}

double ContactStep::spring_energy(const ContactPast& past) const {
  return friction_.active() ? energy(friction_, past.friction.spring) : 0.0;
}

void ContactStep::stretch(ContactPast& past, const Components& missed) const {
  if (!past.closed || !friction_.active() || past.friction.sliding ||
      friction_.kind == contact::FrictionMemoryKind::reference)
    return;
  past.friction.spring.t -=
      friction_.along.t * friction_.stiffness * (past.nz * missed.y - past.ny * missed.z);
  if (in_plane_)
    past.friction.spring.x -= friction_.along.x * friction_.stiffness * missed.x;
}

/// Takes an open contact to its touch, or to the end of the step. Returns whether it touches.
bool ContactStep::find_touch(Motion& m, ContactAct& act) const {
  const double left = h_ - m.t;
  const int count = looks(m.v, left);
  double from = 0.0, gap_from = m.at.gap, to = 0.0, gap_to = gap_from;
  for (int i = 1; i <= count && gap_to > 0.0; ++i) {
    from = to;
    gap_from = gap_to;
    to = left * i / count;
    gap_to = locate(m.u + m.displacement(to)).gap;
  }
  if (gap_to > 0.0) {
    act.relaxed += relax(act.past, left);
    m.move(left, {});
    m.at.gap = gap_to;
    return false;
  }
  // the root by false position, the end that stays weighed less each time (Illinois)
  const double tolerance = touch_tolerance * (to - from);
  int side = 0;
  double touch = to;
  for (int i = 0; i < most_iterations && to - from > tolerance && gap_to < 0.0; ++i) {
    touch = (from * gap_to - to * gap_from) / (gap_to - gap_from);
    const double gap = locate(m.u + m.displacement(touch)).gap;
    if (gap > 0.0) {
      from = touch;
      gap_from = gap;
      if (side == 1)
        gap_to *= 0.5;
      side = 1;
    } else {
      if (to - touch < tolerance)
        break;
      to = touch;
      gap_to = gap;
      if (side == -1)
        gap_from *= 0.5;
      side = -1;
    }
    if (std::abs(gap) <= tolerance * std::abs(gap_to - gap_from) / std::max(to - from, tolerance))
      break;
  }
  act.relaxed += relax(act.past, touch);
  m.move(touch, {});
  m.at = locate(m.u);
  m.at.gap = 0.0;
  return true;
}

/// The gap is linear about where the force of the guess leads.
void ContactStep::find_normal_force(const Motion& m, const Components& guessed, const Interval& of,
                                    Pressed& p) const {
  const double dt = of.length, half = 0.5 * dt * dt, share = of.normal_share;
  const Components by_guess = w_ * guessed, a = m.a + 0.5 * dt * m.j + by_guess;
  const Components way = m.displacement(dt) + half * by_guess;
  const contact::Location there = locate(m.u + way);
  const double turned = there.ny * m.at.ny + there.nz * m.at.nz;
  const auto find = [&](double ny, double nz, double start, double end, double rate) {
    const auto& w = w_.w;
    const double wnn = w[0][0] * ny * ny + (w[0][1] + w[1][0]) * ny * nz + w[1][1] * nz * nz;
    const double guess = dot(ny, nz, guessed), acceleration = wnn * guess - dot(ny, nz, a);
    p.ny = ny;
    p.nz = nz;
    p.normal = contact::normal_over_interval(
        normal_, dt, usual_.length, wnn, share,
        {start, end + half * wnn * guess + (share - 0.5) * dt * dt * acceleration, rate, acceleration});
  };
  const double start = -m.at.gap, rate = -dot(m.at.ny, m.at.nz, m.v);
  // The gap that the laws follow strays from that of the position, by curvature and where beta is not 1/2: over a short interval a damper would
  // take that for a speed.
  const double drift = dt < short_interval * usual_.length ? start + locate(m.u).gap : 0.0;
  p.to = there;
  if (turned > 0.0) {
    double ny = m.at.ny, nz = m.at.nz;
    if (there.gap < 0.0 && turned < 1.0) { // the mean of both; one that opens keeps its own
      const double per = 1.0 / std::sqrt(2.0 * (1.0 + turned));
      ny = per * (ny + there.ny);
      nz = per * (nz + there.nz);
    }
    find(ny, nz, start, drift - there.gap, rate);
  } else { // another face lies ahead of the guess: does the contact stay on its own, or leave it before?
    find(m.at.ny, m.at.nz, start, start - dot(m.at.ny, m.at.nz, way), rate);
    const Components by = w_ * (p.normal.force * Components{p.ny, p.nz, 0.0});
    const contact::Location then = locate(m.u + way + half * (by - by_guess));
    p.to = m.at;
    if (p.normal.to == 1.0 && then.gap < 0.0 && then.ny * m.at.ny + then.nz * m.at.nz <= 0.0) {
      find(there.ny, there.nz, -there.gap + dot(there.ny, there.nz, way), -there.gap,
           -dot(there.ny, there.nz, m.v));
      p.to = there;
    }
  }
  p.damper_work = p.normal.damper_work;
  p.to.gap = -p.normal.end;
}

void ContactStep::find_closed_friction(const Motion& m, const Interval& of, Pressed& p) const {
  const contact::FrictionLaw& law = friction_;
  const bool by_reference =
      law.kind == contact::FrictionMemoryKind::reference; // which knows no parts of an interval
  const bool whole = by_reference || (p.normal.from == 0.0 && p.normal.to == 1.0);
  const double ny = p.ny, nz = p.nz, dt = of.length, from = whole ? 0.0 : p.normal.from * dt;
  const double length = whole ? dt : (p.normal.to - p.normal.from) * dt;
  double stored = energy(law, p.memory.spring);
  if (from > 0.0) {
    p.memory.sliding = false;
    if (stored > 0.0) {
      const double rest = contact::spring_left(law, from);
      p.memory.spring = rest * p.memory.spring;
      p.damper_work += (1.0 - rest * rest) * stored;
      stored *= rest * rest;
    }
  }
  // along t = (nz, -ny), with the mean of the normal force
  const Components a = m.a + 0.5 * dt * m.j + w_ * Components{p.normal.force * ny, p.normal.force * nz, 0.0},
                   v = m.v - (dt * dt / 12.0) * m.j + from * a;
  const auto& w = w_.w;
  const double wtt = w[0][0] * nz * nz - (w[0][1] + w[1][0]) * ny * nz + w[1][1] * ny * ny;
  const double vt = nz * v.y - ny * v.z, at = nz * a.y - ny * a.z;
  const auto close = [&](const auto& f, contact::Vec2 impulse, contact::Vec2 by, contact::Vec2 spring) {
    p.friction = (1.0 / dt) * impulse;
    p.displacement = by;
    p.memory = {spring, f.sliding};
    p.slider_work = f.slider_work;
    p.rubbed = f.rubbed;
    p.slid = f.slid;
    p.sliding_time = f.sliding_time;
    // what goes into the element and is neither stored nor taken by the slider
    p.damper_work += stored - energy(law, spring) - p.slider_work - dot((1.0 / length) * impulse, by);
  };
  if (in_plane_) {
    const double wxt = nz * w[0][2] - ny * w[1][2];
    const contact::Vec2 along = law.along;
    const contact::TangentialPath<contact::Vec2, contact::Sym2> path{
        {along.x * v.x, along.t * vt},
        {along.x * a.x, along.t * at},
        {along.x * w[2][2], along.x * along.t * wxt, along.t * wtt}};
    const auto f = by_reference ? reference_friction(law, of.table, p.memory, p.normal.force, length, path)
                                : contact::friction_over_interval(law, of.piece, mobility_, p.memory.spring,
                                                                  p.memory.sliding, length, p.normal.first,
                                                                  p.normal.last, path);
    close(f, f.impulse, f.displacement, f.spring);
  } else if (by_reference) {
    const auto f =
        reference_friction(law, of.table, p.memory, p.normal.force, length,
                           {{0.0, law.along.t * vt}, {0.0, law.along.t * at}, {0.0, 0.0, law.along.t * wtt}});
    close(f, f.impulse, f.displacement, f.spring);
  } else {
    const contact::TangentialPath<double, double> path{law.along.t * vt, law.along.t * at, law.along.t * wtt};
    const auto f =
        contact::friction_over_interval(law, of.piece, mobility_, p.memory.spring.t, p.memory.sliding, length,
                                        p.normal.first, p.normal.last, path);
    close(f, {0.0, f.impulse}, {0.0, f.displacement}, {0.0, f.spring});
  }
  p.friction_square = dt / length * dot(p.friction, p.friction);
  if (p.normal.to < 1.0) {
    const double rest = by_reference ? 0.0 : contact::spring_left(law, dt - from - length);
    p.damper_work += (1.0 - rest * rest) * energy(law, p.memory.spring);
    p.memory = {rest * p.memory.spring, false};
  }
}

void ContactStep::find_friction(const Motion& m, const ContactPast& past, const Interval& of,
                                Pressed& p) const {
  p.memory = past.friction;
  if (past.ny * p.ny + past.nz * p.nz < 0.0 && p.normal.force > 0.0) { // another surface
    p.memory = {};
    p.damper_work += energy(friction_, past.friction.spring);
  }
  if (p.normal.force > 0.0) {
    find_closed_friction(m, of, p);
    return;
  }
  ContactPast open = past;
  p.damper_work += relax(open, of.length);
  p.memory = open.friction;
}

void ContactStep::press(const Motion& m, const ContactPast& past, const Interval& of, Pressed& p) const {
  Components guess = m.force;
  for (int i = 0;; ++i) {
    p = {};
    find_normal_force(m, guess, of, p);
    p.force = {p.normal.force * p.ny, p.normal.force * p.nz, 0.0};
    if (friction_.active()) {
      find_friction(m, past, of, p);
      p.force.y += p.friction.t * p.nz;
      p.force.z -= p.friction.t * p.ny;
      p.force.x = p.friction.x;
    }
    const double changed = sum_of_sizes(p.force - guess);
    if (of.answer * across_ * changed <= repeat_tolerance * sum_of_sizes(p.force) || i == most_repeats)
      return;
    guess = p.force;
  }
}

/// The contact opens now.
void ContactStep::open(const Motion& m, ContactAct& act) const {
  act.opened = true;
  act.past.closed = false;
  act.state.opened_at = m.t / h_;
  act.state.departure = dot(m.at.ny, m.at.nz, m.v);
}

/// The interval is over: its forces are those of the contact.
void ContactStep::book(Motion& m, const Interval& of, const Pressed& p, ContactAct& act) const {
  ContactState& state = act.state;
  ContactPast& past = act.past;
  const double share = of.length / h_, begin = m.t / h_, middle = begin + 0.5 * share;
  const bool pressed = p.normal.force > 0.0, stays = pressed && p.normal.to == 1.0;
  state.damper_work += p.damper_work;
  if (pressed) {
    if (!past.closed || p.normal.from > 0.0 || past.before_run) {
      ++state.touches;
      past.before_run = false;
      state.closed_at = begin + p.normal.from * share;
      state.approach = -dot(p.ny, p.nz, m.v);
    }
    const double closed = p.normal.to - p.normal.from;
    state.normal_force += share * p.normal.force;
    state.normal_square += share * p.normal.square();
    state.closed += share * closed;
    state.peak = std::max({state.peak, p.normal.first, p.normal.last});
    past.ny = state.ny = p.ny;
    past.nz = state.nz = p.nz;
    act.mean = act.mean + share * p.force;
    act.slope = act.slope + 6.0 * share * (middle - 0.5) * p.force;
    if (friction_.active()) {
      state.friction = state.friction + share * p.friction;
      state.friction_square += share * p.friction_square;
      state.displacement = state.displacement + p.displacement;
      state.slid += p.slid;
      state.rubbed += p.rubbed;
      state.friction_work += p.slider_work;
      state.sliding += p.sliding_time / h_;
      state.slides = p.sliding_time > 0.0;
    }
  }
  m.move(of.length, w_ * p.force);
  m.at = p.to;
  if ((past.closed || pressed) && !stays) {
    const double to = pressed ? p.normal.to : 0.0, after = (1.0 - to) * of.length;
    open(m, act);
    state.opened_at = begin + to * share;
    state.departure -= after * dot(p.ny, p.nz, m.a);
  }
  past.closed = stays;
  act.last = m.force = p.force;
  if (!stays && p.to.gap >= 0.0)
    m.at = locate(m.u);
  if (!friction_.active())
    return;
  past.friction = p.memory;
  if (pressed)
    past.spring_at_opening = dot(p.memory.spring, p.memory.spring);
}

/// s: how long a contact that has opened while it penetrates, where its damper would pull, moves free of force: until it is out, or until
/// K_N p + c p' = 0 again, p'' = a and from 0. 0: its force grows at once.
double ContactStep::pause(const Motion& m) const {
  const double out = dot(m.at.ny, m.at.nz, m.v), pressing = -dot(m.at.ny, m.at.nz, m.a);
  const double falls = normal_.stiffness * out - normal_.damping_at(-m.at.gap) * pressing;
  if (!(out > 0.0 && falls > 0.0))
    return 0.0;
  const double leaves = std::max(-m.at.gap / out, shortest_way_out * usual_.length);
  const double pressed = pressing > 0.0 ? 2.0 * falls / (normal_.stiffness * pressing) : leaves;
  return std::min({h_ - m.t, usual_.length, leaves, pressed});
}

void ContactStep::leave(Motion& m, double time, ContactAct& act) const {
  const double before = m.at.gap;
  act.relaxed += relax(act.past, time);
  m.move(time, {});
  m.at = locate(m.u);
  const double left = std::min(0.0, m.at.gap);
  act.state.damper_work +=
      0.5 * normal_.stiffness * (before * before - left * left); // what the positive part cuts
}

void ContactStep::make(const ContactPast& past, const FreePath& path, const Components& guess,
                       ContactAct& act) const {
  act = {};
  act.past = past;
  Motion m{0.0, path.u, path.v, path.a, path.j, guess, locate(path.u)};
  Interval cut;
  Pressed p;
  for (int events = 0; h_ - m.t > shortest * h_; ++events) {
    if (m.at.gap > 0.0) {
      if (act.past.closed)
        open(m, act);
      if (!find_touch(m, act))
        break;
    } else if (const double time = act.past.closed ? 0.0 : pause(m); time > 0.0) {
      leave(m, time, act);
      continue;
    }
    const double left = h_ - m.t;
    if (!(left > shortest * h_))
      break;
    const double length = left / std::ceil(left / usual_.length * (1.0 - shortest));
    const Interval* of = &usual_;
    if (std::abs(length - usual_.length) > shortest * h_) {
      cut = interval(length);
      of = &cut;
    }
    press(m, act.past, *of, p);
    const double opens = p.normal.to * length;
    if (p.normal.to < 1.0 && opens > shortest * h_ && events < most_events) { // to where it opens
      cut = interval(opens);
      of = &cut;
      press(m, act.past, *of, p);
    } else if (!(opens > shortest * h_) && act.past.closed) {
      open(m, act);
      continue;
    }
    book(m, *of, p, act);
  }
  act.end = m.u;
  act.penetrates = m.at.gap < 0.0;
}

} // namespace fretwork::transient
