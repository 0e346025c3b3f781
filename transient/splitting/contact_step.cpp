// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_step.hpp"
#include "transient/splitting/force_answer.hpp"
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
/// Of an interval: time in which a contact that has opened is out at least.
constexpr double shortest_way_out = 1e-3;
/// Touches, openings and turns that are found in a step: more are none that a step could follow.
constexpr int most_events = 200;

/// Of a step: round-off of the share of it that is closed.
constexpr double share_tolerance = 1e-6;
/// Of the normal force: a change of it that is answered to first order.
constexpr double small_change = 0.5;
/// Of its bound: the mean force of friction of a contact that slides one way.
constexpr double one_way = 0.98;
/// Of the usual length: intervals in which the normal turns, as over an edge, down to which it is followed.
constexpr double shortest_turn = 1.0 / 32.0;

/// Shares of a step between which a contact was closed that was so once.
struct ClosedSpan {
  double from, to;
  explicit ClosedSpan(const ContactAct& act)
      : from(act.state.touches > 0 ? act.state.closed_at : 0.0),
        to(act.past.closed ? 1.0 : act.state.opened_at) {}
};

} // namespace

ContactStep::ContactStep(const contact::Support& support, const Components& rest, const Mobility& mobility,
                         bool in_plane, double step, int parts, double clearance, double tolerance)
    : normal_(support.normal), friction_(support.friction), in_plane_(in_plane), h_(step),
      clearance_(clearance), intervals_(support, rest, mobility, in_plane, step / parts, tolerance),
      apparent_mass_(intervals_.table(step).apparent_mass) {}

void ContactStep::divide(int parts) { intervals_.set_usual(h_ / parts); }

/// How often an open contact is to be looked at in so much time.
int ContactStep::gap_samples(const Components& velocity, double time) const {
  const double speed = std::sqrt(velocity.y() * velocity.y() + velocity.z() * velocity.z());
  const double by_time = time / intervals_.usual().length;
  const double by_way = clearance_ > 0.0 ? speed * time / (longest_way * clearance_) : 0.0;
  return static_cast<int>(std::ceil(std::clamp(std::max(by_time, by_way), 1.0, 1.0 * most_looks)));
}

bool ContactStep::meets(const ContactPast& past, const FreePath& path) const {
  if (past.closed)
    return true;
  const ContactPath m{0.0, path.u, path.v, path.a, path.j, {}, {}, {}};
  const int count = gap_samples(path.v, h_);
  for (int i = count; i >= 0; --i)
    if (intervals_.locate(m.u + m.displacement(h_ * i / count)).gap <= 0.0)
      return true;
  return false;
}

void ContactStep::stretch(ContactPast& past, const Components& missed) const {
  if (!past.closed || !friction_.active() || past.friction.sliding ||
      friction_.kind == contact::FrictionMemoryKind::reference)
    return;
  past.friction.spring.t -= friction_.along.t * friction_.stiffness * tangent(past.axes, missed);
  if (in_plane_)
    past.friction.spring.x -= friction_.along.x * friction_.stiffness * missed.x;
}

