// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/conserving/conserving_friction.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

using contact::FrictionLaw;
using contact::Sym2;
using contact::Vec2;

/// s (I - e e^T), masked.
Sym2 across(const FrictionLaw& law, Vec2 e, double s) {
  return {s * law.along.x * e.t * e.t, -s * law.along.x * law.along.t * e.x * e.t,
          s * law.along.t * e.x * e.x};
}

Vec2 times(const Sym2& m, Vec2 v) { return {m.xx * v.x + m.xt * v.t, m.xt * v.x + m.tt * v.t}; }

/// exp(-share K_T h/C_T): what is left of an open contact's spring after a share of the step.
double left_after(const FrictionLaw& law, double h, double share) {
  if (!(share > 0.0))
    return 1.0;
  return law.damping > 0.0 ? std::exp(-share * law.stiffness * h / law.damping) : 0.0;
}

/// g: weight of the force at the end of the closed part, k = K_T/C_T times its length, r = exp(-k).
double end_weight(double k, double r) {
  constexpr double small = 0.03; // its series then has 1e-10 of itself, the difference 1e-12
  return k < small ? k * k / 6.0 * (1.0 - 0.5 * k + 3.0 / 20.0 * k * k) : 1.0 + r - 2.0 * (1.0 - r) / k;
}

/// Direction of the force of C_T = 0 at the end of a motion that by itself would change the spring by `push`: inside the bound
/// straight, then along it.
Vec2 end_direction(Vec2 spring, Vec2 push, double bound) {
  const double length = norm(spring), way = norm(push);
  if (!(way > 0.0) || !(bound > 0.0))
    return length > 0.0 ? (1.0 / length) * spring : Vec2{};
  const Vec2 from = length > bound ? (bound / length) * spring : spring, d = (1.0 / way) * push;
  const double along = dot(from, d), aside = from.x * d.t - from.t * d.x;
  const double inside = std::max(0.0, std::sqrt(std::max(0.0, bound * bound - aside * aside)) - along);
  if (inside >= way) {
    const Vec2 end = from + push;
    const double size = norm(end);
    return size > 0.0 ? (1.0 / size) * end : Vec2{};
  }
  const double sine = std::clamp(aside / bound, -1.0, 1.0), cosine = std::sqrt(1.0 - sine * sine);
  const double half = sine / (1.0 + cosine) * std::exp(-(way - inside) / bound); // tan(phi_1/2)
  const double scale = 1.0 / (1.0 + half * half), c = (1.0 - half * half) * scale, s = 2.0 * half * scale;
  return {c * d.x + s * d.t, c * d.t - s * d.x};
}

/// Share of the closed part in which the friction is at its bound: what the trial exceeds it by is taken as linear.
/// @param slid  before the step: the trial starts at its bound or above
double sliding_share(double at_start, double at_end, bool slid, bool slides) {
  if (at_end > 0.0 && (at_start > 0.0 || (slid && slides)))
    return 1.0;
  if (at_start > 0.0 || at_end > 0.0)
    return std::max(at_start, at_end) / std::abs(at_end - at_start);
  return slides ? 1.0 : 0.0;
}

} // namespace

StepFriction along_trial(const FrictionLaw& law, Vec2 spring, double coefficient, double normal, Vec2 dx,
                         double h, ClosedPart part) {
  const double s = part.share, bound = coefficient * normal;
  const double left = part.starts_open ? left_after(law, h, 1.0 - s) : 1.0;
  const Vec2 start = left * spring;
  dx = law.masked(dx);
  const double gradient = s * (0.5 * s * law.stiffness + law.damping / h);
  const Vec2 w = s * start - gradient * dx;
  Vec2 by_share = start - (s * law.stiffness + law.damping / h) * dx;
  if (part.starts_open && law.damping > 0.0)
    by_share = by_share + (s * law.stiffness * h / law.damping) * start;
  const double size = norm(w);
  if (size <= bound)
    return {w, {-gradient * law.along.x, 0.0, -gradient * law.along.t}, {}, {}, by_share, false};
  const Vec2 e = (1.0 / size) * w;
  const Sym2 turn = across(law, e, bound / size);
  return {bound * e,
          {-gradient * turn.xx, -gradient * turn.xt, -gradient * turn.tt},
          coefficient * e,
          {},
          times(turn, by_share),
          true};
}

