// SPDX-License-Identifier: GPL-3.0-or-later
// The adaptive scheme against closed forms and itself: events, tolerance, outcomes.
#include "scenes.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace runge_kutta_54_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::PlaneAxis;
using contact::Stop;

namespace {

constexpr double fine = 1e-10;       // tolerance of a step
constexpr double of_fine = 1e-8;     // what some hundred such steps may add up to, relative
constexpr double of_duration = 1e-9; // s: events are found to this

StepOptions adaptive(double tolerance) {
  StepOptions options;
  options.scheme = SchemeKind::runge_kutta_54;
  options.tolerance = tolerance;
  return options;
}

/// A4: a ball, 2 m above a stop, thrown down at 1 m/s under 10 m/s2; z is -y_loc here.
Scene ball() {
  Scene s = mass_point(1.0, Vec3::Zero(), 1.2);
  start(s, 1.0, Vec3::Zero(), Vec3(0, 1.0, 0));
  s.contacts = {contact_of(1.0, {Stop{2.0, PlaneAxis::y}, {100.0}, {}})};
  s.loads = {force_on(1.0, Vec3(0, 10.0, 0), Constant{1.0})};
  return s;
}

/// A6: a free mass of 2 kg at 1.5 m/s on a spring of 5e5 N/m, xi = 0.1, `count` equal contacts that share it.
Scene impact(int count, double duration) {
  Scene s = mass_point(2.0, Vec3::Zero(), duration);
  start(s, 2.0, Vec3::Zero(), Vec3(0, 1.5, 0));
  for (int i = 0; i < count; ++i)
    s.contacts.push_back(contact_of(2.0, {Stop{1e-3, PlaneAxis::y}, {5e5 / count, 200.0 / count}, {}}));
  return s;
}

/// A mass between two planes under harmonic forces in and across the contacts, with every damper and a coefficient of 1: ten impacts, slides
/// that stick and start again.
Scene driven_between_planes() {
  Scene s = mass_point(1.0, Vec3(400.0, 700.0, 1100.0), 0.4);
  for (int i = 0; i < 3; ++i)
    s.system.damping(i) = 0.02 * std::sqrt(s.system.stiffness(i));
  start(s, 1.0, Vec3::Zero(), Vec3(0.2, 0.1, 0.0));
  s.contacts = {
      contact_of(1.0, {contact::PlanePair{5e-4, PlaneAxis::y}, {2e5, 30.0}, {2e5, 60.0, 1.0, 1.0}})};
  s.loads = {force_on(1.0, Vec3(0.0, 1.0, 0.3).normalized(), Harmonic{70.0, 11.0, 0.2}),
             force_on(1.0, Vec3(1.0, 0.0, 0.5).normalized(), Harmonic{50.0, 6.1, 1.0})};
  return s;
}

/// Of a free mass of 1 kg that starts inside a stop and moves outwards, until it comes to rest or leaves the stop.
struct Rebound {
  contact::NormalLaw law;
  double penetration, speed; ///< m, m/s outwards
  Harmonic load;             ///< N, into the stop
  double duration;
  contact::Obstacle obstacle;
};

struct ForceMeans {
  double force = 0.0, closed = 0.0; ///< N, share of the time
};

/// By the laws, with Heun's method.
ForceMeans integrate(const Rebound& r, int steps) {
  const double h = r.duration / steps;
  double p = r.penetration, rate = -r.speed;
  ForceMeans means;
  const auto load = [&](double t) {
    return r.load.amplitude * std::sin(2.0 * std::numbers::pi * r.load.frequency * t + r.load.phase);
  };
  const auto force = [&](double at, double by) { return contact::normal_force(r.law, at, by); };
  for (int i = 0; i < steps; ++i) {
    const double now = force(p, rate), a = load(i * h) - now, p1 = p + h * rate, v1 = rate + h * a,
                 next = force(p1, v1), b = load((i + 1) * h) - next;
    means.force += 0.5 * (now + next) / steps;
    means.closed += 0.5 * ((now > 0.0) + (next > 0.0)) / steps;
    p += 0.5 * h * (rate + v1);
    rate += 0.5 * h * (a + b);
  }
  return means;
}

double largest_difference(const History& a, const History& b) { return (a.q - b.q).cwiseAbs().maxCoeff(); }

} // namespace