/// Takes an open contact to its touch, or to the end of the step. Returns whether it touches.
bool ContactStep::find_touch(ContactPath& m, ContactAct& act) const {
  const double left = h_ - m.t;
  const int count = gap_samples(m.v, left);
  double from = 0.0, gap_from = m.at.gap, to = 0.0, gap_to = gap_from;
  for (int i = 1; i <= count && gap_to > 0.0; ++i) {
    from = to;
    gap_from = gap_to;
    to = left * i / count;
    gap_to = intervals_.locate(m.u + m.displacement(to)).gap;
  }
  if (gap_to > 0.0) {
    act.relaxed += intervals_.relax(act.past, left);
    m.move(left, {}, {});
    m.at.gap = gap_to;
    return false;
  }
  // the root by false position, the end that stays weighed less each time (Illinois)
  const double tolerance = touch_tolerance * (to - from);
  int side = 0;
  double touch = to;
  for (int i = 0; i < most_iterations && to - from > tolerance && gap_to < 0.0; ++i) {
    touch = (from * gap_to - to * gap_from) / (gap_to - gap_from);
    const double gap = intervals_.locate(m.u + m.displacement(touch)).gap;
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
  act.relaxed += intervals_.relax(act.past, touch);
  m.move(touch, {}, {});
  m.at = intervals_.locate(m.u);
  m.at.gap = 0.0;
  m.force = m.rise = {};
  return true;
}

/// The contact opens now.
void ContactStep::open(const ContactPath& m, ContactAct& act) const {
  act.opened = true;
  act.past.closed = false;
  act.past.rise = {};
  act.state.opened_at = m.t / h_;
  act.state.departure = normal(m.at.axes(), m.v);
}

/// The interval is over: its forces are those of the contact.
void ContactStep::finish_interval(ContactPath& m, const IntervalTable& of, const IntervalForces& p,
                                  ContactAct& act) const {
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
      state.approach = -normal(p.axes, m.v);
    }
    const double closed = p.normal.to - p.normal.from;
    state.normal_force += share * p.normal.force;
    state.normal_square += share * p.normal.square();
    state.closed += share * closed;
    state.peak = std::max(state.peak, p.normal.course.largest());
    past.axes = state.axes = p.axes;
    act.mean = act.mean + share * p.force;
    act.slope = act.slope + share * (6.0 * (middle - 0.5) * p.force + 0.5 * share * p.growth);
    if (friction_.active()) {
      state.friction = state.friction + share * p.friction;
      state.friction_square += share * p.friction_square;
      state.displacement = state.displacement + p.displacement;
      state.slid += p.slid;
      state.wear_work += p.wear_work;
      state.friction_work += p.slider_work;
      state.sliding += p.sliding_time / h_;
      state.slides = p.sliding_time > 0.0;
    }
  }
  m.move(of.length, intervals_.mobility() * p.force, intervals_.mobility() * p.growth);
  m.at = p.to;
  if ((past.closed || pressed) && !stays) {
    const double to = pressed ? p.normal.to : 0.0, after = (1.0 - to) * of.length;
    open(m, act);
    state.opened_at = begin + to * share;
    state.departure -= after * normal(p.axes, m.a);
  }
  past.closed = stays;
  act.last = m.force = p.force + 0.5 * p.growth;
  past.rise = m.rise = (1.0 / of.length) * p.growth;
  if (!stays && p.to.gap >= 0.0)
    m.at = intervals_.locate(m.u);
  if (!friction_.active())
    return;
  past.friction = p.memory;
  if (pressed)
    past.spring_at_opening = dot(p.memory.spring, p.memory.spring);
}

/// s: how long a contact that has opened while it penetrates, where its damper would pull, moves free of force: until it is out, or until
/// K_N p + c p' = 0 again, p'' = a and from 0. 0: its force grows at once.
double ContactStep::pause(const ContactPath& m) const {
  const double out = normal(m.at.axes(), m.v), pressing = -normal(m.at.axes(), m.a);
  const double falls = normal_.stiffness * out - normal_.damping_at(-m.at.gap) * pressing;
  if (!(out > 0.0 && falls > 0.0))
    return 0.0;
  const double leaves = std::max(-m.at.gap / out, shortest_way_out * intervals_.usual().length);
  const double pressed = pressing > 0.0 ? 2.0 * falls / (normal_.stiffness * pressing) : leaves;
  if (pressed < shortest_way_out * intervals_.usual().length)
    return 0.0;
  return std::min({h_ - m.t, intervals_.usual().length, leaves, pressed});
}

void ContactStep::leave(ContactPath& m, double time, ContactAct& act) const {
  const double before = normal_.spring_energy(-m.at.gap);
  act.relaxed += intervals_.relax(act.past, time);
  m.move(time, {}, {});
  m.at = intervals_.locate(m.u);
  act.state.damper_work += before - normal_.spring_energy(-m.at.gap); // what the positive part cuts
}

void ContactStep::make(const ContactPast& past, const FreePath& path, const Components& guess,
                       ContactAct& act) const {
  act = {};
  act.past = past;
  ContactPath m{0.0, path.u, path.v, path.a, path.j, guess, past.rise, intervals_.locate(path.u)};
  IntervalTable cut;
  IntervalForces p;
  double longest = intervals_.usual().length;
  for (int events = 0; h_ - m.t > shortest * h_;) {
    if (m.at.gap > 0.0) {
      if (act.past.closed)
        open(m, act);
      if (!find_touch(m, act))
        break;
      ++events;
    } else if (const double time = act.past.closed || events >= most_events ? 0.0 : pause(m); time > 0.0) {
      leave(m, time, act);
      ++events;
      continue;
    }
    const double left = h_ - m.t;
    if (!(left > shortest * h_))
      break;
    const double length = left / std::ceil(left / longest * (1.0 - shortest));
    const IntervalTable* of = &intervals_.usual();
    if (std::abs(length - intervals_.usual().length) > shortest * h_) {
      cut = intervals_.table(length);
      of = &cut;
    }
    const bool may_shorten = events < most_events;
    if (!intervals_.find_forces(m, act.past, *of, may_shorten, p)) {
      ++events;
      const double opens = p.normal.to * length;
      if (p.turns_far() && length > shortest_turn * intervals_.usual().length) {
        longest = 0.5 * length;
        continue;
      }
      if (!(opens > shortest * h_) && act.past.closed) {
        open(m, act);
        continue;
      }
      if (opens > shortest * h_ && p.normal.to < 1.0) { // to where it opens
        cut = intervals_.table(opens);
        of = &cut;
      }
      intervals_.find_forces(m, act.past, *of, false, p);
    }
    longest = std::min(intervals_.usual().length, 2.0 * length);
    finish_interval(m, *of, p, act);
  }
  act.end = m.u;
  act.penetrates = m.at.gap < 0.0;
}

