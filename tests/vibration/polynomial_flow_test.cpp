// SPDX-License-Identifier: GPL-3.0-or-later
// The exact motion under a quadratic force, of modes of all kinds, against Runge and Kutta's method.
#include "vibration/polynomial_flow.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace polynomial_flow_test {

using namespace fretwork;
using namespace fretwork::vibration;

namespace {

/// Rigid, soft, stiff, damped, critical, overdamped, rigid with damping: k, c for a step of 0.1 s.
constexpr double kinds[][2] = {{0.0, 0.0}, {1e-3, 0.0},   {50.0, 0.3},  {4e3, 1.0},    {1e5, 20.0},
                               {1e6, 0.0}, {400.0, 40.0}, {1e-6, 30.0}, {30.0, 200.0}, {0.0, 15.0}};
constexpr double h = 0.1;
constexpr double oracle = 1e-9; ///< of Runge and Kutta's method in 20000 steps, relative to the largest value

struct State {
  double q, v, work;
};

/// q, v and the work of the load (half of the force) at t, by Runge and Kutta's method.
State by_runge_kutta(double k, double c, double t, State y, const std::array<double, 3>& f) {
  constexpr int steps = 20000;
  const double dt = t / steps;
  const auto force = [&](double time) {
    const double s = time / h;
    return f[0] * (1.0 - s) * (1.0 - 2.0 * s) + f[1] * 4.0 * s * (1.0 - s) + f[2] * s * (2.0 * s - 1.0);
  };
  const auto rate = [&](double time, const State& x) {
    return State{x.v, force(time) - c * x.v - k * x.q, 0.5 * force(time) * x.v};
  };
  const auto moved = [](const State& x, double by, const State& r) {
    return State{x.q + by * r.q, x.v + by * r.v, x.work + by * r.work};
  };
  for (int i = 0; i < steps; ++i) {
    const double time = i * dt;
    const State a = rate(time, y), b = rate(time + 0.5 * dt, moved(y, 0.5 * dt, a)),
                d = rate(time + 0.5 * dt, moved(y, 0.5 * dt, b)), e = rate(time + dt, moved(y, dt, d));
    for (const auto& [r, weight] :
         {std::pair(a, 1.0), std::pair(b, 2.0), std::pair(d, 2.0), std::pair(e, 1.0)})
      y = moved(y, weight * dt / 6.0, r);
  }
  return y;
}

constexpr double q0 = 0.3, v0 = -2.0;
constexpr std::array<double, 3> force = {5.0, -40.0, 70.0};

/// One mode of each kind after the other, `count` of them, all in motion under forces of their own.
struct MovingModes {
  explicit MovingModes(int count) {
    system.stiffness.resize(count);
    system.damping.resize(count);
    for (Nodes* nodes : {&q, &v, &load, &contact})
      for (auto& a : nodes->at)
        a.assign(static_cast<std::size_t>(kernels::padded(count)), 0.0);
    for (int i = 0; i < count; ++i) {
      const auto m = static_cast<std::size_t>(i);
      const auto& [k, c] = kinds[m % std::size(kinds)];
      system.stiffness(i) = k;
      system.damping(i) = c;
      q.at[0][m] = q0 * std::cos(i);
      v.at[0][m] = v0 * std::sin(i);
      for (std::size_t j = 0; j < 3; ++j) {
        load.at[j][m] = force[j] * std::sin(2 * i);
        contact.at[j][m] = force[j] * std::cos(3 * i);
      }
    }
  }
  System system;
  Nodes q, v, load, contact;
};

} // namespace

TEST(ForcePolynomial, MovesModesOfEveryKindExactly) {
  System system;
  const Eigen::Index n = std::size(kinds);
  system.stiffness.resize(n);
  system.damping.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    system.stiffness(i) = kinds[i][0];
    system.damping(i) = kinds[i][1];
  }
  const PolynomialFlow flow(system, h);
  const auto padded = static_cast<std::size_t>(kernels::padded(static_cast<int>(n)));
  for (Eigen::Index mode = 0; mode < n; ++mode) {
    const auto i = static_cast<std::size_t>(mode);
    Nodes q, v, load, contact; // the force half by loads, half by contacts; of this mode only
    for (Nodes* nodes : {&q, &v, &load, &contact})
      for (auto& a : nodes->at)
        a.assign(padded, 0.0);
    q.at[0][i] = q0;
    v.at[0][i] = v0;
    for (std::size_t j = 0; j < 3; ++j)
      load.at[j][i] = contact.at[j][i] = 0.5 * force[j];
    const auto works = flow.move(load, contact, q, v);
    for (std::size_t j = 1; j <= 2; ++j) {
      const double t = 0.5 * static_cast<double>(j) * h, k = kinds[i][0], c = kinds[i][1];
      const State exact = by_runge_kutta(k, c, t, {q0, v0, 0.0}, force);
      const double size = std::sqrt(v0 * v0 + k * q0 * q0) + 1.0;
      EXPECT_NEAR(q.at[j][i], exact.q, oracle) << k << " " << c;
      EXPECT_NEAR(v.at[j][i], exact.v, oracle * size) << k << " " << c;
      EXPECT_NEAR(works.load[j - 1], exact.work, oracle * size) << k << " " << c;
      EXPECT_NEAR(works.contact[j - 1], exact.work, oracle * size) << k << " " << c;
      const auto state = state_under(k, c, h, t, q0, v0, force);
      constexpr double round_off = 1e-12;
      EXPECT_NEAR(state.q, q.at[j][i], round_off);
      EXPECT_NEAR(state.v, v.at[j][i], round_off * size);
      const auto without = state_under(k, c, h, t, q0, v0, {force[0], 0.0, 0.0});
      kernels::Array unit(padded, 0.0), by_q[2] = {unit, unit}, by_v[2] = {unit, unit};
      unit[i] = 1.0;
      for (int from = 1; from <= 2; ++from)
        flow.respond(unit.data(), static_cast<int>(j), from, by_q[from - 1].data(), by_v[from - 1].data());
      EXPECT_NEAR(without.q + force[1] * by_q[0][i] + force[2] * by_q[1][i], state.q, round_off);
      EXPECT_NEAR(without.v + force[1] * by_v[0][i] + force[2] * by_v[1][i], state.v, round_off * size);
    }
  }
}

