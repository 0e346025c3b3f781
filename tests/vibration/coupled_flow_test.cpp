// SPDX-License-Identifier: GPL-3.0-or-later
// Modes that a damping matrix couples move exactly. Modes of equal stiffness are the reference: turned to the principal axes of the
// damping matrix they are oscillators of their own.
#include "vibration/coupled_flow.hpp"
#include "vibration/diagonal_flow.hpp"
#include "vibration/oscillator.hpp"
#include "vibration/polynomial_flow.hpp"
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace coupled_flow_test {

using namespace fretwork;
using namespace fretwork::vibration;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double h = 0.01;
constexpr double round_off =
    1e-12; // of the state: fifteen doublings, and the turned matrix holds a damping 1e4 times below its largest to 1e-12

/// Axes that couple all three.
Matrix3d turned() { return Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).toRotationMatrix(); }

/// Three oscillators of stiffness k and dampings c, seen in turned axes.
struct Turned {
  double k;
  Vector3d c;
  const char* name;
  [[nodiscard]] System system() const {
    System s;
    s.stiffness = Vector3d::Constant(k);
    s.damping_matrix = turned() * c.asDiagonal() * turned().transpose();
    s.damping = s.damping_matrix.diagonal();
    return s;
  }
};

const std::array<Turned, 5> regimes = {{{1e4, {1.0, 20.0, 150.0}, "underdamped"},
                                        {1e4, {200.0, 2000.0, 2e6}, "critical and overdamped"},
                                        {4e6, {10.0, 0.0, 1e3}, "many radians a step"},
                                        {0.0, {0.0, 3.0, 5e4}, "rigid"},
                                        {1e-3, {1e-6, 0.0, 1.0}, "slow"}}};

struct Motion {
  Vector3d q, v;
  double work;
};

const Vector3d q0(0.1, -0.2, 0.3), v0(5.0, 1.0, -2.0), f0(100.0, 30.0, -60.0), f1(-40.0, 80.0, 10.0);

/// By oscillator.hpp in the principal axes.
Motion reference(const Turned& t, double time, const Vector3d& from, const Vector3d& to) {
  const Matrix3d r = turned();
  const Vector3d a = r.transpose() * q0, b = r.transpose() * v0, f = r.transpose() * from,
                 g = r.transpose() * to;
  Motion out{Vector3d::Zero(), Vector3d::Zero(), 0.0};
  for (int i = 0; i < 3; ++i) {
    const kernels::StepCoefficients s = step_coefficients(t.k, t.c(i), time);
    out.q(i) = s.qq * a(i) + s.qv * b(i) + s.qf0 * f(i) + s.qf1 * g(i);
    out.v(i) = s.vq * a(i) + s.vv * b(i) + s.vf0 * f(i) + s.vf1 * g(i);
    const double mean = s.mq * a(i) + s.mv * b(i) + s.mf0 * f(i) + s.mf1 * g(i);
    out.work += f(i) * (out.q(i) - a(i)) + (g(i) - f(i)) * (out.q(i) - mean);
  }
  return {r * out.q, r * out.v, out.work};
}

void expect_equal(const Motion& a, const Motion& b, const char* name) {
  EXPECT_LT((a.q - b.q).norm(), round_off * (q0.norm() + b.q.norm())) << name;
  EXPECT_LT((a.v - b.v).norm(), round_off * (v0.norm() + std::sqrt(4e6) * q0.norm() + b.v.norm())) << name;
  EXPECT_NEAR(a.work, b.work, round_off * (f0.norm() + f1.norm()) * (q0.norm() + b.q.norm())) << name;
}

} // namespace

TEST(CoupledFlow, MovesTurnedOscillatorsExactly) {
  for (const Turned& t : regimes) {
    CoupledFlow flow(t.system(), h);
    for (const int halvings : {0, 1}) {
      Motion m{q0, v0, 0.0};
      m.work = flow.advance(halvings, m.q.data(), m.v.data(), f0.data(), f1.data());
      expect_equal(m, reference(t, std::ldexp(h, -halvings), f0, f1), t.name);
      Motion free{q0, v0, 0.0};
      EXPECT_EQ(flow.advance(halvings, free.q.data(), free.v.data(), nullptr, nullptr), 0.0);
      expect_equal(free, reference(t, std::ldexp(h, -halvings), Vector3d::Zero(), Vector3d::Zero()), t.name);
    }
  }
}

