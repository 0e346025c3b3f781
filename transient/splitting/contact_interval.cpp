// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_interval.hpp"
#include <algorithm>
#include <array>

namespace fretwork::transient {
namespace {

/// Where normal and tangential motion are coupled an interval is made again until its force stands to this share.
constexpr double repeat_tolerance = 1e-6;
constexpr int most_repeats = 20;

/// Of the memory `reference`: one mean force over the interval.
contact::FrictionInterval<contact::Vec2>
reference_friction(const contact::FrictionLaw& law, const contact::FrictionTable& table,
                   const contact::FrictionMemory& memory, double normal, double length,
                   const contact::TangentialPath<contact::Vec2, contact::Sym2>& path) {
  const double half = 0.5 * length;
  const contact::Sym2 answer{half * path.mobility.xx, half * path.mobility.xt, half * path.mobility.tt};
  const contact::Vec2 acceleration = path.acceleration + half * path.jerk;
  const contact::Vec2 free = path.velocity - (length * length / 12.0) * path.jerk + half * acceleration;
  const contact::Friction friction = contact::step_friction_plane(law, table, memory, normal, free, answer);
  contact::FrictionInterval<contact::Vec2> out;
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

} // namespace

ContactIntervals::ContactIntervals(const contact::Support& support, const Components& rest,
                                   const Mobility& mobility, bool in_plane, double usual, double tolerance)
    : obstacle_(support.obstacle), normal_(support.normal), friction_(support.friction), rest_(rest),
      w_(mobility), in_plane_(in_plane), mobility_(0.0), across_(0.0), tolerance_(tolerance) {
  const Mobility& w = w_;
  for (int to = 0; to < 3; ++to) {
    mobility_ = std::max(mobility_, w(to, to));
    for (int from = 0; from < to; ++from)
      across_ = std::max({across_, std::abs(w(to, from)), std::abs(w(from, to))});
  }
  across_ = std::max(across_, 0.5 * std::abs(w(1, 1) - w(0, 0)));
  set_usual(usual);
}

IntervalTable ContactIntervals::table(double length) const {
  IntervalTable of;
  of.length = length;
  const double force = 0.5 * length * length * (normal_.stiffness + friction_.stiffness) +
                       length * (normal_.damping + friction_.damping);
  of.apparent_mass = force / (1.0 + force * mobility_);
  of.growing = contact::growing_damping(normal_.damping, normal_.damping * mobility_ * length);
  if (friction_.active() && friction_.kind == contact::FrictionMemoryKind::reference)
    of.table = contact::friction_table(friction_, length);
  return of;
}

void ContactIntervals::set_usual(double length) {
  usual_ = table(length);
  if (friction_.active())
    usual_pieces_ = contact::piece_tables(friction_, mobility_, length);
}

double ContactIntervals::relax(ContactPast& past, double time) const {
  contact::Vec2& spring = past.friction.spring;
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

/// The gap is linear about where the force of the guess leads.
void ContactIntervals::find_normal_force(const ContactPath& m, const Components& guessed,
                                         const Components& growth, const IntervalTable& of,
                                         IntervalForces& p) const {
  const double dt = of.length, half = 0.5 * dt * dt;
  const Components bent = guessed - (1.0 / 6.0) * growth; // moves the contact as far where it is constant
  const Components by_guess = w_ * bent, a = m.a + 0.5 * dt * m.j + w_ * guessed;
  const Components way = m.displacement(dt) + half * by_guess;
  const contact::Location there = locate(m.u + way);
  p.turned = m.at.axes().normal(there.ny, there.nz);
  const double along = tangent(m.at.axes(), way);
  const double curvature = along != 0.0 ? m.at.axes().tangent(there.ny, there.nz) / along : 0.0;
  p.curvature = std::abs(curvature);
  const auto find = [&](const contact::ContactAxes& axes, double start, double end, double rate) {
    const Mobility& w = w_;
    const auto [ny, nz] = axes;
    const double wnn = w(0, 0) * ny * ny + (w(0, 1) + w(1, 0)) * ny * nz + w(1, 1) * nz * nz;
    const double free = end + half * wnn * normal(axes, bent);
    // with what the gap adds where the contact follows a curve, as v_t^2/R
    const double acceleration = (free - start - rate * dt) / half - normal(axes, m.j) * dt / 6.0;
    p.axes = axes;
    p.normal = contact::normal_over_interval(normal_, dt, wnn, of.growing, {start, free, rate, acceleration});
  };
  const double start = -m.at.gap, rate = -normal(m.at.axes(), m.v);
  // The gap that the laws follow strays from that of the position: a damper would take that for a speed.
  const double drift = start + locate(m.u).gap;
  p.to = there;
  if (p.turned > 0.0) {
    contact::ContactAxes axes = m.at.axes();
    if (there.gap < 0.0 && p.turned < 1.0) { // the mean along the way; one that opens keeps its own
      // of length 1 but for the square of the turn, near enough for what the way bends
      const contact::ContactAxes chord{0.5 * (axes.ny + there.ny), 0.5 * (axes.nz + there.nz)};
      const double bend = -(dt * dt / 12.0) * curvature * tangent(chord, a);
      const double per_length = 1.0 / std::sqrt(0.5 * (1.0 + p.turned) * (1.0 + bend * bend));
      axes = {per_length * chord.y(1.0, bend), per_length * chord.z(1.0, bend)};
      p.turn = {there.ny - m.at.ny, there.nz - m.at.nz, 0.0};
    }
    find(axes, start, drift - there.gap, rate);
  } else { // another face lies ahead of the guess: does the contact stay on its own, or leave it before?
    find(m.at.axes(), start, start - normal(m.at.axes(), way), rate);
    const Components by =
        w_ * ((p.normal.force - p.normal.growth / 6.0) * Components{p.axes.ny, p.axes.nz, 0.0});
    const contact::Location then = locate(m.u + way + half * (by - by_guess));
    p.to = m.at;
    if (p.normal.to == 1.0 && then.gap < 0.0 && m.at.axes().normal(then.ny, then.nz) <= 0.0) {
      find(there.axes(), -there.gap + normal(there.axes(), way), -there.gap, -normal(there.axes(), m.v));
      p.to = there;
    }
  }
  p.damper_work = p.normal.damper_work;
  p.to.gap = -p.normal.end;
}

void ContactIntervals::find_closed_friction(const ContactPath& m, const IntervalTable& of,
                                            IntervalForces& p) const {
  const contact::FrictionLaw& law = friction_;
  const bool by_reference =
      law.kind == contact::FrictionMemoryKind::reference; // which knows no parts of an interval
  const bool whole = by_reference || (p.normal.from == 0.0 && p.normal.to == 1.0);
  const auto [ny, nz] = p.axes;
  const double dt = of.length, from = whole ? 0.0 : p.normal.from * dt;
  const double length = whole ? dt : (p.normal.to - p.normal.from) * dt;
  double stored = friction_.spring_energy(p.memory.spring);
  if (from > 0.0) {
    p.memory.sliding = false;
    if (stored > 0.0) {
      const double rest = contact::spring_left(law, from);
      p.memory.spring = rest * p.memory.spring;
      p.damper_work += (1.0 - rest * rest) * stored;
      stored *= rest * rest;
    }
  }
  // along t = (nz, -ny): with the mean of the normal force and its growth
  const Mobility& w = w_;
  const Components by_n{w(0, 0) * ny + w(0, 1) * nz, w(1, 0) * ny + w(1, 1) * nz,
                        w(2, 0) * ny + w(2, 1) * nz};
  const double wtt = w(0, 0) * nz * nz - (w(0, 1) + w(1, 0)) * ny * nz + w(1, 1) * ny * ny;
  const double rise = p.normal.growth / dt, mean = p.normal.force - (0.5 * dt - from) * rise;
  const auto start = [&](double u1, double u2, double u3, double w_n) { // velocity, acceleration, jerk
    return std::array{u1 + from * (u2 + 0.5 * from * u3 + w_n * p.normal.force), u2 + from * u3 + w_n * mean,
                      u3 + w_n * rise};
  };
  const auto [vt, at, jt] =
      start(tangent(p.axes, m.v), tangent(p.axes, m.a), tangent(p.axes, m.j), tangent(p.axes, by_n));
  double growth_square = 0.0; // N2, while it is closed
  const auto close = [&](const auto& f, contact::Vec2 impulse, contact::Vec2 moment, contact::Vec2 by,
                         contact::Vec2 spring, contact::Vec2 faster) {
    p.friction = (1.0 / dt) * impulse;
    const contact::Vec2 growth = (12.0 / (length * length)) * moment;
    growth_square = dot(growth, growth);
    p.friction_growth = (12.0 / (dt * dt)) * (moment + (from + 0.5 * (length - dt)) * impulse);
    p.displacement = by;
    p.memory = {spring, f.sliding};
    p.slider_work = f.slider_work;
    p.wear_work = f.wear_work;
    p.slid = f.slid;
    p.sliding_time = f.sliding_time;
    // what goes into the element and is neither stored nor taken by the slider
    p.damper_work += stored - friction_.spring_energy(spring) - p.slider_work -
                     dot((1.0 / length) * impulse, by) - dot((1.0 / length) * moment, faster);
  };
  if (in_plane_) {
    const double wxt = p.axes.tangent(w(0, 2), w(1, 2));
    const auto [vx, ax, jx] = start(m.v.x, m.a.x, m.j.x, by_n.x);
    const contact::TangentialPath<contact::Vec2, contact::Sym2> path{
        law.masked(contact::Vec2{vx, vt}), law.masked(contact::Vec2{ax, at}),
        law.masked(contact::Vec2{jx, jt}), law.masked(contact::Sym2{w(2, 2), wxt, wtt})};
    const auto f = by_reference
                       ? reference_friction(law, of.table, p.memory, p.normal.force, length, path)
                       : contact::friction_over_interval(law, usual_pieces_, mobility_, p.memory.spring,
                                                         p.memory.sliding, length, p.normal.course, path);
    close(f, f.impulse, f.moment, f.displacement, f.spring, f.velocity - path.velocity);
  } else if (by_reference) {
    const contact::TangentialPath<contact::Vec2, contact::Sym2> path{{0.0, law.along.t * vt},
                                                                     {0.0, law.along.t * at},
                                                                     {0.0, law.along.t * jt},
                                                                     {0.0, 0.0, law.along.t * wtt}};
    const auto f = reference_friction(law, of.table, p.memory, p.normal.force, length, path);
    close(f, f.impulse, f.moment, f.displacement, f.spring, f.velocity - path.velocity);
  } else {
    const contact::TangentialPath<double, double> path{law.along.t * vt, law.along.t * at, law.along.t * jt,
                                                       law.along.t * wtt};
    const auto f = contact::friction_over_interval(law, usual_pieces_, mobility_, p.memory.spring.t,
                                                   p.memory.sliding, length, p.normal.course, path);
    close(f, {0.0, f.impulse}, {0.0, f.moment}, {0.0, f.displacement}, {0.0, f.spring},
          {0.0, f.velocity - path.velocity});
  }
  p.friction_square = dt / length * dot(p.friction, p.friction) + length / (12.0 * dt) * growth_square;
  if (p.normal.to < 1.0) {
    const double rest = by_reference ? 0.0 : contact::spring_left(law, dt - from - length);
    p.damper_work += (1.0 - rest * rest) * friction_.spring_energy(p.memory.spring);
    p.memory = {rest * p.memory.spring, false};
  }
}

void ContactIntervals::find_friction(const ContactPath& m, const ContactPast& past, const IntervalTable& of,
                                     IntervalForces& p) const {
  p.memory = past.friction;
  if (past.axes.opposite(p.axes) && p.normal.force > 0.0) { // another surface
    p.memory = {};
    p.damper_work += friction_.spring_energy(past.friction.spring);
  }
  if (p.normal.force > 0.0) {
    find_closed_friction(m, of, p);
    return;
  }
  ContactPast open = past;
  p.damper_work += relax(open, of.length);
  p.memory = open.friction;
}

bool ContactIntervals::find_forces(const ContactPath& m, const ContactPast& past, const IntervalTable& of,
                                   bool may_shorten, IntervalForces& p) const {
  Components growth = of.length * m.rise, guess = m.force + 0.5 * growth;
  if (normal(m.at.axes(), guess) <= 0.0)
    guess = growth = {};
  const auto along = [&p](double f) { return Components{p.axes.y(f, 0.0), p.axes.z(f, 0.0), 0.0}; };
  // so much more force turns the normal less than the tolerance
  const auto turns_little = [&](double force) {
    return 0.5 * of.length * of.length * mobility_ * std::abs(p.curvature * force) <= tolerance_;
  };
  for (int i = 0;; ++i) {
    p = {};
    find_normal_force(m, guess, growth, of, p);
    if (const double more = p.normal.force - normal(p.axes, guess); !turns_little(more) && i < most_repeats) {
      guess = guess + along(more);
      growth = growth + along(p.normal.growth - normal(p.axes, growth));
      continue;
    }
    if (may_shorten && (p.normal.to < 1.0 || p.turns_far()))
      return false;
    if (friction_.active())
      find_friction(m, past, of, p);
    p.force = {p.axes.y(p.normal.force, p.friction.t), p.axes.z(p.normal.force, p.friction.t), p.friction.x};
    p.growth = Components{p.axes.y(p.normal.growth, p.friction_growth.t),
                          p.axes.z(p.normal.growth, p.friction_growth.t), p.friction_growth.x} +
               p.normal.force * p.turn;
    const double changed = sum_of_sizes(p.force - guess);
    if ((of.apparent_mass * across_ * changed <= repeat_tolerance * sum_of_sizes(p.force) &&
         turns_little(changed)) ||
        i == most_repeats)
      return true;
    guess = p.force;
    growth = p.growth;
  }
}

} // namespace fretwork::transient