bool ContactStep::in_one_state(const ContactAct& act) const {
  const ContactState& state = act.state;
  const ClosedSpan span(act);
  if (std::abs(span.to - span.from - state.closed) > share_tolerance)
    return false;
  if (!friction_.active())
    return true;
  if (!(state.sliding > 0.0))
    return span.from == 0.0; // the spring of one that sticks is stretched from its touch on
  const double bound = friction_.mu_dynamic * state.normal_force;
  return state.sliding > state.closed - share_tolerance &&
         dot(state.friction, state.friction) > one_way * one_way * bound * bound;
}

bool ContactStep::answer(const Components& mean, const Components& slope, ContactAct& act) const {
  ContactState& state = act.state;
  if (!(state.closed > 0.0) ||
      (friction_.active() && friction_.kind == contact::FrictionMemoryKind::reference))
    return false;
  const ClosedSpan span(act);
  const auto find = [&](double stiffness, double damping, double mobility, double by_mean, double by_slope) {
    return answer_of({stiffness, damping, mobility}, h_, span.from, span.to, {by_mean, by_slope});
  };
  const contact::ContactAxes axes = state.axes;
  const auto [ny, nz] = axes;
  const Mobility& w = intervals_.mobility();
  const double across = (w(0, 1) + w(1, 0)) * ny * nz, pressing = state.normal_force / state.closed;
  // at a touch a damper in proportion to the penetration has no force
  const double damping = span.from > 0.0 ? normal_.damping : normal_.damping_at(pressing / normal_.stiffness);
  const LinearInTime n = find(normal_.stiffness, damping, w(0, 0) * ny * ny + across + w(1, 1) * nz * nz,
                              normal(axes, mean), normal(axes, slope));
  if (!(std::abs(n.mean) < small_change * state.normal_force))
    return false;
  // The normal force turns with its normal. Friction is that of an element while it sticks, in proportion to the normal force while it slides.
  // At a corner the spring itself acts along the tangent; round bodies side by side, whose normal force turns away, are left out.
  const double turning = std::clamp(-pressing * intervals_.curvature(act.end), 0.0, normal_.stiffness);
  const double slides = std::min(1.0, state.sliding / state.closed), sticks = 1.0 - slides;
  const double sticks_t = sticks * friction_.along.t, sticks_x = sticks * friction_.along.x;
  const contact::Vec2 in_proportion = (slides / state.normal_force) * state.friction;
  LinearInTime t = find(turning + sticks_t * friction_.stiffness, sticks_t * friction_.damping,
                        w(0, 0) * nz * nz - across + w(1, 1) * ny * ny, tangent(axes, mean),
                        tangent(axes, slope)),
               x;
  if (in_plane_)
    x = find(sticks_x * friction_.stiffness, sticks_x * friction_.damping, w(2, 2), mean.x, slope.x);
  t.mean += in_proportion.t * n.mean;
  t.slope += in_proportion.t * n.slope;
  x.mean += in_proportion.x * n.mean;
  x.slope += in_proportion.x * n.slope;
  const Components by_mean{axes.y(n.mean, t.mean), axes.z(n.mean, t.mean), x.mean},
      by_slope{axes.y(n.slope, t.slope), axes.z(n.slope, t.slope), x.slope};
  act.mean = act.mean + by_mean;
  act.slope = act.slope + by_slope;
  if (act.past.closed)
    act.last = act.last + by_mean + by_slope;
  const double normal_grows = 1.0 + n.mean / state.normal_force,
               friction_grows = 1.0 + slides * n.mean / state.normal_force;
  state.normal_force += n.mean;
  state.normal_square *= normal_grows * normal_grows;
  state.friction = friction_grows * state.friction;
  state.friction_square *= friction_grows * friction_grows;
  state.friction_work *= normal_grows;
  state.wear_work *= normal_grows;
  return true;
}

} // namespace fretwork::transient
