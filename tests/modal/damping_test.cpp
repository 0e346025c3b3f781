// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "modal/damping.hpp"
#include <array>
#include <limits>
#include <numbers>

namespace damping_test {

using namespace fretwork;
using tests::expect_error;

namespace {

modal::Basis basis() {
  modal::Basis b;
  b.omega = Eigen::Vector3d(0.0, 10.0, 40.0);
  return b;
}

} // namespace

TEST(Damping, IsOneRatioForAllModes) {
  auto b = basis();
  modal::apply_damping(b, 0.02);
  EXPECT_EQ(b.damping, Eigen::VectorXd::Constant(3, 0.02));
  EXPECT_EQ(b.damping_matrix.size(), 0);
}

TEST(Damping, IsARatioAModeAndMayListMore) {
  auto b = basis();
  modal::apply_damping(b, std::vector<double>{0.01, 0.02, 0.03, 0.04});
  EXPECT_EQ(b.damping, Eigen::Vector3d(0.01, 0.02, 0.03));
}

TEST(Damping, OfStaticModesFollowsTheirFrequencyAndEndsAList) {
  auto b = basis();
  b.static_modes = 1; // the last
  modal::apply_damping(b, std::vector<double>{0.01, 0.02});
  EXPECT_EQ(b.damping, Eigen::Vector3d(0.01, 0.02, 0.02));
  modal::apply_damping(b, std::vector<double>{0.01, 0.02, 0.03});
  EXPECT_EQ(b.damping, Eigen::Vector3d(0.01, 0.02, 0.02)) << "values beyond the true modes are not for it";
  modal::apply_damping(b, 0.05);
  EXPECT_EQ(b.damping[2], 0.05);
  modal::apply_damping(b, modal::Rayleigh{1e-3, 0.0});
  EXPECT_DOUBLE_EQ(b.damping[2], 0.02);
  expect_error([&] { modal::apply_damping(b, std::vector<double>{0.01}); },
               {"a list of 1 ratios for 2 modes"});
}

TEST(Damping, OfRayleighIsHalfAlphaOmegaPlusBetaOverOmega) {
  auto b = basis();
  modal::apply_damping(b, modal::Rayleigh{1e-3, 0.0});
  EXPECT_DOUBLE_EQ(b.damping[1], 0.005);
  EXPECT_DOUBLE_EQ(b.damping[2], 0.02);
  EXPECT_EQ(b.damping_matrix.size(), 0);
}

TEST(Damping, OfRayleighsMassTermDampsRigidModes) {
  auto b = basis();
  modal::apply_damping(b, modal::Rayleigh{0.0, 0.5});
  EXPECT_EQ(b.damping[0], 0.0);
  EXPECT_DOUBLE_EQ(b.damping[1], 0.025);
  ASSERT_EQ(b.damping_matrix.rows(), 3);
  const Eigen::Matrix3d expected = Eigen::Vector3d::Constant(0.5).asDiagonal(); // C = beta M
  EXPECT_LT((b.damping_matrix - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Damping, OfATableIsLinearBetweenItsRowsAndConstantOutside) {
  constexpr double hertz = 2.0 * std::numbers::pi;
  constexpr double round_off = 1e-15;
  modal::Basis b;
  b.omega.resize(7);
  b.omega << 0.0, 5.0 * hertz, 10.0 * hertz, 15.0 * hertz, 20.0 * hertz, 80.0 * hertz, 500.0 * hertz;
  modal::apply_damping(b, modal::DampingTable{{{10.0, 0.02}, {20.0, 0.04}, {100.0, 0.0}}});
  const std::array<double, 7> expected{0.02, 0.02, 0.02, 0.03, 0.04, 0.01, 0.0};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(b.damping[static_cast<Eigen::Index>(i)], expected[i], round_off) << i;
  EXPECT_EQ(b.damping_matrix.size(), 0);
  modal::apply_damping(b, modal::DampingTable{{{10.0, 0.02}}});
  EXPECT_EQ(b.damping, Eigen::VectorXd::Constant(7, 0.02));
}

TEST(Damping, AddsToThatOfDampers) {
  auto b = basis();
  b.damping_matrix = Eigen::Matrix3d::Ones();
  modal::apply_damping(b, 0.1);
  EXPECT_DOUBLE_EQ(b.damping_matrix(0, 0), 1.0);
  EXPECT_DOUBLE_EQ(b.damping_matrix(1, 1), 3.0);
  EXPECT_DOUBLE_EQ(b.damping_matrix(2, 2), 9.0);
  EXPECT_DOUBLE_EQ(b.damping_matrix(0, 1), 1.0);
}

TEST(Damping, RefusesWhatMakesNone) {
  auto b = basis();
  expect_error([&] { modal::apply_damping(b, -0.01); }, {"[modes] damping", "ratio = -0.01", ">= 0"});
  expect_error([&] { modal::apply_damping(b, std::numeric_limits<double>::quiet_NaN()); }, {"ratio = nan"});
  expect_error(
      [&] {
        modal::apply_damping(b, std::vector<double>{0.1, 0.2});
      },
      {"2 ratios for 3 modes", "one ratio for all"});
  expect_error(
      [&] {
        modal::apply_damping(b, std::vector<double>{0.1, -0.2, 0.1});
      },
      {"ratio of mode 2 = -0.2"});
  expect_error([&] { modal::apply_damping(b, modal::Rayleigh{-1.0, 0.0}); }, {"stiffness = -1"});
  expect_error([&] { modal::apply_damping(b, modal::Rayleigh{0.0, -2.0}); }, {"mass = -2"});
  const auto table = [&](std::vector<modal::DampingTable::Row> rows) {
    return [&b, rows = std::move(rows)] { modal::apply_damping(b, modal::DampingTable{rows}); };
  };
  expect_error(table({}), {"a table without rows", "[Hz, ratio]"});
  expect_error(table({{1.0, -0.1}}), {"ratio of the table at 1 Hz = -0.1"});
  expect_error(table({{-1.0, 0.1}}), {"frequency of the table = -1"});
  expect_error(table({{2.0, 0.1}, {2.0, 0.2}}), {"2 Hz after 2 Hz", "rise from row to row"});
}

} // namespace damping_test
