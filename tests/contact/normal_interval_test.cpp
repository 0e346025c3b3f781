// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/normal_interval.hpp"
#include "contact/restitution.hpp"
#include "oscillator_in_time.hpp"
#include "restitution_of_ratio.hpp"
#include "uniform.hpp"
#include <gtest/gtest.h>
#include <numbers>

namespace normal_interval_test {

using namespace fretwork;
using namespace fretwork::contact;

namespace {

constexpr double round_off = 1e-12;
/// What the phase of ten periods may miss, rad: kappa is a series to x^8.
double next_order(double x) { return 2e-6 * std::pow(x, 10) + 1e-9; }

/// A free mass of 1 kg.
struct Mass {
  double penetration = 0.0, rate = 1.0; ///< m, m/s
  /// @param most_mobile  1/kg: of the damper's growth
  NormalInterval move(const NormalLaw& law, double dt, double load = 0.0, double most_mobile = 1.0) {
    const NormalInterval n =
        normal_over_interval(law, dt, 1.0, 0.0, growing_damping(law.damping, law.damping * most_mobile * dt),
                             {penetration, penetration + dt * (rate + 0.5 * dt * load), rate, load});
    penetration = n.end;
    rate += dt * (load - n.force);
    return n;
  }
};

/// An impact at 1 m/s, w_c = 1 rad/s.
struct Impact {
  double speed = 0.0, time = 0.0, lost = 0.0; ///< m/s, s, J: rebound, time with a force, by the damper
};
/// It touches at this share of an interval, and the interval in which it opens ends there.
Impact impact(const NormalLaw& law, double dt, double phase) {
  Impact out;
  Mass mass;
  for (double length = (1.0 - phase) * dt;; length = dt) {
    const Mass before = mass;
    NormalInterval n = mass.move(law, length);
    const bool opens = n.to < 1.0;
    if (opens) {
      length *= n.to;
      mass = before;
      n = mass.move(law, length);
    }
    out.time += length;
    out.lost += n.damper_work;
    EXPECT_NEAR(n.course.mean * n.to, n.force, round_off);
    if (opens || out.time > 100.0)
      break;
  }
  out.speed = -mass.rate;
  return out;
}

constexpr int phases = 40;
/// Mean over the places of the touch in an interval.
Impact mean_impact(const NormalLaw& law, double dt) {
  Impact out;
  for (int i = 0; i < phases; ++i) {
    const Impact one = impact(law, dt, (i + 0.5) / phases);
    out.speed += one.speed / phases;
    out.time += one.time / phases;
    out.lost += one.lost / phases;
  }
  return out;
}

} // namespace

TEST(NormalInterval, KeepsTheEnergyOfAClosedContactHoweverTimeIsDivided) {
  tests::Uniform draw(3);
  const NormalLaw law{1.0};
  for (const double longest : {0.1, 0.8, 1.7, 5.0}) {
    Mass mass{10.0, 0.5};
    constexpr double load = 10.0;
    const auto energy = [&] {
      return 0.5 * mass.rate * mass.rate + law.spring_energy(mass.penetration) - load * mass.penetration;
    };
    const double before = energy();
    double lost = 0.0;
    for (int i = 0; i < 1000; ++i)
      lost += mass.move(law, draw(0.01, 1.0) * longest, load).damper_work;
    EXPECT_NEAR(energy(), before, 1e-10) << longest;
    EXPECT_NEAR(lost, 0.0, 1e-10) << longest;
  }
}

TEST(NormalInterval, KeepsTheEnergyOfAnImpactWithoutLosses) {
  // but for what the spring bears where the parabola of its force ends
  for (const double dt : {0.1, 0.4, 0.8})
    for (int i = 0; i < phases; ++i)
      EXPECT_NEAR(impact({1.0}, dt, (i + 0.5) / phases).speed, 1.0, 1e-3 * std::pow(dt, 4))
          << dt << ", phase " << i;
}

TEST(NormalInterval, HasTheFrequencyOfTheContact) {
  // the phase after ten periods
  for (const double dt : {0.25, 0.5, 1.0, 1.5}) {
    Mass mass{10.0, 0.5};
    const int count = static_cast<int>(std::lround(20.0 * std::numbers::pi / dt));
    for (int i = 0; i < count; ++i)
      (void)mass.move({1.0}, dt, 10.0);
    const double phase = std::atan2(10.0 - mass.penetration, mass.rate); // behind
    EXPECT_NEAR(std::remainder(-phase - count * dt, 2.0 * std::numbers::pi), 0.0, next_order(dt)) << dt;
  }
}

TEST(NormalInterval, RestsWhereTheLawRests) {
  constexpr double load = 0.3, stiffness = 2.0;
  for (const double dt : {0.1, 1.0, 10.0})
    for (const double damping : {0.0, 0.4, 50.0}) {
      Mass mass{load / stiffness, 0.0};
      const NormalInterval n = mass.move({stiffness, damping}, dt, load);
      EXPECT_NEAR(n.force, load, 1e-10)
          << dt << " " << damping; // of the way without force, which is large against the penetration
      EXPECT_NEAR(n.growth, 0.0, 1e-8);
      EXPECT_NEAR(n.end, load / stiffness, 1e-10 * load * dt * dt + round_off);
    }
}

// v0 z/(1 - e^-z) over the mean of a speed that decays as e^-z; 0.8 is where the series of c' ends.
TEST(NormalInterval, HasTheMeanOfASpeedThatADamperTakesDown) {
  for (const double z : {0.0, 1e-9, 1e-3, 0.1, 0.5, 0.799, 0.801, 2.0, 30.0, 1e4}) {
    const double mean = z > 0.0 ? -std::expm1(-z) / z : 1.0, beta = 0.5 + z * growing_damping(1.0, z) / 12.0;
    EXPECT_NEAR(mean * (1.0 + beta * z), 1.0, 1e-15) << z;
    EXPECT_DOUBLE_EQ(growing_damping(3.0, z), 3.0 * growing_damping(1.0, z)) << z;
  }
}

TEST(NormalInterval, FollowsADamperByItself) {
  // a spring so soft that the speed decays as e^-z
  for (const double z : {0.1, 1.0, 3.0, 30.0}) {
    Mass mass;
    (void)mass.move({1e-9, z}, 1.0);
    EXPECT_NEAR(mass.rate, std::exp(-z), 1e-8) << z;
  }
}

TEST(NormalInterval, LosesWhatItsDampersTakeToOrderFour) {
  for (const NormalLaw& law : {NormalLaw{1.0, 0.1}, NormalLaw{1.0, 0.28}, NormalLaw{1.0, 0.6}}) {
    const double e = tests::restitution_of_ratio(0.5 * law.damping);
    EXPECT_LT(std::abs(mean_impact(law, 0.8).speed / e - 1.0), 3e-3) << law.damping;
    EXPECT_LT(std::abs(mean_impact(law, 0.4).speed / e - 1.0), 3e-4) << law.damping;
  }
  const NormalLaw hunt_crossley{1.0, 0.0, 0.4};
  const double fine = mean_impact(hunt_crossley, 0.01).speed;
  EXPECT_LT(std::abs(mean_impact(hunt_crossley, 0.8).speed / fine - 1.0), 3e-3);
  EXPECT_LT(std::abs(mean_impact(hunt_crossley, 0.4).speed / fine - 1.0), 3e-4);
}

TEST(NormalInterval, BouncesOffADamperOfHuntAndCrossleyHoweverFast) {
  for (const double d : {2.0, 5.0, 15.0}) { // of 1 m/s
    const double fine = impact({1.0, 0.0, d}, 1e-3 / (1.0 + d), 0.0).speed;
    for (const double dt : {0.2, 0.8}) // the last is hardly resolved
      EXPECT_NEAR(mean_impact({1.0, 0.0, d}, dt).speed, fine, dt * d < 10.0 ? 0.02 : 0.12) << d << " " << dt;
  }
  for (const double d : {60.0, 1000.0, 1e6}) // not resolved: no energy comes of it
    for (const double dt : {0.2, 0.8})
      EXPECT_LT(mean_impact({1.0, 0.0, d}, dt).speed, 1.0 + round_off) << d << " " << dt;
}

TEST(NormalInterval, IsOfOrderFourAlsoWhereTheDamperGrowsByALargerMobility) {
  const NormalLaw law{1.0, 0.6};
  const auto after = [&](double dt, double most_mobile) {
    Mass mass{10.0, 0.5};
    for (int i = 0; i < static_cast<int>(std::lround(4.0 / dt)); ++i)
      (void)mass.move(law, dt, 10.0, most_mobile);
    return mass.rate;
  };
  const double exact = after(1e-3, 1.0);
  for (const double most_mobile : {0.5, 2.0, 4.0}) {
    const double coarse = std::abs(after(0.4, most_mobile) - exact),
                 fine = std::abs(after(0.2, most_mobile) - exact);
    EXPECT_LT(coarse, 2e-3) << most_mobile;
    EXPECT_GT(std::log2(coarse / fine), 3.0) << most_mobile;
  }
}

TEST(NormalInterval, LosesNoTouchThatIsPulledOffAgain) {
  // a touch without damper at 1 m/s under -2.4 m/s2: open again within the interval
  Mass mass;
  const NormalInterval n = mass.move({1.0}, 0.8, -2.4);
  EXPECT_GT(n.to, 0.5);
  EXPECT_LT(n.to, 1.0);
  EXPECT_NEAR(0.8 * n.force, 0.105, 0.01);
  Mass shorter;
  EXPECT_GT(shorter.move({1.0}, 0.9, -2.4).force, 0.0) << "outside at the end";
}

TEST(NormalInterval, HasTheCourseOfItsForce) {
  // half a sine: its ends, its largest value, the mean of its square
  const NormalLaw law{1.0};
  Mass mass;
  double square = 0.0, largest = 0.0, last = 0.0;
  constexpr int count = 6;
  constexpr double dt = std::numbers::pi / count;
  for (int i = 0; i < count; ++i) {
    const NormalInterval n = mass.move(law, dt);
    square += n.to * n.course.square() / count;
    largest = std::max(largest, n.course.largest());
    EXPECT_NEAR(n.course.first, last, 2e-3) << i;
    last = n.course.last;
    EXPECT_NEAR(n.course.at(0.5), std::sin((i + 0.5) * dt), 2e-3) << i;
  }
  EXPECT_NEAR(square, 0.5, 1e-3);
  EXPECT_NEAR(largest, 1.0, 2e-3);
}

TEST(NormalInterval, OpensWhereItsForceEndsInside) {
  // pulled off and pressed again within the interval: a parabola with both ends above 0
  const NormalInterval n =
      normal_over_interval({1.0}, 4.0, 0.05, 0.0, 0.0, {1.0, 1.0 - 4.0 * 1.2 + 0.5 * 16.0 * 0.6, -1.2, 0.6});
  EXPECT_LT(n.to, 1.0);
  EXPECT_GT(n.to, 0.1);
}

TEST(NormalInterval, OpensEarlyInAnIntervalUnderAnyDissipation) {
  constexpr double dt = 0.6, leaving = -0.9;
  for (const double dissipation : {0.0, 1e-9, 0.1})
    for (const double start : {0.02, 0.1, 0.3}) {
      const NormalLaw law{1.0, 0.0, dissipation};
      Mass one{start, leaving}, many{start, leaving};
      const NormalInterval n = one.move(law, dt);
      double time = 0.0, impulse = 0.0;
      for (double to = 1.0; to == 1.0 && time < dt;) {
        const NormalInterval part = many.move(law, 1e-3 * dt);
        to = part.to;
        time += to * 1e-3 * dt;
        impulse += part.force * 1e-3 * dt;
      }
      // the force of the law beyond the opening is no parabola
      const double tolerance = 0.03 + 0.2 * dissipation;
      EXPECT_NEAR(n.to * dt / time, 1.0, tolerance) << dissipation << " " << start;
      EXPECT_NEAR(n.force * dt / impulse, 1.0, tolerance) << dissipation << " " << start;
    }
}

TEST(NormalInterval, TurnsNoSpeedRoundByAStiffDamper) {
  // xi = 3.7 leaves 1.6 %, whatever dt; 1e4: nothing
  for (const double dt : {0.01, 0.1, 0.5, 1.0})
    EXPECT_NEAR(mean_impact({1.0, 7.4}, dt).speed, 0.0163, 4e-3) << dt;
  for (const double dt : {0.01, 0.3})
    EXPECT_LT(std::abs(impact({1.0, 2e4}, dt, 0.5).speed), 1e-3) << dt;
}

// In one interval, from two states, on its spring and damper.
TEST(NormalInterval, EndsWhereAMassOnASpringAndADamperIsInTime) {
  for (const double dt : {0.5, 1.0, 1.6})
    for (const double ratio : {0.02, 0.1, 0.3, 0.7, 1.1})
      for (const auto& [p0, v0] : {std::pair(1.0, 0.3), {0.8, -0.05}}) {
        SCOPED_TRACE(testing::Message() << dt << " " << ratio << " " << v0);
        constexpr double load = 0.6;
        const double damping = 2.0 * ratio, z = damping * dt;
        const NormalInterval n =
            normal_over_interval({1.0, damping}, dt, 1.0, 0.0, growing_damping(damping, z),
                                 {p0, p0 + dt * (v0 + 0.5 * dt * load), v0, load});
        ASSERT_EQ(n.to, 1.0);
        const tests::InTime exact = tests::oscillator_in_time(1.0, damping, load, p0, v0, dt);
        const double most = dt > 1.0 ? 1e-3 * ratio + 3e-6 : 1e-4 * ratio * dt * dt;
        EXPECT_NEAR(n.end, exact.end, most);
        EXPECT_NEAR(v0 + dt * (load - n.force), exact.rate, most);
      }
}

// It moves by W t - V t^3/6 after an impulse, and a load lifts its mean: against 20 000 steps of the midpoint rule.
TEST(NormalInterval, HasTheForceOfAStructureThatHoldsItBack) {
  constexpr double stiffness = 1.0, w = 1.0, held_back = 0.5, p0 = 0.7, v0 = 0.4, load = 0.3;
  for (const double damping : {0.0, 0.1})
    for (const double dt : {0.5, 1.0}) {
      // p'' = load - W f + V (integral of the impulse of f); the lift is that of a load (t - dt/2)^2 - dt^2/12, which leaves the ends where they are
      const double lift = 5e-3 * std::pow(dt, 4), fourth = 720.0 * lift / std::pow(dt, 4);
      constexpr int steps = 20000;
      const double tau = dt / steps;
      double p = p0, v = v0, impulse = 0.0, second = 0.0, force_sum = 0.0;
      for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) * tau - 0.5 * dt;
        const double f = stiffness * (p + 0.5 * tau * v) + damping * v;
        const double a = load + 0.5 * fourth * (t * t - dt * dt / 12.0) - w * f + held_back * second;
        p += tau * (v + 0.5 * tau * a);
        v += tau * a;
        second += tau * (impulse + 0.5 * tau * f);
        impulse += tau * f;
        force_sum += f;
      }
      const double mobility = w - held_back * dt * dt / 12.0,
                   compliance = held_back * std::pow(dt, 4) / 180.0;
      const NormalInterval n = normal_over_interval({stiffness, damping}, dt, mobility, compliance,
                                                    growing_damping(damping, damping * mobility * dt),
                                                    {p0, p0 + dt * (v0 + 0.5 * dt * load), v0, load, lift});
      const double order4 = std::pow(dt, 4);
      EXPECT_NEAR(n.force * steps / force_sum, 1.0, 6e-4 * order4)
          << damping << " " << dt; // without Y 2.5e-3
      EXPECT_NEAR(n.end, p, 1e-3 * order4) << damping << " " << dt;
      if (damping == 0.0) {
        EXPECT_NEAR(n.damper_work, 0.0, round_off);
      }
    }
}

