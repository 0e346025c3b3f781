// SPDX-License-Identifier: GPL-3.0-or-later
// Imposed motions are the exact double integrals of their acceleration, and obstacles that they carry act as obstacles at rest act on a
// structure that is described in space.
#include "scenes.hpp"
#include "signals/prescribed_motion.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace obstacle_motion_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::PlaneAxis;

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double duration = 1.0;

/// s(t) by Gauss's rule with two points on n intervals: exact for the cubic pieces of a signal whose joints are ends of intervals.
MotionState integrated(const PrescribedMotion& motion, double t, int n) {
  const Signal a(motion.acceleration, duration);
  MotionState s{motion.displacement0, motion.velocity0};
  const double h = t / n, point = 0.5 / std::sqrt(3.0);
  for (int i = 0; i < n; ++i) {
    const double x0 = h * (i + 0.5 - point), x1 = h * (i + 0.5 + point);
    s.displacement += h * s.velocity + 0.5 * h * ((h * (i + 1) - x0) * a(x0) + (h * (i + 1) - x1) * a(x1));
    s.velocity += 0.5 * h * (a(x0) + a(x1));
  }
  return s;
}

void expect_integral(const TimeFunction& acceleration, int intervals, double tolerance) {
  const PrescribedMotion motion{acceleration, 0.7, -0.2};
  const MotionSignal signal(motion, duration);
  EXPECT_EQ(signal(0.0).displacement, -0.2);
  EXPECT_EQ(signal(0.0).velocity, 0.7);
  for (const double t : {0.125, 0.5, 0.75, 1.0}) {
    const MotionState s = signal(t),
                      exact = integrated(motion, t, static_cast<int>(std::lround(t * intervals)));
    EXPECT_NEAR(s.velocity, exact.velocity, tolerance) << t;
    EXPECT_NEAR(s.displacement, exact.displacement, tolerance) << t;
  }
}

constexpr double round_off = 1e-12;

} // namespace

// A flat band: rms^2 int df/(2 pi f)^4 / (high - low) is the square of the displacement.
TEST(MotionSignal, OfARandomAccelerationStaysAboutItsPlace) {
  for (const Random& random :
       {Random{2.0, 5.0, 50.0, 1, true}, Random{2.0, 3.0, 40.0, 7, true}, Random{2.0, 1.0, 100.0, 2, true}}) {
    constexpr double seconds = 300.0;
    const MotionSignal s({random}, seconds);
    EXPECT_EQ(s(0.0).displacement, 0.0); // what it carries starts at its place, at rest
    EXPECT_EQ(s(0.0).velocity, 0.0);
    EXPECT_EQ(s.acceleration(0.0), 0.0);
    constexpr int n = 300000;
    double mean = 0.0, squares = 0.0, last = 0.0;
    for (int i = 0; i < n; ++i) {
      const double u = s((i + 0.5) * seconds / n).displacement;
      mean += u / n;
      squares += u * u / n;
      if (10 * i >= 9 * n)
        last += u / (n / 10.0);
    }
    const double expected =
        random.rms *
        std::sqrt((std::pow(random.low, -3) - std::pow(random.high, -3)) / 3.0 / (random.high - random.low)) /
        std::pow(two_pi, 2);
    EXPECT_NEAR(std::sqrt(squares), expected, 0.2 * expected); // of some hundred periods of the lower end
    constexpr double nothing = 1e-3; // a period of the lower end in hundreds; a walk would be factors
    EXPECT_LT(std::abs(mean), nothing * expected);
    EXPECT_LT(std::abs(last), 10.0 * nothing * expected);
  }
}

TEST(MotionSignal, OfARandomAccelerationFrom0HasABoundToo) {
  const MotionSignal s({Random{2.0, 0.0, 40.0, 7, true}}, 2000.0);
  double most = 0.0;
  for (double t = 0.0; t < 2000.0; t += 0.05)
    most = std::max(most, std::abs(s(t).displacement));
  // from 40/256 Hz on: rms 0.076 m
  EXPECT_LT(most, 5.0 * 0.076);
  EXPECT_GT(most, 2.0 * 0.076);
}

