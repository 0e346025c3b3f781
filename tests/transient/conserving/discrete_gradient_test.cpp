// SPDX-License-Identifier: GPL-3.0-or-later
// The mean direction of a step's normal force: its work is the change of the gap, whatever the step.
#include "transient/conserving/discrete_gradient.hpp"
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace discrete_gradient_test {

using namespace fretwork;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::PlaneAxis;
using contact::PlanePoint;

namespace {

constexpr double round_off = 2e-15; // a few roundings of positions of about 1

/// A quatrefoil: lobes and protruding lands.
contact::Profile quatrefoil() {
  std::vector<contact::PolarPoint> points;
  for (int i = 0; i < 24; ++i) {
    const double angle = 0.01 + i * 2.0 * std::numbers::pi / 24;
    points.push_back({angle, 1.0 + 0.25 * std::cos(4.0 * angle)});
  }
  return contact::Profile(points);
}

std::vector<contact::Obstacle> obstacles() {
  return {contact::Circle{0.5},
          contact::PlanePair{0.5, PlaneAxis::y},
          contact::PlanePair{0.5, PlaneAxis::z},
          contact::Stop{0.5, PlaneAxis::z},
          contact::RoundPair{0.5},
          contact::FacingPlanes{0.5, PlaneAxis::y, -1.0},
          quatrefoil()};
}

struct Random {
  std::mt19937 engine{7};
  std::uniform_real_distribution<double> side{-1.5, 1.5};
  PlanePoint point() {
    const double y = side(engine);
    return {y, side(engine)};
  }
};

DiscreteGradient at(const contact::Obstacle& o, PlanePoint x0, PlanePoint x1,
                    const PlanePoint* held = nullptr) {
  return discrete_gradient(o, x0, contact::locate(o, x0.y, x0.z), x1, held);
}

} // namespace

TEST(DiscreteGradient, TimesTheDisplacementIsTheChangeOfTheGap) {
  Random random;
  const PlanePoint held{0.3, -0.7};
  for (const contact::Obstacle& o : obstacles())
    for (int i = 0; i < 2000; ++i) {
      const PlanePoint x0 = random.point(), far = random.point();
      const double share = std::pow(10.0, -(i % 14)); // from a leap to next to nothing
      const PlanePoint x1{x0.y + share * (far.y - x0.y), x0.z + share * (far.z - x0.z)};
      const double change = contact::locate(o, x1.y, x1.z).gap - contact::locate(o, x0.y, x0.z).gap;
      for (const PlanePoint* b : {static_cast<const PlanePoint*>(nullptr), &held}) {
        const DiscreteGradient g = at(o, x0, x1, b);
        ASSERT_NEAR(g.y * (x1.y - x0.y) + g.z * (x1.z - x0.z), change, 10.0 * round_off) << o.index();
        if (!b) {
          ASSERT_LE(std::hypot(g.y, g.z), std::sqrt(2.0) + round_off);
        }
      }
    }
}

TEST(DiscreteGradient, TendsToTheNormalWithTheSquareOfTheStep) {
  const PlanePoint middle{0.43, 0.21};
  for (const contact::Obstacle& o :
       {contact::Obstacle(contact::Circle{0.5}), contact::Obstacle(contact::RoundPair{0.5})}) {
    const auto error = [&](double d) {
      const DiscreteGradient g =
          at(o, {middle.y - 0.6 * d, middle.z - 0.8 * d}, {middle.y + 0.6 * d, middle.z + 0.8 * d});
      const auto n = contact::locate(o, middle.y, middle.z);
      return std::hypot(g.y - n.ny, g.z - n.nz);
    };
    EXPECT_NEAR(std::log2(error(2e-3) / error(1e-3)), 2.0, 0.01);
  }
}

TEST(DiscreteGradient, IsTheNormalWhereThatDoesNotTurn) {
  const auto expect = [](const contact::Obstacle& o, PlanePoint x0, PlanePoint x1) {
    const DiscreteGradient g = at(o, x0, x1);
    const auto n = contact::locate(o, x1.y, x1.z);
    EXPECT_EQ(g.y, n.ny) << o.index();
    EXPECT_EQ(g.z, n.nz) << o.index();
  };
  expect(contact::PlanePair{0.5, PlaneAxis::y}, {0.3, -0.2}, {0.7, 0.9});
  expect(contact::PlanePair{0.5, PlaneAxis::z}, {0.3, -0.2}, {0.7, -0.9});
  expect(contact::Stop{0.5, PlaneAxis::y}, {0.3, -0.2}, {0.7, 0.9});
  expect(contact::FacingPlanes{0.5, PlaneAxis::z, 1.0}, {0.3, -0.2}, {0.7, 0.9});
  const contact::PolarPoint square[] = {{0.0, 1.0}, {1.5707963, 1.0}, {3.1415926, 1.0}, {4.712388, 1.0}};
  expect(contact::Profile(square), {0.4, 0.3}, {0.7, 0.6});
}

TEST(DiscreteGradient, IsFiniteAtTheCentreAndAtRest) {
  for (const contact::Obstacle& o : obstacles())
    for (const PlanePoint x : {PlanePoint{0.0, 0.0}, PlanePoint{0.3, 0.4}}) {
      const DiscreteGradient g = at(o, x, x);
      for (const double v : {g.y, g.z, g.yy, g.yz, g.zy, g.zz})
        EXPECT_TRUE(std::isfinite(v)) << o.index();
      EXPECT_NEAR(std::hypot(g.y, g.z), 1.0, round_off) << o.index();
    }
}

TEST(DiscreteGradient, HasTheDerivativesOfItsDifferences) {
  Random random;
  constexpr double d = 1e-6,
                   of_differences = 2e-8; // d^2 and round-off over d, second derivatives of about 10
  const PlanePoint held{0.3, -0.7};
  int compared = 0;
  for (const contact::Obstacle& o : obstacles())
    for (int i = 0; i < 300; ++i) {
      const PlanePoint x0 = random.point(), x1 = random.point();
      if (std::hypot(x1.y - x0.y, x1.z - x0.z) < 0.3 || std::hypot(x1.y, x1.z) < 0.2)
        continue;
      for (const PlanePoint* b : {static_cast<const PlanePoint*>(nullptr), &held}) {
        const DiscreteGradient g = at(o, x0, x1, b), yp = at(o, x0, {x1.y + d, x1.z}, b),
                               ym = at(o, x0, {x1.y - d, x1.z}, b), zp = at(o, x0, {x1.y, x1.z + d}, b),
                               zm = at(o, x0, {x1.y, x1.z - d}, b);
        if (std::hypot(yp.ny - ym.ny, zp.nz - zm.nz) > 1e-3 ||
            std::hypot(yp.nz - ym.nz, zp.ny - zm.ny) > 1e-3)
          continue; // across a jump of the normal
        if (std::abs(yp.ny - g.ny - (g.ny - ym.ny)) + std::abs(zp.nz - g.nz - (g.nz - zm.nz)) > 1e-9)
          continue; // across the edge of a facet, where its derivative jumps
        ++compared;
        EXPECT_NEAR(g.yy, (yp.y - ym.y) / (2 * d), of_differences) << o.index();
        EXPECT_NEAR(g.zy, (yp.z - ym.z) / (2 * d), of_differences) << o.index();
        EXPECT_NEAR(g.yz, (zp.y - zm.y) / (2 * d), of_differences) << o.index();
        EXPECT_NEAR(g.zz, (zp.z - zm.z) / (2 * d), of_differences) << o.index();
      }
    }
  EXPECT_GT(compared, 2000);
}

} // namespace discrete_gradient_test
