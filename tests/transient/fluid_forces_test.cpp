// SPDX-License-Identifier: GPL-3.0-or-later
// Forces that depend on the motion and its past: one metre of tube under the law S1, lift alone,
//     f = rho V^2/2 (-4 u - 0.4 (D/V) u' + 4 z),   z' = -0.4 (V/D) z + u'
// against its exact linear motion and against limit cycles of a Runge-Kutta method of order 8 at 1e-9.
#include "scenes.hpp"
#include "transient/scheme_scope.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace fluid_forces_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

constexpr double mass = 0.9, diameter = 0.01905, density = 300.0, frequency = 20.0, ratio = 0.01; // SI
constexpr double velocity = 2.5;                                                                  // m/s

core::MotionForces law_s1(double v) {
  const double pressure = 0.5 * density * v * v;
  core::MotionForces f;
  f.stiffness = f.damping = Eigen::MatrixXd::Zero(3, 3);
  f.stiffness(1, 1) = -4.0 * pressure / mass;
  f.damping(1, 1) = -0.4 * pressure * diameter / v / mass;
  f.input = Eigen::MatrixXd::Zero(3, 1);
  f.input(1, 0) = 4.0 * pressure / std::sqrt(mass);
  f.rates = Eigen::MatrixXd::Constant(1, 1, -0.4 * v / diameter);
  f.output = Eigen::MatrixXd::Zero(1, 3);
  f.output(0, 1) = 1.0 / std::sqrt(mass);
  return f;
}

/// @param displacement, speed  at the start, m and m/s
Scene tube(double duration, double displacement, double speed) {
  const double omega = 2.0 * std::numbers::pi * frequency;
  Scene scene = mass_point(mass, mass * omega * omega * Vec3(1.0, 1.0, 1.0), duration);
  scene.system.damping = 2.0 * ratio * omega * Vec3(1.0, 1.0, 1.0);
  start(scene, mass, Vec3(0.0, displacement, 0.0), Vec3(0.0, speed, 0.0));
  scene.system.motion = law_s1(velocity);
  return scene;
}

/// Elastic stops at both sides, without loss.
void add_stops(Scene& scene, double gap, double stiffness) {
  scene.contacts.push_back(
      contact_of(mass, {contact::PlanePair{gap, contact::PlaneAxis::y}, {stiffness}, {}}));
}

StepOptions adaptive(double tolerance) {
  StepOptions options;
  options.scheme = SchemeKind::runge_kutta_54;
  options.tolerance = tolerance;
  return options;
}

constexpr double digits = 1e-9; // of the reference values, relative

/// A law without memory, several outputs in a step.
TEST(FluidForces, AreThoseOfTheStateAtEachOutput) {
  struct Forces final : Sampler {
    void state(std::int64_t, double, const double* q, const double* v) override {
      expected.push_back(stiffness * q[1] + damping * v[1]);
    }
    void forces(std::int64_t, double, const double* load, std::span<const ContactForce>) override {
      found.push_back(load[1]);
    }
    void visit(core::StateArchive&) override {}
    double stiffness = 0.0, damping = 0.0;
    std::vector<double> expected, found;
  } forces;
  Scene scene = tube(0.05, 1e-4, 0.1);
  core::MotionForces& law = scene.system.motion;
  law.input.resize(3, 0);
  law.rates.resize(0, 0);
  law.output.resize(0, 3);
  forces.stiffness = law.stiffness(1, 1);
  forces.damping = law.damping(1, 1);
  (void)run(scene, choose_step(scene, splitting(1e-3)), {}, &forces, output_grid(scene.duration, 1e-4));
  ASSERT_EQ(forces.found.size(), 501u);
  const double largest = *std::max_element(forces.expected.begin(), forces.expected.end());
  for (std::size_t i = 0; i < forces.found.size(); ++i)
    EXPECT_NEAR(forces.found[i], forces.expected[i], digits * largest) << i;
}

