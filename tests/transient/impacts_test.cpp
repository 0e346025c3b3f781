// SPDX-License-Identifier: GPL-3.0-or-later
// Impacts with closed solutions: elastic stop, ball, restitution, oblique impact, oscillator in a gap.
#include "scenes.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;
using contact::PlaneAxis;
using contact::PlanePair;
using contact::Stop;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double asked = 1e-3; // accuracy asked of single impacts at the automatic step
constexpr double euler_asked =
    2e-3; // Euler at a step that resolves the contact by w_c h = 1e-3: its order is 1

constexpr double two_steps = 1.6e-3; // of 2.5e-5 s, relative to a contact: its ends are known to a step each

struct Impact {
  double start = 0.0, duration = 0.0, peak = 0.0, peak_time = 0.0, impulse = 0.0;
};

/// The impacts of contact 0; the peak by the parabola through its three highest steps.
std::vector<Impact> impacts(std::vector<Trace::Entry> records) {
  std::vector<Impact> out;
  const double h = records[1].time - records[0].time;
  records.insert(records.begin(), Trace::Entry{}); // open before the start
  for (std::size_t i = 1; i + 1 < records.size(); ++i) {
    const double a = records[i - 1].normal, b = records[i].normal, c = records[i + 1].normal;
    if (b > 0.0 && a == 0.0)
      out.push_back({records[i].time - 0.5 * h});
    if (!(b > 0.0) || out.empty())
      continue;
    Impact& now = out.back();
    now.duration += h;
    now.impulse += h * b;
    if (b > now.peak && b >= c && b >= a) {
      const double bend = a - 2.0 * b + c, shift = bend < 0.0 ? 0.5 * (a - c) / bend : 0.0;
      now.peak = b - 0.25 * (a - c) * shift;
      now.peak_time = records[i].time + shift * h;
    }
  }
  return out;
}

/// A2: mass 100 on a spring 1e4, stop of 1e6 at rest position, arriving at 1 m/s.
struct ElasticStop {
  static constexpr double m = 100.0, k = 1e4, stiffness = 1e6;
  static Scene scene() {
    Scene s = mass_point(m, Vec3(0, k, 0), 0.5);
    start(s, m, Vec3::Zero(), Vec3(0, 1, 0));
    s.contacts = {contact_of(m, {Stop{0.0, PlaneAxis::y}, {stiffness}, {}})};
    return s;
  }
  static void check(const StepOptions& options, double tolerance) {
    const auto found = impacts(trace(scene(), options));
    const double w2 = std::sqrt((k + stiffness) / m), w1 = std::sqrt(k / m), duration = pi / w2,
                 period = duration + pi / w1;
    ASSERT_GE(found.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(found[i].peak / 9950.371902, 1.0, tolerance);
      EXPECT_NEAR(found[i].peak_time / (0.5 * duration + static_cast<double>(i) * period), 1.0, tolerance);
      EXPECT_NEAR(found[i].impulse / 198.019802, 1.0, tolerance);
    }
    EXPECT_NEAR(found[1].duration / duration, 1.0, two_steps);
  }
};

/// A4: a ball dropped on a stop 2 m below.
Scene ball() {
  Scene s = mass_point(1.0, Vec3::Zero(), 1.1);
  start(s, 1.0, Vec3::Zero(), Vec3(0, 0, 1.0)); // z_loc is down
  s.contacts = {contact_of(1.0, {Stop{2.0, PlaneAxis::z}, {100.0}, {}})};
  s.loads = {force_on(1.0, Vec3(0, 0, 10.0), Constant{1.0})};
  return s;
}

void check_ball(const StepOptions& options, double tolerance) {
  const History run = simulate(ball(), options, 0.1);
  EXPECT_NEAR(run.q(2, 10) / 1.332162981855, 1.0, tolerance);
  EXPECT_NEAR(run.q(2, 11) / 0.856394405035, 1.0, tolerance);
  const auto found = impacts(trace(ball(), options));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].start / 0.54031242374329, 1.0, tolerance);
  EXPECT_NEAR((found[0].start + found[0].duration) / 0.88545615307643, 1.0, tolerance);
  EXPECT_NEAR(found[0].peak / 74.8074, 1.0, tolerance);
}

/// A6: a free mass 2 kg on 5e5 N/m at 1.5 m/s, damping ratio xi.
void check_restitution(double xi, double e, double duration, double peak, const StepOptions& options,
                       double tolerance) {
  constexpr double m = 2.0, k = 5e5, v0 = 1.5;
  Scene s = mass_point(m, Vec3::Zero(), 0.008);
  start(s, m, Vec3::Zero(), Vec3(0, v0, 0));
  s.contacts = {contact_of(m, {Stop{0.0, PlaneAxis::y}, {k, 2.0 * xi * std::sqrt(k * m)}, {}})};
  const History run = simulate(s, options, s.duration);
  EXPECT_NEAR(-run.v(1, 1) / std::sqrt(m) / v0, e, tolerance);
  const auto found = impacts(trace(s, options));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].duration / duration, 1.0, tolerance);
  EXPECT_NEAR(found[0].peak / peak, 1.0, tolerance);
}