TEST(RungeKutta54, FollowsABallOnAStop) {
  const History run = simulate(ball(), adaptive(fine), 0.1);
  EXPECT_NEAR(run.q(1, 10), 1.332162981855, of_fine);
  EXPECT_NEAR(run.q(1, 11), 0.856394405035, of_fine);
}

TEST(RungeKutta54, EndsStepsWhereContactsCloseAndOpen) {
  const auto records = trace(ball(), adaptive(fine));
  for (const double event : {0.54031242374329, 0.88545615307643}) {
    double nearest = 1.0;
    for (const auto& r : records)
      nearest = std::min(nearest, std::abs(r.time - event));
    EXPECT_LT(nearest, of_duration);
  }
}

TEST(RungeKutta54, GivesTheRestitutionOfADampedImpact) {
  constexpr double e = 0.74407940; // to eight digits
  const History run = simulate(impact(1, 0.02), adaptive(fine), 0.02);
  EXPECT_NEAR(-run.v(1, 1) / (std::sqrt(2.0) * 1.5), e, of_fine);
}

TEST(RungeKutta54, TakesEventsOfSeveralContactsAtOneInstant) {
  const History one = simulate(impact(1, 0.02), adaptive(fine), 1e-3),
                three = simulate(impact(3, 0.02), adaptive(fine), 1e-3);
  EXPECT_EQ(three.report.outcome, Outcome::done);
  EXPECT_LT(largest_difference(one, three), of_fine * one.q.cwiseAbs().maxCoeff());
}

TEST(RungeKutta54, CountsAnImpactWithItsSpeedsAndDuration) {
  const History run = simulate(impact(1, 0.02), adaptive(1e-12), 1e-3);
  ASSERT_EQ(run.statistics[0].impacts, 1);
  EXPECT_NEAR(run.statistics[0].impact_velocity_mean, 1.5, of_fine);
  EXPECT_NEAR(run.statistics[0].departure_velocity_mean, 1.5 * 0.74407940, of_fine);
}

TEST(RungeKutta54, IsAsAccurateAsItsTolerance) {
  // friction, dampers, all kinds of obstacles; short, as errors grow with every impact
  constexpr double horizon = 0.05, growth = 30.0;
  const Scene scene = rattling(5, 12, horizon);
  const History exact = simulate(scene, adaptive(1e-12), horizon / 10.0);
  const double size = exact.q.cwiseAbs().maxCoeff();
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    const History run = simulate(scene, adaptive(tolerance), horizon / 10.0);
    EXPECT_EQ(run.report.outcome, Outcome::done);
    EXPECT_LT(largest_difference(run, exact), growth * tolerance * size) << tolerance;
  }
}

