// SPDX-License-Identifier: GPL-3.0-or-later
// Friction without a damper, C_T = 0, and with one that is short beside the step (K_T h/C_T of 4 to 20): a mass pressed on a plane.
#include "scenes.hpp"
#include <gtest/gtest.h>
#include <numbers>

namespace small_damper_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

enum class Drive { harmonics, circle, line };

/// Pressed by 100 N -+ 20 N on a plane, mu = 0.3, and driven along it above the bound.
Scene driven(Drive drive, double damping) {
  Scene s = mass_point(1.0, Vec3(400.0, 700.0, 1100.0), 2.0);
  for (int i = 0; i < 3; ++i)
    s.system.damping(i) = 0.04 * std::sqrt(s.system.stiffness(i));
  s.contacts = {contact_of(1.0, {contact::Stop{0.0, contact::PlaneAxis::z}, {1e5}, {2e4, damping, 0.3, 0.3}},
                           {0, 0, 1e-3})};
  const double second = drive == Drive::harmonics ? 8.0 : 4.0,
               phase = drive == Drive::harmonics ? 0.7 : 0.5 * std::numbers::pi;
  s.loads = {force_on(1.0, Vec3(drive == Drive::line ? 0 : 45.0, 0, 0), Harmonic{1.0, 4.0, 0.0}),
             force_on(1.0, Vec3(0, 45.0, 0), Harmonic{1.0, second, phase}),
             force_on(1.0, Vec3(0, 0, 20.0), Harmonic{1.0, 9.0, 0.0})};
  return s;
}

double work_rate(const Scene& scene, const StepOptions& options) {
  const History run = simulate(scene, options, 0.5);
  EXPECT_EQ(run.report.outcome, Outcome::done);
  return run.statistics[0].work_rate;
}

StepOptions at(SchemeKind kind, double step) {
  StepOptions options;
  options.scheme = kind;
  options.step = step;
  return options;
}

StepOptions adaptive(double tolerance) {
  StepOptions options;
  options.scheme = SchemeKind::runge_kutta_54;
  options.tolerance = tolerance;
  return options;
}

constexpr double step = 1e-4;         // s: w_c h = 0.03
constexpr double of_direction = 5e-3; // relative: springs that are set once a step turn with order 1
constexpr double of_short_one = 1e-3; // of collocation, which relaxes springs exactly

} // namespace

TEST(SmallDamper, SlidesInThePlaneWithoutADamper) {
  const Scene scene = driven(Drive::harmonics, 0.0);
  constexpr double right = 116.771; // W, an independent integrator that locates events
  EXPECT_NEAR(work_rate(scene, adaptive(1e-6)), right, 2e-4 * right);
  EXPECT_NEAR(work_rate(scene, at(SchemeKind::collocation, step)), right, of_short_one * right);
  EXPECT_NEAR(work_rate(scene, at(SchemeKind::devogelaere, step)), right, of_direction * right);
  EXPECT_NEAR(work_rate(scene, at(SchemeKind::euler, step)), right, of_direction * right);
}

TEST(SmallDamper, SlidesRoundACircleAndAlongALineWithoutADamper) {
  for (const Drive drive : {Drive::circle, Drive::line}) {
    const Scene scene = driven(drive, 0.0);
    const double right = work_rate(scene, adaptive(1e-7));
    EXPECT_NEAR(work_rate(scene, at(SchemeKind::collocation, step)), right, of_short_one * right);
    EXPECT_NEAR(work_rate(scene, at(SchemeKind::devogelaere, step)), right, of_direction * right);
    EXPECT_NEAR(work_rate(scene, at(SchemeKind::euler, step)), right, of_direction * right);
  }
}

TEST(SmallDamper, MayBeShortBesideTheStep) {
  // Devogelaere's scheme integrates the spring explicitly: its automatic step is short enough
  for (const Drive drive : {Drive::harmonics, Drive::circle, Drive::line})
    for (const double ratio : {20.0, 10.0, 4.0}) {
      const Scene scene = driven(drive, 2e4 * step / ratio);
      const double right = work_rate(scene, adaptive(1e-6));
      EXPECT_NEAR(work_rate(scene, at(SchemeKind::collocation, step)), right, of_short_one * right) << ratio;
      EXPECT_NEAR(work_rate(scene, at(SchemeKind::euler, step)), right, of_direction * right) << ratio;
      StepOptions automatic;
      automatic.scheme = SchemeKind::devogelaere;
      EXPECT_NEAR(work_rate(scene, automatic), right, of_short_one * right) << ratio;
    }
}