TEST(MotionSignal, IntegratesConstantsAndTablesExactly) {
  expect_integral(Constant{3.0}, 8, round_off);
  expect_integral(Table{{0.25, 0.5, 0.5, 0.875}, {1.0, 3.0, -2.0, 4.0}}, 64,
                  round_off);                                                // a jump; constant outside
  expect_integral(Table{{-0.5, 0.5, 2.0}, {1.0, 3.0, -2.0}}, 64, round_off); // begun before, ends after
  expect_integral(Table{{-2.0, -1.0}, {1.0, 3.0}}, 64, round_off);
}

TEST(MotionSignal, IntegratesHarmonics) {
  constexpr double of_the_rule = 1e-9; // (w h)^4/4320 of a/w^2, h = 1/4096
  expect_integral(Harmonic{5.0, 3.0, 0.4}, 4096, of_the_rule);
  expect_integral(Harmonic{5.0, 1e-7, 0.4}, 4096, round_off); // nothing cancels where w t is small
}

TEST(MotionSignal, IntegratesTheSignalThatTheLoadsFollow) {
  const Random noise{2.0, 5.0, 20.0, 7};
  const double step = Signal(noise, duration).grid_step();
  const PrescribedMotion motion{noise, 0.7, -0.2};
  const MotionSignal signal(motion, duration);
  for (const int pieces : {1, 10, 300}) {
    const MotionState s = signal(pieces * step), exact = integrated(motion, pieces * step, 4 * pieces);
    EXPECT_NEAR(s.velocity, exact.velocity, round_off);
    EXPECT_NEAR(s.displacement, exact.displacement, round_off);
    // inside a piece: the derivative of what is there
    constexpr double share = 0.01, difference = 1e-6; // (share step)^2 of the third derivative
    const double t = (pieces + 0.4) * step, d = share * step;
    EXPECT_NEAR((signal(t + d).displacement - signal(t - d).displacement) / (2.0 * d), signal(t).velocity,
                difference);
  }
}

namespace {

/// The state of a displacement's motion, and its acceleration by differences.
void expect_displacement(const TimeFunction& s, double t, const MotionState& wanted, double tolerance) {
  const MotionSignal signal(motion_of_displacement(s), duration);
  EXPECT_NEAR(signal(t).displacement, wanted.displacement, tolerance) << t;
  EXPECT_NEAR(signal(t).velocity, wanted.velocity, tolerance) << t;
}

} // namespace

TEST(MotionOfDisplacement, IsTheDisplacement) {
  constexpr double w = two_pi * 3.0;
  for (const double t : {0.0, 0.3, 1.0}) {
    expect_displacement(Constant{2.0}, t, {2.0, 0.0}, round_off);
    expect_displacement(Harmonic{5.0, 3.0, 0.4}, t,
                        {5.0 * std::sin(w * t + 0.4), 5.0 * w * std::cos(w * t + 0.4)}, 1e-11); // of w^2 t^2
    expect_displacement(Table{{0.2}, {3.0}}, t, {3.0, 0.0}, round_off);
  }
}

