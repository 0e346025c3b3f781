// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "core/symmetric.hpp"
#include "hand_made.hpp"
#include <random>

namespace fretwork::flow::sampling_test {
namespace {

using tests::HandMade;
using tests::liquid_zone;
using tests::pi;

constexpr double round_off = 1e-12; ///< relative, of sums of a hundred terms

TEST(FlowSampling, IntegratesTheMassOfTheElements) {
  // motion across a straight tube: the mass matrix of the elements is consistent with the same shapes
  HandMade hand = tests::pinned_tube(tests::tube_property(), 2.0, 5, {1.0, 2.0, 3.0});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (Eigen::Index i = 0; i < 3; ++i)
    for (const Index node : hand.nodes)
      hand.set_shape(i, node, {number(random), number(random), 0.0}, {number(random), number(random), 0.0});
  const Eigen::VectorXd share =
      transverse_share(sample(hand.tube(), Profile({liquid_zone("a", 0.3, 1.1, 740, 1)}, 2.0), hand.basis));
  for (Eigen::Index i = 0; i < 3; ++i) {
    double expected = 0.0;
    for (const fem::Beam& beam : hand.builder.model.beams) {
      fem::Vector12 u;
      u << hand.basis.shapes.col(i).segment<6>(hand.basis.row_of(beam.a)),
          hand.basis.shapes.col(i).segment<6>(hand.basis.row_of(beam.b));
      expected += u.dot(fem::BeamElement(hand.builder.model, beam).mass() * u);
    }
    EXPECT_NEAR(share(i), expected, round_off * expected);
  }
}

TEST(FlowSampling, IsExactForLinearTablesAndCubicShapes) {
  // one element with a cubic shape: rho V^2 |phi|^2 of degree 9, cut by the rows of the tables
  HandMade hand;
  hand.nodes =
      hand.builder.line(Vec3::Zero(), Vec3::UnitZ(), 1, hand.builder.property(tests::tube_property()));
  hand.set_frequencies({1.0});
  hand.set_shape(0, hand.nodes[0], Vec3::Zero(), Vec3::Zero());
  hand.set_shape(0, hand.nodes[1], Vec3::UnitX(), {0, 3.0, 0}); // s^3
  Zone zone = liquid_zone("a", 0.25, 1.0, 0.0, 0.0);
  zone.velocity = ScalarVelocity{{{0.25, 1.0}, {0.25, 1.0}}};                         // s
  zone.fluid = SinglePhase{Phase::liquid, {{0.25, 0.5, 1.0}, {0.5, 1.0, 1.0}}, 1e-7}; // 2 s, then 1
  const Sampling sampling = sample(hand.tube(), Profile({zone}, 1.0), hand.basis);
  double energy = 0.0, length = 0.0;
  for (const Station& p : sampling.stations) {
    energy += p.weight * p.flow.density * std::pow(p.flow.velocity, 2) * p.shapes.col(0).squaredNorm();
    length += p.weight;
  }
  const double expected =
      2.0 * (std::pow(0.5, 10) - std::pow(0.25, 10)) / 10.0 + (1.0 - std::pow(0.5, 9)) / 9.0; // s^9, s^8
  EXPECT_NEAR(energy, expected, round_off);
  EXPECT_NEAR(length, 1.0, round_off);
}

TEST(FlowSampling, KeepsOnlyMotionAcrossTheTube) {
  const HandMade hand = tests::pinned_tube(tests::tube_property(), 1.0, 4, {40.0, 80.0}, Vec3::UnitZ());
  const Sampling sampling = sample(hand.tube(), Profile({}, 1.0), hand.basis);
  EXPECT_EQ(transverse_share(sampling).cwiseAbs().maxCoeff(), 0.0);
}

TEST(FlowSampling, LeavesStaticModesOut) {
  HandMade hand = tests::pinned_tube(tests::tube_property(), 1.0, 4, {40.0, 80.0, 900.0});
  hand.basis.static_modes = 1;
  const Sampling sampling = sample(hand.tube(), Profile({}, 1.0), hand.basis);
  EXPECT_EQ(sampling.modes(), 2);
  EXPECT_EQ(sampling.stations[0].shapes.cols(), 2);
  EXPECT_NEAR(sampling.frequency(1), 80.0, 80.0 * round_off);
}

TEST(FlowSampling, HasTheFlowAndTheShapesAtItsAbscissae) {
  const HandMade hand = tests::pinned_tube(tests::tube_property(), 1.0, 40, {40.0});
  const Sampling sampling =
      sample(hand.tube(), Profile({liquid_zone("a", 0.5, 1.0, 740, 1.5)}, 1.0), hand.basis);
  constexpr double interpolated = 1e-7; // (pi/40)^4/384
  ASSERT_LT(sampling.stations.front().tube.s, 0.5);
  ASSERT_GT(sampling.stations.back().tube.s, 0.5);
  for (const Station& station : sampling.stations) {
    EXPECT_EQ(station.flow.velocity, station.tube.s > 0.5 ? 1.5 : 0.0) << station.tube.s;
    EXPECT_NEAR(station.shapes(0, 0), std::sin(station.tube.s * pi), interpolated) << station.tube.s;
  }
}

TEST(FlowSampling, RefusesModalMassesWithoutSense) {
  const HandMade hand = tests::pinned_tube(tests::tube_property(), 1.0, 4, {40.0, 80.0});
  tests::expect_error(
      [&] { (void)sample(hand.tube(), Profile({}, 1.0), hand.basis, Eigen::VectorXd::Ones(3)); },
      {"3 modal masses for 2 modes"});
  tests::expect_error(
      [&] { (void)sample(hand.tube(), Profile({}, 1.0), hand.basis, Eigen::Vector2d(1.0, 0.0)); },
      {"mode 2: modal mass = 0"});
}

} // namespace
} // namespace fretwork::flow::sampling_test
