// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/reference_contact.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::bench {

using contact::Sym2;
using contact::Vec2;

namespace {

Vec2 scaled_to(Vec2 direction, double length) {
  const double size = norm(direction);
  return size > 0.0 ? (length / size) * direction : Vec2{};
}

/// (I + s A)^-1 b.
Vec2 solve(const Sym2& a, double s, Vec2 b) {
  const double xx = 1.0 + s * a.xx, tt = 1.0 + s * a.tt, xt = s * a.xt, det = xx * tt - xt * xt;
  return {(tt * b.x - xt * b.t) / det, (xx * b.t - xt * b.x) / det};
}

/// Perfect plasticity, by another formula than that of contact/friction_interval.cpp: tan(a/2) of the angle between a spring at its bound and what drives it falls as exp(-drive/bound).
Vec2 turned(Vec2 spring, Vec2 drive, double bound) {
  const double length = norm(drive), cross = spring.x * drive.t - spring.t * drive.x;
  if (!(length > 0.0 && bound > 0.0))
    return scaled_to(spring, bound);
  const double angle = std::atan2(cross, dot(spring, drive)),
               left = 2.0 * std::atan(std::tan(0.5 * angle) * std::exp(-length / bound));
  const Vec2 along = (bound / length) * drive;
  return {std::cos(left) * along.x + std::sin(left) * along.t,
          std::cos(left) * along.t - std::sin(left) * along.x};
}

Local operator+(Local a, Local b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Local operator*(const Response& r, Local f) {
  return {r[0] * f.x + r[1] * f.y + r[2] * f.z, r[3] * f.x + r[4] * f.y + r[5] * f.z,
          r[6] * f.x + r[7] * f.y + r[8] * f.z};
}

} // namespace

ReferenceContact::ReferenceContact(const contact::Support& support, double step)
    : support_(support), h_(step) {
  const contact::FrictionLaw& law = support_.friction;
  if (!(law.active() && law.damping > 0.0))
    return;
  const double a = law.stiffness * step / law.damping, mean = -std::expm1(-a) / a; // (1 - e)/A
  relaxation_ = std::exp(-a);
  by_last_ = a < 1e-4 ? a / 2 - a * a / 6 : 1.0 - mean;
  by_first_ = a < 1e-4 ? a / 2 - a * a / 3 : mean - relaxation_;
}

Vec2 ReferenceContact::tangential(Local v, double ny, double nz) const {
  const Vec2 along = support_.friction.along;
  return {along.x * v.x, along.t * (nz * v.y - ny * v.z)};
}

bool ReferenceContact::place(Local position) {
  now_ = position;
  const contact::Location at = contact::locate(support_.obstacle, position.y, position.z);
  gap_now_ = at.gap;
  ny_now_ = at.ny;
  nz_now_ = at.nz;
  return gap_now_ <= 0.0;
}

void ReferenceContact::start(Local velocity) {
  if (ny_ * ny_now_ + nz_ * nz_now_ < 0.0) { // the opposite face: the past is forgotten
    spring_ = force_ = {};
    closed_ = slides_ = false;
  }
  Vec2 dx;
  if (closed_) {
    const Local moved{now_.x - position_.x, now_.y - position_.y, now_.z - position_.z};
    dx = tangential(moved, 0.5 * (ny_ + ny_now_), 0.5 * (nz_ + nz_now_));
  } else { // closed since a share of the step
    const double share = gap_ > 0.0 ? gap_now_ / (gap_now_ - gap_) : 1.0;
    dx = (share * h_) * tangential(velocity, ny_now_, nz_now_);
  }
  loaded_ = spring_ - support_.friction.stiffness * dx;
  if (!closed_) {
    normal_ = 0.0;
    friction_ = {};
    friction_part_ = {};
  }
}

ReferenceContact::Friction ReferenceContact::friction(double normal, Vec2 free, const Sym2& response,
                                                      bool slid) const {
  const contact::FrictionLaw& law = support_.friction;
  const double bound = law.coefficient(slid) * normal, slip = law.mu_dynamic * normal;
  if (!(law.damping > 0.0)) {
    if (norm(loaded_) <= bound)
      return {loaded_, loaded_, false};
    const Vec2 force = slides_ && dot(loaded_, spring_) > 0.0 ? turned(spring_, loaded_ - spring_, slip)
                                                              : scaled_to(loaded_, slip);
    return {force, force, true};
  }
  // F = g (base - C_T v) in stick, v = free + response F
  const bool stuck = closed_ && !slides_;
  const Vec2 past = relaxation_ * spring_ + by_first_ * force_;
  const double g = stuck ? 1.0 : 1.0 / (1.0 - by_last_);
  const Vec2 base = stuck ? loaded_ : past;
  const Vec2 stick = solve(response, g * law.damping, g * (base - law.damping * free));
  if (norm(stick) <= bound)
    return {stick, stuck ? loaded_ : past + by_last_ * stick, false};
  const Vec2 velocity = free + response * friction_.force; // of the last sweep
  const Vec2 force = scaled_to((stuck ? loaded_ : past) - law.damping * velocity, slip);
  return {force, past + by_last_ * force, true};
}

Local ReferenceContact::force(Local free, const Response& r) {
  const contact::NormalLaw& law = support_.normal;
  const double ny = ny_now_, nz = nz_now_, p = -gap_now_;
  const double c = law.damping + law.stiffness * law.dissipation * p;
  const double nwn = ny * ny * r[4] + ny * nz * (r[5] + r[7]) + nz * nz * r[8];
  const Local moved = free + r * friction_part_;
  const double rate = -(ny * moved.y + nz * moved.z);
  normal_ = std::max(0.0, law.stiffness * p + c * rate) / (1.0 + c * nwn);
  Local out{0.0, normal_ * ny, normal_ * nz};
  if (!support_.friction.active())
    return out;
  const Vec2 along = support_.friction.along;
  const Sym2 tangent{along.x * r[0], along.x * along.t * (nz * r[1] - ny * r[2]),
                     along.t * (nz * nz * r[4] - ny * nz * (r[5] + r[7]) + ny * ny * r[8])};
  const Vec2 sliding_free = tangential(free + r * out, ny, nz);
  const bool slid =
      slides_ ||
      (!closed_ && support_.friction.slides_at_touch(law.damping * std::max(0.0, rate),
                                                     norm(support_.friction.trial(spring_, sliding_free))));
  friction_ = friction(normal_, sliding_free, tangent, slid);
  velocity_ = sliding_free + tangent * friction_.force;
  friction_part_ = {friction_.force.x, friction_.force.t * nz, -friction_.force.t * ny};
  return out + friction_part_;
}

void ReferenceContact::commit(bool in_window, double weight) {
  if (!(normal_ > 0.0)) { // p >= 0, but the damper would pull
    leave_open(1);
    return;
  }
  if (in_window) {
    impacts_ += closed_ ? 0 : 1;
    add(weight * h_);
  }
  closed_ = true;
  counted_ = in_window;
  slides_ = friction_.slides;
  spring_ = friction_.spring;
  force_ = friction_.force;
  normal_before_ = normal_;
  ny_ = ny_now_;
  nz_ = nz_now_;
  gap_ = gap_now_;
  position_ = now_;
}

/// N: the slider's force where the spring meets the bound, both linear over the step. Without tangential damper.
double ReferenceContact::slip_began() const {
  const contact::FrictionLaw& law = support_.friction;
  const double before = law.mu_static * normal_before_, after = law.mu_static * normal_;
  const double spare = before - norm(force_), missing = norm(loaded_) - after;
  return law.mu_dynamic / law.mu_static * (before + (after - before) * spare / (spare + missing));
}

void ReferenceContact::add(double h) {
  const contact::FrictionLaw& law = support_.friction;
  time_ += h;
  impulse_ += normal_ * h;
  squares_ += normal_ * normal_ * h;
  largest_ = std::max(largest_, normal_);
  if (!law.active())
    return;
  const double power = normal_ * norm(velocity_);
  tangential_power_ += power * h;
  if (!friction_.slides)
    return;
  work_ += power * h;
  sliding_ += h;
  const Vec2 force = friction_.force;
  if (law.damping > 0.0) {
    const Vec2 stretching = (1.0 / law.damping) * (friction_.spring - force);
    slider_ -= h * dot(force, velocity_ - stretching);
  } else { // -F.dz; F goes from where the slip begins to this one
    const double began = slides_ || !closed_ ? norm(force_) : slip_began();
    const Vec2 mean = slides_ ? 0.5 * (force_ + force) : (0.5 + 0.5 * began / norm(force)) * force;
    slider_ -= dot(mean, force - loaded_) / law.stiffness;
  }
}

void ReferenceContact::leave_open(std::int64_t steps) {
  const double kept = steps == 1 ? relaxation_ : std::pow(relaxation_, static_cast<double>(steps));
  if (const contact::FrictionLaw& law = support_.friction;
      closed_ && counted_ && law.active() &&
      !(law.damping > 0.0)) // the bound falls to 0: the slider takes the spring's energy
    slider_ += dot(force_, force_) / (2.0 * law.stiffness);
  spring_ = kept * spring_ + (closed_ && support_.friction.damping > 0.0 ? by_first_ : 0.0) * force_;
  force_ = {};
  closed_ = slides_ = false;
  gap_ = gap_now_;
}

ReferenceFigures ReferenceContact::figures(double length) const {
  ReferenceFigures out;
  out.work_rate = work_ / length;
  out.friction_power = slider_ / length;
  out.tangential_rate = tangential_power_ / length;
  out.normal_mean = impulse_ / length;
  out.normal_rms = std::sqrt(squares_ / length);
  out.normal_max = largest_;
  out.contact_time_ratio = time_ / length;
  out.sliding_time_ratio = sliding_ / length;
  out.impacts = impacts_;
  out.impact_rate = static_cast<double>(impacts_) / length;
  return out;
}

} // namespace fretwork::bench