TEST(CoupledFlow, KnowsTheStateAtAnyInstantOfAStep) {
  const Vector3d slope = (f1 - f0) / h;
  for (const Turned& t : regimes) {
    CoupledFlow flow(t.system(), h);
    for (const double share : {0.0, 1e-9, 0.123, 0.5, 0.77, 0.999, 1.0}) {
      Motion m{Vector3d::Zero(), Vector3d::Zero(), 0.0};
      flow.inside(share * h, q0.data(), v0.data(), f0.data(), slope.data(), m.q.data(), m.v.data());
      Motion expected{q0, v0, 0.0};
      if (share > 0.0)
        expected = reference(t, share * h, f0, f0 + share * (f1 - f0));
      expected.work = 0.0;
      expect_equal(m, expected, t.name);
    }
  }
}

namespace {

/// A step of h/2 by the flow of h, in turned axes, and the same in the principal axes, where the modes are alone.
struct TurnedStep {
  static constexpr int halvings = 1;
  static constexpr double step = h / 2.0;
  struct Axes {
    Nodes q, v, load, contact;
  };
  CoupledFlow coupled;
  PolynomialFlow turned_flow, plain_flow;
  Axes turned_axes, plain_axes;

  static System apart(const Turned& t) { return {Vector3d::Constant(t.k), t.c, {}}; }
  explicit TurnedStep(const Turned& t)
      : coupled(t.system(), h, 2, halvings + 1), turned_flow(t.system(), step, &coupled, halvings),
        plain_flow(apart(t), step) {
    for (std::size_t node = 0; node < 3; ++node) {
      const auto k = static_cast<double>(node);
      set(&Axes::q, node, q0);
      set(&Axes::v, node, v0);
      set(&Axes::load, node, f0 + k * k * f1);
      set(&Axes::contact, node, f1 - k * f0);
    }
  }
  void set(Nodes Axes::*which, std::size_t node, const Vector3d& x) {
    for (Axes* axes : {&turned_axes, &plain_axes})
      (axes->*which).at[node].assign(kernels::lanes, 0.0);
    Eigen::Map<Vector3d>((plain_axes.*which).at[node].data()) = x;
    Eigen::Map<Vector3d>((turned_axes.*which).at[node].data()) = turned() * x;
  }
  static std::array<double, 3> nodal(const Nodes& force, Eigen::Index mode) {
    const auto i = static_cast<std::size_t>(mode);
    return {force.at[0][i], force.at[1][i], force.at[2][i]};
  }
  void expect_same_motion(const char* what) const {
    for (Nodes Axes::*which : {&Axes::q, &Axes::v})
      for (std::size_t node = 1; node <= 2; ++node) {
        const Eigen::Map<const Vector3d> a((turned_axes.*which).at[node].data()),
            b((plain_axes.*which).at[node].data());
        EXPECT_LT((a - turned() * b).norm(), round_off * (v0.norm() + std::sqrt(4e6) * q0.norm() + b.norm()))
            << what << " " << node;
      }
  }
};

} // namespace

TEST(PolynomialFlow, MovesTurnedOscillatorsExactly) {
  for (const Turned& t : regimes) {
    TurnedStep s(t);
    TurnedStep::Axes &x = s.turned_axes, &y = s.plain_axes;
    s.turned_flow.predict(x.load, x.contact, x.q, x.v);
    s.plain_flow.predict(y.load, y.contact, y.q, y.v);
    s.expect_same_motion(t.name);
    const auto a = s.turned_flow.move(x.load, x.contact, x.q, x.v),
               b = s.plain_flow.move(y.load, y.contact, y.q, y.v);
    s.expect_same_motion(t.name);
    const double size = 4.0 * (f0.norm() + f1.norm()) * (q0.norm() + v0.norm() * TurnedStep::step);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(a.load[k], b.load[k], round_off * size) << t.name;
      EXPECT_NEAR(a.contact[k], b.contact[k], round_off * size) << t.name;
    }
  }
}

TEST(PolynomialFlow, RespondsToTheForceOfANode) {
  for (const Turned& t : regimes) {
    const TurnedStep s(t);
    kernels::Array force(kernels::lanes, 0.0), q = force, v = force, plain_q = force, plain_v = force;
    for (int from = 1; from <= 2; ++from)
      for (int to = 1; to <= 2; ++to) {
        Eigen::Map<Vector3d>(force.data()) = turned() * f0;
        s.turned_flow.respond(force.data(), to, from, q.data(), v.data());
        Eigen::Map<Vector3d>(force.data()) = f0;
        s.plain_flow.respond(force.data(), to, from, plain_q.data(), plain_v.data());
        const Eigen::Map<const Vector3d> a(q.data()), b(plain_q.data()), c(v.data()), d(plain_v.data());
        EXPECT_LT((a - turned() * b).norm(), round_off * f0.norm() * h * h) << t.name;
        EXPECT_LT((c - turned() * d).norm(), round_off * f0.norm() * h) << t.name;
      }
  }
}

