// SPDX-License-Identifier: GPL-3.0-or-later
// Modes that a damping matrix couples move exactly. Modes of equal stiffness are the reference: turned to the principal axes of the
// damping matrix they are oscillators of their own.
#include "scenes.hpp"
#include "transient/collocation/force_polynomial.hpp"
#include "transient/modes/coupled_flow.hpp"
#include "transient/modes/diagonal_flow.hpp"
#include "transient/modes/oscillator.hpp"
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace matrix_flow_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;
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
    const StepCoefficients s = step_coefficients(t.k, t.c(i), time);
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
Scene fed() {
  constexpr Eigen::Index n = 4;
  Scene scene;
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
  const Scene scene = fed();
  std::vector<CoupledBlock> blocks = coupled_blocks(scene.system);
  ASSERT_EQ(blocks.size(), 1u);
  constexpr double step = 1e-3;
  CoupledFlow exponential(scene.system, blocks, step);
  DiagonalFlow diagonal(scene, blocks, step, {3, 1});
  EXPECT_TRUE(blocks.empty());
  kernels::Array q(8, 0.0), v(8, 0.0), f0(8, 0.0), f1(8, 0.0), y(diagonal.size());
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = 1e-3 * static_cast<double>(i + 1);
    v[i] = 0.1 - 0.07 * static_cast<double>(i);
    f0[i] = 3.0 - static_cast<double>(i);
    f1[i] = 1.0 + 2.0 * static_cast<double>(i);
  }
  diagonal.start(q.data(), v.data(), y.data());
  kernels::Array q_e = q, v_e = v, z(4, 0.0), q_in(8, 0.0), v_in(8, 0.0), slope(8, 0.0);
  for (int k = 0; k < 5; ++k) {
    const kernels::Array y0 = y;
    diagonal.move(1, y0.data(), f0.data(), f1.data(), y.data(), q.data(), v.data());
    (void)exponential.advance(0, q_e.data(), v_e.data(), f0.data(), f1.data(), z.data());
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(q[i], q_e[i], round_off * 0.01) << k << " " << i;
      EXPECT_NEAR(v[i], v_e[i], round_off * 10.0) << k << " " << i;
    }
  }
  // three steps at once under one line of the load
  kernels::Array y3 = y, q3 = q, v3 = v;
  diagonal.move(0, y.data(), f0.data(), f1.data(), y3.data(), q3.data(), v3.data());
  for (int k = 0; k < 3; ++k) {
    kernels::Array from(8, 0.0), to(8, 0.0);
    for (std::size_t i = 0; i < 4; ++i) {
      from[i] = f0[i] + k / 3.0 * (f1[i] - f0[i]);
      to[i] = f0[i] + (k + 1) / 3.0 * (f1[i] - f0[i]);
      slope[i] = (f1[i] - f0[i]) / (3.0 * step);
    }
    (void)exponential.advance(0, q_e.data(), v_e.data(), from.data(), to.data(), z.data());
  }
  diagonal.inside(3.0 * step, y.data(), f0.data(), slope.data(), q_in.data(), v_in.data());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(q3[i], q_e[i], round_off * 0.01) << i;
    EXPECT_NEAR(v3[i], v_e[i], round_off * 10.0) << i;
    EXPECT_NEAR(q_in[i], q_e[i], round_off * 0.01) << i;
    EXPECT_NEAR(v_in[i], v_e[i], round_off * 10.0) << i;
  }
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

namespace {

MatrixXd turned_modes() {
  MatrixXd r = MatrixXd::Identity(6, 6); // mode 2 stays alone
  r.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(0.6).toRotationMatrix();
  r.bottomRightCorner<3, 3>() = turned();
  return r;
}

/// A scene that impacts and slides in axes of its own, and the same seen in turned modal axes of equal stiffness.
std::array<Scene, 2> twins() {
  Scene plain = rattling(3, 6, 0.3);
  plain.system.stiffness.setConstant(4e3);
  plain.system.damping = VectorXd::LinSpaced(6, 0.5, 60.0);
  Scene twin = plain;
  const MatrixXd r = turned_modes();
  twin.system.damping_matrix = r * plain.system.damping.asDiagonal() * r.transpose();
  twin.system.damping.setZero(); // replaced by the matrix
  for (auto& c : twin.contacts)
    c.b = c.b * r.transpose();
  for (auto& load : twin.loads)
    load.modal_force = r * load.modal_force;
  return {plain, twin};
}

} // namespace

class DampingMatrix : public testing::TestWithParam<Candidate> {};
INSTANTIATE_TEST_SUITE_P(Schemes, DampingMatrix, testing::ValuesIn(candidates), name_of_candidate);

TEST_P(DampingMatrix, GivesTheSameInOtherModalAxes) {
  const auto scenes = twins();
  const StepOptions options{
      GetParam().kind, GetParam().kind == SchemeKind::runge_kutta_54 ? std::nullopt : std::optional(1e-4)};
  const History a = simulate(scenes[0], options, 7.7e-4), b = simulate(scenes[1], options, 7.7e-4);
  constexpr double grown = 1e-7; // round-off grows tenfold in 0.05 to 0.1 s
  EXPECT_GT(a.normal.maxCoeff(), 0.0);
  EXPECT_LT((a.normal - b.normal).norm(), grown * a.normal.norm());
  EXPECT_LT(std::abs(a.q.norm() - b.q.norm()), grown * a.q.norm());
  EXPECT_LT(std::abs(a.v.norm() - b.v.norm()), grown * a.v.norm());
  const Energy &x = a.report.energy, &y = b.report.energy;
  EXPECT_GT(x.modal_damping, 0.01 * x.throughput);
  // Euler, of order 1, books a matrix with the velocity before the step, single dampings with the mean of both
  const double booked = GetParam().first_order() ? 1e-4 : grown;
  EXPECT_NEAR(x.modal_damping, y.modal_damping, booked * x.throughput);
  EXPECT_NEAR(x.load_work, y.load_work, grown * x.throughput);
  EXPECT_NEAR(a.report.residual_relative, b.report.residual_relative, booked);
}