TEST(RungeKutta54, EndsStepsWhereTablesBendAndJump) {
  // from rest: a ramp and a jump back, then a pulse that no step would meet, on w = 40 rad/s
  constexpr double w = 40.0, duration = 0.3, ramp = 0.1, jump = 0.16, pulse = 0.2345, width = 1e-9,
                   impulse = 0.02;
  Scene s = mass_point(1.0, Vec3(0, w * w, 0), duration);
  s.loads = {force_on(1.0, Vec3(0, 1.0, 0),
                      Table{{0.0, ramp, jump, jump, pulse - width, pulse, pulse + width, 1.0},
                            {0.0, 0.0, 1.0, -0.5, -0.5, impulse / width, -0.5, -0.5}})};
  const auto of_ramp = [&](double t) {
    return t < 0.0 ? 0.0 : (t - std::sin(w * t) / w) / (w * w * (jump - ramp));
  };
  const auto of_step = [&](double t) { return t < 0.0 ? 0.0 : (1.0 - std::cos(w * t)) / (w * w); };
  const History run = simulate(s, adaptive(1e-8), 1e-3);
  EXPECT_EQ(run.report.outcome, Outcome::done);
  EXPECT_LT(run.report.counts.steps + run.report.counts.rejected, 400); // 200 at least
  constexpr double tolerance = 1e-6;                                    // of about 1e-3
  for (Eigen::Index j = 0; j < run.time.size(); ++j) {
    const double t = run.time(j), after = t - pulse;
    const double q = of_ramp(t - ramp) - of_ramp(t - jump) - 1.5 * of_step(t - jump) +
                     (after < 0.0 ? 0.0 : impulse * std::sin(w * after) / w);
    EXPECT_NEAR(run.q(1, j), q, tolerance * 1e-3) << t;
  }
}

TEST(RungeKutta54, IsNotDrivenByAModeThatDoesNotMove) {
  Scene scene = impact(1, 0.02), with_silent = scene;
  with_silent.system.stiffness(2) = 1e4; // along z_loc, where nothing acts
  const History a = simulate(scene, adaptive(1e-6), 1e-3), b = simulate(with_silent, adaptive(1e-6), 1e-3);
  EXPECT_EQ(a.report.counts.steps, b.report.counts.steps);
  EXPECT_EQ(a.report.counts.rejected, b.report.counts.rejected);
}

TEST(RungeKutta54, TellsThatNoStepMeetsAToleranceBelowRoundOff) {
  const History run = simulate(rattling(5, 12, 0.05), adaptive(1e-20), 0.01);
  EXPECT_EQ(run.report.outcome, Outcome::step_failed);
  EXPECT_EQ(run.report.failure, StepFailure::tolerance);
  EXPECT_LT(run.report.end_time, 0.05);
  EXPECT_GT(run.report.counts.rejected, 0);
}

TEST(RungeKutta54, EndsWithEveryFrictionLaw) {
  for (const auto kind : {contact::FrictionMemoryKind::return_map, contact::FrictionMemoryKind::reference})
    for (const double damping : {30.0, 0.0})
      for (const double mu_static : {0.3, 0.5}) {
        Scene scene = rattling(5, 12, 0.2);
        for (ContactPoint& point : scene.contacts)
          if (point.support.friction.active())
            point.support.friction = {1e5, damping, mu_static, 0.3, kind};
        const History run = simulate(scene, adaptive(1e-4), 0.01);
        EXPECT_EQ(run.report.outcome, Outcome::done);
        constexpr double balance = 2e-2; // of the energy put in: jumps of `reference` included
        EXPECT_LT(run.report.residual_relative, balance);
      }
}

TEST(RungeKutta54, KeepsTheEnergyOfManyImpacts) {
  Scene s = mass_point(1.0, Vec3(0, 100.0, 0), 10.0);
  start(s, 1.0, Vec3::Zero(), Vec3(0, 0.4, 0));
  s.contacts = {contact_of(1.0, {contact::PlanePair{0.02, PlaneAxis::y}, {1e6}, {}})};
  constexpr double drift = 1e-6; // about 2000 steps of 1e-10, with margin
  EXPECT_LT(simulate(s, adaptive(fine), 1.0).report.residual_relative, drift);
}