TEST(PolynomialFlow, IsKnownAtAnyInstantOfAStepInTurnedAxes) {
  for (const Turned& t : regimes) {
    TurnedStep s(t);
    for (const double share : {1e-9, 0.123, 0.5, 0.999}) {
      Vector3d q = Vector3d::Zero(), v = q;
      s.coupled.inside(
          share * TurnedStep::step, s.turned_axes.q.at[0].data(), s.turned_axes.v.at[0].data(),
          [&](Eigen::Index mode, int k, double from, double length) {
            return part_of(TurnedStep::nodal(s.turned_axes.load, mode), from / TurnedStep::step,
                           length / TurnedStep::step)[static_cast<std::size_t>(k)];
          },
          q.data(), v.data());
      for (Eigen::Index i = 0; i < 3; ++i) {
        const auto wanted = state_under(t.k, t.c(i), TurnedStep::step, share * TurnedStep::step, q0(i), v0(i),
                                        TurnedStep::nodal(s.plain_axes.load, i));
        EXPECT_NEAR(turned().col(i).dot(q), wanted.q, round_off) << t.name << share;
        EXPECT_NEAR(turned().col(i).dot(v), wanted.v, round_off * std::sqrt(4e6)) << t.name << share;
      }
    }
  }
}

/// Four modes with a state each, all coupled, one of them growing.
ForcedSystem fed() {
  constexpr Eigen::Index n = 4;
  ForcedSystem scene;
  scene.duration = 1.0;
  scene.system.stiffness = Eigen::Vector4d(1e4, 4e4, 9e4, 4e6);
  scene.system.damping = Eigen::Vector4d(1.0, 4.0, 600.0, 40.0);
  core::MotionForces& f = scene.system.motion;
  f.stiffness = f.damping = f.input = f.rates = Eigen::MatrixXd::Zero(n, n);
  f.output = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto d = static_cast<double>(i - j);
      f.stiffness(i, j) = -3e3 / (1.0 + d * d);
      f.damping(i, j) = 5.0 / (1.0 + d * d);
      f.input(i, j) = 2e3 / (1.0 + 2.0 * d * d);
      f.rates(i, i) = -20.0 - 7.0 * static_cast<double>(i);
    }
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(n);
  return scene;
}

TEST(DiagonalFlow, MovesAsTheMatrixExponential) {
  const ForcedSystem scene = fed();
  const std::vector<CoupledBlock> blocks = coupled_blocks(scene.system);
  ASSERT_EQ(blocks.size(), 1u);
  constexpr double step = 1e-3;
  CoupledFlow exponential(scene.system, blocks, step);
  DiagonalFlow diagonal(scene.system, blocks, step, {3, 1});
  ASSERT_EQ(diagonal.blocks(), 1u);
  kernels::Array q(8, 0.0), v(8, 0.0), f0(8, 0.0), f1(8, 0.0), y(diagonal.size()), rate(y);
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = 1e-3 * static_cast<double>(i + 1);
    v[i] = 0.1 - 0.07 * static_cast<double>(i);
    f0[i] = 3.0 - static_cast<double>(i);
    f1[i] = 1.0 + 2.0 * static_cast<double>(i);
  }
  const kernels::Array none(kernels::numbers_of_input * y.size(), 0.0);
  const auto input = [&](const kernels::Array& force) {
    kernels::Array g(none);
    diagonal.add_input(force.data(), g.data());
    return g;
  };
  const kernels::Array g0 = input(f0), g1 = input(f1);
  const kernels::StateInputs loads{g0.data(), g1.data(), none.data(), none.data()};
  diagonal.start(q.data(), v.data(), y.data());
  kernels::Array q_e = q, v_e = v, z(4, 0.0);
  const auto expect_same = [&](const kernels::Array& at) {
    diagonal.modes_of(at.data(), q.data(), v.data());
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(q[i], q_e[i], round_off * 0.01) << i;
      EXPECT_NEAR(v[i], v_e[i], round_off * 10.0) << i;
    }
  };
  kernels::Array y0;
  for (int k = 0; k < 5; ++k) {
    y0 = y;
    diagonal.move(1, y0.data(), loads, y.data(), rate.data());
    (void)exponential.advance(0, q_e.data(), v_e.data(), f0.data(), f1.data(), z.data());
    expect_same(y);
  }
  // three steps at once under one line of the load, as a load or as a contact force
  y0 = y;
  diagonal.move(0, y0.data(), loads, y.data(), rate.data());
  kernels::Array from(8, 0.0), to(8, 0.0), mean(8, 0.0), slope(8, 0.0), y3(y);
  for (std::size_t i = 0; i < 4; ++i) {
    mean[i] = 0.5 * (f0[i] + f1[i]);
    slope[i] = 0.5 * (f1[i] - f0[i]);
  }
  const kernels::Array m = input(mean), s = input(slope);
  diagonal.move(0, y0.data(), {none.data(), none.data(), m.data(), s.data()}, y3.data(), rate.data());
  for (std::size_t i = 0; i < y.size(); ++i)
    EXPECT_NEAR(y3[i], y[i], round_off * 10.0);
  for (int k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 4; ++i) {
      from[i] = f0[i] + k / 3.0 * (f1[i] - f0[i]);
      to[i] = f0[i] + (k + 1) / 3.0 * (f1[i] - f0[i]);
    }
    (void)exponential.advance(0, q_e.data(), v_e.data(), from.data(), to.data(), z.data());
  }
  expect_same(y);
  diagonal.inside(3.0 * step, y0.data(), loads, y3.data());
  expect_same(y3);
}