StepFriction opposing(const FrictionLaw& law, double rho, double normal, Vec2 dx, Vec2 force) {
  const double bound = law.mu_dynamic * normal;
  const Vec2 z{law.along.x * (force.x - rho * dx.x), law.along.t * (force.t - rho * dx.t)};
  const double size = contact::norm(z);
  if (size <= bound)
    return {z, {-rho * law.along.x, 0.0, -rho * law.along.t}, {}, {law.along.x, 0.0, law.along.t}, {}, true};
  const Vec2 e = (1.0 / size) * z;
  const Sym2 turn = across(law, e, bound / size);
  return {bound * e, {-rho * turn.xx, -rho * turn.xt, -rho * turn.tt}, law.mu_dynamic * e, turn, {}, true};
}

ClosedStep close_part(const FrictionLaw& law, const contact::FrictionMemory& memory,
                      contact::Friction friction, double normal, double end_normal, Vec2 dx, double h,
                      ClosedPart part) {
  const double s = part.share, stiffness = law.stiffness;
  const double open = part.starts_open ? left_after(law, h, 1.0 - s) : 1.0;
  const double after = part.starts_open ? 1.0 : left_after(law, h, 1.0 - s);
  const Vec2 start = open * memory.spring, force = (1.0 / s) * friction.force;
  dx = s * law.masked(dx);
  const double left = left_after(law, h, s);
  const double weight = law.damping > 0.0 ? end_weight(s * stiffness * h / law.damping, left) : 1.0;

  const Vec2 stuck = start - stiffness * dx, damped = (law.damping / (s * h)) * dx;
  Vec2 end = stuck;
  bool rests = !friction.slides;
  if (friction.slides) {
    const double bound = norm(force);
    const Vec2 end_force =
        law.mu_dynamic * end_normal * end_direction(start - damped, -stiffness * dx, bound);
    end = (1.0 - left) * force + left * start + weight * (end_force - force);
    const Vec2 slip = dx - (1.0 / stiffness) * (start - end);
    if (!(dot(force, slip) < 0.0 || bound == 0.0)) {
      end = stuck;
      rests = true;
    }
  }
  const bool slid = memory.sliding || part.slides_at_touch;
  const double coefficient = law.coefficient(slid);
  const double end_bound = coefficient * end_normal, held = norm(end);
  const bool cut = rests && held > end_bound;
  if (cut)
    end = (1.0 - weight * (1.0 - end_bound / held)) * end;

  ClosedStep out;
  const double work = -dot(force, dx), before = law.spring_energy(memory.spring),
               held_at_start = law.spring_energy(start);
  double loss = work - (law.spring_energy(end) - held_at_start);
  if (friction.slides && loss < 0.0) { // the spring cannot hold more than that
    const double most = held_at_start + work;
    end = std::sqrt(std::max(0.0, most) / law.spring_energy(end)) * end;
    loss = work - (law.spring_energy(end) - held_at_start);
  }
  const double slider = -dot(force, dx - (1.0 / stiffness) * (start - end));
  const bool stuck_before = !memory.sliding && !part.starts_open;
  const double at_onset = friction.slides && stuck_before ? law.damper_work_at_slip_onset(normal / s) : 0.0;
  if (rests && !cut) // the slider stands
    out.friction_work = 0.0;
  else
    out.friction_work = std::max(0.0, law.damping > 0.0 ? std::min(slider, loss) : loss - at_onset);
  out.damper_work = loss - out.friction_work;
  out.spring = after * end;
  const double after_all = law.spring_energy(out.spring);
  out.given_up = (before - held_at_start) + (law.spring_energy(end) - after_all);
  out.stored = after_all - before;

  const double bound = coefficient * normal / s;
  out.slid = norm(dx) * sliding_share(norm(start - damped) - std::max(0.0, 2.0 * bound - end_bound),
                                      norm(stuck - damped) - end_bound, slid, friction.slides);
  return out;
}

} // namespace fretwork::transient