TEST(FluidForces, LinearMotionIsExactForAnyStep) {
  for (const double step : {1e-4, 1e-3, 1e-2}) {
    const History h = simulate(tube(0.1, 0.0, 0.1), splitting(step), 0.1);
    const Eigen::Index last = h.time.size() - 1;
    ASSERT_NEAR(h.time(last), 0.1, 1e-12);
    EXPECT_NEAR(h.q(1, last) / std::sqrt(mass), 3.173993207881e-4, digits * 3.2e-4) << step;
    EXPECT_NEAR(h.v(1, last) / std::sqrt(mass), 0.1217013605055, digits * 0.12) << step;
    const Energy& e = h.report.energy;
    EXPECT_NEAR(e.fluid_work, 4.334707111e-3, digits * 4.4e-3) << step;
    EXPECT_NEAR(e.modal_damping, 1.453771003e-3, digits * 1.5e-3) << step;
    EXPECT_NEAR(e.fluid_work - e.modal_damping, 2.880936108e-3, digits * 4.4e-3) << step;
    EXPECT_NEAR(e.stored, 7.380936108e-3, digits * 7.4e-3) << step;
  }
}

/// The law leaves a critically damped motion, which no eigenvectors span: u = v0 t exp(-100 t).
TEST(FluidForces, BlocksThatCannotBeDiagonalisedMoveExactlyToo) {
  constexpr double k = 1e4, c = 200.0, speed = 0.1;
  Scene scene = tube(0.1, 0.0, speed);
  core::MotionForces& f = scene.system.motion;
  f.stiffness(1, 1) = scene.system.stiffness(1) - k;
  f.damping(1, 1) = scene.system.damping(1) - c;
  f.input.setZero(); // the lag follows the motion and does nothing
  for (const double step : {1e-4, 1e-3}) {
    const History h = simulate(scene, splitting(step), 0.01);
    for (Eigen::Index i = 0; i < h.time.size(); ++i) {
      const double t = h.time(i);
      EXPECT_NEAR(h.q(1, i) / std::sqrt(mass), speed * t * std::exp(-100.0 * t), digits * speed / 100.0)
          << step << ", " << t;
    }
  }
}

/// Modes with the law, contacts and loads: steps put together while no contact is near give the motion of single steps.
TEST(FluidForces, MacroStepsAreExactToo) {
  Scene scene = tube(0.5, 0.0, 0.1);
  add_stops(scene, 1.0, 1e5); // never reached
  scene.loads = {{Constant{1.0}, Eigen::Vector3d(0.0, 1.0, 0.0)}};
  StepOptions options;
  options.scheme = SchemeKind::splitting;
  const History h = simulate(scene, options, 0.5);
  EXPECT_GT(h.choice.macro_steps, 1);
  EXPECT_LT(h.report.records, h.choice.steps);
  scene.contacts.clear();
  const History single = simulate(scene, splitting(1e-3), 0.5);
  EXPECT_NEAR(h.q(1, h.q.cols() - 1), single.q(1, single.q.cols() - 1), digits * 1e-3);
  EXPECT_LT(h.report.residual_relative, 1e-12);
}

/// z(0) = 0: the displacement at the start has been held for ever.
TEST(FluidForces, AHeldDisplacementIsNoMotion) {
  const History h = simulate(tube(0.1, 1e-3, 0.0), splitting(1e-3), 0.1);
  EXPECT_NEAR(h.q(1, h.time.size() - 1) / std::sqrt(mass), 1.455521132913e-3, digits * 1.5e-3);
}

/// The adaptive scheme knows the forces by their rates alone.
TEST(FluidForces, RungeKuttaHasTheSameMotionAndWorks) {
  constexpr double of_tolerance = 1e-8; // relative, of some hundred steps at 1e-11
  const History h = simulate(tube(0.1, 0.0, 0.1), adaptive(1e-11), 0.1);
  const Eigen::Index last = h.time.size() - 1;
  EXPECT_NEAR(h.q(1, last) / std::sqrt(mass), 3.173993207881e-4, of_tolerance * 3.2e-4);
  constexpr double of_last_record = 2e-4; // its energies are those some 1e-5 s before the end
  EXPECT_NEAR(h.report.energy.fluid_work, 4.334707111e-3, of_last_record * 4.4e-3);
  EXPECT_NEAR(h.report.energy.modal_damping, 1.453771003e-3, of_last_record * 1.5e-3);
  EXPECT_LT(h.report.residual_relative, of_tolerance);
}

