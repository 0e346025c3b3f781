// SPDX-License-Identifier: GPL-3.0-or-later
// Stability diagrams: crossings against reference values and against the characteristic equation, modes that keep their names.
#include "flow/stability_diagram.hpp"
#include "fluidelastic_cases.hpp"
#include <gtest/gtest.h>

namespace fluidelastic_test::diagram {
namespace {

using Complex = std::complex<double>;

constexpr double digits = 1e-9; // of the reference values, relative

std::vector<double> evenly(double last, int points) {
  std::vector<double> out;
  for (int i = 0; i < points; ++i)
    out.push_back(last * i / (points - 1));
  return out;
}

/// Factors are velocities, m/s.
StabilityDiagram diagram(const Sampling& sampling, const FluidelasticLaw& law, double damping,
                         const std::vector<double>& factors) {
  const Eigen::VectorXd w = 2.0 * std::numbers::pi * sampling.frequency;
  return stability_diagram(w.cwiseAbs2(), 2.0 * damping * w,
                           forces_over_factor({{sampling, 0}}, law, sampling.modes(), no_limit), factors);
}
StabilityDiagram diagram(const Sampling& sampling, const FluidelasticLaw& law, double damping, double last,
                         int points = 21) {
  return diagram(sampling, law, damping, evenly(last, points));
}

double critical(const Sampling& sampling, const FluidelasticLaw& law, double damping, double last) {
  const StabilityDiagram found = diagram(sampling, law, damping, last);
  return found.critical() ? found.critical()->factor : 0.0;
}

TEST(StabilityDiagram, HasTheCriticalVelocitiesOfTheLaws) {
  Eigen::Matrix2d gradients = Eigen::Matrix2d::Zero();
  gradients(1, 1) = -15.5;
  const FluidelasticLaw granger = quasi_unsteady_law(0.2, 0.0, gradients, {{1.25, 0.05}, {-0.12, 0.3}});
  EXPECT_NEAR(critical(metre(c1, 1.0), granger, c1.damping, 4.0), 2.6081342741, digits * 2.6);
  EXPECT_NEAR(critical(metre(s1, 1.0), law_s1(), s1.damping, 3.0), 1.8175472134, digits * 1.8);
  gradients(1, 1) = -4.0;
  EXPECT_NEAR(critical(metre(s1, 1.0), quasi_steady_law(0.4, 0.0, gradients, 1.0), s1.damping, 2.0),
              0.9979707974, digits);
  const StabilityDiagram found = diagram(metre(s1, 1.0), law_s1(), s1.damping, 3.0);
  ASSERT_EQ(found.crossings.size(), 1u);
  EXPECT_EQ(found.crossings[0].mode, 0);
  EXPECT_NEAR(frequency_of(found.crossings[0].root), 20.11618734, 1e-8 * 20.0);
}

/// Two equal frequencies whose shapes the flow chooses.
TEST(StabilityDiagram, CouplesTwoDirectionsOfEqualFrequency) {
  FluidelasticLaw law = connors_law(3.0);
  Sampling two = metre(s1, 1.0);
  two.frequency = Eigen::Vector2d(s1.frequency, s1.frequency);
  two.modal_mass = Eigen::Vector2d::Ones();
  two.stations[0].shapes = Eigen::Matrix3Xd::Identity(3, 2) / std::sqrt(s1.mass);
  EXPECT_NEAR(critical(two, law, s1.damping, 1.5), 0.8237621096, digits);
  law.damping = -0.4 * Eigen::Matrix2d::Identity();
  EXPECT_NEAR(critical(two, law, s1.damping, 1.5), 1.0128649486, digits);
}

TEST(StabilityDiagram, OfATubeWithItsStopClosed) {
  for (const auto& [stiffness, velocity] : {std::pair(2e4, 2.5729411430), std::pair(1e5, 4.2461993963)}) {
    const double w = 2.0 * std::numbers::pi * s1.frequency, closed = std::sqrt(w * w + stiffness / s1.mass);
    Sampling held = metre(s1, 1.0);
    held.frequency(0) = closed / (2.0 * std::numbers::pi);
    EXPECT_NEAR(critical(held, law_s1(), s1.damping * w / closed, 6.0), velocity, digits * velocity);
  }
}

TEST(StabilityDiagram, OfAPinnedTubeInManyModes) {
  for (const auto& [modes, velocity] : std::vector<std::pair<Eigen::Index, double>>{
           {1, 3.3371847905}, {3, 3.3372210909}, {6, 3.3372216084}, {12, 3.3372217687}})
    EXPECT_NEAR(critical(pinned(modes, 0.25, 0.75), law_s1(), 0.01, 4.0), velocity, digits * velocity)
        << modes;
  EXPECT_NEAR(critical(pinned(6, 0.0, 1.0), law_s1(), 0.01, 4.0), 3.1792635889, digits * 3.2);
  const StabilityDiagram found = diagram(pinned(6, 0.25, 0.75), law_s1(), 0.01, 4.0);
  const Complex first = found.roots(found.roots.rows() - 1, 0);
  EXPECT_NEAR(first.real(), 1.915330586, digits * 200.0);
  EXPECT_NEAR(first.imag(), 212.385903309, digits * 200.0);
  for (Eigen::Index mode = 0; mode < 6; ++mode) // at rest as without flow
    EXPECT_NEAR(frequency_of(found.roots(0, mode)),
                33.425241258 * static_cast<double>((mode + 1) * (mode + 1)), 1e-6);
  EXPECT_NEAR(damping_of(found.roots(0, 3)), 0.01, 1e-12);
}

/// c_d is positive in a window of V_r: the tube becomes unstable, and stable again.
TEST(StabilityDiagram, FindsBothEndsOfAWindow) {
  constexpr OneDof heavy{20.0, 30.0, 2e-4, 1000.0}; // its frequency changes little
  FluidelasticLaw law;
  law.damping(1, 1) = -0.9;
  const std::pair<double, double> lags[] = {{1.5, 6.0}, {0.3, -3.0}}; // d, B
  for (const auto& [d, b] : lags)
    law.lags.push_back({d, Eigen::Vector2cd(0.0, b).asDiagonal().toDenseMatrix()});
  const StabilityDiagram found = diagram(metre(heavy, 1.0), law, heavy.damping, 12.0, 41);
  ASSERT_EQ(found.crossings.size(), 2u);
  EXPECT_TRUE(found.crossings[0].to_unstable);
  EXPECT_FALSE(found.crossings[1].to_unstable);
  EXPECT_GT(found.crossings[1].factor, 1.5 * found.crossings[0].factor);
  const double end = found.crossings[1].factor; // also where all factors lie beyond it
  EXPECT_EQ(
      diagram(metre(heavy, 1.0), law, heavy.damping, {1.1 * end, 1.2 * end, 1.3 * end}).crossings.size(), 2u);
  for (const Crossing& one : found.crossings) {
    const double v = one.factor, w0 = 2.0 * std::numbers::pi * heavy.frequency, w = one.root.imag();
    const Complex p(0.0, w * diameter / v);
    Complex force = -0.9 * p;
    for (const auto& [d, b] : lags)
      force += b * p / (p + d);
    const Complex balance = heavy.mass * Complex(w0 * w0 - w * w, 2.0 * heavy.damping * w0 * w) -
                            0.5 * heavy.density * v * v * force;
    EXPECT_LT(std::abs(balance), digits * heavy.mass * w0 * w0) << v;
  }
}

/// A rigid motion and undamped modes that the flow does not move stay what they are.
TEST(StabilityDiagram, TakesNoRoundOffForGrowth) {
  core::MotionForces forces;
  forces.stiffness = forces.damping = Eigen::MatrixXd::Zero(4, 4);
  forces.damping(1, 1) = -2.0;
  forces.input.resize(4, 0);
  forces.output.resize(0, 4);
  const Eigen::Vector4d k(0.0, 1e4, 1e6, 1e10), c = Eigen::Vector4d::Zero();
  EXPECT_TRUE(stability_diagram(
                  k, c, [&](double factor) { return scaled(forces, factor); }, evenly(3.0, 31))
                  .crossings.empty());
}

/// A static force that grows with the displacement outweighs the stiffness: m w^2 = q K.
TEST(StabilityDiagram, FindsDivergence) {
  FluidelasticLaw law;
  law.stiffness(1, 1) = 2.0;
  law.damping(1, 1) = -0.4;
  const StabilityDiagram found = diagram(metre(s1, 1.0), law, s1.damping, 9.0);
  ASSERT_EQ(found.crossings.size(), 1u);
  const double w = 2.0 * std::numbers::pi * s1.frequency;
  EXPECT_NEAR(found.crossings[0].factor, w * std::sqrt(s1.mass / s1.density), digits * 7.0);
  EXPECT_EQ(found.crossings[0].root.imag(), 0.0);
  EXPECT_EQ(found.crossings[0].mode, 0);
  EXPECT_GT(found.roots(20, 0).real(), 0.0);
}

/// Without structural damping a force along the velocity makes it grow in the slowest flow.
TEST(StabilityDiagram, TellsWhatIsUnstableFromTheStart) {
  FluidelasticLaw law;
  law.damping(1, 1) = 0.4;
  const StabilityDiagram found = diagram(metre(s1, 1.0), law, 0.0, 3.0);
  ASSERT_EQ(found.crossings.size(), 1u);
  EXPECT_EQ(found.crossings[0].factor, 0.0);
  EXPECT_TRUE(found.crossings[0].to_unstable);
  EXPECT_EQ(found.critical(), found.crossings.data());
  law.damping(1, 1) = -0.4;
  EXPECT_TRUE(diagram(metre(s1, 1.0), law, 0.0, 3.0).crossings.empty());
}

/// The flow stiffens the mode along drag past the frequency of that along lift.
TEST(StabilityDiagram, ModesKeepTheirNamesWhereFrequenciesCross) {
  FluidelasticLaw law;
  law.stiffness(0, 0) = -4.0;
  Sampling two = metre(s1, 1.0);
  two.frequency = Eigen::Vector2d(20.0, 24.0);
  two.modal_mass = Eigen::Vector2d::Ones();
  two.stations[0].shapes = Eigen::Matrix3Xd::Identity(3, 2) / std::sqrt(s1.mass);
  const StabilityDiagram found = diagram(two, law, s1.damping, 6.0);
  for (std::size_t i = 0; i < found.factors.size(); ++i) {
    const double w = 40.0 * std::numbers::pi, v = found.factors[i];
    EXPECT_NEAR(std::abs(found.roots(static_cast<Eigen::Index>(i), 0)),
                std::sqrt(w * w + 0.5 * s1.density * v * v * 4.0 / s1.mass), digits * w);
    EXPECT_NEAR(std::abs(found.roots(static_cast<Eigen::Index>(i), 1)), 48.0 * std::numbers::pi, digits * w);
  }
  EXPECT_GT(std::abs(found.roots(20, 0)), std::abs(found.roots(20, 1)));
  EXPECT_TRUE(found.crossings.empty());
}

} // namespace
} // namespace fluidelastic_test::diagram
