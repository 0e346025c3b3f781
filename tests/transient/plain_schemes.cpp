// SPDX-License-Identifier: GPL-3.0-or-later
#include "plain_schemes.hpp"
#include "contact/normal_law.hpp"
#include "vibration/oscillator.hpp"
#include <vector>

namespace fretwork::tests {

using namespace signals;
using namespace transient;
using namespace vibration;
using contact::Vec2;
using core::Vec3;

namespace {

/// One contact with its axes and memory.
struct Point {
  const ContactPoint& at;
  contact::FrictionTable table;
  contact::FrictionMemory memory{};
  double ny = 0.0, nz = 0.0; ///< normal now
  double last_ny = 0.0, last_nz = 0.0;
  double spring = 0.0, damping = 0.0, normal = 0.0;
  Vec3 push = Vec3::Zero(); ///< F_N n at the last step
  Vec3 last = Vec3::Zero(); ///< displacement at the last action
  contact::Friction friction{};
  bool was_closed = false;                           ///< at the last action, and then:
  Vec3 stood = Vec3::Zero(), left_at = Vec3::Zero(); ///< displacement, velocity before it
  Vec2 last_dx{};

  [[nodiscard]] Vec3 n() const { return {0.0, ny, nz}; }
  [[nodiscard]] Vec3 t() const { return {0.0, nz, -ny}; }
  [[nodiscard]] Vec3 force() const {
    return normal * n() + friction.force.t * t() + friction.force.x * Vec3::UnitX();
  }
  /// Finds the place; the memory of the opposite face is not that of this one.
  double locate(const Vec3& u) {
    const auto place = contact::locate(at.support.obstacle, u.y() + at.rest.y(), u.z() + at.rest.z());
    ny = place.ny;
    nz = place.nz;
    return -place.gap;
  }
  void turn_memory() {
    if (last_ny * ny + last_nz * nz < 0.0)
      memory = {};
  }
  double commit(Vec2 dx) {
    const auto step = contact::close_step(at.support.friction, table, memory, friction, dx);
    memory = step.memory;
    last_ny = ny;
    last_nz = nz;
    return step.friction_work;
  }
  /// Along x_loc and t of the last commit, as far as friction acts along it.
  [[nodiscard]] Vec2 tangential(const Vec3& u) const {
    const Vec2 along = at.support.friction.along;
    return {along.x * u.x(), along.t * (last_nz * u.y() - last_ny * u.z())};
  }
  /// What the spring of a sticking contact lacks of its displacement since the last action.
  void follow(const Vec3& u, const Vec3& v, double h) {
    if (!was_closed || !at.support.friction.active() || memory.sliding)
      return;
    const Vec2 e =
        tangential(u - stood) - (last_dx - 0.5 * h * tangential(left_at)) - 0.5 * h * tangential(v);
    memory.spring = memory.spring - at.support.friction.stiffness * e;
  }
  void open() { memory = contact::open_step(at.support.friction, table, memory).memory; }
};

Eigen::VectorXd load(const Scene& scene, const std::vector<Signal>& signals, double time) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(scene.system.size());
  for (std::size_t i = 0; i < signals.size(); ++i)
    f += signals[i](time) * scene.loads[i].modal_force;
  return f;
}

std::vector<Signal> signals_of(const Scene& scene) {
  std::vector<Signal> out;
  for (const Load& l : scene.loads)
    out.emplace_back(l.function, scene.duration);
  return out;
}

std::vector<Point> points_of(const Scene& scene, double h) {
  std::vector<Point> out;
  for (const ContactPoint& c : scene.contacts)
    out.push_back({c, contact::friction_table(c.support.friction, h)});
  return out;
}

} // namespace

PlainState plain_euler(const Scene& scene, double h, int steps) {
  const auto signals = signals_of(scene);
  auto points = points_of(scene, h);
  PlainState s{scene.q0, scene.v0};
  for (int k = 0; k < steps; ++k) {
    Eigen::VectorXd f = load(scene, signals, k * h) -
                        Eigen::VectorXd(scene.system.stiffness.cwiseProduct(s.q)) -
                        Eigen::VectorXd(scene.system.damping.cwiseProduct(s.v));
    for (Point& p : points) {
      const Vec3 w = p.at.b * s.v;
      const double depth = p.locate(p.at.b * s.q);
      p.friction = {};
      p.normal = contact::normal_force(p.at.support.normal, depth, -p.n().dot(w));
      if (!(p.normal > 0.0)) {
        p.open();
        p.was_closed = false;
        continue;
      }
      ++s.closed;
      if (p.at.support.friction.active()) {
        p.turn_memory();
        const Vec2 v{w.x(), w.dot(p.t())};
        const double deeper =
            -h * p.n().dot(w); // m, in the step; its spring follows the node from the touch on
        const bool damped = p.at.support.friction.damping > 0.0;
        const Vec2 dx = (damped || p.was_closed || !(deeper > depth) ? h : h * depth / deeper) * v;
        p.friction = contact::evaluate(p.at.support.friction, p.memory, p.normal, dx, v);
        s.slid += p.friction.slides;
        s.friction_work += p.commit(dx);
      }
      p.was_closed = true;
      f += p.at.b.transpose() * p.force();
    }
    s.v += h * f;
    s.q += h * s.v;
  }
  return s;
}

} // namespace fretwork::tests