TEST(MotionOfDisplacement, GoesThroughATableFromRestToRest) {
  // a cubic that rests at both ends is its own spline, wherever the run begins
  const auto cubic = [](double t, double start, double end) {
    const double x = (t - start) / (end - start);
    return x <= 0.0   ? MotionState{0.0, 0.0}
           : x >= 1.0 ? MotionState{1.0, 0.0}
                      : MotionState{x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x) / (end - start)};
  };
  for (const double start : {0.25, 0.0, -0.5, -3.0}) {
    Table table;
    for (const double x : {0.0, 0.3, 0.45, 1.0}) {
      table.time.push_back(start + x);
      table.value.push_back(cubic(start + x, start, start + 1.0).displacement);
    }
    for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0})
      expect_displacement(table, t, cubic(t, start, start + 1.0), round_off);
  }
  // any other points are met, with a velocity that does not jump
  const Table points{{0.1, 0.2, 0.5, 0.6, 0.8}, {0.0, 2.0, -1.0, 0.5, 1.0}};
  const MotionSignal signal(motion_of_displacement(points), duration);
  for (std::size_t i = 0; i < points.time.size(); ++i) {
    EXPECT_NEAR(signal(points.time[i]).displacement, points.value[i], round_off);
    EXPECT_NEAR(signal(points.time[i] - 1e-9).velocity, signal(points.time[i] + 1e-9).velocity, 1e-5);
  }
  EXPECT_NEAR(signal(1.0).displacement, 1.0, round_off);
  EXPECT_NEAR(signal(1.0).velocity, 0.0, round_off);
}

TEST(MotionOfDisplacement, HoldsWhereATableHolds) {
  for (const double sign : {1.0, -1.0}) {
    const Table table{{0.0, 0.05, 0.6, 0.7, 1.0}, {0.0, sign * 1e-3, sign * 1e-3, sign * 3e-3, sign * 3e-3}};
    const MotionSignal signal(motion_of_displacement(table), duration);
    for (const double t : {0.05, 0.1, 0.3, 0.59, 0.6})
      EXPECT_NEAR(signal(t).displacement, sign * 1e-3, round_off) << t;
    for (double t = 0.0; t < 1.0; t += 0.01) {
      EXPECT_GE(sign * signal(t).displacement, -round_off) << t;
      EXPECT_LE(sign * signal(t).displacement, 3e-3 + round_off) << t;
    }
  }
}

TEST(MotionOfDisplacement, IsOfOrderFourThroughRowsOfASmoothCurve) {
  // 1 - cos over whole periods rests at its ends: nothing is limited, where its tops lie between rows neither
  double last = 0.0;
  for (const int rows : {27, 54, 108}) {
    Table table;
    for (int i = 0; i <= rows; ++i) {
      table.time.push_back(static_cast<double>(i) / rows);
      table.value.push_back(1.0 - std::cos(2.0 * two_pi * table.time.back()));
    }
    const MotionSignal signal(motion_of_displacement(table), duration);
    double error = 0.0;
    for (double t = 0.0; t < 1.0; t += 1e-3)
      error = std::max(error, std::abs(signal(t).displacement - 1.0 + std::cos(2.0 * two_pi * t)));
    if (last > 0.0) {
      EXPECT_NEAR(std::log2(last / error), 4.0, 0.3) << rows;
    }
    last = error;
  }
}