// As above where the force ends within the interval: the end of a motion under the force that it has had.
TEST(NormalInterval, OpensOnAStructureThatHoldsItBack) {
  constexpr double dt = 1.0, mobility = 1.0, compliance = 2e-3;
  const NormalInterval n = normal_over_interval({1.0, 0.1}, dt, mobility, compliance,
                                                growing_damping(0.1, 0.1), {0.3, 0.3 - 0.6 * dt, -0.6, 0.0});
  ASSERT_LT(n.to, 1.0);
  EXPECT_LT(n.growth, 0.0);
  EXPECT_NEAR(n.end,
              0.3 - 0.6 * dt - mobility * dt * dt * (0.5 * n.force - n.growth / 12.0) - compliance * n.growth,
              round_off);
}

// Hunt and Crossley's law on such a structure moves by the same equations, G with its damper.
TEST(NormalInterval, GrowsWithHuntAndCrossleysDamperOnAStructureThatHoldsItBack) {
  constexpr double dt = 0.7, mobility = 1.0, d = 0.4, p0 = 0.5, v0 = 0.4;
  for (const double compliance : {0.0, 5e-3, 0.06}) { // 0.06: more than W dt^2/12
    const NormalInterval n =
        normal_over_interval({1.0, 0.0, d}, dt, mobility, compliance, 0.0, {p0, p0 + v0 * dt, v0, 0.0});
    ASSERT_EQ(n.to, 1.0);
    const double v1 = v0 - mobility * dt * n.force,
                 stiffness = linear_terms(1.0, mobility, dt * dt / 12.0, 0.0, 0.0).stiffness;
    EXPECT_NEAR(n.growth, stiffness * (n.end - p0) + d * (n.end * v1 - p0 * v0), 1e-10) << compliance;
    EXPECT_NEAR(n.end,
                p0 + v0 * dt - mobility * dt * dt * (0.5 * n.force - n.growth / 12.0) - compliance * n.growth,
                1e-10)
        << compliance;
  }
}

// Along a direction in which nothing moves the contact its mobility is round-off, of either sign.
TEST(NormalInterval, HasTheForceOfTheSpringWhereItsMobilityIsRoundOff) {
  constexpr double stiffness = 1e6, depth = 1e-5, dt = 1e-4;
  for (const double mobility : {-1e-17, 0.0, 1e-17})
    for (const double acceleration : {-1e-3, 0.0, 1e-6}) {
      const NormalInterval n =
          normal_over_interval({stiffness}, dt, mobility, 0.0, 0.0,
                               {depth, depth + 0.5 * acceleration * dt * dt, 0.0, acceleration});
      EXPECT_NEAR(n.force, stiffness * depth, 1e-5) << mobility << " " << acceleration;
    }
}
} // namespace normal_interval_test
