// SPDX-License-Identifier: GPL-3.0-or-later
#include "single_mass.hpp"
#include <cmath>
#include <numbers>
#include <random>

namespace fretwork::tests {

using contact::Vec2;

namespace {

struct State {
  Vec3 x, v;
  Vec2 spring;
};

struct Forces {
  Vec3 acceleration;
  double normal;
  Vec2 friction, spring_rate; ///< N, N/s; the rate not for C_T = 0
  double excess;              ///< N, of the trial over its bound: > 0 slides
};

Vec2 within(Vec2 v, double bound) {
  const double size = contact::norm(v);
  return size > bound ? (bound / size) * v : v;
}

double normal_of(const SingleMass& m, const State& s) {
  const double p = s.x.z() - m.gap;
  return p > 0.0 ? std::max(0.0, m.normal.stiffness * p + m.normal.damping * s.v.z()) : 0.0;
}

/// Of a step: what the trial exceeds its bound by is taken as linear. Without C_T a sliding contact starts at its bound, but for round-off.
double sliding_share(double before, double after, double bound) {
  constexpr double round_off = 1e-12;
  const bool from_start = before >= -round_off * bound;
  if (after > 0.0)
    return from_start ? 1.0 : after / (after - before);
  return before > 0.0 ? before / (before - after) : 0.0;
}

Forces forces(const SingleMass& m, double time, const State& s) {
  Forces f{};
  f.normal = normal_of(m, s);
  const Vec2 slip{s.v.x(), s.v.y()}, trial = s.spring - m.tangential_damping * slip;
  const double bound = m.mu * f.normal;
  f.excess = contact::norm(trial) - bound;
  f.friction = within(trial, bound);
  if (m.tangential_damping > 0.0)
    f.spring_rate = f.excess > 0.0
                        ? (-m.tangential_stiffness / m.tangential_damping) * (s.spring - f.friction)
                        : -m.tangential_stiffness * slip;
  for (int k = 0; k < 3; ++k) {
    const auto& load = m.load[static_cast<std::size_t>(k)];
    f.acceleration(k) =
        load.amplitude * std::sin(2.0 * std::numbers::pi * load.frequency * time + load.phase) -
        m.stiffness(k) * s.x(k) - m.damping(k) * s.v(k);
  }
  f.acceleration += Vec3(f.friction.x, f.friction.t, -f.normal);
  f.acceleration /= m.mass;
  return f;
}

} // namespace

transient::Scene scene_of(const SingleMass& m) {
  transient::Scene scene = mass_point(m.mass, m.stiffness, m.duration);
  scene.system.damping = m.damping / m.mass;
  start(scene, m.mass, Vec3::Zero(), m.velocity);
  scene.contacts = {contact_of(m.mass,
                               {contact::Stop{0.0, contact::PlaneAxis::z},
                                m.normal,
                                {m.tangential_stiffness, m.tangential_damping, m.mu, m.mu}},
                               Vec3(0.0, 0.0, -m.gap))};
  for (int k = 0; k < 3; ++k)
    if (const auto& load = m.load[static_cast<std::size_t>(k)]; load.amplitude != 0.0)
      scene.loads.push_back(force_on(m.mass, Vec3::Unit(k), load));
  return scene;
}

MassFigures integrate(const SingleMass& m, double step) {
  const auto steps = static_cast<std::int64_t>(std::ceil(m.duration / step));
  const double h = m.duration / static_cast<double>(steps);
  const bool plastic = m.tangential_damping == 0.0;
  MassFigures out;
  State s{Vec3::Zero(), m.velocity, {}};
  bool was_closed = false;
  for (std::int64_t i = 0; i < steps; ++i) {
    const double time = static_cast<double>(i) * h;
    const Forces a = forces(m, time, s);
    State guess{s.x + h * s.v, s.v + h * a.acceleration, s.spring + h * a.spring_rate};
    if (plastic)
      guess.spring = within(s.spring - (m.tangential_stiffness * h) * Vec2{s.v.x(), s.v.y()},
                            m.mu * normal_of(m, guess));
    const Forces b = forces(m, time + h, guess);
    const Vec3 speed = 0.5 * (s.v + guess.v);
    const State before = s;
    s.x += h * speed;
    s.v += 0.5 * h * (a.acceleration + b.acceleration);
    const Vec2 moved = h * Vec2{speed.x(), speed.y()};
    double end_excess = b.excess;
    if (plastic) {
      const Vec2 trial = s.spring - m.tangential_stiffness * moved;
      s.spring = within(trial, m.mu * normal_of(m, s));
      end_excess = contact::norm(trial) - m.mu * normal_of(m, s);
    } else {
      s.spring = s.spring + (0.5 * h) * (a.spring_rate + b.spring_rate);
    }
    const double normal = 0.5 * (a.normal + b.normal);
    const Vec2 friction = 0.5 * (a.friction + b.friction);
    if (const double share = sliding_share(a.excess, end_excess, m.mu * a.normal);
        normal > 0.0 && share > 0.0) {
      out.work_rate += share * normal * contact::norm(moved);
      out.friction_power -=
          contact::dot(friction, moved + (1.0 / m.tangential_stiffness) * (s.spring - before.spring));
    }
    out.normal_rms += h * normal * normal;
    out.normal_mean += h * normal;
    out.normal_max = std::max(out.normal_max, normal);
    out.tangential_rms += h * contact::dot(friction, friction);
    out.tangential_max = std::max(out.tangential_max, contact::norm(friction));
    out.contact_time_ratio += a.normal > 0.0 ? h : 0.0;
    out.impacts += a.normal > 0.0 && !was_closed;
    was_closed = a.normal > 0.0;
  }
  for (double* x : {&out.work_rate, &out.friction_power, &out.normal_rms, &out.normal_mean,
                    &out.tangential_rms, &out.contact_time_ratio})
    *x /= m.duration;
  out.normal_rms = std::sqrt(out.normal_rms);
  out.tangential_rms = std::sqrt(out.tangential_rms);
  return out;
}

SingleMass random_mass(unsigned seed, double damping) {
  std::mt19937_64 generator(seed);
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  const auto between = [&](double low, double high) { return low * std::pow(high / low, uniform()); };
  constexpr double two_pi = 2.0 * std::numbers::pi, swing = 1e-3; // m
  SingleMass m;
  m.mass = between(0.1, 2.0);
  const double w = two_pi * between(3.0, 12.0), contact = w * between(15.0, 60.0);
  for (int k = 0; k < 3; ++k)
    m.stiffness(k) = m.mass * w * w * (0.7 + 0.6 * uniform());
  m.damping.setConstant(2.0 * 0.05 * m.mass * w);
  m.normal.stiffness = m.mass * contact * contact;
  const bool damped = uniform() >= 0.4;
  m.normal.damping = damped ? 2.0 * 0.3 * uniform() * m.mass * contact : 0.0;
  m.tangential_stiffness = m.normal.stiffness * between(0.01, 1.0);
  m.mu = between(0.1, 1.0);
  m.tangential_damping = damping * std::sqrt(m.tangential_stiffness * m.mass);
  const bool pressed = uniform() < 0.4;
  for (std::size_t k = 0; k < 3; ++k)
    m.load[k] = {m.mass * w * w * swing * (0.5 + uniform()) * (k == 2 && pressed ? 0.3 : 1.5),
                 w / two_pi * (0.6 + uniform()), two_pi * uniform()};
  m.gap = pressed ? -swing * between(0.3, 2.0) : swing * 0.5 * uniform();
  m.duration = 5.0 * two_pi / w;
  return m;
}

MassFigures figures_of(const post::ContactSummary& s) {
  return {s.work_rate,     s.friction_power, s.normal_rms,         s.normal_mean,
          s.normal_max,    s.tangential_rms, s.contact_time_ratio, static_cast<int>(s.impacts),
          s.tangential_max};
}

} // namespace fretwork::tests