namespace {

// A mass on springs whose foot moves by s = -(A/w^2) sin(w t) along (0.6, 0.8, 0), inside a round hole that stays in space.
constexpr double foot_acceleration = 8.0, foot_frequency = 4.0, spring = 900.0;
const Vec3 along(0.6, 0.8, 0.0); // x_loc and y_loc

double foot(double t) {
  const double w = two_pi * foot_frequency;
  return -foot_acceleration / (w * w) * std::sin(w * t);
}

Scene hole(double friction) {
  Scene s = mass_point(1.0, Vec3::Constant(spring), 0.5);
  s.system.damping.setConstant(1.0);
  s.contacts = {contact_of(1.0, {contact::Circle{2e-3}, {2e4, 10.0}, {1e4, 20.0, friction, friction}},
                           Vec3(0, 1e-3, 0.5e-3))};
  return s;
}

/// Displacements from the foot.
Scene from_the_foot(double friction) {
  Scene s = hole(friction);
  const Harmonic a{foot_acceleration, foot_frequency, 0.0};
  const double w = two_pi * foot_frequency;
  s.motions = {{a, -foot_acceleration / w, 0.0}};
  s.contacts[0].imposed = along;
  s.loads = {force_on(1.0, -along, a)};
  start(s, 1.0, Vec3::Zero(), foot_acceleration / w * along); // at rest in space
  return s;
}

/// Displacements in space: the foot's are a load on the springs, its velocity one on the dampers.
Scene in_space(double friction) {
  Scene s = hole(friction);
  const double w = two_pi * foot_frequency, a = foot_acceleration / (w * w);
  s.loads = {force_on(1.0, along, Harmonic{-a * spring, foot_frequency, 0.0}),
             force_on(1.0, along, Harmonic{-a * w * 1.0, foot_frequency, 0.5 * std::numbers::pi})};
  return s;
}

/// Largest difference of the motion in space, m.
double difference(double friction, const StepOptions& options) {
  const History relative = simulate(from_the_foot(friction), options, 0.01),
                absolute = simulate(in_space(friction), options, 0.01);
  EXPECT_GT(absolute.normal.maxCoeff(), 1.0);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < absolute.time.size(); ++i)
    largest =
        std::max(largest, (relative.q.col(i) + foot(absolute.time(i)) * along - absolute.q.col(i)).norm());
  return largest;
}

/// A coarse run, a fine one, and by what errors fall between them.
struct Pair {
  StepOptions coarse, fine;
  double fall, fall_with_friction;
};
Pair pair(SchemeKind kind) {
  const auto steps = [kind](double coarse, double fall, double fall_with_friction) {
    return Pair{{kind, coarse}, {kind, coarse / 16.0}, fall, fall_with_friction};
  };
  switch (kind) {
  case SchemeKind::splitting:
  case SchemeKind::energy_conserving:
    return steps(1.6e-3, 100.0, 100.0); // of 256
  case SchemeKind::collocation:
  case SchemeKind::devogelaere:
    return steps(8e-4, 1000.0, 1000.0); // of 65536, to round-off
  case SchemeKind::euler:
    return steps(1.6e-4, 14.0, 3.0); // of 16; stick and slip scatter about it
  case SchemeKind::runge_kutta_54: {
    Pair tolerances = steps(1.0, 50.0, 50.0); // of 1e4 in the tolerance, about its power 4/5 in the motion
    tolerances.coarse.step = tolerances.fine.step = std::nullopt;
    tolerances.coarse.tolerance = 1e-4;
    tolerances.fine.tolerance = 1e-8;
    return tolerances;
  }
  }
  return {};
}

} // namespace

class ObstacleMotions : public testing::TestWithParam<Candidate> {};
INSTANTIATE_TEST_SUITE_P(Schemes, ObstacleMotions, testing::ValuesIn(candidates), name_of_candidate);

TEST_P(ObstacleMotions, ActLikeAnObstacleAtRest) {
  constexpr double size = 1e-2; // m, of the motion
  const Pair runs = pair(GetParam().kind);
  for (const double friction : {0.0, 0.3}) {
    const double coarse = difference(friction, runs.coarse), fine = difference(friction, runs.fine);
    EXPECT_LT(fine, coarse / (friction > 0.0 ? runs.fall_with_friction : runs.fall)) << friction;
    EXPECT_LT(fine, (GetParam().first_order() ? 3e-4 : 1e-5) * size) << friction;
  }
}

TEST_P(ObstacleMotions, BringEnergyThatIsBooked) {
  const auto residual = [](const StepOptions& options) {
    return simulate(from_the_foot(0.3), options, 0.5).report.residual_relative;
  };
  const Pair runs = pair(GetParam().kind);
  const double coarse = residual(runs.coarse), fine = residual(runs.fine);
  if (GetParam().kind == SchemeKind::energy_conserving) {
    EXPECT_LT(coarse, round_off);
    EXPECT_LT(fine, round_off);
  } else {
    EXPECT_LT(fine, coarse / std::min(14.0, runs.fall)); // through impacts, stick and slip
    EXPECT_LT(fine, GetParam().first_order() ? 1e-4 : 1e-5);
  }
}

