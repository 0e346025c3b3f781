// SPDX-License-Identifier: GPL-3.0-or-later
#include "plain_schemes.hpp"
#include "contact/instant_spring.hpp"
#include "transient/oscillator.hpp"
#include <vector>

namespace fretwork::tests {

using namespace transient;
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
  /// What the spring of a sticking contact lacks of its displacement since the last action (contact_memory.hpp).
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

void flow(const System& system, double h, const Eigen::VectorXd& f0, const Eigen::VectorXd& f1,
          PlainState& s) {
  for (Eigen::Index i = 0; i < system.size(); ++i) {
    const auto c = step_coefficients(system.stiffness(i), system.damping(i), h);
    const double q = s.q(i), v = s.v(i);
    s.q(i) = c.qq * q + c.qv * v + c.qf0 * f0(i) + c.qf1 * f1(i);
    s.v(i) = c.vq * q + c.vv * v + c.vf0 * f0(i) + c.vf1 * f1(i);
  }
}

/// One pass over the shut contacts, each solved with all others held. `mean_velocity` follows the forces.
void sweep(std::vector<Point*>& shut, double h, Eigen::VectorXd& mean_velocity) {
  for (Point* p : shut) {
    const Eigen::MatrixXd& b = p->at.b;
    const Eigen::Matrix3d mobility = 0.5 * h * b * b.transpose();
    mean_velocity -= 0.5 * h * b.transpose() * p->force();
    // the normal force before the friction: the order of a block of the sweep
    const Vec3 tangential = p->force() - p->normal * p->n();
    const double rate = -p->n().dot(b * mean_velocity + mobility * tangential);
    p->normal = contact::NormalStep(p->spring, p->damping, p->n().dot(mobility * p->n())).force(rate);
    if (p->at.support.friction.active()) {
      const Vec3 free = b * mean_velocity + mobility * (p->normal * p->n());
      const Vec3 t = p->t();
      p->friction = contact::step_friction_plane(
          p->at.support.friction, p->table, p->memory, p->normal, {free.x(), free.dot(t)},
          {mobility(0, 0), Vec3::UnitX().dot(mobility * t), t.dot(mobility * t)});
    }
    mean_velocity += 0.5 * h * b.transpose() * p->force();
  }
}

} // namespace

PlainState plain_splitting(const Scene& scene, double h, int steps) {
  constexpr int sweeps = 200; // far past convergence
  const auto signals = signals_of(scene);
  auto points = points_of(scene, h);
  PlainState s{scene.q0, scene.v0};
  for (Point& p : points)
    p.last = p.at.b * s.q;
  Eigen::VectorXd pushed = Eigen::VectorXd::Zero(scene.system.size()); // by the contacts of the last step
  double time = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double next = (k + 0.5) * h;
    flow(scene.system, k == 0 ? 0.5 * h : h, load(scene, signals, time), load(scene, signals, next), s);
    time = next;
    std::vector<Point*> shut;
    for (Point& p : points) {
      p.follow(p.at.b * s.q, p.at.b * s.v, h);
      p.was_closed = false;
      const contact::NormalLaw& law = p.at.support.normal;
      const double depth = p.locate(p.at.b * s.q), rate = -p.n().dot(p.at.b * s.v);
      const double closed = contact::closed_share(depth - 0.5 * h * rate, depth + 0.5 * h * rate);
      const double mobility = 0.5 * h * (p.at.b.transpose() * p.n()).squaredNorm();
      p.spring = depth > 0.0 ? contact::InstantSpring(law.stiffness, mobility, h)
                                   .push(depth, -p.n().dot(p.at.b * s.q - p.last) / h, rate)
                                   .force
                             : 0.0;
      p.last = p.at.b * s.q;
      p.damping = (law.damping > 0.0 ? closed * law.damping : 0.0) + law.dissipation * p.spring;
      p.normal = 0.0;
      p.friction = {};
      if (depth > 0.0 || p.damping > 0.0) {
        p.turn_memory();
        shut.push_back(&p);
      } else {
        p.open();
      }
    }
    Eigen::VectorXd mean_velocity = s.v;
    for (int i = 0; i < sweeps; ++i)
      sweep(shut, h, mean_velocity);
    const PlainState before = s;
    pushed.setZero();
    for (Point* p : shut) {
      if (p->normal > 0.0) {
        Vec3 w = p->at.b * mean_velocity;
        const Vec3 push = p->normal * p->n();
        if (p->friction.slides && !p->push.isZero(0.0)) // sliding_paths.hpp
          w -= h / 6.0 * p->at.b * p->at.b.transpose() * (push - p->push);
        ++s.closed;
        s.slid += p->friction.slides;
        if (p->at.support.friction.active())
          s.friction_work += p->commit({h * w.x(), h * w.dot(p->t())});
        p->was_closed = true;
        p->stood = p->at.b * before.q;
        p->left_at = p->at.b * before.v;
        p->last_dx = h * p->tangential(w);
      } else {
        p->open();
      }
      pushed += p->at.b.transpose() * p->force();
    }
    s.v += h * pushed;
    for (Point& p : points)
      p.push = p.normal * p.n();
  }
  s.q += h * h / 12.0 * pushed; // the mean over the step
  return s;
}

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
        continue;
      }
      ++s.closed;
      if (p.at.support.friction.active()) {
        p.turn_memory();
        const Vec2 v{w.x(), w.dot(p.t())};
        p.friction = contact::evaluate(p.at.support.friction, p.memory, p.normal, h * v, v);
        s.slid += p.friction.slides;
        s.friction_work += p.commit(h * v);
      }
      f += p.at.b.transpose() * p.force();
    }
    s.v += h * f;
    s.q += h * s.v;
  }
  return s;
}

} // namespace fretwork::tests
