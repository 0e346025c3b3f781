// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_interval.hpp"
#include <algorithm>

namespace fretwork::transient {
namespace {

using contact::dot;
using contact::Vec2;

/// Of its clearance, what a contact may move in an interval, and the most intervals of a step for its sake.
constexpr double longest_way = 1.0;
constexpr int most_for_speed = 64;
/// rad: by which a normal turns in an interval at most, as far as the terms of the curvature know.
constexpr double most_turned = 1.0;
/// Of an interval: what is shorter is none.
constexpr double shortest = 1e-9;

/// Of the memory `reference`: one mean force over the interval.
contact::FrictionInterval<Vec2> reference_friction(const contact::FrictionLaw& law,
                                                   const contact::FrictionTable& table,
                                                   const contact::FrictionMemory& memory, double normal,
                                                   double length,
                                                   const contact::TangentialPath<Vec2, contact::Sym2>& path) {
  const double half = 0.5 * length;
  const contact::Sym2 answer{half * path.mobility.xx, half * path.mobility.xt, half * path.mobility.tt};
  const Vec2 acceleration = path.acceleration + half * path.jerk;
  const Vec2 free = path.velocity - (length * length / 12.0) * path.jerk + half * acceleration;
  const contact::Friction friction = contact::step_friction_plane(law, table, memory, normal, free, answer);
  contact::FrictionInterval<Vec2> out;
  out.displacement = length * (free + answer * friction.force);
  out.velocity = path.velocity + length * (acceleration + path.mobility * friction.force);
  const contact::FrictionStep step = contact::close_step(law, table, memory, friction, out.displacement);
  out.impulse = length * friction.force;
  out.spring = step.memory.spring;
  out.sliding = friction.slides;
  out.slider_work = step.friction_work;
  if (friction.slides) {
    out.slid = norm(out.displacement);
    out.wear_work = normal * out.slid;
    out.sliding_time = length;
  }
  return out;
}

Vec2 in_plane(Vec2 v) { return v; }
Vec2 in_plane(double along_t) { return {0.0, along_t}; }

} // namespace

/// How a contact moves over an interval without its own force, along the normal at its mean position and across.
struct ContactIntervals::Motion {
  contact::ContactAxes axes;
  Components velocity;      ///< m/s, at the start
  Components acceleration;  ///< m/s2, mean
  Components jerk;          ///< m/s3
  Components by_normal;     ///< 1/kg, W n
  double mobility = 0.0;    ///< 1/kg, n W n
  double penetration = 0.0; ///< m, at the start
  double rate = 0.0;        ///< m/s
  double acceleration_inwards =
      0.0;           ///< m/s2, mean of the second derivative of the penetration, under the friction expected
  double bend = 0.0; ///< m: by its jerk at the end
  double turning = 0.0;        ///< rad/s, of the normal towards t, half way
  double turning_growth = 0.0; ///< rad/s2
  bool curved = false;         ///< the normal turns
  double ahead = 0.0;          ///< rad, by which the axes, at the mean position, are ahead of those half way
  [[nodiscard]] double after(double time) const {
    return penetration + time * (rate + 0.5 * time * acceleration_inwards);
  }
};

/// Its normal force over an interval.
struct ContactIntervals::NormalForce {
  double force = 0.0,
         growth = 0.0; ///< N, mean over the interval, and growth of a linear force with its first moment
  double from = 0.0, to = 0.0;            ///< s: it acts between,
  contact::ParabolicForce course;         ///< so
  bool touches = false, opens = false;    ///< in the interval
  double approach = 0.0, departure = 0.0; ///< m/s, where it closes and opens
  double damper_work = 0.0;               ///< J
};

ContactIntervals::ContactIntervals(const contact::Support& support, const Components& rest,
                                   const Mobility& mobility, bool in_plane, double step, double clearance)
    : obstacle_(support.obstacle), normal_(support.normal), friction_(support.friction), rest_(rest),
      w_(mobility), in_plane_(in_plane), h_(step), clearance_(clearance),
      mobility_(std::max({mobility(0, 0), mobility(1, 1), mobility(2, 2)})) {}

IntervalTable ContactIntervals::table(int count) const {
  IntervalTable of;
  of.count = count;
  of.share = 1.0 / count;
  of.length = of.share * h_;
  of.growing = contact::growing_damping(normal_.damping, normal_.damping * mobility_ * of.length);
  const auto mass = [&](double stiffness, double damping) {
    const double force = of.length * (stiffness * of.length / 6.0 + damping);
    return force / (1.0 + force * mobility_);
  };
  of.sliding_mass = mass(normal_.stiffness, normal_.damping);
  of.apparent_mass = std::max(of.sliding_mass, mass(friction_.stiffness, friction_.damping));
  if (friction_.active()) {
    of.pieces = contact::piece_tables(friction_, mobility_, of.length);
    if (friction_.kind == contact::FrictionMemoryKind::reference)
      of.reference = contact::friction_table(friction_, of.length);
  }
  return of;
}

int ContactIntervals::least_count(const Components& velocity) const {
  if (!(clearance_ > 0.0))
    return 1;
  const double speed = std::sqrt(velocity.y() * velocity.y() + velocity.z() * velocity.z());
  return static_cast<int>(
      std::ceil(std::clamp(speed * h_ / (longest_way * clearance_), 1.0, 1.0 * most_for_speed)));
}

bool ContactIntervals::meets(const ContactPast& past, const FreePath& path, int count) const {
  if (past.closed)
    return true;
  for (int i = count; i >= 0; --i)
    if (locate(path.displacement(h_ * i / count)).gap <= 0.0)
      return true;
  return false;
}

void ContactIntervals::begin(MovingContact& m, const Components& held, const IntervalTable& of) const {
  m.growth = of.length * m.past.rise;
  m.force = held + 0.5 * m.growth;
  m.by_held = w_ * held;
  follow(m);
}

void ContactIntervals::follow(MovingContact& m) const {
  m.by_force = w_ * m.force;
  m.by_growth = w_ * m.growth;
}

void ContactIntervals::move(MovingContact& m, const IntervalTable& of) const {
  const double dt = of.length;
  follow(m);
  const Components by = m.others + m.by_force - m.by_held, growth = m.others_growth + m.by_growth;
  m.response = m.response + dt * (m.rate + dt * (0.5 * by - (1.0 / 12.0) * growth));
  m.rate = m.rate + dt * by;
  m.others = m.others + m.others_growth;
}

double ContactIntervals::answer(const MovingContact& m, const IntervalTable& of, const Components& by) const {
  return m.past.closed ? (m.past.friction.sliding ? of.sliding_mass : of.apparent_mass) * sum_of_sizes(by)
                       : 0.0;
}

void ContactIntervals::expect(MovingContact& m) const {
  if (!m.throughout)
    m.growth = {};
  m.force = m.last + 0.5 * m.growth;
  follow(m);
}

double ContactIntervals::relax(ContactPast& past, double time) const {
  Vec2& spring = past.friction.spring;
  past.friction.sliding = false;
  if (!(dot(spring, spring) > 0.0))
    return 0.0;
  const double left =
      friction_.kind == contact::FrictionMemoryKind::return_map ? contact::spring_left(friction_, time) : 0.0;
  const double before = friction_.spring_energy(spring);
  spring = left * spring;
  if (dot(spring, spring) <= contact::forgotten * contact::forgotten * past.spring_at_opening)
    spring = {};
  return before - friction_.spring_energy(spring);
}

void ContactIntervals::stretch(ContactPast& past, const Components& missed) const {
  if (!past.closed || !friction_.active() || past.friction.sliding ||
      friction_.kind == contact::FrictionMemoryKind::reference)
    return;
  past.friction.spring.t -= friction_.along.t * friction_.stiffness * tangent(past.axes, missed);
  if (in_plane_)
    past.friction.spring.x -= friction_.along.x * friction_.stiffness * missed.x;
}

ContactIntervals::Motion ContactIntervals::motion_of(const MovingContact& m, const IntervalTable& of,
                                                     int index) const {
  Motion a;
  const double dt = of.length, start = index * dt;
  const Components of_path = m.path.a + (start + 0.5 * dt) * m.path.j;
  const Components changed = m.others + m.by_force - m.by_held;
  const Components now = of_path + changed; // under the force that is expected of it
  a.velocity = m.path.velocity(start) + m.rate;
  a.jerk = m.path.j + (1.0 / dt) * m.others_growth;
  a.acceleration = now - m.by_force;
  const Components grows = dt * a.jerk + m.by_growth;
  const Components mean =
      m.path.displacement(start) + m.response + (0.5 * dt) * (a.velocity + (dt / 3.0) * (now - 0.25 * grows));
  const contact::Location at = locate(mean);
  a.axes = at.axes();
  const auto [ny, nz] = a.axes;
  a.by_normal = w_ * Components{ny, nz, 0.0};
  a.mobility = normal(a.axes, a.by_normal);
  const Components half_way = a.velocity + (0.5 * dt) * (now - 0.25 * grows);
  const double along_t = tangent(a.axes, half_way), along_n = normal(a.axes, half_way),
               faster = tangent(a.axes, now);
  // near a centre or a corner the normal turns at once: no more than the interval can follow
  const double most = most_turned / (dt * (std::abs(along_t) + std::abs(along_n) + dt * std::abs(faster)));
  const double kappa = std::clamp(curvature(mean), -most, most); // 1/m
  a.curved = kappa != 0.0;
  a.turning = kappa * along_t;
  a.turning_growth = kappa * (faster - 2.0 * a.turning * along_n);
  a.ahead = dt * dt / 24.0 * kappa * faster;
  const double centripetal = a.turning * along_t, inwards = -normal(a.axes, now) - centripetal;
  // m/s3: of the penetration, by the centripetal acceleration that grows; m/s2: its change over the interval
  const double jerk_by_turning = a.turning * (faster - a.turning * along_n) + a.turning_growth * along_t;
  // rad, to the start
  const double angle = 0.5 * dt * a.turning, more = 0.125 * dt * dt * a.turning_growth - a.ahead;
  a.rate =
      (angle - more) * tangent(a.axes, a.velocity) - (1.0 - 0.5 * angle * angle) * normal(a.axes, a.velocity);
  const double change = normal(a.axes, grows) + dt * (jerk_by_turning + a.turning * faster);
  // its mean over the interval, on a curved wall another than that of its mean position
  const double mean_penetration = -at.gap - dt * dt / 24.0 * centripetal;
  a.penetration = mean_penetration - (0.5 * dt) * (a.rate + (dt / 3.0) * (inwards + 0.25 * change));
  a.acceleration_inwards = inwards + normal(a.axes, m.force) * a.mobility;
  a.bend = dt * dt * dt / 12.0 *
           (normal(a.axes, a.jerk) + jerk_by_turning + a.turning * tangent(a.axes, a.acceleration));
  return a;
}

/// s: from when on the contact has a force; dt and more: not in the interval.
double ContactIntervals::time_of_closing(const Motion& a, bool closed, double dt) const {
  if (a.penetration < 0.0) {
    const double square = a.rate * a.rate - 2.0 * a.acceleration_inwards * a.penetration;
    const double speed = square > 0.0 ? a.rate + std::sqrt(square) : 0.0;
    return speed > 0.0 ? std::min(dt, -2.0 * a.penetration / speed) : dt;
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

ContactIntervals::NormalForce ContactIntervals::find_normal_force(const Motion& a, bool closed,
                                                                  const IntervalTable& of) const {
  NormalForce out;
  const double dt = of.length, closes = time_of_closing(a, closed, dt);
  if (!(closes < (1.0 - shortest) * dt)) {
    out.damper_work = released(a.penetration, a.after(dt));
    return out;
  }
  const double start = std::max(0.0, closes > 0.0 ? a.after(closes) : a.penetration);
  const double rate = a.rate + closes * a.acceleration_inwards;
  const auto over = [&](double length) {
    const bool whole = length == dt;
    const double growing =
        whole ? of.growing : contact::growing_damping(normal_.damping, normal_.damping * mobility_ * length);
    const double end =
        start + length * (rate + 0.5 * length * a.acceleration_inwards) + (whole ? a.bend : 0.0);
    return contact::normal_over_interval(normal_, length, a.mobility, growing,
                                         {start, end, rate, a.acceleration_inwards});
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
  out.touches = !closed;
  out.to = closes + (out.opens ? n.to : 1.0) * length;
  out.course = n.course;
  out.approach = rate;
  out.departure = -(rate + length * (a.acceleration_inwards - a.mobility * n.force));
  out.damper_work = n.damper_work;
  if (closes > 0.0)
    out.damper_work += released(a.penetration, start);
  if (out.opens) {
    const double left = dt - closes - length;
    const double end = n.end + left * (-out.departure + 0.5 * left * a.acceleration_inwards);
    out.damper_work += released(n.end, end);
  }
  return out;
}

/// A force along axes that turn, seen along those of the mean position.
void ContactIntervals::turn(const Motion& a, const NormalForce& n, double dt, MovingContact& m) {
  const double place = 0.5 * (n.from + n.to - dt), acts = n.to - n.from,
               square = place * place + acts * acts / 12.0; // s2, mean of the time since the middle, squared
  const double fn = normal(a.axes, m.force), ft = tangent(a.axes, m.force);
  const double by_growth = dt / 12.0 * a.turning, by_force = 0.5 * square * a.turning_growth - a.ahead,
               less = 0.5 * square * a.turning * a.turning;
  m.force = m.force + along(a.axes, -by_growth * tangent(a.axes, m.growth) - by_force * ft - less * fn,
                            {0.0, by_growth * normal(a.axes, m.growth) + by_force * fn - less * ft});
  const double grows = 12.0 / dt * square * a.turning;
  m.growth = m.growth + along(a.axes, -grows * ft, {0.0, grows * fn});
}

void ContactIntervals::act(MovingContact& m, const IntervalTable& of, int index) const {
  const Motion a = motion_of(m, of, index);
  const NormalForce n = find_normal_force(a, m.past.closed, of);
  ContactState& state = m.state;
  ContactPast& past = m.past;
  const bool was_closed = past.closed;
  const double start = index * of.share;
  state.damper_work += n.damper_work;
  m.force = m.growth = m.last = {};
  past.closed = n.force > 0.0 && !n.opens;
  if (n.force > 0.0) {
    if (n.touches ||
        past.before_run) { // not where a closed contact rolls out by less than its path is known to
      ++state.touches;
      past.before_run = false;
      state.closed_at = start + n.from / h_;
      state.approach = n.approach;
    }
    const double share = (n.to - n.from) / h_;
    state.normal_force += of.share * n.force;
    state.normal_square += share * n.course.square();
    state.closed += share;
    state.peak = std::max(state.peak, n.course.largest());
    if (friction_.active()) {
      find_friction(a, n, of, m);
    } else {
      m.force = along(a.axes, n.force, {});
      m.growth = along(a.axes, n.growth, {});
    }
    past.axes = state.axes = a.axes;
    if (a.curved)
      turn(a, n, of.length, m);
    if (past.closed)
      m.last = n.from > 0.0 ? (n.course.last / n.force) * m.force : m.force + 0.5 * m.growth;
    m.mean = m.mean + of.share * m.force;
    m.slope =
        m.slope + of.share * ((6.0 * (start + 0.5 * of.share) - 3.0) * m.force + (0.5 * of.share) * m.growth);
  } else if (friction_.active()) {
    m.relaxed += relax(past, of.length);
  }
  if ((was_closed || n.force > 0.0) && !past.closed) {
    m.opened = true;
    state.opened_at = start + n.to / h_;
    state.departure = n.force > 0.0 ? n.departure : -a.rate;
  }
  m.throughout = past.closed && n.from == 0.0;
  past.rise = m.throughout ? (1.0 / of.length) * m.growth : Components{};
  m.penetrates = a.after(of.length) > 0.0 || past.closed;
}

/// Its friction over an interval.   @param f  a FrictionInterval<V>   @param velocity  m/s, at its start
template <class V, class Friction>
void ContactIntervals::take_friction(const Motion& a, const NormalForce& n, const IntervalTable& of,
                                     const Friction& f, V velocity, MovingContact& m) const {
  ContactState& state = m.state;
  const double dt = of.length, length = n.to - n.from;
  const V mean = (1.0 / length) * f.impulse, growth = (12.0 / (length * length)) * f.moment;
  const Vec2 force = in_plane(V((1.0 / dt) * f.impulse));
  m.force = along(a.axes, n.force, force);
  m.growth = along(a.axes, n.growth,
                   (12.0 / (dt * dt)) * in_plane(V(f.moment + (n.from + 0.5 * (length - dt)) * f.impulse)));
  // what goes into the element and is neither stored nor taken by the slider
  state.damper_work += friction_.spring_energy(m.past.friction.spring) - friction_.spring_energy(f.spring) -
                       f.slider_work - dot(mean, f.displacement) -
                       dot(V((length / 12.0) * growth), V(f.velocity - velocity));
  state.friction = state.friction + of.share * force;
  state.friction_square += length / h_ * (dot(mean, mean) + dot(growth, growth) / 12.0);
  state.displacement = state.displacement + in_plane(f.displacement);
  state.slid += f.slid;
  state.wear_work += f.wear_work;
  state.friction_work += f.slider_work;
  state.sliding += f.sliding_time / h_;
  state.slides = f.sliding_time > 0.0;
  m.past.friction = {in_plane(f.spring), f.sliding};
}

void ContactIntervals::find_friction(const Motion& a, const NormalForce& n, const IntervalTable& of,
                                     MovingContact& m) const {
  const double dt = of.length, length = n.to - n.from;
  const bool by_reference = friction_.kind == contact::FrictionMemoryKind::reference;
  ContactState& state = m.state;
  contact::FrictionMemory& memory = m.past.friction;
  const double before = friction_.spring_energy(memory.spring);
  if (m.past.axes.opposite(a.axes)) // another surface
    memory = {};
  else if (n.touches && n.from > 0.0)
    memory = {by_reference ? Vec2{} : contact::spring_left(friction_, n.from) * memory.spring, false};
  state.damper_work += before - friction_.spring_energy(memory.spring);
  // along t: with the normal force, linear in time
  const double from = by_reference ? 0.0 : n.from; // it knows no parts of an interval
  const double since_half = from - 0.5 * dt;
  const double rise = n.growth / dt, then = n.force + since_half * rise;
  const Components velocity = a.velocity + from * (a.acceleration + (0.5 * (from - dt)) * a.jerk);
  const Components acceleration = a.acceleration + since_half * a.jerk;
  const contact::ContactAxes& axes = a.axes;
  const Components along_t{axes.nz, -axes.ny, 0.0}, by_t = w_ * along_t;
  const double wtt = tangent(axes, by_t);
  const double by_t_of_n = tangent(axes, a.by_normal);
  double vt = tangent(axes, velocity), at = tangent(axes, acceleration) + by_t_of_n * then,
         jt = tangent(axes, a.jerk) + by_t_of_n * rise;
  double turned_x = 0.0, turning_x = 0.0;             // m/s2, m/s3: along x, as the normal force turns
  if (a.curved) {                                     // (v t)' = a t - turning v n
    const double angle = a.turning * since_half;      // rad, since half way
    const double free = normal(axes, a.acceleration); // m/s2, without the normal force
    const double speed = -(a.rate + from * a.acceleration_inwards);        // m/s, along n
    const double pressed = by_reference ? n.force : n.force * dt / length; // N, while it acts
    const double faster = a.mobility * pressed - a.acceleration_inwards;   // m/s2, growth of that speed
    const double unequal =
        wtt - a.mobility; // 1/kg: the acceleration by a force that turns is not its own turned
    vt -= 0.5 * angle * angle * vt +
          (angle + 0.5 * since_half * since_half * a.turning_growth - a.ahead) * normal(axes, velocity);
    at += angle * (unequal * then - free) - (a.turning + a.turning_growth * since_half) * speed;
    jt += a.turning * (unequal * n.force - free - faster) - a.turning_growth * (speed - since_half * faster);
    turned_x = angle * by_t.x * then;
    turning_x = a.turning * by_t.x * n.force;
  }
  if (in_plane_ || by_reference) {
    const double vx = velocity.x, ax = acceleration.x + a.by_normal.x * then + turned_x,
                 jx = a.jerk.x + a.by_normal.x * rise + turning_x;
    const contact::TangentialPath<Vec2, contact::Sym2> path{
        friction_.masked(Vec2{in_plane_ ? vx : 0.0, vt}), friction_.masked(Vec2{in_plane_ ? ax : 0.0, at}),
        friction_.masked(Vec2{in_plane_ ? jx : 0.0, jt}),
        friction_.masked(in_plane_ ? contact::Sym2{w_(2, 2), by_t.x, wtt} : contact::Sym2{0.0, 0.0, wtt})};
    if (by_reference) {
      NormalForce whole = n;
      whole.from = 0.0;
      whole.to = dt;
      take_friction(a, whole, of, reference_friction(friction_, of.reference, memory, n.force, dt, path),
                    path.velocity, m);
    } else {
      take_friction(a, n, of,
                    contact::friction_over_interval(friction_, of.pieces, mobility_, memory.spring,
                                                    memory.sliding, length, n.course, path),
                    path.velocity, m);
    }
  } else {
    const contact::TangentialPath<double, double> path{friction_.along.t * vt, friction_.along.t * at,
                                                       friction_.along.t * jt, friction_.along.t * wtt};
    take_friction(a, n, of,
                  contact::friction_over_interval(friction_, of.pieces, mobility_, memory.spring.t,
                                                  memory.sliding, length, n.course, path),
                  path.velocity, m);
  }
  m.past.spring_at_opening = dot(memory.spring, memory.spring);
  if (n.opens)
    state.damper_work += relax(m.past, dt - n.to);
}

} // namespace fretwork::transient
