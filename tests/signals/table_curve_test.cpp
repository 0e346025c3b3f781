// SPDX-License-Identifier: GPL-3.0-or-later
// The curve through the rows of a displacement table: its shape, its smoothness, its order.
#include "signals/prescribed_motion.hpp"
#include "signals/table_curve.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace table_curve_test {

using namespace fretwork::signals;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double round_off = 1e-13; // of the largest value
constexpr int places = 64;          // between two rows

/// How far the motion of a table leaves the range of the two rows about it, over the table's whole range.
double excess(const Table& table) {
  const MotionSignal motion(motion_of_displacement(table), table.time.back());
  const auto [low, high] = std::minmax_element(table.value.begin(), table.value.end());
  double out = 0.0;
  for (std::size_t i = 0; i + 1 < table.time.size(); ++i)
    for (int k = 0; k <= places; ++k) {
      const double t = table.time[i] + (table.time[i + 1] - table.time[i]) * k / places;
      const double s = motion(t).displacement;
      out = std::max({out, s - std::max(table.value[i], table.value[i + 1]),
                      std::min(table.value[i], table.value[i + 1]) - s});
    }
  return out / (*high - *low);
}

/// Largest errors of displacement and velocity of a table of a curve, over the duration 1.
struct Errors {
  double displacement = 0.0, velocity = 0.0;
};
template <class Curve> Errors errors(const Curve& curve, int rows) {
  Table table;
  for (int i = 0; i <= rows; ++i) {
    table.time.push_back(static_cast<double>(i) / rows);
    table.value.push_back(curve(table.time.back()).displacement);
  }
  const MotionSignal motion(motion_of_displacement(table), 1.0);
  Errors out;
  constexpr int samples = 4000;
  for (int k = 0; k <= samples; ++k) {
    const double t = static_cast<double>(k) / samples;
    const MotionState exact = curve(t), found = motion(t);
    out.displacement = std::max(out.displacement, std::abs(found.displacement - exact.displacement));
    out.velocity = std::max(out.velocity, std::abs(found.velocity - exact.velocity));
  }
  return out;
}

/// Orders over four halvings of the interval.
template <class Curve>
void expect_orders(const Curve& curve, int rows, double displacement, double velocity) {
  constexpr double near = 0.4; // of the asymptotic order
  Errors last = errors(curve, rows);
  for (int k = 0; k < 4; ++k) {
    rows *= 2;
    const Errors now = errors(curve, rows);
    EXPECT_NEAR(std::log2(last.displacement / now.displacement), displacement, near) << rows;
    EXPECT_NEAR(std::log2(last.velocity / now.velocity), velocity, near) << rows;
    last = now;
  }
}

} // namespace

TEST(TableCurve, HoldsWhereRowsAreEqual) {
  const Table table{{0.0, 0.3, 0.5, 2.0}, {0.0, 0.0, 2e-3, 2e-3}};
  const MotionSignal motion(motion_of_displacement(table), 2.0);
  for (const double t : {0.0, 0.1, 0.15, 0.2, 0.29, 0.3}) {
    EXPECT_NEAR(motion(t).displacement, 0.0, round_off) << t;
    EXPECT_NEAR(motion(t).velocity, 0.0, round_off) << t;
  }
  for (const double t : {0.5, 0.6, 1.0, 2.0})
    EXPECT_NEAR(motion(t).displacement, 2e-3, round_off) << t;
  EXPECT_LT(excess(table), round_off);
}

TEST(TableCurve, KeepsWithinTheRowsOfItsInterval) {
  EXPECT_LT(excess({{0.0, 0.2, 0.4, 0.8, 2.0}, {0.0, 1e-3, 0.0, 2e-3, 1e-3}}), round_off);
  EXPECT_LT(excess({{0.0, 1.0, 2.0, 3.0}, {0.0, 1.0, 1.0, 0.0}}), round_off); // ramp, hold, ramp
  EXPECT_LT(excess({{0.0, 0.1, 0.9, 1.0}, {0.0, 0.05, 0.95, 1.0}}), round_off);
}

TEST(TableCurve, OfRandomRowsStaysMonotoneAndHasAContinuousVelocity) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int draw = 0; draw < 300; ++draw) {
    Table table{{0.0}, {0.0}};
    for (int i = 0; i < 12; ++i) {
      table.time.push_back(table.time.back() + 0.01 + uniform(generator));
      const double step = std::max(0.0, uniform(generator) - 0.3); // holds too
      table.value.push_back(table.value.back() + (draw % 2 == 0 ? step : -step));
    }
    EXPECT_LT(excess(table), round_off) << draw;
    const MotionSignal motion(motion_of_displacement(table), table.time.back());
    const std::vector<double> slope = shape_preserving_slopes(table);
    for (std::size_t i = 0; i < slope.size(); ++i) {
      EXPECT_NEAR(motion(table.time[i]).velocity, slope[i], 1e-10) << draw; // of some tens 1/s
      EXPECT_NEAR(motion(table.time[i]).displacement, table.value[i], 1e-12) << draw;
    }
  }
}

TEST(TableCurve, OfRowsThatTurnKeepsWithinThemButForSmoothMaxima) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int draw = 0; draw < 300; ++draw) {
    Table table{{0.0}, {0.0}};
    for (int i = 0; i < 12; ++i) {
      table.time.push_back(table.time.back() + 0.01 + uniform(generator));
      table.value.push_back((i % 2 == 0 ? 1.0 : -1.0) * uniform(generator)); // up and down: nothing is smooth
    }
    EXPECT_LT(excess(table), round_off) << draw;
  }
}

TEST(TableCurve, IsOfOrderFourThroughRowsOfASmoothCurve) {
  // its maxima lie between rows, wherever these stand: 12 rows a period or more
  for (const int rows : {24, 25, 26, 27, 29, 31})
    expect_orders(
        [](double t) {
          const double w = 4.0 * pi;
          return MotionState{1.0 - std::cos(w * t), w * std::sin(w * t)};
        },
        rows, 4.0, 3.0);
}

TEST(TableCurve, IsOfOrderTwoWhereASmoothRampEndsInAHold) {
  // the acceleration jumps at 0.3 and 0.7, where rows stand
  expect_orders(
      [](double t) {
        const double w = pi / 0.4, x = std::clamp(t - 0.3, 0.0, 0.4);
        return MotionState{0.5 * (1.0 - std::cos(w * x)), 0.5 * w * std::sin(w * x)};
      },
      50, 2.0, 1.0);
}

} // namespace table_curve_test