TEST(RungeKutta54, HasTheStatisticsOfItsContinuousMotion) {
  // its long steps leave little to the ends: sums over records there were 2.7 % off at 1e-6, 0.5 % at 1e-10
  const Scene scene = driven_between_planes();
  constexpr double allowed = 1e-4; // relative, at tolerances from 1e-5 on
  constexpr double independent =
      5.49; // W, an integrator of the laws that locates events, to its three digits
  const auto exact = simulate(scene, adaptive(1e-12), 0.1).statistics[0];
  EXPECT_NEAR(exact.work_rate, independent, 5e-3);
  for (const double tolerance : {1e-5, 1e-6, 1e-8}) {
    const auto run = simulate(scene, adaptive(tolerance), 0.1).statistics[0];
    const auto expect_near = [&](double value, double right) {
      EXPECT_NEAR(value, right, allowed * right) << tolerance;
    };
    EXPECT_EQ(run.impacts, exact.impacts);
    expect_near(run.work_rate, exact.work_rate);
    expect_near(run.friction_power, exact.friction_power);
    expect_near(run.damping_work, exact.damping_work);
    expect_near(run.sliding_distance, exact.sliding_distance);
    expect_near(run.normal_mean, exact.normal_mean);
    expect_near(run.normal_rms, exact.normal_rms);
    expect_near(run.tangential_rms, exact.tangential_rms);
    expect_near(run.contact_time_ratio, exact.contact_time_ratio);
    expect_near(run.sticking_ratio, exact.sticking_ratio);
    expect_near(run.contact_duration_mean, exact.contact_duration_mean);
    expect_near(run.y.std, exact.y.std);
  }
}

TEST(RungeKutta54, GivesTheForcesOfTheLawsAtOutputs) {
  const Scene scene = driven_between_planes();
  const contact::Support& support = scene.contacts[0].support;
  const History run = simulate(scene, adaptive(1e-6), 4e-4), exact = simulate(scene, adaptive(1e-12), 4e-4);
  constexpr double round_off = 1e-9;                          // of the force
  const double follows = 1e-4 * exact.normal.maxCoeff();      // N: between its steps too
  const double jump = support.normal.damping * 0.5 + follows; // N: at a touch that is located elsewhere
  int closed = 0;
  for (Eigen::Index j = 0; j < run.time.size(); ++j) {
    const auto at = contact::locate(support.obstacle, run.q(1, j), run.q(2, j));
    const double force = run.normal(0, j);
    if (force > 0.0) {
      EXPECT_NEAR(force, support.normal.stiffness * -at.gap - support.normal.damping * at.ny * run.v(1, j),
                  round_off * (1.0 + force));
      ++closed;
    }
    const bool touches = (force > 0.0) != (exact.normal(0, j) > 0.0);
    EXPECT_NEAR(force, exact.normal(0, j), touches ? jump : follows) << run.time(j);
    EXPECT_NEAR(run.along_x(0, j), exact.along_x(0, j), touches ? jump : follows) << run.time(j);
  }
  EXPECT_GT(closed, 700);
}

TEST(RungeKutta54, CoversTheWholeRunWithItsRecords) {
  struct Sum final : Observer {
    void visit(core::StateArchive&) override {}
    void step(const Record& record) override { time += record.step; }
    double time = 0.0;
  } sum;
  const Scene scene = rattling(5, 12, 0.05);
  Observer* const observers[] = {&sum};
  (void)run(scene, choose_step(scene, adaptive(1e-6)), observers, nullptr, {});
  constexpr double round_off = 1e-14;
  EXPECT_NEAR(sum.time, 0.05, round_off);
}

// Without clearance the contact closes on one plane in the instant in which it leaves the other: that ends a step too, or the spring of
// such a step would be that of both faces. It sticks nearly all the time, under a slow force.
TEST(RungeKutta54, EndsStepsWhereAContactPassesFromFaceToFace) {
  Scene scene = mass_point(1.0, Vec3(0.0, 1.5e6, 2.6e6), 0.08);
  scene.contacts = {
      contact_of(1.0, {contact::PlanePair{0.0, PlaneAxis::y}, {3.9e5, 1240.0}, {3.9e5, 0.0, 3.0, 3.0}})};
  scene.loads = {force_on(1.0, Vec3(0.0, 1.0, 0.3).normalized(), Harmonic{50.0, 50.0, 0.0})};
  const Energy other = trace(scene, splitting(1e-6)).back().energy;
  for (const auto& [tolerance, share] : {std::pair{1e-5, 1e-2}, {fine, 1e-3}}) { // without C_T of order 1
    const Energy found = trace(scene, adaptive(tolerance)).back().energy;
    EXPECT_NEAR(found.friction, other.friction, share * other.friction);
    EXPECT_NEAR(found.contact_damping, other.contact_damping, share * other.contact_damping);
  }
}

