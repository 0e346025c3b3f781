// SPDX-License-Identifier: GPL-3.0-or-later
// The coefficients of one mode against the exponential of a matrix in extended precision.
#include "vibration/oscillator.hpp"
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

namespace oscillator_test {

using namespace fretwork;
using namespace fretwork::vibration;

namespace {

constexpr double accuracy =
    1e-12; // relative to the coefficient's own bound: cancellation leaves three digits of sixteen at worst

using Matrix = Eigen::Matrix<long double, 5, 5>;

/// exp(h A) of z = (q, v, f, f', int q) with the step as unit of time: columns answer unit q, v, f, slope.
Matrix propagator(double k, double c, double h) {
  Matrix a = Matrix::Zero();
  const long double t = h;
  a(0, 1) = t;
  a(1, 0) = -k * t;
  a(1, 1) = -c * t;
  a(1, 2) = t;
  a(2, 3) = t;
  a(4, 0) = t;
  return a.exp();
}

struct Mode {
  double k, c;
};

/// All regimes at h = 1: free, dragged, under-, over-, critically damped, near critical, tiny and large k
/// h^2.
std::vector<Mode> modes() {
  std::vector<Mode> out = {{0, 0}, {0, 1e-9}, {0, 0.3}, {0, 1.4}, {0, 1.6}, {0, 40}, {0, 1e4}};
  for (const double k : {1e-12, 1e-8, 1e-5, 1e-3, 0.03, 0.3, 2.0, 2.3, 9.0, 60.0, 1e3, 1e4})
    for (const double ratio : {0.0, 0.001, 0.05, 0.7, 0.999, 1.0, 1.0 + 1e-9, 1.001, 1.1, 1.12, 3.0, 100.0})
      out.push_back({k, 2.0 * ratio * std::sqrt(k)});
  out.push_back({1e-10, 5.0}); // almost rigid, strongly damped
  out.push_back({1e-10, 0.6});
  out.push_back({1e-3, 100.0});
  return out;
}

void expect_near(double value, long double exact, double bound, const Mode& mode, const char* name) {
  EXPECT_NEAR(value, static_cast<double>(exact), accuracy * bound)
      << name << " at k = " << mode.k << ", c = " << mode.c;
}

/// Displacement and velocity at h = 1 from rest, by the exponential of the chain of the force's derivatives.   @param f  the force and its derivatives at the start
std::array<double, 2> end_under(const Mode& mode, const std::array<double, 4>& f) {
  Eigen::Matrix<long double, 6, 6> a = Eigen::Matrix<long double, 6, 6>::Zero();
  a(0, 1) = 1.0;
  a(1, 0) = -mode.k;
  a(1, 1) = -mode.c;
  a(1, 2) = a(2, 3) = a(3, 4) = a(4, 5) = 1.0;
  Eigen::Matrix<long double, 6, 1> start;
  start << 0.0, 0.0, f[0], f[1], f[2], f[3];
  const Eigen::Matrix<long double, 6, 1> end = a.exp() * start;
  return {static_cast<double>(end(0)), static_cast<double>(end(1))};
}

} // namespace

TEST(LinearForBends, LeaveTheModeWhereBentForcesDo) {
  for (const double wh : {0.11, 0.5, 1.5, 2.0, 2.9})
    for (const double ratio : {0.0, 0.01, 0.2, 1.0, 3.0}) {
      const Mode m{wh * wh, 2.0 * ratio * wh};
      const std::array<LinearForce, 2> by = linear_for_bends(m.k, m.c, 1.0, step_coefficients(m.k, m.c, 1.0));
      const std::array<double, 4> bends[] = {{1.0, -6.0, 12.0, 0.0}, {-1.0, 12.0, -60.0, 120.0}};
      for (std::size_t i = 0; i < by.size(); ++i) {
        SCOPED_TRACE(testing::Message() << "w h = " << wh << ", damping ratio " << ratio << ", bend " << i);
        const auto [q, v] = end_under(m, bends[i]);
        const auto [q_linear, v_linear] =
            end_under(m, {by[i].mean - by[i].slope, 2.0 * by[i].slope, 0.0, 0.0});
        EXPECT_NEAR(q_linear, q, 1e-10);
        EXPECT_NEAR(v_linear, v, 1e-10);
      }
    }
}

TEST(StepCoefficients, AreThoseOfTheMatrixExponentialInEveryRegime) {
  for (const Mode& m : modes()) {
    constexpr double h = 1.0;
    const kernels::StepCoefficients s = step_coefficients(m.k, m.c, h);
    const Matrix e = propagator(m.k, m.c, h);
    const double w = std::sqrt(m.k);
    expect_near(s.qq, e(0, 0), 1.0, m, "qq");
    expect_near(s.qv, e(0, 1), h, m, "qv");
    expect_near(s.vq, e(1, 0), std::max(m.k * h, w), m, "vq");
    expect_near(s.vv, e(1, 1), 1.0, m, "vv");
    // a load linear from f0 to f1: its slope is (f1 - f0)/h
    const auto end = [&](int row) { return e(row, 3) / h; };
    const double stiff = 1.0 / std::max(1.0, m.k), slow = 1.0 / std::max(1.0, m.c);
    expect_near(s.qf1, end(0), std::min(stiff, slow), m, "qf1");
    expect_near(s.qf0, e(0, 2) - end(0), std::min(stiff, slow), m, "qf0");
    expect_near(s.vf1, end(1), slow, m, "vf1");
    expect_near(s.vf0, e(1, 2) - end(1), slow, m, "vf0");
    expect_near(s.mq, e(4, 0), 1.0, m, "mq");
    expect_near(s.mv, e(4, 1), 1.0, m, "mv");
    expect_near(s.mf1, end(4), std::min(stiff, slow), m, "mf1");
    expect_near(s.mf0, e(4, 2) - end(4), std::min(stiff, slow), m, "mf0");
  }
}

TEST(DenseCoefficients, AreThoseOfTheMatrixExponentialAtAnyInstant) {
  for (const Mode& m : modes())
    for (const double t : {1e-9, 0.01, 0.37, 1.0}) {
      const DenseCoefficients d = dense_coefficients(m.k, m.c, t);
      const Matrix e = propagator(m.k, m.c, t);
      expect_near(d.qq, e(0, 0), 1.0, m, "qq");
      expect_near(d.qv, e(0, 1), t, m, "qv");
      expect_near(d.qf, e(0, 2), t * t, m, "qf");
      expect_near(d.qs, e(0, 3), t * t * t, m, "qs");
      expect_near(d.vq, e(1, 0), std::max(m.k * t, std::sqrt(m.k)), m, "vq");
      expect_near(d.vv, e(1, 1), 1.0, m, "vv");
      expect_near(d.vf, e(1, 2), t, m, "vf");
      expect_near(d.vs, e(1, 3), t * t, m, "vs");
    }
}

TEST(DenseCoefficients, AtTheStartAreTheStateItself) {
  for (const Mode& m : modes()) {
    const DenseCoefficients d = dense_coefficients(m.k, m.c, 0.0);
    EXPECT_EQ(d.qq, 1.0);
    EXPECT_EQ(d.vv, 1.0);
    for (const double zero : {d.qv, d.qf, d.qs, d.vq, d.vf, d.vs})
      EXPECT_EQ(zero, 0.0);
  }
}

TEST(StepCoefficients, LeaveTheEnergyOfAnUndampedModeAlone) {
  for (const double k : {1e-6, 1.0, 1e4, 1e8}) {
    const kernels::StepCoefficients s = step_coefficients(k, 0.0, 0.01);
    double q = 1.0, v = 0.3 * std::sqrt(k);
    const double energy = v * v + k * q * q;
    for (int i = 0; i < 100000; ++i) {
      const double next = s.qq * q + s.qv * v;
      v = s.vq * q + s.vv * v;
      q = next;
    }
    constexpr double drift = 1e-10; // 1e5 steps of round-off
    EXPECT_NEAR((v * v + k * q * q) / energy, 1.0, drift);
  }
}

TEST(ImpulseResponse, PassesSmoothlyThroughCriticalDamping) {
  constexpr double c = 3.0, t = 0.8, critical = 0.25 * c * c;
  const Impulse at = impulse_response(critical, c, t);
  EXPECT_NEAR(at.g, t * std::exp(-0.5 * c * t), accuracy);
  EXPECT_NEAR(at.rate, (1.0 - 0.5 * c * t) * std::exp(-0.5 * c * t), accuracy);
  for (const double side :
       {-1.0, 1.0}) { // on both sides of the change of formula: g' = -t^3/6 exp(-c t/2) with respect to k
    const double d = side * 1e-4 / (t * t), slope = -t * t * t / 6.0 * std::exp(-0.5 * c * t);
    constexpr double curvature = 1e-9; // d^2 t^5/120
    EXPECT_NEAR(impulse_response(critical + 0.999 * d, c, t).g, at.g + 0.999 * d * slope, curvature);
    EXPECT_NEAR(impulse_response(critical + 1.001 * d, c, t).g, at.g + 1.001 * d * slope, curvature);
  }
}

} // namespace oscillator_test
