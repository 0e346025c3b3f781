// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_interval.hpp"
#include "transient/scene/scheme_limits.hpp"
#include "transient/splitting/contact_interval_motion.hpp"
#include <algorithm>

namespace fretwork::transient {
namespace {

using contact::dot;
using contact::Vec2;

/// Intervals of a step that dampers, speeds and other sides ask for at most.
constexpr int most_intervals = limits_of(SchemeKind::splitting).intervals;
static_assert(most_intervals <= most_at_corner, "no step has more pieces of force");
static_assert(limits_of(SchemeKind::splitting).normal_damper.largest < contact::most_parabolic,
              "forces of impacts that dampers stop fall within an interval as parabolas");
/// Of its clearance, what a contact may move in an interval.
constexpr double longest_way = 1.0;
/// Of a step in which a contact meets a corner of its obstacle: times as many intervals, the fewest of them.
constexpr int at_corner = 16, least_at_corner = 32;
/// Of one in which it meets another side: as many for each clearance that it moves by, in a step of one interval and in others; the fewest.
constexpr int at_side_alone = 1, at_side = 2, least_at_side = 4;
/// Cosine of the angle by which its normal turns there in half a step; way in the clearance without which a round hole or two planes have no such turn.
constexpr double least_cosine = 0.9, least_way = 0.4;
/// d v of Hunt and Crossley's damper that leaves intervals as they are.
constexpr double least_stiffer = 1.0;
/// r_t dt of a contact that sticks, at most, where w_s h of it by itself, along one direction, is above the other. Where such a contact starts to slip,
/// intervals up to 6.3 give free decays as much energy as they dissipate, these 4 % of it (schemes.md, Limits).
constexpr double fastest_sticking = 4.0, fast_structure = 1.0;
/// Of an interval: what is shorter is none.
constexpr double shortest = 1e-9;

int intervals_at(double needed) {
  return static_cast<int>(std::ceil(std::min(needed, 1.0 * most_intervals)));
}

/// Whether the modes that move a contact are as fast as the step along a direction.
bool is_fast(const ImpulseResponse& own, double step) {
  constexpr double least = fast_structure * fast_structure;
  for (int k = 0; k < 3; ++k)
    if (own.v(k, k) * step * step > least * own.w(k, k))
      return true;
  return false;
}

} // namespace

ContactIntervals::ContactIntervals(const contact::Support& support, const Components& rest,
                                   const ImpulseResponse& own, bool in_plane, double step, double clearance,
                                   const DamperRates& rates)
    : obstacle_(support.obstacle), normal_(support.normal), friction_(support.friction), rest_(rest),
      own_(own), in_plane_(in_plane), has_corners_(contact::properties_of(support.obstacle).has_parts),
      has_sides_(contact::properties_of(support.obstacle).has_opposite_sides), h_(step),
      clearance_(clearance), spring_left_(spring_left(step)), rates_(rates),
      beside_fast_structure_(support.friction.active() && is_fast(own, step)) {}

IntervalTable ContactIntervals::table(int count) const {
  IntervalTable table;
  table.count = count;
  table.share = 1.0 / count;
  table.length = table.share * h_;
  table.w = own_.over(table.length);
  table.compliance = own_.compliance(table.length);
  const double across = std::max(table.w(0, 0), table.w(1, 1)), along_x = table.w(2, 2);
  table.mobility = std::max(across, along_x);
  table.growing = contact::growing_damping(normal_.damping, normal_.damping * table.mobility * table.length);
  table.sliding_mass = apparent_mass(table.length, table.mobility, normal_.stiffness, normal_.damping);
  table.mass_across = table.mass_along = table.sliding_mass;
  if (friction_.active()) {
    const auto sticking_mass = [&](double mobility) {
      return apparent_mass(table.length, mobility, friction_.stiffness, friction_.damping);
    };
    if (friction_.along.t > 0.0) {
      table.friction_mobility = across;
      table.mass_across = std::max(table.sliding_mass, sticking_mass(across));
    }
    if (friction_.along.x > 0.0) {
      table.friction_mobility = std::max(table.friction_mobility, along_x);
      table.mass_along = std::max(table.sliding_mass, sticking_mass(along_x));
    }
    table.spring_left = spring_left(table.length);
    table.pieces = contact::piece_tables(friction_, table.friction_mobility, table.length);
    if (friction_.kind == contact::FrictionMemoryKind::reference)
      table.reference = contact::friction_table(friction_, table.length);
  }
  return table;
}

double ContactIntervals::apparent_mass(double length, double mobility, double stiffness, double damping) {
  const double force = length * (stiffness * length / 6.0 + damping);
  return force / (1.0 + force * mobility);
}

int ContactIntervals::least_count(int parts, const ContactPast& past, const FreePath& path) const {
  const double speed = std::sqrt(path.v.y() * path.v.y() + path.v.z() * path.v.z()), way = h_ * speed;
  // Hunt and Crossley's damper makes a spring of K (1 + d v) where it closes
  if (const double stiffer = normal_.dissipation * speed; stiffer > least_stiffer)
    parts = std::max(parts, static_cast<int>(std::min(std::round(parts * std::sqrt(1.0 + stiffer)),
                                                      1.0 * most_intervals)));
  if (rates_.by_penetration > 0.0)
    parts = std::max(parts, intervals_for_dampers(path));
  if (beside_fast_structure_ && past.closed && !past.friction.sliding)
    parts = std::max(parts, intervals_at(rates_.tangential * h_ / fastest_sticking));
  if (may_turn(past, path, way) && meets_corner(path))
    return std::max(parts, has_corners_ ? std::clamp(at_corner * parts, least_at_corner, most_at_corner)
                                        : intervals_at_side(parts, way));
  if (past.closed || !(clearance_ > 0.0))
    return parts;
  return std::max(parts, intervals_at(way / (longest_way * clearance_)));
}

/// @param way  m, in the step
int ContactIntervals::intervals_at_side(int parts, double way) const {
  return std::max(least_at_side, intervals_at((parts > 1 ? at_side : at_side_alone) * way / clearance_));
}

/// For dampers of Hunt and Crossley, at the largest penetration that is ahead under the forces held.
int ContactIntervals::intervals_for_dampers(const FreePath& path) const {
  const double deepest =
      std::max({0.0, -locate(path.displacement(0.0)).gap, -locate(path.displacement(h_)).gap});
  return intervals_at(rates_.normal_at(deepest) * h_ /
                      limits_of(SchemeKind::splitting).normal_damper.largest);
}

bool ContactIntervals::may_turn(const ContactPast& past, const FreePath& path, double way) const {
  if (past.closed)
    return has_corners_ || (has_sides_ && way > least_way * clearance_);
  return has_corners_ && locate(path.displacement(h_)).gap <= 0.0;
}

/// Whether the normal turns much on the way, or is that of another side at its end.
bool ContactIntervals::meets_corner(const FreePath& path) const {
  const contact::ContactAxes start = locate(path.displacement(0.0)).axes(),
                             half = locate(path.displacement(0.5 * h_)).axes(),
                             end = locate(path.displacement(h_)).axes();
  return std::min(start.normal(half.ny, half.nz), half.normal(end.ny, end.nz)) < least_cosine;
}

bool ContactIntervals::may_close(const ContactPast& past, const FreePath& path, int count) const {
  if (past.closed)
    return true;
  for (int i = count; i >= 0; --i)
    if (locate(path.displacement(h_ * i / count)).gap <= 0.0)
      return true;
  return false;
}

void ContactIntervals::begin(MovingContact& m, const Components& held, const IntervalTable& table) const {
  m.growth = table.length * m.course.past.rise;
  m.force = held + 0.5 * m.growth;
  m.by_held = table.w * held;
  m.held = held;
  apply_own_force(m, table);
}

void ContactIntervals::apply_own_force(MovingContact& m, const IntervalTable& table) {
  m.by_force = table.w * m.force;
  m.by_growth = table.w * m.growth;
}

void ContactIntervals::keep_middle(MovingContact& m, const IntervalTable& table, double time) {
  const double dt = table.length;
  apply_own_force(m, table);
  const Components by = m.others_over(dt) + m.by_force - m.by_held,
                   growth = m.others_growth_over(dt) + m.by_growth;
  m.middle = m.response + time * (m.rate + time * (0.5 * by + (time / (6.0 * dt) - 0.25) * growth));
}

void ContactIntervals::move(MovingContact& m, const IntervalTable& table) const {
  const double dt = table.length;
  apply_own_force(m, table);
  const Components by = m.others_over(dt) + m.by_force - m.by_held,
                   growth = m.others_growth_over(dt) + m.by_growth;
  m.response = m.response + dt * (m.rate + dt * (0.5 * by - (1.0 / 12.0) * growth)) +
               (m.others_lift_growth + table.compliance * m.growth);
  m.rate = m.rate + dt * by;
  m.others = m.others + m.others_growth;
  m.others_lift = m.others_lift + m.others_lift_growth;
}

double ContactIntervals::force_change(const MovingContact& m, const IntervalTable& table,
                                      const Components& by) const {
  if (!m.course.penetrates) // one that its damper holds free of force answers too
    return 0.0;
  const bool slides = m.course.past.friction.sliding;
  double across = slides ? table.sliding_mass : table.mass_across;
  const double along_x = slides ? table.sliding_mass : table.mass_along;
  if (normal_.dissipation > 0.0)
    across = std::max(across, apparent_mass(table.length, table.mobility, normal_.stiffness,
                                            normal_.damping_at(m.penetration)));
  return across * (std::abs(by.y()) + std::abs(by.z())) + along_x * std::abs(by.x);
}

void ContactIntervals::extrapolate(MovingContact& m, const IntervalTable& table) {
  if (!m.throughout)
    m.growth = {};
  m.force = m.last + 0.5 * m.growth;
  apply_own_force(m, table);
}

Components ContactIntervals::with_means(const MovingContact& m, bool of_normal, bool of_friction) {
  const contact::ContactAxes& axes = m.course.past.axes;
  const Components &along_normal = of_normal ? m.course.force.mean : m.last,
                   &tangential = of_friction ? m.course.force.mean : m.last;
  return along(axes, normal(axes, along_normal), {tangential.x, tangent(axes, tangential)});
}

double ContactIntervals::relax(ContactPast& past, int steps) const {
  double left = spring_left_;
  for (int step = 1; step < steps; ++step)
    left *= spring_left_;
  return relax_to(past, left);
}

double ContactIntervals::relax_to(ContactPast& past, double share) const {
  Vec2& spring = past.friction.spring;
  past.friction.sliding = false;
  if (!(dot(spring, spring) > 0.0))
    return 0.0;
  const double before = friction_.spring_energy(spring);
  spring = share * spring;
  if (dot(spring, spring) <= contact::forgotten * contact::forgotten * past.spring_at_opening)
    spring = {};
  return before - friction_.spring_energy(spring);
}

double ContactIntervals::spring_left(double time) const {
  return friction_.kind == contact::FrictionMemoryKind::return_map ? contact::spring_left(friction_, time)
                                                                   : 0.0;
}

void ContactIntervals::correct_spring_drift(ContactPast& past, const Components& missed) const {
  if (!past.closed || !friction_.active() || past.friction.sliding ||
      friction_.kind == contact::FrictionMemoryKind::reference)
    return;
  past.friction.spring.t -= friction_.along.t * friction_.stiffness * tangent(past.axes, missed);
  if (in_plane_)
    past.friction.spring.x -= friction_.along.x * friction_.stiffness * missed.x;
}

/// Along the normal, doc/schemes.md, (S6) to (S9): under the force that is expected of it, whose normal part is then taken away.
ContactIntervals::Motion ContactIntervals::motion_of(const MovingContact& m, const IntervalTable& table,
                                                     int index) const {
  Motion a;
  const double dt = table.length, start = index * dt;
  const Components of_path = m.path.acceleration(start + 0.5 * dt, table.share);
  const Components expected = of_path + (m.others_over(dt) + m.by_force - m.by_held);
  a.velocity = m.path.velocity(start) + m.rate;
  a.jerk = m.path.jerk(start + 0.5 * dt) + (1.0 / dt) * m.others_growth_over(dt);
  a.acceleration = expected - m.by_force;
  const Components growth = dt * a.jerk + m.by_growth;
  a.expected = m.force - 0.125 * m.growth;
  a.lift = m.path.lift(dt, table.share) + m.others_lift - 0.625 * m.others_lift_growth +
           table.compliance * (a.expected - m.held);
  const Components lift = a.lift + 0.5 * m.others_lift_growth;
  const Components mean = m.path.displacement(start) + m.response +
                          (0.5 * dt) * (a.velocity + (dt / 3.0) * (expected - 0.25 * growth)) + lift;
  a.half_way = a.velocity + (0.5 * dt) * (expected - 0.25 * growth);
  const contact::Location at = locate(mean);
  a.axes = at.axes();
  a.mean = mean + rest_;
  a.by_normal = table.w * Components{at.ny, at.nz, 0.0};
  a.mobility = normal(a.axes, a.by_normal);
  a.compliance_by_normal = table.compliance * Components{at.ny, at.nz, 0.0};
  a.compliance = normal(a.axes, a.compliance_by_normal);
  const auto of = [&](const Components& c) {
    return contact::AlongAxes{normal(a.axes, c), tangent(a.axes, c)};
  };
  const contact::NormalKinematics p = contact::normal_kinematics(
      dt, at.gap, curvature(mean), {of(a.velocity), of(a.half_way), of(expected), of(growth)});
  a.turn = p.turn;
  a.penetration = p.penetration + normal(a.axes, lift);
  a.lift_inwards = a.compliance * normal(a.axes, a.expected) - normal(a.axes, a.lift);
  a.rate = p.rate;
  a.acceleration_inwards = p.acceleration + normal(a.axes, m.force) * a.mobility;
  a.per_interval = 1.0 / dt;
  a.bend = dt * dt * dt / 12.0 *
               (normal(a.axes, a.jerk) + p.jerk_by_turning + a.turn.omega * tangent(a.axes, a.acceleration)) -
           normal(a.axes, m.others_lift_growth);
  return a;
}

/// s: when a contact closes that is to touch about `guess`, by the parabola without bend; dt: not in the interval.
double ContactIntervals::touch_after(const Motion& a, double guess, double dt) {
  constexpr int steps = 2; // of Newton's method: the bend is small beside the way to the touch
  double time = std::min(guess, dt);
  for (int i = 0; i < steps; ++i) {
    const double rate = a.rate_after(time);
    if (!(rate > 0.0))
      return dt;
    time -= a.after(time) / rate;
    if (!(time < dt))
      return dt;
  }
  return std::max(time, 0.0);
}

/// s: from when on the contact has a force; dt and more: not in the interval.
double ContactIntervals::time_of_closing(const Motion& a, bool closed, double dt) const {
  if (a.penetration < 0.0) {
    const double square = a.rate * a.rate - 2.0 * a.acceleration_inwards * a.penetration;
    const double speed = square > 0.0 ? a.rate + std::sqrt(square) : 0.0;
    return speed > 0.0         ? touch_after(a, -2.0 * a.penetration / speed, dt)
           : a.after(dt) > 0.0 ? touch_after(a, dt, dt)
                               : dt;
  }
  if (closed)
    return 0.0;
  // It has opened before it is out: where its damper would pull, or as the normal turns.
  const double end = a.after(dt);
  const double first = normal_.spring_and_damper(a.penetration, a.rate);
  const double last = end > 0.0 ? normal_.spring_and_damper(end, a.rate + dt * a.acceleration_inwards) : 0.0;
  if (a.rate < 0.0 && !(last > 0.0))
    return dt;
  if (first >= 0.0)
    return 0.0;
  return last > 0.0 ? dt * first / (first - last) : dt;
}

/// m: of a penetration that comes from p0, v0 to p1, v1 in a time, by the cubic through both.
double ContactIntervals::deepest_of(double p0, double v0, double p1, double v1, double time) {
  double turn = 0.0;
  if (v0 > 0.0 && v1 < 0.0) {
    const double mean = (p1 - p0) / time, a = (6.0 * mean - 4.0 * v0 - 2.0 * v1) / time,
                 j = 6.0 * (v0 + v1 - 2.0 * mean) / (time * time);
    const double at = 2.0 * v0 / (std::sqrt(std::max(0.0, a * a - 2.0 * j * v0)) - a);
    turn = p0 + at * (v0 + at * (0.5 * a + at * j / 6.0));
  }
  return std::max({p0, p1, turn});
}

ContactIntervals::NormalForce ContactIntervals::find_normal_force(const Motion& a, bool closed,
                                                                  const IntervalTable& table) const {
  NormalForce out;
  out.departure = -a.rate;
  const double dt = table.length, closes = time_of_closing(a, closed, dt);
  if (!(closes < (1.0 - shortest) * dt)) {
    out.damper_work = released(a.penetration, a.after(dt));
    return out;
  }
  const double start = std::max(0.0, closes > 0.0 ? a.after(closes) : a.penetration);
  const double rate = a.rate_after(closes);
  const auto over = [&](double length) {
    const bool whole = length == dt;
    const double growing =
        whole ? table.growing
              : contact::growing_damping(normal_.damping, normal_.damping * table.mobility * length);
    const double mean = a.acceleration_over(closes, length);
    const double end = start + length * (rate + 0.5 * length * mean) + a.bend_over(length);
    const double fourth = whole ? 1.0 : contact::fourth_power(length / dt);
    return contact::normal_over_interval(normal_, length, a.mobility, fourth * a.compliance, growing,
                                         {start, end, rate, mean, fourth * a.lift_inwards});
  };
  double length = dt - closes;
  contact::NormalInterval n = over(length);
  out.opens = n.to < 1.0;
  if (!(n.to * length > shortest * dt)) {
    out.damper_work = released(a.penetration, a.after(dt));
    return out;
  }
  if (out.opens) { // the force until then
    length *= n.to;
    n = over(length);
  }
  const double share = length / dt, begin = closes / dt;
  out.force = share * n.force;
  out.growth = share * share * n.growth + (12.0 * begin + 6.0 * (share - 1.0)) * out.force;
  out.from = closes;
  out.to = closes + (out.opens ? n.to : 1.0) * length;
  out.course = n.course;
  out.approach = rate;
  const double last_rate = rate + length * (a.acceleration_over(closes, length) - a.mobility * n.force);
  if (n.force > 0.0)
    out.departure = -last_rate;
  if (normal_.damps())
    out.deepest = deepest_of(start, rate, n.end, last_rate, length);
  out.damper_work = n.damper_work;
  if (closes > 0.0)
    out.damper_work += released(a.penetration, start);
  if (out.opens) {
    const double left = dt - closes - length;
    const double end =
        n.end + left * (last_rate + 0.5 * left * a.acceleration_over(dt - left, left)) + a.bend_over(left);
    out.damper_work += released(n.end, end);
  }
  return out;
}

/// A force along axes that turn has other components along those of the mean position: doc/schemes.md, (S10).
void ContactIntervals::rotate_force(const Motion& a, const NormalForce& n, double dt, MovingContact& m) {
  const double middle = 0.5 * (n.from + n.to - dt), acts = n.to - n.from,
               s2 = middle * middle + acts * acts / 12.0; // s2, mean of tau^2 while it acts
  const auto& [turns, omega, omega_dot, delta] = a.turn;
  const double fn = normal(a.axes, m.force), ft = tangent(a.axes, m.force);
  const double by_growth = dt / 12.0 * omega, by_force = 0.5 * s2 * omega_dot - delta,
               lost = 0.5 * s2 * omega * omega;
  m.force = m.force + along(a.axes, -by_growth * tangent(a.axes, m.growth) - by_force * ft - lost * fn,
                            {0.0, by_growth * normal(a.axes, m.growth) + by_force * fn - lost * ft});
  const double growth_by_force = 12.0 / dt * s2 * omega;
  m.growth = m.growth + along(a.axes, -growth_by_force * ft, {0.0, growth_by_force * fn});
}

/// Without a damper that could hold it free of force a contact that rolls round stays closed while the normal turns.
bool ContactIntervals::rolls_round(const Motion& a, double dt) const {
  return !normal_.damps() &&
         contact::rolls_round(obstacle_, {a.mean.y(), a.mean.z()}, {a.half_way.y(), a.half_way.z()}, dt);
}

/// When and how fast it touches and departs, and its normal force.
inline void ContactIntervals::record(Passage passage, const NormalForce& n, const IntervalTable& table,
                                     int index, ContactCourse& course) const {
  ContactState& state = course.state;
  const double start = index * table.share, acts = (n.to - n.from) / h_; // shares of the step
  if (crosses(passage)) {
    course.opened = true;
    state.opened_at = start + (n.from - shortest * table.length) / h_; // before it closes again
    state.departure = n.approach;
  }
  if (touches(passage) || (course.past.before_run && n.force > 0.0)) {
    ++state.touches;
    course.past.before_run = false;
    state.closed_at = start + n.from / h_;
    state.approach = n.approach;
  }
  if (departs(passage)) {
    course.opened = true;
    state.opened_at = start + n.to / h_;
    state.departure = n.departure;
  }
  state.closed += passage == Passage::rolls_round ? table.share : acts;
  state.normal_force += table.share * n.force;
  state.normal_square += acts * n.course.square();
  state.peak = std::max(state.peak, n.course.largest());
  state.deepest = std::max(state.deepest, n.deepest);
  state.damper_work += n.damper_work;
}

/// Its force with its friction, along axes that turn; and its part of the linear force over the step.
inline void ContactIntervals::add_force(Passage passage, const Motion& motion, const NormalForce& n,
                                        const IntervalTable& table, int index, MovingContact& m) const {
  ContactCourse& course = m.course;
  if (friction_.active()) {
    find_friction(passage, motion, n, table, m);
  } else {
    m.force = along(motion.axes, n.force, {});
    m.growth = along(motion.axes, n.growth, {});
  }
  course.past.axes = course.state.axes = motion.axes;
  if (motion.turn.turns)
    rotate_force(motion, n, table.length, m);
  if (course.past.closed)
    m.last = n.from > 0.0 ? (n.course.last / n.force) * m.force : m.force + 0.5 * m.growth;
  const double share = table.share, x = (2.0 * index + 1.0) * share - 1.0; // the interval's middle
  const double s2 = share * share, x2 = x * x;
  StepForce& f = course.force;
  f.mean = f.mean + share * m.force;
  f.slope = f.slope + share * ((3.0 * x) * m.force + (0.5 * share) * m.growth);
  f.bends[0] = f.bends[0] + (2.5 * share) * ((3.0 * x2 + s2 - 1.0) * m.force + (share * x) * m.growth);
  f.bends[1] = f.bends[1] + (3.5 * share) * ((x * (5.0 * (x2 + s2) - 3.0)) * m.force +
                                             (0.5 * share * (5.0 * x2 + s2 - 1.0)) * m.growth);
}

void ContactIntervals::find_force(MovingContact& m, const IntervalTable& table, int index) const {
  const Motion motion = motion_of(m, table, index);
  ContactPast& past = m.course.past;
  const NormalForce n = find_normal_force(motion, past.closed, table);
  const Passage passage = passage_of({.was_closed = past.closed,
                                      .rolls_round = past.closed && rolls_round(motion, table.length),
                                      .crosses = past.axes.opposite(motion.axes),
                                      .has_force = n.force > 0.0,
                                      .force_ends = n.opens});
  record(passage, n, table, index, m.course);
  past.closed = ends_closed(passage);
  m.force = m.growth = m.last = {};
  m.piece = {m.number, 0.0, 0.0, n.course, {}};
  if (n.force > 0.0) {
    m.piece.from = index * table.share + n.from / h_;
    m.piece.to = index * table.share + n.to / h_;
    add_force(passage, motion, n, table, index, m);
  } else if (friction_.active()) {
    m.course.relaxed += relax_to(past, table.spring_left);
  }
  m.throughout = past.closed && n.from == 0.0;
  past.rise = m.throughout ? (1.0 / table.length) * m.growth : Components{};
  m.penetration = std::max({0.0, motion.penetration, motion.after(table.length)});
  m.course.penetrates = m.penetration > 0.0 || past.closed;
}

} // namespace fretwork::transient
