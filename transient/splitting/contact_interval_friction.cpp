// SPDX-License-Identifier: GPL-3.0-or-later
// The friction of a contact over an interval, under the normal force found.
#include "transient/splitting/contact_interval_motion.hpp"
#include <algorithm>
#include <type_traits>

namespace fretwork::transient {
namespace {

using contact::dot;
using contact::norm;
using contact::Vec2;

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

/// Of a piece of normal force: the mean and, by the law, the ends. `reference` has one force in the interval.   @param start  memory there
template <class V, class Friction>
void ContactIntervals::set_friction(ForcePiece& piece, const contact::FrictionMemory& start,
                                    const Friction& f, V velocity) const {
  const double acts = (piece.to - piece.from) * h_, mean = norm(f.impulse) / acts;
  const auto within = [&](double normal, bool sliding, double force) {
    return std::min(friction_.coefficient(sliding) * normal, force);
  };
  if (friction_.kind == contact::FrictionMemoryKind::reference) {
    piece.friction = {within(piece.normal.first, false, mean), within(piece.normal.last, false, mean), mean};
  } else {
    V spring;
    if constexpr (std::is_same_v<V, double>)
      spring = start.spring.t;
    else
      spring = start.spring;
    piece.friction = {within(piece.normal.first, start.sliding, norm(friction_.trial(spring, velocity))),
                      within(piece.normal.last, f.sliding, norm(friction_.trial(f.spring, f.velocity))),
                      mean};
  }
  piece.friction_peak = f.at_changes > 0.0 || friction_.kind == contact::FrictionMemoryKind::reference
                            ? std::max({piece.friction.first, piece.friction.last, mean, f.at_changes})
                            : piece.friction.largest();
}

/// Its friction over an interval.   @param f  a FrictionInterval<V>   @param path  a TangentialPath<V, M>
template <class Path, class Friction>
void ContactIntervals::add_friction(const Motion& a, const NormalForce& n, const IntervalTable& table,
                                    const Friction& f, const Path& path, MovingContact& m) const {
  using V = decltype(path.velocity);
  ContactState& state = m.course.state;
  const double dt = table.length, length = n.to - n.from;
  const V mean = (1.0 / length) * f.impulse, growth = (12.0 / (length * length)) * f.moment;
  const Vec2 force = in_plane(V((1.0 / dt) * f.impulse));
  set_friction(m.piece, m.course.past.friction, f, path.velocity);
  m.force = along(a.axes, n.force, force);
  m.growth = along(a.axes, n.growth,
                   (12.0 / (dt * dt)) * in_plane(V(f.moment + (n.from + 0.5 * (length - dt)) * f.impulse)));
  // what goes into the element and is neither stored nor taken by the slider
  state.damper_work +=
      friction_.spring_energy(m.course.past.friction.spring) - friction_.spring_energy(f.spring) -
      f.slider_work - dot(mean, f.displacement) -
      dot(growth, V((length / 12.0) * V(f.velocity - path.velocity) - path.lift_under(mean, growth)));
  state.friction = state.friction + table.share * force;
  state.friction_peak = std::max(state.friction_peak, m.piece.friction_peak);
  state.friction_square += length / h_ * (dot(mean, mean) + dot(growth, growth) / 12.0);
  state.displacement = state.displacement + in_plane(f.displacement);
  state.slid += f.slid;
  state.wear_work += f.wear_work;
  state.friction_work += f.slider_work;
  state.sliding += f.sliding_time / h_;
  state.slides = f.sliding_time > 0.0;
  m.course.past.friction = {in_plane(f.spring), f.sliding};
}

void ContactIntervals::find_friction(Passage passage, const Motion& a, const NormalForce& n,
                                     const IntervalTable& table, MovingContact& m) const {
  const double dt = table.length, length = n.to - n.from;
  const bool by_reference = friction_.kind == contact::FrictionMemoryKind::reference;
  ContactState& state = m.course.state;
  contact::FrictionMemory& memory = m.course.past.friction;
  const double before = friction_.spring_energy(memory.spring);
  if (m.course.past.axes.opposite(a.axes)) // another surface
    memory = {};
  else if (touches(passage) && n.from > 0.0)
    memory = {by_reference ? Vec2{} : contact::spring_left(friction_, n.from) * memory.spring, false};
  state.damper_work += before - friction_.spring_energy(memory.spring);
  // along t and x, at the start: doc/schemes.md, (S11) and (S12), with the normal force linear in time
  const double from = by_reference ? 0.0 : n.from; // it knows no parts of an interval
  const double tau = from - 0.5 * dt;
  const double force_dot = n.growth / dt, force = n.force + tau * force_dot;
  const Components velocity = a.velocity + from * (a.acceleration + (0.5 * (from - dt)) * a.jerk);
  const Components acceleration = a.acceleration + tau * a.jerk;
  const contact::ContactAxes& axes = a.axes;
  const Components by_t = table.w * Components{axes.nz, -axes.ny, 0.0};
  // Y, L and S while it acts: those by its normal force in place of what was expected of it
  const double share = by_reference ? 1.0 : length / dt, fourth = contact::fourth_power(share);
  const Mobility compliance = fourth * table.compliance;
  const Components compliance_by_t = compliance * Components{axes.nz, -axes.ny, 0.0};
  const Components by_normal_growth = (fourth * share * n.growth) * a.compliance_by_normal;
  const Components shift = fourth * m.others_lift_growth + by_normal_growth;
  const Components lift = fourth * a.lift - compliance * a.expected +
                          (fourth * n.force / share) * a.compliance_by_normal - 0.625 * by_normal_growth;
  const double wtt = tangent(axes, by_t), wtn = tangent(axes, a.by_normal), wnn = a.mobility;
  double vt = tangent(axes, velocity), at = tangent(axes, acceleration) + wtn * force,
         jt = tangent(axes, a.jerk) + wtn * force_dot;
  const auto& [turns, omega, omega_dot, delta] = a.turn;
  const double turned = omega * tau; // rad
  if (turns) {
    const double theta = turned + 0.5 * tau * tau * omega_dot - delta;    // rad
    const double free = normal(axes, a.acceleration);                     // m/s2, without the normal force
    const double vn = -(a.rate + from * a.acceleration_inwards);          // m/s
    const double acting = by_reference ? n.force : n.force * dt / length; // N, mean while it acts
    const double vn_dot = wnn * acting - a.acceleration_inwards;          // m/s2
    vt -= 0.5 * turned * turned * vt + theta * normal(axes, velocity);
    at += turned * ((wtt - wnn) * force - free) - (omega + omega_dot * tau) * vn;
    jt += omega * ((wtt - wnn) * n.force - free - vn_dot) - omega_dot * (vn - tau * vn_dot);
  }
  if (in_plane_ || by_reference) {
    const double ax = acceleration.x + a.by_normal.x * force + turned * by_t.x * force,
                 jx = a.jerk.x + a.by_normal.x * force_dot + omega * by_t.x * n.force;
    const contact::TangentialPath<Vec2, contact::Sym2> path{
        friction_.masked(Vec2{in_plane_ ? velocity.x : 0.0, vt}),
        friction_.masked(Vec2{in_plane_ ? ax : 0.0, at}),
        friction_.masked(Vec2{in_plane_ ? jx : 0.0, jt}),
        friction_.masked(in_plane_ ? contact::Sym2{table.w(2, 2), by_t.x, wtt}
                                   : contact::Sym2{0.0, 0.0, wtt}),
        friction_.masked(Vec2{in_plane_ ? lift.x : 0.0, tangent(axes, lift)}),
        friction_.masked(
            in_plane_ ? contact::Sym2{compliance(2, 2), compliance_by_t.x, tangent(axes, compliance_by_t)}
                      : contact::Sym2{0.0, 0.0, tangent(axes, compliance_by_t)}),
        friction_.masked(Vec2{in_plane_ ? shift.x : 0.0, tangent(axes, shift)})};
    if (by_reference) {
      NormalForce whole = n;
      whole.from = 0.0;
      whole.to = dt;
      add_friction(a, whole, table, reference_friction(friction_, table.reference, memory, n.force, dt, path),
                   path, m);
    } else {
      add_friction(a, n, table,
                   contact::friction_over_interval(friction_, table.pieces, table.friction_mobility,
                                                   memory.spring, memory.sliding, length, n.course, path),
                   path, m);
    }
  } else {
    const contact::TangentialPath<double, double> path{friction_.along.t * vt,
                                                       friction_.along.t * at,
                                                       friction_.along.t * jt,
                                                       friction_.along.t * wtt,
                                                       friction_.along.t * tangent(axes, lift),
                                                       friction_.along.t * tangent(axes, compliance_by_t),
                                                       friction_.along.t * tangent(axes, shift)};
    add_friction(a, n, table,
                 contact::friction_over_interval(friction_, table.pieces, table.friction_mobility,
                                                 memory.spring.t, memory.sliding, length, n.course, path),
                 path, m);
  }
  m.course.past.spring_at_opening = dot(memory.spring, memory.spring);
  if (n.opens)
    state.damper_work += relax_to(m.course.past, spring_left(dt - n.to));
}

} // namespace fretwork::transient