/// Against Simpson's rule over instants inside a step.
TEST(DiagonalFlow, KnowsTheWorksOfAllForces) {
  const ForcedSystem scene = fed();
  const std::vector<CoupledBlock> blocks = coupled_blocks(scene.system);
  constexpr double step = 2e-3;
  DiagonalFlow diagonal(scene.system, blocks, step, {1});
  const Eigen::Vector4d load0(3.0, -2.0, 1.0, 0.5), load1(1.0, 4.0, -2.0, 1.0), mean(-5.0, 2.0, 0.0, 7.0),
      slope(1.0, -1.0, 3.0, 2.0);
  const auto input = [&](const Eigen::Vector4d& force) {
    kernels::Array g(kernels::numbers_of_input * diagonal.size(), 0.0);
    diagonal.add_input(force.data(), g.data());
    return g;
  };
  const kernels::Array l0 = input(load0), l1 = input(load1), m = input(mean), s = input(slope),
                       none(l0.size(), 0.0);
  kernels::Array y0(diagonal.size(), 0.0), y1(y0), y(y0), rate(y0);
  Eigen::Vector4d q(1e-3, -2e-3, 0.0, 5e-4), v(0.1, 0.3, -0.2, 0.05);
  diagonal.start(q.data(), v.data(), y0.data());
  const kernels::StateInputs inputs{l0.data(), l1.data(), m.data(), s.data()};
  diagonal.move(0, y0.data(), inputs, y1.data(), rate.data());
  const kernels::StateWorks works = diagonal.works(0, y0.data(), inputs);
  constexpr int intervals = 2000;
  double load = 0.0, contact = 0.0, fluid = 0.0, damping = 0.0;
  for (int k = 0; k <= intervals; ++k) {
    const double share = static_cast<double>(k) / intervals;
    const double weight = (k == 0 || k == intervals ? 1.0 : k % 2 == 0 ? 2.0 : 4.0) * step / intervals / 3.0;
    const Eigen::Vector4d of_load = load0 + share * (load1 - load0),
                          of_contact = mean + (2.0 * share - 1.0) * slope;
    const kernels::Array start = input(load0 + mean - slope), now = input(of_load + of_contact);
    diagonal.inside(share * step, y0.data(), {start.data(), now.data(), none.data(), none.data()}, y.data());
    diagonal.modes_of(y.data(), q.data(), v.data());
    Eigen::Vector4d of_fluid = Eigen::Vector4d::Zero();
    diagonal.add_forces(y.data(), of_fluid.data());
    load += weight * of_load.dot(v);
    contact += weight * of_contact.dot(v);
    fluid += weight * of_fluid.dot(v);
    damping += weight * v.cwiseAbs2().dot(scene.system.damping);
  }
  constexpr double digits = 1e-10; // of Simpson's rule and of P
  const double found = works.fluid + diagonal.fluid_form(y0.data()) - diagonal.fluid_form(y1.data());
  EXPECT_NEAR(works.load, load, digits * std::abs(load));
  EXPECT_NEAR(works.contact, contact, digits * std::abs(contact));
  EXPECT_NEAR(found, fluid, digits * std::abs(fluid));
  EXPECT_NEAR(load + contact + fluid - damping, diagonal.energy(y1.data()) - diagonal.energy(y0.data()),
              digits * damping);
}

TEST(CoupledFlow, TakesOnlyTheModesThatTheMatrixCouples) {
  System s;
  s.stiffness = VectorXd::LinSpaced(6, 1.0, 6.0);
  s.damping_matrix = VectorXd::Constant(6, 2.0).asDiagonal();
  EXPECT_TRUE(CoupledFlow(s, h).empty());
  s.damping_matrix(1, 4) = s.damping_matrix(4, 1) = 0.5;
  s.damping_matrix(4, 5) = s.damping_matrix(5, 4) = 0.5;
  const CoupledFlow flow(s, h);
  for (Eigen::Index i = 0; i < 6; ++i)
    EXPECT_EQ(flow.couples(i), i == 1 || i >= 4);
  s.damping_matrix.resize(0, 0);
  EXPECT_TRUE(CoupledFlow(s, h).empty());
}

} // namespace coupled_flow_test
