// SPDX-License-Identifier: GPL-3.0-or-later
// Fluidelastic laws and their forces on modes, by the eigenvalues of the coupled system: one metre of tube, and a pinned tube in flow over
// half its length. Reference values: Routh's criterion of the closed form, and a separate computation of the same equations.
#include "core/error.hpp"
#include "core/general_eigenvalues.hpp"
#include "fluidelastic_cases.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace fluidelastic_test {

using namespace fretwork;
using namespace fretwork::flow;

namespace {

constexpr double digits = 1e-9; // of the reference values, relative

/// Of one tube.
core::MotionForces motion_forces(const Sampling& sampling, const FluidelasticLaw& law, Eigen::Index modes,
                                 double largest_factor) {
  return flow::motion_forces(std::vector<TubeOfLaw>{{sampling, 0}}, law, modes, largest_factor);
}

Eigen::VectorXcd roots(const Sampling& sampling, const FluidelasticLaw& law, double damping, double factor) {
  const Eigen::VectorXd w = 2.0 * std::numbers::pi * sampling.frequency;
  return core::general_eigenvalues(
      state_matrix(w.cwiseAbs2(), 2.0 * damping * w,
                   scaled(motion_forces(sampling, law, sampling.modes(), no_limit), factor)));
}

/// Where the largest real part passes zero, V0 = 1 m/s.
double critical(const Sampling& sampling, const FluidelasticLaw& law, double damping, double low,
                double high) {
  const auto growth = [&](double v) { return roots(sampling, law, damping, v).real().maxCoeff(); };
  EXPECT_LT(growth(low), 0.0);
  EXPECT_GT(growth(high), 0.0);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (growth(middle) < 0.0 ? low : high) = middle;
  }
  return low;
}

std::complex<double> upper(const Eigen::VectorXcd& all) {
  Eigen::Index at = 0;
  all.imag().maxCoeff(&at);
  return all(at);
}

TEST(Fluidelastic, QuasiUnsteadyMemoryOfALiftForce) {
  Eigen::Matrix2d gradients = Eigen::Matrix2d::Zero();
  gradients(1, 1) = -15.5;
  const FluidelasticLaw law = quasi_unsteady_law(0.2, 0.0, gradients, {{1.25, 0.05}, {-0.12, 0.3}});
  const Sampling one = metre(c1, 1.0);
  const std::complex<double> slow = upper(roots(one, law, c1.damping, 1.0));
  EXPECT_NEAR(std::abs(slow) / (2.0 * std::numbers::pi), 29.60857106, 1e-8 * 30.0);
  EXPECT_NEAR(-slow.real() / std::abs(slow), 8.9536231015e-3, digits * 9e-3);
  const Eigen::VectorXcd fast = roots(one, law, c1.damping, 2.0);
  EXPECT_NEAR(upper(fast).real(), -1.39586667, 1e-8);
  EXPECT_NEAR(upper(fast).imag(), 178.28561262, 1e-8);
  EXPECT_NEAR(fast.real().minCoeff(), -27.05297322, 1e-8);
  EXPECT_NEAR(critical(one, law, c1.damping, 2.0, 3.0), 2.6081342741, digits * 2.6);
}

/// Without damping the tube becomes unstable where c_d = 0, at one reduced velocity whatever its mass.
TEST(Fluidelastic, ReducedVelocityOfAnUndampedTube) {
  Eigen::Matrix2d gradients = Eigen::Matrix2d::Zero();
  gradients(1, 1) = -15.5;
  const FluidelasticLaw law = quasi_unsteady_law(0.2, 0.0, gradients, {{1.25, 0.05}, {-0.12, 0.3}});
  for (const double mass : {1.1, 5.0}) {
    const Sampling one = metre({mass, c1.frequency, 0.0, c1.density}, 1.0);
    const double v = critical(one, law, 0.0, 1.0, 4.0);
    const double frequency = std::abs(upper(roots(one, law, 0.0, v))) / (2.0 * std::numbers::pi);
    EXPECT_NEAR(v / (frequency * diameter), 4.2754021428, digits * 4.3) << mass;
  }
}

/// V_s, where the tube becomes unstable with its stops closed: no limit cycle holds above it.
TEST(Fluidelastic, VelocityUpToWhichAClosedStopHolds) {
  for (const auto& [stiffness, velocity] : {std::pair(2e4, 2.5729411430), std::pair(1e5, 4.2461993963)}) {
    const double w = 2.0 * std::numbers::pi * s1.frequency, closed = std::sqrt(w * w + stiffness / s1.mass);
    Sampling held = metre(s1, 1.0);
    held.frequency(0) = closed / (2.0 * std::numbers::pi);
    EXPECT_NEAR(critical(held, law_s1(), s1.damping * w / closed, 1.0, 6.0), velocity, digits * velocity);
  }
}