// Near the middle of a hole without clearance the normal turns round within a step: a contact that comes to stick there slides again at once.
TEST(RungeKutta54, KeepsFrictionWithinItsBoundWhereTheNormalTurns) {
  constexpr double mass = 2.55e-4, friction = 3.0, duration = 0.0644;
  Scene scene = mass_point(mass, Vec3(0.0, 616.13, 1047.42), duration);
  scene.system.damping = (0.0 + scene.system.stiffness.array()).sqrt().matrix();
  scene.contacts = {
      contact_of(mass, {contact::Circle{0.0}, {104.9, 3.27e-3}, {104.9, 0.0, friction, friction}})};
  scene.loads = {force_on(mass, 2.59e-2 * Vec3(0.0, 1.0, 0.3).normalized(), Harmonic{1.0, 185.686, 0.0})};
  const History run = simulate(scene, adaptive(1e-6), duration / 20000.0);
  constexpr double of_step = 1e-6; // tolerance of a step, of the largest force
  const double allowed = of_step * friction * run.normal.maxCoeff();
  EXPECT_GT(run.normal.maxCoeff(), 1e-3);
  for (Eigen::Index j = 0; j < run.time.size(); ++j)
    EXPECT_LE(std::hypot(run.along_x(0, j), run.along_t(0, j)), friction * run.normal(0, j) + allowed)
        << run.time(j);
}

// The forces of spring and damper, K p + c p', end while the mass penetrates, and are back before it moves inwards again. Between planes without
// clearance, too, it is not on the opposite one then.
TEST(RungeKutta54, ClosesAContactWhoseForceIsBackWhileItStillLeaves) {
  const contact::Obstacle stop = Stop{0.0, PlaneAxis::y}, planes = contact::PlanePair{0.0, PlaneAxis::y};
  const Harmonic steady{30.0, 1e-6, 0.5 * std::numbers::pi}, turning{60.0, 100.0, -0.5 * std::numbers::pi};
  const contact::NormalLaw kelvin_voigt{1e4, 100.0}, hunt_crossley{1e4, 0.0, 2.0};
  for (const Rebound& r : {Rebound{kelvin_voigt, 0.00452, 0.45, steady, 0.02, stop},
                           Rebound{kelvin_voigt, 0.00452, 0.45, steady, 0.02, planes},
                           Rebound{hunt_crossley, 0.0045, 0.4, turning, 0.006, stop},
                           Rebound{hunt_crossley, 0.0045, 0.4, turning, 0.006, planes}}) {
    Scene scene = mass_point(1.0, Vec3::Zero(), r.duration);
    start(scene, 1.0, Vec3(0, r.penetration, 0), Vec3(0, -r.speed, 0));
    scene.contacts = {contact_of(1.0, {r.obstacle, r.law, {}})};
    scene.loads = {force_on(1.0, Vec3(0, 1.0, 0), r.load)};
    const ForceMeans exact = integrate(r, 200000);
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      const auto found = simulate(scene, adaptive(tolerance), r.duration).statistics[0];
      const double allowed = 1e-5 + 30.0 * tolerance; // of the integration, and of the steps
      EXPECT_NEAR(found.normal_mean, exact.force, allowed * exact.force) << tolerance;
      EXPECT_NEAR(found.contact_time_ratio, exact.closed, allowed) << tolerance;
    }
  }
}

} // namespace runge_kutta_54_test