TEST(SmallDamper, DecidesOnWhatATouchBeginsWith) {
  // m = 1 flies into a stop with 1 and 1.5 m/s. Without damper it sticks from the touch on, up to mu_s F_N; however small a damper bears more
  // than the bound there, and then the spring, which grows by more than mu_d F_N, slides all along.
  constexpr double kn = 1e5, kt = 2e4, mu_s = 0.5, mu_d = 0.2, vn = 1.0, vt = 1.5;
  const double wn = std::sqrt(kn), wt = std::sqrt(kt);
  double onset = 0.0; // s: where the spring of one that sticks is at mu_s F_N
  while (kt / wt * vt * std::sin(wt * onset) < mu_s * kn / wn * vn * std::sin(wn * onset) + 1e-12)
    onset += 1e-7;
  const double sticks = vt * std::cos(wt * onset) - mu_d * vn * (1.0 + std::cos(wn * onset)),
               slides = vt - 2.0 * mu_d * vn;
  ASSERT_GT(slides - sticks, 0.2);
  for (const double damping : {0.0, 0.02, 0.2})
    for (const SchemeKind kind :
         {SchemeKind::splitting, SchemeKind::energy_conserving, SchemeKind::collocation, SchemeKind::euler,
          SchemeKind::devogelaere, SchemeKind::runge_kutta_54})
      for (const double phase : {0.0, 0.3, 0.6}) { // of the step, at the touch
        StepOptions options = kind == SchemeKind::runge_kutta_54 ? adaptive(1e-8) : at(kind, 1e-5);
        if (kind == SchemeKind::devogelaere || kind == SchemeKind::euler)
          options.step = damping > 0.0 ? 0.2 * damping / kt : 1e-6;
        const double gap = 1e-3 + phase * vn * options.step.value_or(1e-5);
        Scene s = mass_point(1.0, Vec3::Zero(), 0.02);
        start(s, 1.0, Vec3::Zero(), {0.0, vt, vn});
        s.contacts = {contact_of(
            1.0, {contact::Stop{gap, contact::PlaneAxis::z}, {kn}, {kt, damping, mu_s, mu_d}}, {0, 0, 0})};
        const History run = simulate(s, options, 1e-3);
        const double end = run.v(1, run.v.cols() - 1);
        EXPECT_NEAR(end, damping > 0.0 ? slides : sticks, 0.02)
            << name_of(kind) << " " << damping << " " << phase;
      }
}

TEST(SmallDamper, DecidesByTheNormalDamperToo) {
  // F_N begins with C_N v_n = 20 N: tangential dampers of 5 and 20 N s/m bear 7.5 and 30 N there, mu_s F_N is 10 N
  for (const double damping : {5.0, 20.0}) {
    std::vector<double> ends;
    for (const SchemeKind kind : {SchemeKind::runge_kutta_54, SchemeKind::splitting,
                                  SchemeKind::energy_conserving, SchemeKind::collocation}) {
      Scene s = mass_point(1.0, Vec3::Zero(), 0.02);
      start(s, 1.0, Vec3::Zero(), {0.0, 1.5, 1.0});
      s.contacts = {
          contact_of(1.0, {contact::Stop{1e-3, contact::PlaneAxis::z}, {1e5, 20.0}, {2e4, damping, 0.5, 0.2}},
                     {0, 0, 0})};
      const History run =
          simulate(s, kind == SchemeKind::runge_kutta_54 ? adaptive(1e-8) : at(kind, 2e-5), 1e-3);
      ends.push_back(run.v(1, run.v.cols() - 1));
      EXPECT_NEAR(ends.back(), ends.front(), 5e-3) << name_of(kind) << " " << damping;
    }
  }
}

// A mass that sticks in an impact until F_N, with C_N, has fallen to |T|/mu_s, and then slides at mu_d F_N while its spring unwinds through
// the slider and a damper slower or faster than a step: what is lost, and how far it has slid when the contact opens.
TEST(SmallDamper, BreaksLooseAsAnImpactEnds) {
  constexpr double mass = 0.2455, kt = 4.28e5, vn = 0.06, vt = 0.1;
  for (const double damping : {0.0, 0.05, 0.5, 5.0}) {
    Scene s = mass_point(mass, Vec3::Zero(), 6e-4);
    start(s, mass, Vec3::Zero(), {0.0, vt, vn});
    s.contacts = {contact_of(
        mass, {contact::Stop{1e-5, contact::PlaneAxis::z}, {1.825e7, 583.0}, {kt, damping, 0.5, 0.2}},
        {0, 0, 0})};
    const History right = simulate(s, adaptive(1e-9), 1e-4);
    const double lost = right.statistics[0].friction_power, worked = right.statistics[0].work_rate;
    for (const double h : {1e-5, 4e-6, 1e-6}) {
      const History run = simulate(s, at(SchemeKind::collocation, h), 1e-4);
      EXPECT_NEAR(run.statistics[0].friction_power, lost, 4e-3 * lost) << damping << " " << h;
      // of an impact that slides for 14e-6 s, which records sample
      const double sampled = h < 1e-5 ? 0.5 * h / 14e-6 : 1.0;
      EXPECT_NEAR(run.statistics[0].work_rate, worked, sampled * worked) << damping << " " << h;
    }
  }
}

} // namespace small_damper_test
