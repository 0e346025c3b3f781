// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/friction_interval.hpp"
#include "friction_pieces.hpp"
#include "oscillator_in_time.hpp"
#include "uniform.hpp"
#include <array>
#include <gtest/gtest.h>
#include <numbers>

namespace friction_interval_test {

using namespace fretwork;
using namespace fretwork::contact;
using tests::driven;
using tests::law;
using tests::line;

namespace {

constexpr double round_off = 1e-12;
/// What the phase of ten periods may miss, rad: kappa is a series to x^8.
double next_order(double x) { return 2e-6 * std::pow(x, 10) + 1e-9; }

} // namespace

TEST(FrictionInterval, StaysWithinItsBoundOnTheMean) {
  tests::Uniform draw(7);
  constexpr int draws = 200000;
  for (int i = 0; i < draws; ++i) {
    const FrictionLaw any{draw.scale(0.01, 100.0), draw.scale(0.01, 100.0), 0.5, draw(0.2, 0.5)};
    const double dt = draw.scale(0.01, 2.0), normal0 = draw(0.0, 2.0), normal1 = draw(0.0, 2.0);
    const double bound = any.mu_static * 0.5 * (normal0 + normal1) * dt * (1.0 + round_off);
    const PieceTables table = piece_tables(any, 1.0, dt);
    const Vec2 spring = draw.vector(any.mu_static * normal0), velocity = draw.vector(1.0),
               acceleration = draw.vector(1.0);
    const auto one = friction_over_interval(any, table, 1.0, spring.t, false, dt, line(normal0, normal1),
                                            {velocity.t, acceleration.t, 0.0, 1.0});
    ASSERT_LE(std::abs(one.impulse), bound) << i;
    const auto plane = friction_over_interval(any, table, 1.0, spring, false, dt, line(normal0, normal1),
                                              {velocity, acceleration, {}, {1.0, 0.0, 1.0}});
    ASSERT_LE(norm(plane.impulse), bound) << i;
  }
}

TEST(FrictionInterval, StartsToSlideInsideTheInterval) {
  // at rest until K_T v t = mu N: what it slides after that; with a growing normal force the bound is met later
  constexpr double dt = 1.0, v = 0.5; // K v = 1 N/s
  for (const double growth : {0.0, 0.8}) {
    const double begin = 0.5 / (1.0 - 0.5 * growth);
    const auto f = friction_over_interval(law, piece_tables(law, 0.0, dt), 0.0, 0.0, false, dt,
                                          line(1.0, 1.0 + growth), driven<double, double>(v));
    EXPECT_NEAR(f.sliding_time, dt - begin, round_off);
    EXPECT_NEAR(f.slid, v * (dt - begin), round_off);
    EXPECT_NEAR(f.spring, -0.5 * (1.0 + growth), round_off);
    EXPECT_TRUE(f.sliding);
  }
}

TEST(FrictionInterval, StopsToSlideInsideTheInterval) {
  // a mass that friction brings to rest: after v/(mu N), whatever the interval
  constexpr double v = 0.2, stop = 0.4;
  const FrictionLaw stiff{1e6, 0.0, 0.5, 0.5};
  const auto f = friction_over_interval(stiff, piece_tables(stiff, 1.0, 1.0), 1.0, -0.5, true, 1.0,
                                        line(1.0, 1.0), {v, 0.0, 0.0, 1.0});
  EXPECT_NEAR(f.sliding_time, stop, 1e-3); // the spring's stretch: mu N/K
  EXPECT_NEAR(f.slid, 0.5 * v * stop, 1e-3 * v * stop);
  EXPECT_NEAR(f.slider_work, 0.5 * v * v, 1e-3 * v * v);
  EXPECT_FALSE(f.sliding);
}

TEST(FrictionInterval, SlidesAsWithoutDamperWhereThatIsFast) {
  // x = 2 t - 1.5 t^2: sticks up to mu_s N, the spring falls to mu_d N at once, it slides until it turns at 2/3 s, and sticks again
  constexpr double dt = 1.0, turns = 2.0 / 3.0;
  const double begins = (2.0 - std::sqrt(4.0 - 1.5)) / 3.0, back = 1.5 * (dt - turns) * (dt - turns);
  for (const double damping : {0.0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3}) {
    const FrictionLaw fast{2.0, damping, 0.5, 0.2};
    const auto f =
        friction_over_interval(fast, piece_tables(fast, 0.0, dt), 0.0, 0.0, false, dt, line(1.0, 1.0),
                               TangentialPath<double, double>{2.0, -3.0, 0.0, 0.0});
    const double tolerance = 2e-3 + 20.0 * damping;
    EXPECT_NEAR(f.sliding_time, turns - begins, tolerance) << damping;
    EXPECT_NEAR(f.spring, -0.2 + fast.stiffness * back, tolerance) << damping;
    EXPECT_FALSE(f.sliding) << damping;
  }
}

TEST(FrictionInterval, SlidesOnUnderANormalForceThatIsNotAsItWasExpected) {
  constexpr double dt = 0.1;
  for (const double damping : {0.0, 1e-9, 1e-4, 1e-3})
    for (const double expected : {0.95, 1.0, 1.05}) { // of the interval before, 1 in this one
      const FrictionLaw fast{2.0, damping, 0.5, 0.2};
      const auto f = friction_over_interval(fast, piece_tables(fast, 0.0, dt), 0.0, -0.2 * expected, true, dt,
                                            line(1.0, 1.0), driven<double, double>(0.5));
      EXPECT_TRUE(f.sliding) << damping << " " << expected;
      EXPECT_NEAR(f.sliding_time, dt, round_off) << damping << " " << expected;
      EXPECT_NEAR(f.spring, -0.2, 20.0 * damping + round_off) << damping << " " << expected;
    }
}

TEST(FrictionInterval, StandsFarBelowABoundThatWasNotExpected) {
  constexpr double dt = 0.1, v = 0.5; // pulls the spring by 0.1 N in the interval, half of the bound
  for (const double damping : {0.0, 1e-9, 1e-4}) {
    const FrictionLaw fast{2.0, damping, 0.5, 0.2};
    const auto f = friction_over_interval(fast, piece_tables(fast, 0.0, dt), 0.0, -0.1, true, dt,
                                          line(1.0, 1.0), driven<double, double>(v));
    EXPECT_FALSE(f.sliding) << damping;
    EXPECT_EQ(f.wear_work, 0.0) << damping;
    EXPECT_NEAR(f.spring, -0.1 - fast.stiffness * v * dt, round_off) << damping;
  }
}

TEST(FrictionInterval, StandsWhenASpringAboveItsBoundHasFallen) {
  constexpr double dt = 1.0, v = -0.1; // back, where it slid before
  for (const double damping : {1e-7, 1e-6, 1e-4}) {
    const FrictionLaw fast{2.0, damping, 0.5, 0.2};
    const auto f = friction_over_interval(fast, piece_tables(fast, 0.0, dt), 0.0, -0.3, true, dt,
                                          line(1.0, 1.0), driven<double, double>(v));
    EXPECT_FALSE(f.sliding) << damping;
    EXPECT_NEAR(f.spring, -0.2 - fast.stiffness * v * dt, 20.0 * damping) << damping;
  }
}

TEST(FrictionInterval, StopsUnderDampersOfAnySpeed) {
  // slides that stop inside the interval, from r = K_T tau/C_T = 0.1 on: against a thousand intervals
  constexpr double dt = 1.0;
  constexpr int many = 1000;
  tests::Uniform draw(3);
  for (int i = 0; i < 2000; ++i) {
    const double r = draw.scale(0.1, 1e4), growth = draw(-0.3, 0.3);
    const FrictionLaw any{2.0, 2.0 * dt / r, 0.5, 0.2};
    const double v = draw(0.05, 1.0), a = draw(-3.0, -0.1),
                 spring = -0.2 + any.damping * v - any.damping * draw(0.05, 1.0);
    const auto one =
        friction_over_interval(any, piece_tables(any, 0.0, dt), 0.0, spring, true, dt,
                               line(1.0, 1.0 + growth), TangentialPath<double, double>{v, a, 0.0, 0.0});
    double in_parts = spring, slid = 0.0;
    bool sliding = true;
    for (int k = 0; k < many; ++k) {
      const double t0 = k * dt / many, t1 = (k + 1) * dt / many;
      const auto f = friction_over_interval(any, piece_tables(any, 0.0, dt / many), 0.0, in_parts, sliding,
                                            dt / many, line(1.0 + growth * t0, 1.0 + growth * t1),
                                            TangentialPath<double, double>{v + a * t0, a, 0.0, 0.0});
      in_parts = f.spring;
      sliding = f.sliding;
      slid += f.sliding_time;
    }
    ASSERT_NEAR(one.spring, in_parts, 0.03)
        << i << " r " << r << " v " << v << " a " << a << " T " << spring << " N' " << growth;
    ASSERT_NEAR(one.sliding_time, slid, 0.06)
        << i << " r " << r << " v " << v << " a " << a << " T " << spring << " N' " << growth;
  }
}

/// Of a mass of 1 kg under a normal force of 1 N, in so many intervals of one second together.
template <class V, class M>
FrictionInterval<V> in_intervals(int count, const FrictionLaw& any, V spring, V velocity, V acceleration,
                                 const M& mobility) {
  FrictionInterval<V> out;
  out.spring = spring;
  out.velocity = velocity;
  out.sliding = true;
  double slid = 0.0, work = 0.0;
  for (int i = 0; i < count; ++i) {
    const double dt = 1.0 / count;
    out = friction_over_interval(any, piece_tables(any, 1.0, dt), 1.0, out.spring, out.sliding, dt,
                                 line(1.0, 1.0), {out.velocity, acceleration, V{}, mobility});
    slid += out.slid;
    work += out.slider_work;
  }
  out.slid = slid;
  out.slider_work = work;
  return out;
}

TEST(FrictionInterval, SticksWhileItTurnsRound) {
  // decelerated, stopped and pushed back: the damper turns the force round while the contact sticks, for 2 mu N/(C_T a)
  for (const double damping : {0.3, 1.0, 1.5, 3.0, 6.0, 30.0})
    for (const double v : {0.1, 0.2, 0.5, 0.9})
      for (const double a : {-1.0, -1.5, -3.0}) {
        SCOPED_TRACE(testing::Message() << "C_T " << damping << ", v " << v << ", a " << a);
        const FrictionLaw any{2.0, damping, 0.5, 0.5};
        const auto exact = in_intervals<double, double>(2000, any, -0.5, v, a, 1.0),
                   one = in_intervals<double, double>(1, any, -0.5, v, a, 1.0);
        EXPECT_NEAR(one.velocity, exact.velocity, 0.01);
        EXPECT_NEAR(one.slid, exact.slid, 0.01);
        EXPECT_NEAR(one.slider_work, exact.slider_work, 0.005);
        const Vec2 along{0.6, 0.8};
        const auto plane =
            in_intervals<Vec2, Sym2>(1, any, -0.5 * along, v * along, a * along, {1.0, 0.0, 1.0});
        EXPECT_NEAR(dot(plane.velocity, along), one.velocity, 1e-6);
        EXPECT_NEAR(plane.slid, one.slid, 1e-6);
      }
}

TEST(FrictionInterval, WorksAsMuchInOneIntervalAsInMany) {
  // a slide that begins above the dynamic bound, under a falling normal force: the spring drops while that is still large
  constexpr double dt = 1.0, v = 0.4, normal0 = 2.0, normal1 = 0.2, begin = -1.6;
  constexpr int many = 64;
  for (const double damping : {0.0, 1e-3, 0.3, 3.0, 100.0}) {
    const FrictionLaw slipping{2.0, damping, 0.8, 0.5};
    double spring = begin, work = 0.0, slid = 0.0;
    for (int i = 0; i < many; ++i) {
      const double n0 = normal0 + (normal1 - normal0) * i / many,
                   n1 = normal0 + (normal1 - normal0) * (i + 1) / many;
      const auto f = friction_over_interval(slipping, piece_tables(slipping, 0.0, dt / many), 0.0, spring,
                                            true, dt / many, line(n0, n1), driven<double, double>(v));
      EXPECT_TRUE(f.sliding);
      spring = f.spring;
      work += f.slider_work;
      slid += f.slid;
    }
    const auto one = friction_over_interval(slipping, piece_tables(slipping, 0.0, dt), 0.0, begin, true, dt,
                                            line(normal0, normal1), driven<double, double>(v));
    EXPECT_NEAR(one.spring, spring, round_off) << damping;
    EXPECT_NEAR(one.slid, slid, round_off) << damping;
    EXPECT_NEAR(one.slider_work, work, round_off) << damping;
  }
}

TEST(FrictionInterval, RestsUnderItsForce) {
  for (const double damping : {0.0, 0.3, 100.0}) {
    const FrictionLaw damped{2.0, damping, 0.5, 0.5};
    const auto f = friction_over_interval(damped, piece_tables(damped, 1.0, 0.7), 1.0, 0.2, false, 0.7,
                                          line(1.0, 1.0), {0.0, -0.2, 0.0, 1.0});
    EXPECT_NEAR(f.displacement, 0.0, round_off) << damping;
    EXPECT_NEAR(f.spring, 0.2, round_off) << damping;
  }
}

TEST(FrictionInterval, SticksWithTheFrequencyOfItsSpring) {
  // 1 kg on K_T = 1 N/m, undamped: after ten periods, and its energy stays
  const FrictionLaw sticking{1.0, 0.0, 10.0, 10.0};
  for (const double dt : {0.25, 0.5, 1.0, 1.5}) {
    const int count = static_cast<int>(std::lround(20.0 * std::numbers::pi / dt));
    const PieceTables table = piece_tables(sticking, 1.0, dt);
    double spring = 0.0, velocity = 1.0;
    Vec2 plane, rate{0.6, 0.8};
    for (int i = 0; i < count; ++i) {
      const auto f = friction_over_interval(sticking, table, 1.0, spring, false, dt, line(1.0, 1.0),
                                            {velocity, 0.0, 0.0, 1.0});
      spring = f.spring;
      velocity = f.velocity;
      const auto g = friction_over_interval(sticking, table, 1.0, plane, false, dt, line(1.0, 1.0),
                                            {rate, {}, {}, {1.0, 0.0, 1.0}});
      plane = g.spring;
      rate = g.velocity;
    }
    EXPECT_NEAR(spring * spring + velocity * velocity, 1.0, 1e-10) << dt;
    const double phase = count * dt;
    EXPECT_NEAR(velocity, std::cos(phase), next_order(dt)) << dt;
    EXPECT_NEAR(-spring, std::sin(phase), next_order(dt)) << dt;
    EXPECT_NEAR(0.6 * rate.x + 0.8 * rate.t, velocity, 1e-10);
  }
}

// It moves by W t - V t^3/6 after an impulse, and a load lifts its mean: as the normal force (normal_interval_test.cpp), also in the plane and after a slip.
// Whatever the largest mobility, of which its table is.
TEST(FrictionInterval, SticksOnASpringAndADamperAsInTime) {
  constexpr double load = 0.6, spring = -0.2, v = 0.3;
  for (const double dt : {0.5, 1.0})
    for (const double ratio : {0.0, 0.02, 0.1, 0.3, 0.7, 1.1})
      for (const double largest : {1.0, 4.0}) {
        SCOPED_TRACE(testing::Message() << dt << " " << ratio << " " << largest);
        const FrictionLaw sticking{1.0, 2.0 * ratio, 10.0, 10.0};
        const auto f = friction_over_interval(sticking, piece_tables(sticking, largest, dt), largest, spring,
                                              false, dt, line(1.0, 1.0), {v, load, 0.0, 1.0});
        const tests::InTime exact =
            tests::oscillator_in_time(1.0, sticking.damping, load, -spring, v, dt); // T = -K x
        const double most = 1e-4 * ratio * dt * dt + 1e-6;
        EXPECT_NEAR(f.displacement, exact.end + spring, most);
        EXPECT_NEAR(f.velocity, exact.rate, most);
      }
}

// Axes of a quarter of the mobility, turned: as two contacts on a line.
TEST(FrictionInterval, SticksAndSlipsOnAStructureThatHoldsItBack) {
  constexpr double stiffness = 1.0, dt = 1.0, w = 1.0, held_back = 0.5, lift = 5e-3, v = 0.4, load = 0.3;
  const double mobility = w - held_back * dt * dt / 12.0, compliance = held_back * std::pow(dt, 4) / 180.0;
  const FrictionLaw sticking{stiffness, 0.0, 10.0, 10.0};
  constexpr double spring = -0.7;
  const PieceTables table = piece_tables(sticking, mobility, dt);
  const auto f = friction_over_interval(sticking, table, mobility, spring, false, dt, line(1.0, 1.0),
                                        {v, load, 0.0, mobility, lift, compliance});
  // the penetration of a stop
  const NormalInterval n = normal_over_interval(
      {stiffness}, dt, mobility, compliance, 0.0,
      {-spring / stiffness, -spring / stiffness + v * dt + 0.5 * load * dt * dt, v, load, lift});
  EXPECT_NEAR(-f.impulse / dt, n.force, 1e-12);
  EXPECT_NEAR(-12.0 * f.moment / (dt * dt), n.growth, 1e-12);
  EXPECT_NEAR(-f.spring, stiffness * n.end, 1e-12);
  const Vec2 along{0.6, 0.8};
  const contact::Sym2 plane{1.0, 0.0, 1.0};
  const auto g = friction_over_interval(
      sticking, table, mobility, spring * along, false, dt, line(1.0, 1.0),
      {v * along, load * along, {}, mobility * plane, lift * along, compliance * plane});
  EXPECT_NEAR(dot(g.impulse, along), f.impulse, 1e-12);
  EXPECT_NEAR(dot(g.spring, along), f.spring, 1e-12);

  // a force that grows takes a contact that slips further by Y G; the lift leaves its motion at the end as it is, but not the work of a force that grows
  const FrictionLaw slipping{stiffness, 0.0, 0.5, 0.5};
  const auto slip = [&](double y, double lifted) {
    return friction_over_interval(slipping, piece_tables(slipping, mobility, dt), mobility, -0.5, true, dt,
                                  line(1.0, 2.0), {3.0, 0.0, 0.0, mobility, lifted, y});
  };
  EXPECT_EQ(slip(0.0, lift).sliding_time, dt);
  EXPECT_NEAR(slip(compliance, lift).displacement - slip(0.0, lift).displacement, -0.5 * compliance, 1e-12);
  EXPECT_NEAR(slip(0.0, lift).displacement - slip(0.0, 0.0).displacement, 0.0, 1e-15);
  EXPECT_NEAR(slip(0.0, lift).slider_work - slip(0.0, 0.0).slider_work, -0.5 * lift, 1e-12);
}

TEST(FrictionInterval, TakesAParabolaOfTheNormalForceAsManyShortIntervals) {
  constexpr double dt = 1.0, v = 0.4;
  constexpr int many = 400;
  const ParabolicForce normal{2.0, 1.2, 1.9};
  for (const double damping : {0.0, 0.3, 3.0, 100.0}) {
    const FrictionLaw slipping{2.0, damping, 0.5, 0.5};
    double spring = -1.0, work = 0.0, wear = 0.0;
    for (int i = 0; i < many; ++i) {
      const double from = static_cast<double>(i) / many, to = from + 1.0 / many;
      const auto f =
          friction_over_interval(slipping, piece_tables(slipping, 0.0, dt / many), 0.0, spring, true,
                                 dt / many, line(normal.at(from), normal.at(to)), driven<double, double>(v));
      spring = f.spring;
      work += f.slider_work;
      wear += f.wear_work;
    }
    const auto one = friction_over_interval(slipping, piece_tables(slipping, 0.0, dt), 0.0, -1.0, true, dt,
                                            normal, driven<double, double>(v));
    EXPECT_NEAR(one.spring, spring, 1e-5) << damping;
    EXPECT_NEAR(one.slider_work, work, 1e-2 * work)
        << damping; // but for the bend of the force where the spring's stretch decays
    EXPECT_NEAR(one.wear_work, wear, 1e-5 * wear) << damping;
    EXPECT_NEAR(one.impulse, -0.5 * normal.mean * dt, round_off);
    EXPECT_NEAR(one.moment, -0.5 * (normal.last - normal.first) * dt * dt / 12.0, round_off);
  }
}

TEST(FrictionInterval, SlidesAtOnceWhereNothingHoldsIt) {
  // a touch: no spring yet, and the bound grows more slowly than the spring would
  const FrictionLaw undamped{2.0, 0.0, 0.5, 0.5};
  constexpr double dt = 1.0, v = -1.0, growth = 1.0; // K_T |v| > mu N'
  const auto f = friction_over_interval(undamped, piece_tables(undamped, 0.0, dt), 0.0, 0.0, false, dt,
                                        line(0.0, growth), driven<double, double>(v));
  EXPECT_NEAR(f.sliding_time, dt, round_off);
  EXPECT_NEAR(f.impulse, 0.25 * growth * dt, round_off);
  EXPECT_NEAR(f.spring, 0.5 * growth, round_off);
}

TEST(FrictionInterval, SlidesWhereTheNormalForceIsLowestInside) {
  // held at both ends, over the bound between them
  const FrictionLaw held{1.0, 0.0, 1.0, 1.0};
  const auto f = friction_over_interval(held, piece_tables(held, 0.0, 1.0), 0.0, 1.0, false, 1.0,
                                        ParabolicForce{2.0, 2.0, 1.0}, driven<double, double>(0.0));
  EXPECT_GT(f.slider_work, 0.0);
  EXPECT_NEAR(f.spring, 0.5, 1e-2) << "the lowest bound";
  EXPECT_FALSE(f.sliding);
}

} // namespace friction_interval_test
