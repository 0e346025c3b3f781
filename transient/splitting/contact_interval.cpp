// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_interval.hpp"
#include <algorithm>

namespace fretwork::transient {
namespace {

/// Of the usual length: intervals below it take the gap of the position for their rates.
constexpr double short_interval = 0.3;
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
    out.wear_work = normal * out.slid;
    out.sliding_time = length;
  }
  return out;
}

} // namespace

ContactIntervals::ContactIntervals(const contact::Support& support, const Components& rest,
                                   const Mobility& mobility, bool in_plane, double usual)
    : obstacle_(support.obstacle), normal_(support.normal), friction_(support.friction), rest_(rest),
      w_(mobility), in_plane_(in_plane), mobility_(0.0), across_(0.0) {
  const auto& w = w_.w;
  for (int to = 0; to < 3; ++to) {
    mobility_ = std::max(mobility_, w[to][to]);
    for (int from = 0; from < to; ++from)
      across_ = std::max({across_, std::abs(w[to][from]), std::abs(w[from][to])});
  }
  across_ = std::max(across_, 0.5 * std::abs(w[1][1] - w[0][0]));
  set_usual(usual);
}

IntervalTable ContactIntervals::table(double length) const {
  IntervalTable of;
  of.length = length;
  const double force = 0.5 * length * length * (normal_.stiffness + friction_.stiffness) +
                       length * (normal_.damping + friction_.damping);
  of.apparent_mass = force / (1.0 + force * mobility_);
  of.normal_share =
      normal_.damping > 0.0 ? contact::implicit_share(normal_.damping * mobility_ * length) : 0.5;
  if (friction_.active()) {
    of.piece = contact::piece_table(friction_, mobility_, length);
    if (friction_.kind == contact::FrictionMemoryKind::reference)
      of.table = contact::friction_table(friction_, length);
  }
  return of;
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
                                         const IntervalTable& of, IntervalForces& p) const {
  const double dt = of.length, half = 0.5 * dt * dt, share = of.normal_share;
  const Components by_guess = w_ * guessed, a = m.a + 0.5 * dt * m.j + by_guess;
  const Components way = m.displacement(dt) + half * by_guess;
  const contact::Location there = locate(m.u + way);
  const double turned = m.at.axes().normal(there.ny, there.nz);
  const auto find = [&](const contact::ContactAxes& axes, double start, double end, double rate) {
    const auto& w = w_.w;
    const auto [ny, nz] = axes;
    const double wnn = w[0][0] * ny * ny + (w[0][1] + w[1][0]) * ny * nz + w[1][1] * nz * nz;
    const double guess = normal(axes, guessed), acceleration = wnn * guess - normal(axes, a);
    p.axes = axes;
    p.normal = contact::normal_over_interval(
        normal_, dt, usual_.length, wnn, share,
        {start, end + half * wnn * guess + (share - 0.5) * dt * dt * acceleration, rate, acceleration});
  };
  const double start = -m.at.gap, rate = -normal(m.at.axes(), m.v);
  // The gap that the laws follow strays from that of the position, by curvature and where beta is not 1/2: over a short interval a damper would
  // take that for a speed.
  const double drift = dt < short_interval * usual_.length ? start + locate(m.u).gap : 0.0;
  p.to = there;
  if (turned > 0.0) {
    contact::ContactAxes axes = m.at.axes();
    if (there.gap < 0.0 && turned < 1.0) { // the mean of both; one that opens keeps its own
      const double per = 1.0 / std::sqrt(2.0 * (1.0 + turned));
      axes = {per * (axes.ny + there.ny), per * (axes.nz + there.nz)};
    }
    find(axes, start, drift - there.gap, rate);
  } else { // another face lies ahead of the guess: does the contact stay on its own, or leave it before?
    find(m.at.axes(), start, start - normal(m.at.axes(), way), rate);
    const Components by = w_ * (p.normal.force * Components{p.axes.ny, p.axes.nz, 0.0});
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
  // along t = (nz, -ny), with the mean of the normal force
  const Components a = m.a + 0.5 * dt * m.j + w_ * Components{p.normal.force * ny, p.normal.force * nz, 0.0},
                   v = m.v - (dt * dt / 12.0) * m.j + from * a;
  const auto& w = w_.w;
  const double wtt = w[0][0] * nz * nz - (w[0][1] + w[1][0]) * ny * nz + w[1][1] * ny * ny;
  const double vt = tangent(p.axes, v), at = tangent(p.axes, a);
  const auto close = [&](const auto& f, contact::Vec2 impulse, contact::Vec2 by, contact::Vec2 spring) {
    p.friction = (1.0 / dt) * impulse;
    p.displacement = by;
    p.memory = {spring, f.sliding};
    p.slider_work = f.slider_work;
    p.wear_work = f.wear_work;
    p.slid = f.slid;
    p.sliding_time = f.sliding_time;
    // what goes into the element and is neither stored nor taken by the slider
    p.damper_work +=
        stored - friction_.spring_energy(spring) - p.slider_work - dot((1.0 / length) * impulse, by);
  };
  if (in_plane_) {
    const double wxt = p.axes.tangent(w[0][2], w[1][2]);
    const contact::TangentialPath<contact::Vec2, contact::Sym2> path{
        law.masked(contact::Vec2{v.x, vt}), law.masked(contact::Vec2{a.x, at}),
        law.masked(contact::Sym2{w[2][2], wxt, wtt})};
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

void ContactIntervals::find_forces(const ContactPath& m, const ContactPast& past, const IntervalTable& of,
                                   IntervalForces& p) const {
  Components guess = m.force;
  for (int i = 0;; ++i) {
    p = {};
    find_normal_force(m, guess, of, p);
    if (friction_.active())
      find_friction(m, past, of, p);
    p.force = {p.axes.y(p.normal.force, p.friction.t), p.axes.z(p.normal.force, p.friction.t), p.friction.x};
    const double changed = sum_of_sizes(p.force - guess);
    if (of.apparent_mass * across_ * changed <= repeat_tolerance * sum_of_sizes(p.force) || i == most_repeats)
      return;
    guess = p.force;
  }
}

} // namespace fretwork::transient
