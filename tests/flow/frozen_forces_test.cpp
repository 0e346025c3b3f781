// SPDX-License-Identifier: GPL-3.0-or-later
// Laws frozen at the frequency of each mode: published and closed-form frequencies, dampings and thresholds, modes of equal frequency.
#include "core/error.hpp"
#include "core/general_eigenvalues.hpp"
#include "flow/stability_diagram.hpp"
#include "fluidelastic_cases.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>

namespace fluidelastic_test::frozen {
namespace {

constexpr double digits = 1e-9;     // of the reference values, relative
constexpr double round_off = 1e-12; // relative

/// Rows so near that linear interpolation leaves 1e-11 of the coefficients.
FluidelasticLaw table_of(MeasuredForce (*measured)(double), double from, double to, double step) {
  std::vector<MeasuredForce> rows;
  for (double x = from; x < to; x += step)
    rows.push_back(measured(x));
  return frozen_law(rows);
}

std::complex<double> root(const Sampling& sampling, const FluidelasticLaw& law, double damping, double v) {
  const Eigen::VectorXd w = 2.0 * std::numbers::pi * sampling.frequency;
  const ForcesOverFactor forces = forces_over_factor({{sampling, 0}}, law, sampling.modes(), no_limit);
  const Eigen::VectorXcd all =
      core::general_eigenvalues(state_matrix(w.cwiseAbs2(), 2.0 * damping * w, forces(v)));
  return *std::max_element(all.begin(), all.end(), [](auto a, auto b) { return a.imag() < b.imag(); });
}

StabilityDiagram diagram(const Sampling& sampling, const FluidelasticLaw& law, double damping, double last) {
  const Eigen::VectorXd w = 2.0 * std::numbers::pi * sampling.frequency;
  std::vector<double> factors;
  for (int i = 0; i <= 20; ++i)
    factors.push_back(last * i / 20);
  return stability_diagram(w.cwiseAbs2(), 2.0 * damping * w,
                           forces_over_factor({{sampling, 0}}, law, sampling.modes(), no_limit), factors);
}

/// One metre of tube with two modes of equal frequency, turned from drag and lift. @param turn  rad
Sampling two_directions(double turn) {
  Sampling two = metre(s1, 1.0);
  two.frequency = Eigen::Vector2d(s1.frequency, s1.frequency);
  two.modal_mass = Eigen::Vector2d::Ones();
  two.stations[0].shapes = Eigen::Matrix3Xd::Zero(3, 2);
  two.stations[0].shapes.topRows(2) = Eigen::Rotation2Dd(turn).toRotationMatrix() / std::sqrt(s1.mass);
  return two;
}

/// Measured coefficients of a cell of tubes (A1); frequency and damping published with Code_Aster's test SDLL117A.
TEST(FrozenForces, OfAPinnedTubeArePublished) {
  Sampling tube = pinned(1, 0.0, 1.0);
  tube.frequency(0) = 33.384181674; // Hz, dry
  for (Station& station : tube.stations)
    station.flow.density = 1000.0;
  const std::complex<double> s = root(tube, table_of(a1, 2.3, 2.6, 1e-5), 0.03, 1.5);
  EXPECT_NEAR(frequency_of(s), 32.28970218, 1e-8 * 32.0);
  EXPECT_NEAR(damping_of(s), 8.9435177660e-3, digits * 9e-3);
}

/// Below there is a window of instability at reduced velocities near 2.
TEST(FrozenForces, HaveTheThresholdOfMeasuredCoefficients) {
  const StabilityDiagram found = diagram(metre(c1, 1.0), table_of(a3, 1.5, 8.0, 1e-5), c1.damping, 4.0);
  ASSERT_EQ(found.crossings.size(), 3u);
  const Crossing& last = found.crossings.back();
  EXPECT_TRUE(found.crossings[0].to_unstable && !found.crossings[1].to_unstable && last.to_unstable);
  EXPECT_NEAR(last.factor, 3.4488399331, digits * 3.4);
  EXPECT_NEAR(frequency_of(last.root), 28.5033004825, 1e-8 * 28.0);
}

/// zeta = zeta_0 (1 - (V/V_c)^2), V_c = K f D (m delta/(rho D^2))^(1/2), in every direction.
TEST(FrozenForces, HaveConnorsDampingOverTheVelocity) {
  constexpr double critical = 0.8237621096;
  const FluidelasticLaw law = connors_damping_law(3.0);
  for (const double v : {0.3, 0.6, 1.2}) {
    const std::complex<double> s = root(two_directions(0.4), law, s1.damping, v);
    EXPECT_NEAR(damping_of(s), s1.damping * (1.0 - v * v / (critical * critical)), digits);
    EXPECT_NEAR(frequency_of(s), s1.frequency, digits * s1.frequency);
  }
  const StabilityDiagram found = diagram(metre(s1, 1.0), law, s1.damping, 1.5);
  ASSERT_NE(found.critical(), nullptr);
  EXPECT_NEAR(found.critical()->factor, critical, digits);
}

TEST(FrozenForces, OfEqualFrequenciesDoNotDependOnTheAxesOfTheModes) {
  const FluidelasticLaw law = frozen_law({a3(3.0), a3(4.0), a3(6.0)});
  const auto sorted = [&](double turn) {
    const StabilityDiagram found = diagram(two_directions(turn), law, s1.damping, 2.0);
    std::vector<std::complex<double>> out(found.roots.row(20).begin(), found.roots.row(20).end());
    std::sort(out.begin(), out.end(), [](auto a, auto b) { return a.imag() < b.imag(); });
    return out;
  };
  const auto along = sorted(0.0), turned = sorted(0.6);
  EXPECT_GT(std::abs(along[0] - along[1]), 1e-3 * std::abs(along[0])) << "lift alone is moved";
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_LT(std::abs(along[k] - turned[k]), round_off * std::abs(along[k]));
}

/// c_k of one row is constant: m w^2 = q c_k.
TEST(FrozenForces, DivergeWhereTheyOutweighTheStiffness) {
  const StabilityDiagram found = diagram(metre(s1, 1.0), frozen_law({{3.0, 2.0, -0.5}}), s1.damping, 8.0);
  const double w = 2.0 * std::numbers::pi * s1.frequency;
  ASSERT_NE(found.critical(), nullptr);
  EXPECT_EQ(found.critical()->root, std::complex<double>());
  EXPECT_NEAR(found.critical()->factor, std::sqrt(s1.mass * w * w / s1.density), digits * 7.0);
}

TEST(FrozenForces, OfConnorsNeedAFrequency) {
  Sampling rigid = metre(s1, 1.0);
  rigid.frequency(0) = 0.0;
  const ForcesOverFactor forces = forces_over_factor({{rigid, 0}}, connors_damping_law(3.0), 1, no_limit);
  EXPECT_THROW((void)forces(1.0), core::Error);
}

} // namespace
} // namespace fluidelastic_test::frozen
