// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/friction_law.hpp"
#include <algorithm>

namespace fretwork::contact {

namespace {

/// Beyond this count Newton's method on the bound has long converged (it is monotone and quadratic; 4 to 6
/// are usual).
constexpr int most_iterations = 50;
constexpr double one_line =
    1e-12; ///< det A / trace^2 below which the node moves along one line only: round-off of W
constexpr double bound_tolerance = 1e-14; ///< relative: |F| meets the bound to round-off

/// Solves (M + s I) f = b, M + s I symmetric positive definite.
Vec2 solve(const Mobility& m, double s, Vec2 b) {
  const double xx = m.xx + s, tt = m.tt + s;
  const double det = xx * tt - m.xt * m.xt;
  return {(tt * b.x - m.xt * b.t) / det, (xx * b.t - m.xt * b.x) / det};
}

Vec2 scaled_to(Vec2 direction, double length) {
  const double size = norm(direction);
  return size > 0.0 ? (length / size) * direction : Vec2{};
}

/// The slip force of `reference`: opposite to the velocity v = free_velocity + A F it leaves, or the smaller
/// one that makes v zero.
Vec2 opposing(double length, const Mobility& a, Vec2 free_velocity) {
  const double speed = norm(free_velocity), trace = a.xx + a.tt;
  if (a.xx * a.tt - a.xt * a.xt > one_line * trace * trace) {
    const Vec2 stopping = solve(a, 0.0, -1.0 * free_velocity);
    return norm(stopping) <= length ? stopping : force_of_length(length, a, -1.0 * free_velocity);
  }
  const Vec2 along = (-1.0 / speed) * free_velocity; // the line the node moves on
  const double mobility =
      along.x * along.x * a.xx + 2.0 * along.x * along.t * a.xt + along.t * along.t * a.tt;
  return (speed < mobility * length ? speed / mobility : length) * along;
}

} // namespace

/// The f of given length with (M + s I) f = b for some s >= 0 (0 where even s = 0 leaves |f| below it: then
/// along b). Newton on 1/|f(s)| - 1/length, with d|f|/ds = -f.(M + s I)^-1 f / |f|: it rises to the root
/// without passing it.
Vec2 force_of_length(double length, const Mobility& m, Vec2 b) {
  // |b|/length - trace(M) is below the root: a start where M + s I is regular even if M is singular (a node
  // that cannot move)
  double s = std::max(0.0, norm(b) / length - m.xx - m.tt);
  if (!((m.xx + s) * (m.tt + s) - m.xt * m.xt > 0.0))
    return scaled_to(b, length);
  Vec2 f = solve(m, s, b);
  for (int i = 0; i < most_iterations; ++i) {
    const double size = norm(f);
    const double next = s + size * size / dot(f, solve(m, s, f)) * (size / length - 1.0);
    if (size - length <= bound_tolerance * length || !(next > s))
      break;
    s = next;
    f = solve(m, s, b);
  }
  return scaled_to(f, length);
}

Friction evaluate(const FrictionLaw& law, const FrictionMemory& memory, double normal_force, Vec2 dx,
                  Vec2 velocity) {
  dx = law.masked(dx);
  velocity = law.masked(velocity);
  const Vec2 trial = law.trial(memory.spring - law.stiffness * dx, velocity);
  const auto [force, slides] = law.bounded(trial, law.coefficient(memory.sliding), normal_force);
  if (slides && law.kind == FrictionMemoryKind::reference && norm(velocity) > 0.0)
    return {scaled_to(velocity, -law.mu_dynamic * normal_force), true};
  return {force, slides};
}

FrictionTable friction_table(const FrictionLaw& law, double h) {
  return {0.5 * law.stiffness * h + law.damping,
          law.damping > 0.0 ? std::exp(-law.stiffness * h / law.damping) : 0.0,
          law.stiffness > 0.0 ? 1.0 / law.stiffness : 0.0};
}

FrictionStep close_step(const FrictionLaw& law, const FrictionTable& table, const FrictionMemory& memory,
                        Friction friction, Vec2 dx) {
  dx = law.masked(dx);
  const auto [force, slides] = friction;
  FrictionStep step;
  step.memory.sliding = slides;
  const Vec2 before = memory.spring;
  Vec2 after = before - law.stiffness * dx;
  Vec2 stretch = dx; // of the spring and damper; the slider takes the rest
  if (slides &&
      law.kind ==
          FrictionMemoryKind::reference) { // the spring is set, whatever it held; all motion is sliding
    after = force;
    stretch = {};
    step.slip = dx;
  } else if (slides) {
    const Vec2 relaxed = force + table.relaxation * (before - force);
    const Vec2 relaxed_stretch = table.compliance * (before - relaxed);
    // A slider that would move with the force did not move: the bound only clipped a spring that was letting
    // go by itself. Without a force (mu_d = 0) it moves freely.
    if (dot(force, dx - relaxed_stretch) < 0.0 || dot(force, force) == 0.0) {
      after = relaxed;
      stretch = relaxed_stretch;
      step.slip = dx - stretch;
    }
  }
  step.friction_work = -dot(force, step.slip);
  step.memory.spring = after;
  step.stored = law.spring_energy(after) - law.spring_energy(before);
  step.damper_work = -dot(force, stretch) - step.stored;
  return step;
}

FrictionStep open_step(const FrictionLaw& law, const FrictionTable& table, const FrictionMemory& memory) {
  FrictionStep step;
  step.memory.spring = (law.kind == FrictionMemoryKind::return_map ? table.relaxation : 0.0) * memory.spring;
  step.stored = law.spring_energy(step.memory.spring) - law.spring_energy(memory.spring);
  step.damper_work = -step.stored;
  return step;
}

Friction step_friction_plane(const FrictionLaw& law, const FrictionTable& table, const FrictionMemory& memory,
                             double normal_force, Vec2 free_velocity, const Mobility& mobility) {
  const double gh = table.gradient;
  const Mobility a = law.masked(mobility);
  free_velocity = law.masked(free_velocity);
  const Mobility m{1.0 + gh * a.xx, gh * a.xt, 1.0 + gh * a.tt};
  const Vec2 b = memory.spring - gh * free_velocity;
  const Vec2 stick = solve(m, 0.0, b);
  const double bound = law.coefficient(memory.sliding) * normal_force;
  if (norm(stick) <= bound)
    return {stick, false};
  const double slip_bound = law.mu_dynamic * normal_force;
  if (!(slip_bound > 0.0))
    return {{}, true};
  if (law.kind == FrictionMemoryKind::reference && norm(free_velocity) > 0.0)
    return {opposing(slip_bound, a, free_velocity), true};
  return {force_of_length(slip_bound, m, b), true};
}

Friction step_friction_line(const FrictionLaw& law, const FrictionTable& table, const FrictionMemory& memory,
                            double normal_force, double free_velocity, double mobility) {
  const double gradient = law.along.t * table.gradient;
  const double stick = (memory.spring.t - gradient * free_velocity) / (1.0 + gradient * mobility);
  if (std::abs(stick) <= law.coefficient(memory.sliding) * normal_force)
    return {{0.0, stick}, false};
  const double bound = law.mu_dynamic * normal_force;
  if (law.kind != FrictionMemoryKind::reference || free_velocity == 0.0)
    return {{0.0, std::copysign(bound, stick)}, true};
  const double speed = std::abs(free_velocity); // over the mobility: what brings the node to rest
  return {{0.0, std::copysign(speed < mobility * bound ? speed / mobility : bound, -free_velocity)}, true};
}

} // namespace fretwork::contact