TEST(Fluidelastic, TablesBecomeLags) {
  std::vector<MeasuredForce> rows;
  for (int i = 0; i <= 20; ++i)
    rows.push_back(a3(2.16 + (6.57 - 2.16) * i / 20.0));
  const FittedLaw fitted = fitted_law(rows, 2);
  EXPECT_LE(fitted.damping_error, 0.05); // a fit with rates 0.5 and 2 has 0.045 and 0.40
  EXPECT_LE(fitted.stiffness_error, 0.6);
  EXPECT_EQ(fitted.law.range, (std::array<double, 2>{2.16, 6.57}));
  constexpr double of_fits = 0.05; // iterated on the table itself: 3.4488; with rates 0.5 and 2: 3.3511
  EXPECT_NEAR(critical(metre(c1, 1.0), fitted.law, c1.damping, 2.0, 5.0), 3.4, of_fits * 3.4);
}

TEST(Fluidelastic, OneLagByRouth) {
  const Sampling one = metre(s1, 1.0);
  EXPECT_NEAR(critical(one, law_s1(), s1.damping, 1.0, 2.5), 1.8175472134, digits * 1.8);
  const Eigen::VectorXcd all = roots(one, law_s1(), s1.damping, 2.5);
  EXPECT_NEAR(upper(all).real(), 2.767382391, digits * 100.0);
  EXPECT_NEAR(upper(all).imag(), 128.198913480, digits * 100.0);
  EXPECT_NEAR(all.real().minCoeff(), -63.716477226, digits * 100.0);
}

/// The lift of S1 with a delay of D/V: Pade (3, 3).
TEST(Fluidelastic, DelayByPade) {
  Eigen::Matrix2d gradients = Eigen::Matrix2d::Zero();
  gradients(1, 1) = -4.0;
  EXPECT_NEAR(critical(metre(s1, 1.0), quasi_steady_law(0.4, 0.0, gradients, 1.0), s1.damping, 0.5, 1.5),
              0.9979707974, digits);
}

/// The same delay as a rational law of Pade's approximant (n, n): e^-x = D(-x)/D(x) = 1 - sum alpha x/(x + d).
FluidelasticLaw delay_by_pade(int n) {
  constexpr double lift = -4.0, drag = 0.4;
  Eigen::VectorXd d = Eigen::VectorXd::Ones(n + 1); // coefficients of D; that of x^n is 1
  for (int k = n; k-- > 0;)
    d(k) = d(k + 1) * (2 * n - k) * (k + 1) / (n - k);
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  companion.diagonal(-1).setOnes();
  companion.col(n - 1) = -d.head(n);
  FluidelasticLaw law;
  law.stiffness(1, 1) = lift;
  law.damping(1, 1) = -drag;
  for (const std::complex<double>& x : core::general_eigenvalues(companion)) {
    if (x.imag() < 0.0)
      continue; // of a pair one stands for both
    std::complex<double> numerator = 0.0, slope = 0.0;
    for (int k = n; k >= 0; --k) {
      numerator = -x * numerator + d(k);
      slope = k > 0 ? x * slope + static_cast<double>(k) * d(k) : slope;
    }
    const std::complex<double> share = numerator / (slope * -x);
    Eigen::MatrixXcd force = Eigen::MatrixXcd::Zero(2, 2);
    force(1, 1) = -(x.imag() > 0.0 ? 2.0 : 1.0) * share * lift;
    law.lags.push_back({-x, force});
  }
  return law;
}

TEST(Fluidelastic, DelayByPadeOfOtherOrders) {
  const std::pair<int, double> cases[] = {
      {1, 0.8441987395}, {2, 0.9809269250}, {3, 0.9979707974}, {4, 0.9987254949}};
  for (const auto& [order, velocity] : cases)
    EXPECT_NEAR(critical(metre(s1, 1.0), delay_by_pade(order), s1.damping, 0.5, 1.5), velocity, digits)
        << order;
  // on the imaginary axis the exact delay has a closed form: m (w0^2 - w^2) = q K cos kr, 2 m zeta w0 w = q (C kr - K sin kr)
  const double w0 = 2.0 * std::numbers::pi * s1.frequency;
  const auto growth = [&](double v) {
    const double q = 0.5 * s1.density * v * v;
    double w = w0;
    for (int i = 0; i < 200; ++i)
      w = std::sqrt(w0 * w0 + 4.0 * q * std::cos(w * diameter / v) / s1.mass);
    const double kr = w * diameter / v;
    return q * (-0.4 * kr + 4.0 * std::sin(kr)) - 2.0 * s1.mass * s1.damping * w0 * w;
  };
  double low = 0.9, high = 1.1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (growth(middle) < 0.0 ? low : high) = middle;
  }
  EXPECT_NEAR(low, 0.9987435667, digits);
}