/// Largest |u| over the second half of a run, m.
double amplitude(const History& h) {
  const Eigen::Index n = h.time.size();
  return h.q.row(1).tail(n / 2).cwiseAbs().maxCoeff() / std::sqrt(mass);
}

/// Rising passages of u through 0 over the second half of a run, per second.
double dominant_frequency(const Eigen::VectorXd& time, const Eigen::RowVectorXd& u) {
  double first = -1.0, last = -1.0;
  int periods = -1;
  for (Eigen::Index i = time.size() / 2; i + 1 < time.size(); ++i)
    if (u(i) < 0.0 && u(i + 1) >= 0.0) {
      const double share = u(i) / (u(i) - u(i + 1));
      last = time(i) + share * (time(i + 1) - time(i));
      if (periods++ < 0)
        first = last;
    }
  return periods / (last - first);
}
double dominant_frequency(const History& h) { return dominant_frequency(h.time, h.q.row(1)); }

/// Mean speed where |u| passes the gap outwards, over the second half of a run.
double speed_at_touch(const Eigen::RowVectorXd& u, const Eigen::RowVectorXd& v, double gap) {
  double sum = 0.0;
  int touches = 0;
  for (Eigen::Index i = u.size() / 2; i + 1 < u.size(); ++i) {
    const double before = std::abs(u(i)) - gap, after = std::abs(u(i + 1)) - gap;
    if (before < 0.0 && after >= 0.0) {
      sum += std::abs(v(i) + before / (before - after) * (v(i + 1) - v(i)));
      ++touches;
    }
  }
  return sum / touches;
}

/// Work of the forces of law S1 in a period, J: the lag from the outputs, linear between them, over whole periods of the second half of a run.
double fluid_work_of_a_period(const History& h) {
  const core::MotionForces f = law_s1(velocity);
  const Eigen::RowVectorXd u = h.q.row(1), v = h.v.row(1);
  double lag = 0.0, work = 0.0, power = 0.0, from_last_start = 0.0;
  int periods = -1;
  for (Eigen::Index i = 1; i < h.time.size(); ++i) {
    const double dt = h.time(i) - h.time(i - 1), x = f.rates(0, 0) * dt;
    lag = lag * std::exp(x) + f.output(0, 1) * (u(i) - u(i - 1)) * std::expm1(x) / x;
    const double now = v(i) * (f.stiffness(1, 1) * u(i) + f.damping(1, 1) * v(i) + f.input(1, 0) * lag);
    from_last_start += 0.5 * (power + now) * dt;
    power = now;
    if (i >= h.time.size() / 2 && u(i - 1) < 0.0 && u(i) >= 0.0) {
      if (periods++ >= 0)
        work += from_last_start;
      from_last_start = 0.0;
    }
  }
  return work / periods;
}

constexpr double every = 1e-4; // s, outputs

/// A stop raises the frequency, the reduced velocity falls, the fluid damps: a limit cycle without any contact loss.
TEST(FluidForces, ElasticStopsLimitTheMotion) {
  struct Case {
    double stiffness, u_max, frequency;
  };
  for (const auto& [stiffness, u_max, f] :
       {Case{1e5, 7.114824902e-4, 29.83458335}, Case{1e6, 5.399947031e-4, 29.42519052}}) {
    Scene scene = tube(8.0, 0.0, 0.1);
    add_stops(scene, 5e-4, stiffness);
    const History h = simulate(scene, splitting(0.05 / std::sqrt(stiffness / mass)), every);
    EXPECT_NEAR(amplitude(h) / u_max, 1.0, 1e-3) << stiffness;
    EXPECT_NEAR(dominant_frequency(h) / f, 1.0, 1e-4) << stiffness;
    EXPECT_LT(h.report.residual_relative, 1e-3) << stiffness;
  }
}