TEST(Collocation, GivesTheSameInOtherModalAxesWhereItCutsSteps) {
  auto scenes = twins();
  for (Scene& scene : scenes) {
    scene.v0.setConstant(0.02);
    scene.duration = 0.025;
    for (auto& c : scene.contacts)
      c.support.normal.stiffness = 1e8;
  }
  scenes[1].v0 = turned_modes() * scenes[0].v0;
  const History a = simulate(scenes[0], collocation(8e-4), 7.7e-4),
                b = simulate(scenes[1], collocation(8e-4), 7.7e-4);
  constexpr double grown = 1e-6; // round-off through impacts on stiff contacts
  EXPECT_GT(a.report.counts.rejected, 0);
  EXPECT_EQ(a.report.counts.rejected, b.report.counts.rejected);
  EXPECT_LT((a.q - turned_modes().transpose() * b.q).norm(), grown * a.q.norm());
  EXPECT_LT((a.v - turned_modes().transpose() * b.v).norm(), grown * a.v.norm());
}

TEST(DampingMatrix, TakesWhatIsBooked) {
  // free motion of two coupled modes: the loss is int v.C v dt, here by Simpson's rule over fine outputs
  Scene s = mass_point(1.0, Vec3(100.0, 900.0, 0.0), 1.0);
  s.system.damping_matrix = Matrix3d{{3.0, 2.0, 0.0}, {2.0, 5.0, 0.0}, {0.0, 0.0, 1.0}};
  start(s, 1.0, Vec3(0.1, -0.05, 0.0), Vec3(1.0, 0.0, 2.0));
  constexpr int intervals = 2000;
  for (const StepOptions& options : {splitting(1e-2), collocation(1e-2)}) {
    const History run = simulate(s, options, 1.0 / intervals);
    // energies of splitting are those at the end of the last record's step, of collocation those at its time
    const double end =
        run.report.end_time + (run.choice.scheme == SchemeKind::splitting ? 0.5 * run.choice.step : 0.0);
    double loss = 0.0;
    const int last = static_cast<int>(std::lround(end * intervals));
    for (int k = 0; k <= last; ++k) {
      const double weight = k == 0 || k == last ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
      loss += weight / (3.0 * intervals) * run.v.col(k).dot(s.system.damping_matrix * run.v.col(k));
    }
    ASSERT_EQ(last % 2, 0);
    constexpr double simpson = 1e-8; // (w h)^4/180 with w h = 0.03
    EXPECT_NEAR(run.report.energy.modal_damping, loss, simpson * loss);
    EXPECT_LT(run.report.residual_relative, 1e-12);
  }
}

TEST(CaseA5, ChainWithNonProportionalDamping) {
  // eight masses between fixed ends; modes of the undamped chain, known in closed form
  constexpr int n = 8;
  MatrixXd shapes(n, n), damping = MatrixXd::Zero(n, n);
  Scene s;
  s.system.stiffness.resize(n);
  const double pi = std::acos(-1.0);
  for (int i = 0; i < n; ++i) {
    s.system.stiffness(i) = 4.0 * 1e4 * std::pow(std::sin((i + 1) * pi / 18.0), 2);
    for (int j = 0; j < n; ++j)
      shapes(j, i) = std::sqrt(2.0 / 9.0 / 10.0) * std::sin((i + 1) * (j + 1) * pi / 9.0);
  }
  for (int d = 0; d < n + 1; ++d) { // between masses d - 1 and d
    const double c = d == 0 ? 250.0 : d == n ? 25.0 : 50.0;
    if (d < n)
      damping(d, d) += c;
    if (d > 0)
      damping(d - 1, d - 1) += c;
    if (d > 0 && d < n) {
      damping(d - 1, d) -= c;
      damping(d, d - 1) -= c;
    }
  }
  s.system.damping_matrix = shapes.transpose() * damping * shapes;
  s.system.damping = s.system.damping_matrix.diagonal();
  s.loads = {{Constant{1.0}, shapes.row(3).transpose()}};
  s.q0 = s.v0 = VectorXd::Zero(n);
  s.duration = 1.0;
  const History run = simulate(s, {}, 0.09);
  EXPECT_EQ(run.choice.scheme, SchemeKind::splitting);
  const std::array<double, 9> exact = {3.954085e-5, 5.135974e-6, 3.767924e-5, 7.355104e-6, 3.585249e-5,
                                       8.819161e-6, 3.465793e-5, 1.009426e-5, 3.362162e-5};
  constexpr double digits = 1e-11; // of the six decimals printed, with one unit of 1e-5's seventh digit
  for (int k = 1; k <= 9; ++k)
    EXPECT_NEAR(shapes.row(3).dot(run.q.col(k)), exact[static_cast<std::size_t>(k - 1)], digits)
        << "0.09 * " << k;
}

} // namespace matrix_flow_test