/// Drag and lift that push each other: V_c/(f D) = K sqrt(m delta/(rho D^2)) exactly.
// Fit of measured coefficients of one tube in a rigid bundle (doc/validation.md, D1) with two lags.
TEST(Fluidelastic, FitOfMeasuredCoefficients) {
  FluidelasticLaw law;
  law.stiffness(1, 1) = -0.3278;
  law.damping(1, 1) = 0.8767;
  law.lags = {{0.5, Eigen::Vector2cd(0.0, 2.9113).asDiagonal().toDenseMatrix()},
              {2.0, Eigen::Vector2cd(0.0, -4.9667).asDiagonal().toDenseMatrix()}};
  EXPECT_NEAR(critical(metre(c1, 1.0), law, c1.damping, 2.0, 5.0), 3.3510485712, digits * 3.4);
}

TEST(Fluidelastic, CouplingOfConnors) {
  FluidelasticLaw law = connors_law(3.0);
  EXPECT_NEAR(law.stiffness(0, 1), 2.792526803, digits * 2.8);
  Sampling two = metre(s1, 1.0);
  two.frequency = Eigen::Vector2d(s1.frequency, s1.frequency);
  two.modal_mass = Eigen::Vector2d::Ones();
  two.stations[0].shapes = Eigen::Matrix3Xd::Identity(3, 2) / std::sqrt(s1.mass);
  EXPECT_NEAR(critical(two, law, s1.damping, 0.5, 1.5), 0.8237621096, digits);
  law.damping = -0.4 * Eigen::Matrix2d::Identity();
  EXPECT_NEAR(critical(two, law, s1.damping, 0.5, 1.5), 1.0128649486, digits);
}

TEST(Fluidelastic, PinnedTubeInFlowOverHalfItsLength) {
  const std::vector<std::pair<Eigen::Index, double>> cases = {
      {1, 3.3371847905}, {3, 3.3372210909}, {6, 3.3372216084}, {12, 3.3372217687}};
  for (const auto& [modes, velocity] : cases)
    EXPECT_NEAR(critical(pinned(modes, 0.25, 0.75), law_s1(), 0.01, 3.0, 4.0), velocity, digits * 3.3)
        << modes;
  EXPECT_NEAR(critical(pinned(6, 0.0, 1.0), law_s1(), 0.01, 3.0, 4.0), 3.1792635889, digits * 3.2);
  double growth = -1.0, at = 0.0;
  for (const std::complex<double>& s : roots(pinned(6, 0.25, 0.75), law_s1(), 0.01, 4.0))
    if (s.real() > growth && s.imag() > 0.0) {
      growth = s.real();
      at = s.imag();
    }
  EXPECT_NEAR(growth, 1.915330586, digits * 200.0);
  EXPECT_NEAR(at, 212.385903309, digits * 200.0);
}

/// The forces of one lag along lift with a state a station.
core::MotionForces with_a_state_a_station(const Sampling& sampling, const FluidelasticLaw& law) {
  const Eigen::Index m = sampling.modes(), stations = static_cast<Eigen::Index>(sampling.stations.size());
  FluidelasticLaw without = law;
  without.lags.clear();
  core::MotionForces out = motion_forces(sampling, without, m, no_limit);
  out.input = Eigen::MatrixXd::Zero(m, stations);
  out.output = Eigen::MatrixXd::Zero(stations, m);
  out.rates = Eigen::MatrixXd::Zero(stations, stations);
  for (Eigen::Index i = 0; i < stations; ++i) {
    const Station& station = sampling.stations[static_cast<std::size_t>(i)];
    const double v = station.flow.velocity;
    out.output.row(i) = station.shapes.row(1);
    out.input.col(i) = 0.5 * station.flow.density * v * v * station.weight * law.lags[0].force(1, 1).real() *
                       station.shapes.row(1).transpose();
    out.rates(i, i) = -law.lags[0].rate.real() * v / station.tube.outer_diameter;
  }
  return out;
}