TEST(FluidForces, RungeKuttaHasTheSameLimitCycle) {
  Scene scene = tube(8.0, 0.0, 0.1);
  add_stops(scene, 5e-4, 1e5);
  const History h = simulate(scene, adaptive(1e-9), every);
  EXPECT_NEAR(amplitude(h) / 7.114824902e-4, 1.0, 1e-4); // outputs miss the peak by at most (w every)^2/8
  EXPECT_NEAR(dominant_frequency(h) / 29.83458335, 1.0, 1e-5);
  // outputs are 1/300 of a period apart: both are linear between them
  EXPECT_NEAR(speed_at_touch(h.q.row(1), h.v.row(1), 5e-4 * std::sqrt(mass)) / std::sqrt(mass) /
                  0.09552107695,
              1.0, 1e-4);
  EXPECT_NEAR(fluid_work_of_a_period(h) / 6.2601893315e-4, 1.0, 1e-3);
}

/// Nothing but the gap has a length.
TEST(FluidForces, AmplitudeIsProportionalToTheGap) {
  const auto cycle = [](double scale) {
    Scene scene = tube(4.0, 0.0, scale * 0.1);
    add_stops(scene, scale * 5e-4, 1e5);
    return simulate(scene, splitting(1e-4), 1e-3);
  };
  const History one = cycle(1.0), two = cycle(2.0);
  EXPECT_NEAR(amplitude(two) / amplitude(one), 2.0, 1e-9);
  EXPECT_NEAR(dominant_frequency(two) / dominant_frequency(one), 1.0, 1e-9);
}

/// A damping that is negative at every frequency has no limit cycle between stops without loss.
TEST(FluidForces, FrozenNegativeDampingGrowsBetweenElasticStops) {
  Scene scene = tube(6.0, 0.0, 0.1);
  core::MotionForces& f = scene.system.motion;
  f.stiffness.setZero();
  f.input.setZero();
  f.damping(1, 1) = 2.0 * scene.system.damping(1);
  add_stops(scene, 5e-4, 1e5);
  const History h = simulate(scene, splitting(1e-4), 1e-3);
  const Eigen::Index n = h.time.size();
  double before = 0.0;
  for (int second = 0; second < 6; ++second) {
    const double now = h.q.row(1).segment(second * n / 6, n / 6).cwiseAbs().maxCoeff();
    EXPECT_GT(now, 1.2 * before) << second;
    before = now;
  }
}

/// Constant friction and a damping that is negative at every frequency: motion decays below the amplitude
///     X = a (r + 1)/(r - 1), a = mu F_N/k, r = exp(-pi zeta/(1 - zeta^2)^(1/2)), and grows above it.
TEST(FluidForces, FrictionHoldsNegativeDampingBelowAnAmplitude) {
  constexpr double zeta = -0.01, friction = 0.5; // N
  const double omega = 2.0 * std::numbers::pi * frequency, k = mass * omega * omega;
  const double r = std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta));
  const double rigid = friction / k * (r + 1.0) / (r - 1.0);
  EXPECT_NEAR(rigid, 2.2397621172e-3, 1e-12);
  constexpr double elastic = 2.2392462080e-3; // with K_T = 1e6 N/m in series
  const auto grows = [&](double amplitude, double tangential) {
    Scene scene = mass_point(mass, k * Vec3(1.0, 1.0, 1.0), 3.0);
    scene.system.damping.setZero();
    start(scene, mass, Vec3(0.0, amplitude, 0.0), Vec3::Zero());
    core::MotionForces& f = scene.system.motion = law_s1(velocity);
    f.stiffness.setZero();
    f.input.setZero();
    f.damping(1, 1) = -2.0 * zeta * omega;
    scene.contacts = {pressed(mass, 1.0, {tangential, 0.0, friction, friction})};
    const History h = simulate(scene, splitting(1e-4), 1e-3);
    const Eigen::Index period = 50, n = h.time.size();
    return h.q.row(1).tail(period).maxCoeff() > h.q.row(1).segment(n - 20 * period, period).maxCoeff();
  };
  constexpr double near = 3e-3; // of the amplitude
  for (const auto& [tangential, threshold] : {std::pair(1e6, elastic), std::pair(1e9, rigid)}) {
    EXPECT_TRUE(grows(threshold * (1.0 + near), tangential)) << tangential;
    EXPECT_FALSE(grows(threshold * (1.0 - near), tangential)) << tangential;
  }
}

