// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/instant_spring.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace fretwork::contact::instant_spring_test {
namespace {

constexpr double round_off = 1e-13;
constexpr double stiffness = 3e5, mass = 2.0, speed = 0.4;
const double frequency = std::sqrt(stiffness / mass);

/// A mass between free flights that the spring pushes once a step.
struct Impact {
  double leaves = 0.0;  ///< m/s, outwards
  double impulse = 0.0; ///< N s
  double energy = 0.0;  ///< J, when it leaves, kinetic and of the acceleration, over what it came with
  double square = 0.0;  ///< N^2 s, sum of h F^2
  double product = 0.0; ///< N^2 s, sum of h F times the force at the instant
  double time = 0.0;    ///< s, of actions with a force
  double largest = 0.0; ///< N
};

/// @param phase  0 to 1: where the instant of touch lies between two actions   @param pull  towards the spring, of its largest force
Impact impact(double resolution, double phase, double pull = 0.0) {
  const double h = resolution / frequency, acceleration = pull * speed * frequency;
  const InstantSpring spring(stiffness, 0.5 * h / mass, h);
  double p = (phase - 1.0) * h * speed, v = speed;
  const auto energy = [&] { return 0.5 * v * v - acceleration * p; };
  const double came = energy();
  Impact out;
  for (int i = 0; i < 1000 && (p > 0.0 || v > 0.0); ++i) {
    const InstantSpring::Push push =
        p > 0.0 ? spring.push(p, v - 0.5 * h * acceleration, v) : InstantSpring::Push{0.0, 0.0};
    const double force = push.force;
    EXPECT_GE(force, 0.0);
    v -= h / mass * force;
    out.energy = energy() / came;
    p += h * (v + 0.5 * h * acceleration);
    v += h * acceleration;
    out.impulse += h * force;
    out.square += h * force * force;
    out.product += h * force * push.instant;
    out.time += force > 0.0 ? h : 0.0;
    out.largest = std::max(out.largest, force);
  }
  out.leaves = -v;
  return out;
}

/// Mean over phases.
template <class Figure> double mean(double resolution, Figure figure) {
  constexpr int phases = 500;
  double sum = 0.0;
  for (int i = 0; i < phases; ++i)
    sum += figure(impact(resolution, (i + 0.5) / phases));
  return sum / phases;
}

} // namespace

TEST(InstantSpring, GivesBackTheSpeedOfAnImpactWhereverItsActionsLie) {
  for (const double resolution : {0.02, 0.1, 0.45, 0.7, 0.9, 1.0})
    for (double phase = 0.001; phase < 1.0; phase += 0.0173) {
      const Impact i = impact(resolution, phase);
      EXPECT_NEAR(i.leaves / speed, 1.0, round_off / resolution) << resolution << " " << phase;
      EXPECT_NEAR(i.impulse / (2.0 * mass * speed), 1.0, round_off / resolution);
    }
}

// Without it a pull of 1 % gives or takes 0.1 % of the energy at 0.8, in the mean over the phases.
TEST(InstantSpring, KeepsTheEnergyOfAnImpactUnderAnAcceleration) {
  for (const double resolution : {0.1, 0.45, 0.8, 1.0, 1.049})
    for (const double pull : {-0.05, -0.01, 0.01, 0.05})
      for (double phase = 0.011; phase < 1.0; phase += 0.0173)
        EXPECT_NEAR(impact(resolution, phase, pull).energy, 1.0, round_off / resolution)
            << resolution << " " << pull << " " << phase;
}

TEST(InstantSpring, TellsTheForceAtItsInstantForIntegralsOfSquares) {
  const double square = 0.5 * std::numbers::pi * stiffness * mass * speed * speed / frequency;
  for (const double resolution : {0.2, 0.45, 0.7, 0.8, 0.95, 1.0})
    EXPECT_NEAR(mean(resolution, [](const Impact& i) { return i.product; }) / square, 1.0,
                resolution < 1.0 ? 1e-3 : 4e-3)
        << resolution;
}

// A force K p, the same with the penetration averaged over the step or K p of the action alone, is 0.4 and 2 % off at 0.7.
TEST(InstantSpring, BearsTheForcesOfAnImpactInTheMean) {
  const double square = 0.5 * std::numbers::pi * stiffness * mass * speed * speed / frequency;
  const double peak = mass * frequency * speed;
  for (const double resolution : {0.2, 0.45, 0.7}) {
    const double fourth = std::pow(resolution, 4);
    EXPECT_NEAR(mean(resolution, [](const Impact& i) { return i.square; }) / square, 1.0, 0.03 * fourth);
    EXPECT_NEAR(mean(resolution, [](const Impact& i) { return i.time; }) * frequency / std::numbers::pi, 1.0,
                0.1 * fourth + 1e-3);
    EXPECT_NEAR(mean(resolution, [](const Impact& i) { return i.largest; }) / peak, 1.0,
                resolution * resolution / 20.0); // between actions: cos over half a step, in the mean
  }
}

TEST(InstantSpring, LetsAClosedContactSwingAtItsOwnFrequency) {
  for (const double resolution : {0.2, 0.7, 1.0}) {
    const double h = resolution / frequency;
    const double closed = InstantSpring(stiffness, 0.5 * h / mass, h).closed_stiffness();
    // free flight and K_h p: p(t + h) + p(t - h) = (2 - K_h h^2/m) p(t)
    EXPECT_NEAR(std::acos(1.0 - 0.5 * closed * h * h / mass) / resolution, 1.0,
                std::pow(resolution, 6) / 10000.0);
  }
}

// Euler and Maclaurin: what the sum over actions lacks of the impulse.
TEST(InstantSpring, KeepsTheImpulseOfAPathThatItDoesNotChange) {
  constexpr double h = 1e-3, rate = 0.2;
  const InstantSpring spring(stiffness, 0.0, h);
  EXPECT_EQ(spring.force(3e-4, rate), stiffness * 3e-4);
  for (const double share : {0.01, 0.3, 0.5, 0.9}) {
    const double missing = 0.5 * stiffness * h * rate * (share * share - share + 1.0 / 6.0);
    for (const double sign : {1.0, -1.0})
      EXPECT_NEAR(spring.force(share * h * rate, sign * rate), stiffness * share * h * rate + missing,
                  round_off * stiffness * h * rate);
  }
}

TEST(InstantSpring, IsTheSpringWhereTheStepIsShort) {
  const double force = stiffness * 1e-4;
  EXPECT_NEAR(InstantSpring(stiffness, 1e-9 / mass, 1e-9).force(1e-4, 0.3) / force, 1.0, 1e-9);
}

TEST(InstantSpring, IsLinearInTheMotion) {
  const InstantSpring spring(stiffness, 0.35 / frequency / mass, 0.7 / frequency);
  const double h = 0.7 / frequency;
  for (const double rate : {1.5, 0.5, 0.0, -0.5, -1.5}) // closes, stays, opens
    EXPECT_NEAR(spring.force(3.0 * h, 3.0 * rate), 3.0 * spring.force(h, rate),
                round_off * spring.force(h, rate));
}

} // namespace fretwork::contact::instant_spring_test