TEST_P(ObstacleMotions, HitABodyAtRest) {
  // a stop comes along at V: half a period of its contact later the body leaves it at 2 V
  constexpr double mass = 2.0, stiffness = 5e4, gap = 1e-3, speed = 0.25;
  Scene s = mass_point(mass, Vec3::Zero(), 0.1);
  s.contacts = {contact_of(mass, {contact::Stop{gap, PlaneAxis::y}, {stiffness}, {}})};
  s.motions = {{Constant{0.0}, speed}};
  s.contacts[0].imposed = Vec3(0, 1, 0);
  const History run = simulate(s, GetParam().options(1e-6), s.duration / 100.0);
  const double w = std::sqrt(stiffness / mass), touch = gap / speed, leave = touch + std::numbers::pi / w;
  for (Eigen::Index i = 0; i < run.time.size(); ++i) {
    const double t = std::clamp(run.time(i), touch, leave) - touch;
    const double wanted = -speed * (1.0 - std::cos(w * t));
    EXPECT_NEAR(run.v(1, i) / std::sqrt(mass), wanted, 2.0 * speed * GetParam().tolerance()) << run.time(i);
  }
  EXPECT_NEAR(run.report.energy.load_work / (2.0 * mass * speed * speed), 1.0, GetParam().tolerance());
}

TEST(ObstacleMotion, IsMetByRungeAndKuttaWhereItIs) {
  // the same, its two events located: the error is that of the tolerance, and no step is halved down to them
  Scene s = mass_point(1.0, Vec3::Zero(), 1.0);
  s.contacts = {contact_of(1.0, {contact::Stop{1e-3, PlaneAxis::y}, {100.0}, {}})};
  s.motions = {{Constant{0.0}, 0.003}};
  s.contacts[0].imposed = Vec3(0, 1, 0);
  StepOptions options{SchemeKind::runge_kutta_54, {}};
  options.tolerance = 1e-9;
  const History run = simulate(s, options, 1.0);
  EXPECT_NEAR(run.v(1, 1) / -0.006, 1.0, 1e-7);
  EXPECT_LE(run.report.counts.rejected, 10); // each event found at once
}

TEST(ObstacleMotion, CarriesATableUnderABlock) {
  // case A3 seen from space: the table moves, the block is at rest there
  Scene s = mass_point(1.0, Vec3::Zero(), 12.0);
  s.contacts = {pressed(1.0, 10.0, {9e6, 600.0, 0.1, 0.1})};
  s.motions = {{Harmonic{1.5, 1.0, 0.0}}};
  s.contacts[0].imposed = Vec3(0, -1, 0);
  const History run = simulate(s, splitting(), 12.0, 4.0);
  constexpr double asked = 1e-3;
  EXPECT_NEAR(run.statistics[0].work_rate / 0.40906245, 1.0, asked);
  EXPECT_LT(run.report.residual_relative, asked);
}

TEST(ObstacleMotion, SlidesAlongAnAxisThatNoModeMoves) {
  Scene s = mass_point(1.0, Vec3::Zero(), 1.0);
  s.contacts = {pressed(1.0, 10.0, {1e5, 100.0, 0.1, 0.1})};
  s.contacts[0].b.row(0).setZero();
  s.motions = {{Constant{0.0}, 0.2}};
  s.contacts[0].imposed = Vec3(1, 0, 0);
  const History run = simulate(s, splitting(), 0.5);
  EXPECT_NEAR(run.along_x(0, 1), -1.0, 1e-9); // the bound, against the motion of the node from the obstacle
  EXPECT_NEAR(run.statistics[0].work_rate, 2.0, 1e-2);
}

} // namespace obstacle_motion_test