TEST(Fluidelastic, LagsOfAChangingVelocityAreInterpolated) {
  constexpr Eigen::Index modes = 6;
  constexpr double of_the_effect = 1e-5; // what nodes leave of a lag
  for (const double least : {0.5, 0.1, 0.0}) {
    Sampling tube = pinned(modes, 0.0, 1.0);
    const auto number = static_cast<double>(tube.stations.size());
    for (std::size_t i = 0; i < tube.stations.size(); ++i)
      tube.stations[i].flow.velocity =
          4.0 * (least + (1.0 - least) * (static_cast<double>(i) + 0.5) / number);
    const core::MotionForces nodes = motion_forces(tube, law_s1(), modes, no_limit),
                             exact = with_a_state_a_station(tube, law_s1());
    EXPECT_LE(nodes.states(), 13 * modes);
    EXPECT_LT(nodes.states(), exact.states());
    const Eigen::VectorXd w = 2.0 * std::numbers::pi * tube.frequency, c = 0.02 * w;
    const auto vibrations = [&](const core::MotionForces& forces) {
      std::vector<std::complex<double>> out;
      for (const std::complex<double>& s : core::general_eigenvalues(state_matrix(w.cwiseAbs2(), c, forces)))
        if (s.imag() > 100.0)
          out.push_back(s);
      std::sort(out.begin(), out.end(), [](auto a, auto b) { return a.imag() < b.imag(); });
      return out;
    };
    core::MotionForces none;
    none.stiffness = none.damping = Eigen::MatrixXd::Zero(modes, modes);
    none.input = Eigen::MatrixXd::Zero(modes, 0);
    none.rates = Eigen::MatrixXd::Zero(0, 0);
    none.output = Eigen::MatrixXd::Zero(0, modes);
    const auto by_nodes = vibrations(nodes), by_stations = vibrations(exact), dry = vibrations(none);
    ASSERT_EQ(by_nodes.size(), by_stations.size());
    ASSERT_EQ(by_nodes.size(), dry.size());
    for (std::size_t k = 0; k < dry.size(); ++k)
      EXPECT_LT(std::abs(by_nodes[k] - by_stations[k]), of_the_effect * std::abs(by_stations[k] - dry[k]))
          << least << ", mode " << k;
  }
}

TEST(Fluidelastic, OneStateAModeAndLagWhereTheVelocityIsConstant) {
  EXPECT_EQ(motion_forces(pinned(6, 0.25, 0.75), law_s1(), 8, no_limit).states(), 6);
  const core::MotionForces f = motion_forces(pinned(6, 0.25, 0.75), law_s1(), 8, no_limit);
  EXPECT_TRUE(f.stiffness.bottomRows(2).isZero(0.0)); // static modes feel nothing
}

// V/(f D) reaches 0.3 in four modes at the critical velocity.
TEST(Fluidelastic, FastModesNeedNoStates) {
  constexpr Eigen::Index modes = 12;
  const Sampling tube = pinned(modes, 0.25, 0.75);
  const core::MotionForces f = motion_forces(tube, law_s1(), modes, 3.4);
  EXPECT_EQ(f.states(), 4);
  const Eigen::VectorXd w = 2.0 * std::numbers::pi * tube.frequency;
  const auto growth = [&](double v) {
    return core::general_eigenvalues(state_matrix(w.cwiseAbs2(), 0.02 * w, scaled(f, v))).real().maxCoeff();
  };
  constexpr double all_modes = 3.3372217687, left_out = 1e-6; // m/s
  EXPECT_LT(growth(all_modes - left_out), 0.0);
  EXPECT_GT(growth(all_modes + left_out), 0.0);
}

// A mode that is not coupled keeps frequency and damping that the law gives it in harmonic motion.
TEST(Fluidelastic, FastModesFeelTheLawAtTheirFrequency) {
  const FluidelasticLaw law = quasi_steady_law(0.2, 0.1, Eigen::Matrix2d{{0.3, 0.1}, {-0.2, -8.0}}, 1.0);
  const Sampling one = metre(s1, 0.1); // V/(f D) = 0.26
  const core::MotionForces fast = motion_forces(one, law, 1, 1.0);
  EXPECT_EQ(fast.states(), 0);
  EXPECT_GT(motion_forces(one, law, 1, 1.2).states(), 0);
  const auto upper = [](const Eigen::VectorXcd& roots) {
    return *std::max_element(roots.begin(), roots.end(), [](auto a, auto b) { return a.imag() < b.imag(); });
  };
  const Eigen::VectorXd w = 2.0 * std::numbers::pi * one.frequency;
  const std::complex<double> exact = upper(roots(one, law, s1.damping, 1.0)),
                             frozen = upper(core::general_eigenvalues(
                                 state_matrix(w.cwiseAbs2(), 2.0 * s1.damping * w, fast))),
                             dry = w(0) * std::complex<double>(-s1.damping,
                                                               std::sqrt(1.0 - s1.damping * s1.damping));
  constexpr double of_the_effect =
      0.05; // the motion decays by 1 % a radian, its frequency is not quite the mode's
  EXPECT_LT(std::abs(frozen - exact), of_the_effect * std::abs(exact - dry));
}

TEST(Fluidelastic, AskForADirection) {
  Sampling one = metre(s1, 1.0);
  one.stations[0].flow.drag.setZero();
  EXPECT_THROW((void)motion_forces(one, law_s1(), 1, no_limit), core::Error);
}

} // namespace

} // namespace fluidelastic_test