TEST(ForcePolynomial, PredictsWithTheForcesOfTheStartAndTheLoads) {
  System system;
  system.stiffness = Eigen::VectorXd::Constant(1, 50.0);
  system.damping = Eigen::VectorXd::Constant(1, 0.3);
  Nodes q, v, load, contact;
  for (Nodes* nodes : {&q, &v, &load, &contact})
    for (auto& a : nodes->at)
      a.assign(kernels::lanes, 0.0);
  q.at[0][0] = q0;
  for (std::size_t j = 0; j < 3; ++j)
    load.at[j][0] = force[j];
  contact.at[0][0] = 3.0;
  contact.at[1][0] = contact.at[2][0] = 1e6; // not yet known
  PolynomialFlow(system, h).predict(load, contact, q, v);
  const auto state = state_under(50.0, 0.3, h, h, q0, 0.0, {force[0] + 3.0, force[1], force[2]});
  EXPECT_DOUBLE_EQ(q.at[2][0], state.q);
  EXPECT_DOUBLE_EQ(v.at[2][0], state.v);
}

TEST(ForcePolynomial, MovesManyModesAndSumsTheirWorks) {
  constexpr double round_off = 1e-12; // relative to the sum of magnitudes
  for (const int count : {1, 4, 7, 8, 13, 40}) {
    MovingModes modes(count);
    auto& [system, q, v, load, contact] = modes;
    const PolynomialFlow flow(system, h);
    Nodes predicted_q = q, predicted_v = v;
    flow.predict(load, contact, predicted_q, predicted_v);
    const auto works = flow.move(load, contact, q, v);
    double by_load[2]{}, by_contact[2]{}, size = 0.0;
    for (int i = 0; i < count; ++i) {
      const auto m = static_cast<std::size_t>(i);
      const double k = system.stiffness(i), c = system.damping(i), fast = std::sqrt(k) + c + 1.0;
      std::array<double, 3> f{}, known{};
      for (std::size_t j = 0; j < 3; ++j) {
        f[j] = load.at[j][m] + contact.at[j][m];
        known[j] = load.at[j][m] + contact.at[0][m] * (j == 0);
      }
      for (std::size_t j = 1; j <= 2; ++j) {
        const double t = 0.5 * static_cast<double>(j) * h;
        const auto state = state_under(k, c, h, t, q.at[0][m], v.at[0][m], f);
        EXPECT_NEAR(q.at[j][m], state.q, round_off);
        EXPECT_NEAR(v.at[j][m], state.v, round_off * fast);
        const auto first = state_under(k, c, h, t, q.at[0][m], v.at[0][m], known);
        EXPECT_NEAR(predicted_q.at[j][m], first.q, round_off);
        EXPECT_NEAR(predicted_v.at[j][m], first.v, round_off * fast);
      }
      MovingModes alone(1);
      alone.system.stiffness(0) = k;
      alone.system.damping(0) = c;
      alone.q.at[0][0] = q.at[0][m];
      alone.v.at[0][0] = v.at[0][m];
      for (std::size_t j = 0; j < 3; ++j) {
        alone.load.at[j][0] = load.at[j][m];
        alone.contact.at[j][0] = contact.at[j][m];
      }
      const auto own = PolynomialFlow(alone.system, h).move(alone.load, alone.contact, alone.q, alone.v);
      for (std::size_t j = 0; j < 2; ++j) {
        by_load[j] += own.load[j];
        by_contact[j] += own.contact[j];
        size += std::abs(own.load[j]) + std::abs(own.contact[j]);
      }
    }
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(works.load[j], by_load[j], round_off * size) << count;
      EXPECT_NEAR(works.contact[j], by_contact[j], round_off * size) << count;
    }
  }
}

TEST(DecayFunctions, MeetBetweenSeriesAndClosedForm) {
  constexpr double round_off = 1e-13;
  for (const double x : {0.0, 1e-8, 0.3, 1.4999999, 1.5000001, 8.0, 700.0}) {
    const auto phi = decay_functions(x);
    double factorial = 1.0;
    for (std::size_t n = 0; n < 4; ++n) { // phi_n + x phi_{n+1} = 1/n!
      EXPECT_NEAR(phi[n] + x * phi[n + 1], 1.0 / factorial, round_off) << x;
      factorial *= static_cast<double>(n + 2);
    }
    EXPECT_NEAR(phi[0] * x, -std::expm1(-x), round_off) << x;
  }
}

} // namespace polynomial_flow_test