/// A pinned tube of 1 m in six modes along lift, flow over its middle half, stops at its middle.
TEST(FluidForces, StopsLimitATubeInManyModes) {
  constexpr Eigen::Index modes = 6;
  constexpr double line = 1.0993164814, first = 33.425241258, v = 4.0, gap = 5e-4;
  const double pressure = 0.5 * density * v * v;
  Eigen::MatrixXd overlap(modes, modes); // int of products of shapes from 1/4 to 3/4
  for (Eigen::Index j = 0; j < modes; ++j)
    for (Eigen::Index k = 0; k < modes; ++k) {
      const auto integral = [](Eigen::Index wave) { // of cos(wave pi s)
        const double a = std::numbers::pi * static_cast<double>(wave);
        return wave == 0 ? 0.5 : (std::sin(0.75 * a) - std::sin(0.25 * a)) / a;
      };
      overlap(j, k) = (integral(std::abs(j - k)) - integral(j + k + 2)) / line;
    }
  Scene scene;
  scene.duration = 8.0;
  scene.system.stiffness.resize(modes);
  for (Eigen::Index k = 0; k < modes; ++k)
    scene.system.stiffness(k) =
        std::pow(2.0 * std::numbers::pi * first * static_cast<double>((k + 1) * (k + 1)), 2);
  scene.system.damping = 2.0 * ratio * scene.system.stiffness.cwiseSqrt();
  scene.q0 = Eigen::VectorXd::Zero(modes);
  scene.v0 = 0.05 * Eigen::VectorXd::Unit(modes, 0);
  core::MotionForces& f = scene.system.motion;
  f.stiffness = -4.0 * pressure * overlap;
  f.damping = -0.4 * pressure * diameter / v * overlap;
  f.input = 4.0 * pressure * overlap;
  f.rates = -0.4 * v / diameter * Eigen::MatrixXd::Identity(modes, modes);
  f.output = Eigen::MatrixXd::Identity(modes, modes);
  ContactPoint stop;
  stop.support = {contact::PlanePair{gap, contact::PlaneAxis::y}, {1e5}, {}};
  stop.b = Eigen::MatrixXd::Zero(3, modes);
  for (Eigen::Index k = 0; k < modes; ++k)
    stop.b(1, k) = std::sqrt(2.0 / line) * std::sin(0.5 * std::numbers::pi * static_cast<double>(k + 1));
  scene.contacts = {stop};
  const History h = simulate(scene, splitting(2e-5), every);
  const Eigen::RowVectorXd all = stop.b.row(1) * h.q, v_all = stop.b.row(1) * h.v,
                           u = all.tail(all.size() / 2);
  EXPECT_NEAR(dominant_frequency(h.time, all) / 42.24715150, 1.0, 1e-4);
  EXPECT_NEAR(speed_at_touch(all, v_all, gap) / 0.117968157, 1.0, 1e-3);
  EXPECT_NEAR(u.cwiseAbs().maxCoeff() / 6.733738331e-4, 1.0, 1e-3);
  EXPECT_NEAR(std::sqrt(u.squaredNorm() / static_cast<double>(u.size())) / 4.6423795e-4, 1.0, 1e-3);
}

TEST(FluidForces, OtherSchemesRefuseThem) {
  const Scene scene = tube(1.0, 0.0, 0.1);
  for (const SchemeKind kind :
       {SchemeKind::euler, SchemeKind::collocation, SchemeKind::devogelaere, SchemeKind::energy_conserving})
    EXPECT_NE(out_of_scope(scene, kind).find("depend on the motion"), std::string::npos);
  for (const SchemeKind kind : {SchemeKind::splitting, SchemeKind::runge_kutta_54})
    EXPECT_EQ(out_of_scope(scene, kind), "");
}

} // namespace

} // namespace fluid_forces_test