/// A7: vn' and vt' after a sliding oblique impact.
void check_oblique(double xi, double vn, double vt, const StepOptions& options, double tolerance) {
  constexpr double k = 1e6;
  Scene s = mass_point(1.0, Vec3::Zero(), 0.004);
  start(s, 1.0, Vec3::Zero(), Vec3(0, 1.0, 2.0));
  const double damper = contact::automatic_tangential_damping(k, 0.0, 1.0, 0.0);
  s.contacts = {
      contact_of(1.0, {Stop{0.0, PlaneAxis::y}, {k, 2.0 * xi * std::sqrt(k)}, {k, damper, 0.3, 0.3}})};
  const History run = simulate(s, options, s.duration);
  EXPECT_NEAR(-run.v(1, 1), vn, tolerance);
  EXPECT_NEAR(run.v(2, 1), vt, tolerance);
}

} // namespace

TEST(ElasticStop, HasThePeaksAndImpulsesOfItsClosedForm) { ElasticStop::check(splitting(), asked); }

TEST(ElasticStop, OfEulerConvergesToThem) { ElasticStop::check(euler(1e-5), euler_asked); }

TEST(ElasticStop, OfEnergyConservingHasThem) { ElasticStop::check(energy_conserving(), asked); }

TEST(BallOnAStop, FliesSinksAndReturnsAsItsClosedForm) { check_ball(splitting(), asked); }

TEST(BallOnAStop, OfEulerConvergesToIt) { check_ball(euler(1e-5), euler_asked); }

TEST(BallOnAStop, OfEnergyConservingHasIt) { check_ball(energy_conserving(), asked); }

TEST(Restitution, WithoutDamperIsOne) {
  check_restitution(0.0, 1.0, 6.283185e-3, 1500.0, splitting(), asked);
}

TEST(Restitution, WithADamperIsThatOfALawThatNeverPulls) {
  check_restitution(0.1, 0.74407940, 5.912151e-3, 1320.216, splitting(), asked);
}

TEST(Restitution, OfEulerConvergesToThem) {
  check_restitution(0.0, 1.0, 6.283185e-3, 1500.0, euler(1e-6), euler_asked);
  check_restitution(0.1, 0.74407940, 5.912151e-3, 1320.216, euler(1e-6), euler_asked);
}

TEST(Restitution, OfEnergyConservingHasThem) {
  check_restitution(0.0, 1.0, 6.283185e-3, 1500.0, energy_conserving(), asked);
  check_restitution(0.1, 0.74407940, 5.912151e-3, 1320.216, energy_conserving(), asked);
}

TEST(ObliqueImpact, ThatSlidesLosesTangentialSpeedByTheNormalImpulse) {
  check_oblique(0.0, 1.0, 1.4, splitting(), asked);
  check_oblique(0.1, 0.74407940, 1.4767762, splitting(), asked);
}

TEST(ObliqueImpact, OfEulerConvergesToIt) {
  check_oblique(0.0, 1.0, 1.4, euler(1e-7), euler_asked);
  check_oblique(0.1, 0.74407940, 1.4767762, euler(1e-7), euler_asked);
}

TEST(ObliqueImpact, OfEnergyConservingHasIt) {
  check_oblique(0.0, 1.0, 1.4, energy_conserving(), asked);
  check_oblique(0.1, 0.74407940, 1.4767762, energy_conserving(), asked);
}

void check_gap_oscillator(const StepOptions& options) {
  constexpr double k = 4.0 * pi * pi;
  for (const auto& [speed, period] : {std::pair(0.05, 1.0), std::pair(0.1, 0.61212248),
                                      std::pair(0.2, 0.39503082), std::pair(0.5, 0.27698718)}) {
    Scene s = mass_point(1.0, Vec3(0, k, 0), 3.1 * period);
    start(s, 1.0, Vec3::Zero(), Vec3(0, speed, 0));
    s.contacts = {contact_of(1.0, {PlanePair{0.01, PlaneAxis::y}, {24.0 * k}, {}})};
    const auto records = trace(s, options);
    std::vector<double> crossings; // upwards
    for (std::size_t i = 1; i < records.size(); ++i)
      if (records[i - 1].uy < 0.0 && records[i].uy >= 0.0)
        crossings.push_back(records[i].time - (records[i].time - records[i - 1].time) * records[i].uy /
                                                  (records[i].uy - records[i - 1].uy));
    ASSERT_EQ(crossings.size(), 3u);
    for (std::size_t n = 0; n < 3; ++n)
      EXPECT_NEAR(crossings[n] / (static_cast<double>(n + 1) * period), 1.0, asked) << "speed " << speed;
  }
}

TEST(GapOscillator, HasThePeriodOfItsClosedForm) { check_gap_oscillator(splitting()); }

TEST(GapOscillator, OfEnergyConservingHasIt) { check_gap_oscillator(energy_conserving()); }

TEST(ElasticStop, OfCollocationHasThem) { ElasticStop::check(collocation(), asked); }

TEST(BallOnAStop, OfCollocationHasIt) { check_ball(collocation(), asked); }

TEST(Restitution, OfCollocationHasThem) {
  check_restitution(0.0, 1.0, 6.283185e-3, 1500.0, collocation(), asked);
  check_restitution(0.1, 0.74407940, 5.912151e-3, 1320.216, collocation(), asked);
}

TEST(ObliqueImpact, OfCollocationHasIt) {
  check_oblique(0.0, 1.0, 1.4, collocation(), asked);
  check_oblique(0.1, 0.74407940, 1.4767762, collocation(), asked);
}
