// SPDX-License-Identifier: GPL-3.0-or-later
// Impacts with closed solutions: elastic stop, ball, restitution, oblique impact, oscillator in a gap.
#include "scenes.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace impacts_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::PlaneAxis;
using contact::PlanePair;
using contact::Stop;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double two_steps = 1.6e-3; // of 2.5e-5 s, relative to a contact: its ends are known to a step each

/// Records at equal distances but for macro-steps, which separate single impacts.
constexpr Candidate with_fixed_steps[] = {{SchemeKind::splitting},
                                          {SchemeKind::collocation},
                                          {SchemeKind::euler},
                                          {SchemeKind::energy_conserving},
                                          {SchemeKind::devogelaere}};

struct Impact {
  double start = 0.0, duration = 0.0, peak = 0.0, peak_time = 0.0, impulse = 0.0;
};

/// The impacts of contact 0; the peak by the parabola through its three highest steps.
std::vector<Impact> impacts(std::vector<Trace::Entry> records) {
  std::vector<Impact> out;
  double h = records[1].time - records[0].time; // of a step: macro-steps, in which no force acts, are longer
  for (std::size_t i = 1; i < records.size(); ++i)
    h = std::min(h, records[i].time - records[i - 1].time);
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

void check_ball_in_flight(const StepOptions& options, double tolerance) {
  const History run = simulate(ball(), options, 0.1);
  EXPECT_NEAR(run.q(2, 10) / 1.332162981855, 1.0, tolerance);
  EXPECT_NEAR(run.q(2, 11) / 0.856394405035, 1.0, tolerance);
}

void check_ball_on_stop(const StepOptions& options, double tolerance) {
  const auto found = impacts(trace(ball(), options));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].start / 0.54031242374329, 1.0, tolerance);
  EXPECT_NEAR((found[0].start + found[0].duration) / 0.88545615307643, 1.0, tolerance);
  EXPECT_NEAR(found[0].peak / 74.8074, 1.0, tolerance);
}

/// A6: a free mass 2 kg on 5e5 N/m at 1.5 m/s, damping ratio xi.
struct FreeMass {
  static constexpr double m = 2.0, k = 5e5, v0 = 1.5;
  double xi, e, duration, peak;
  [[nodiscard]] Scene scene() const;
  void check_speed(const StepOptions& options, double tolerance) const;
  void check_impact(const StepOptions& options, double tolerance) const;
};
constexpr FreeMass free_masses[] = {{0.0, 1.0, 6.283185e-3, 1500.0},
                                    {0.1, 0.74407940, 5.912151e-3, 1320.216}};

Scene FreeMass::scene() const {
  Scene s = mass_point(m, Vec3::Zero(), 0.008);
  start(s, m, Vec3::Zero(), Vec3(0, v0, 0));
  s.contacts = {contact_of(m, {Stop{0.0, PlaneAxis::y}, {k, 2.0 * xi * std::sqrt(k * m)}, {}})};
  return s;
}

void FreeMass::check_speed(const StepOptions& options, double tolerance) const {
  const History run = simulate(scene(), options, scene().duration);
  EXPECT_NEAR(-run.v(1, 1) / std::sqrt(m) / v0, e, tolerance) << xi;
}

void FreeMass::check_impact(const StepOptions& options, double tolerance) const {
  const auto found = impacts(trace(scene(), options));
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

/// A8: a mass between two stops of a gap.
void check_gap_oscillator(const StepOptions& options, double tolerance) {
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
      EXPECT_NEAR(crossings[n] / (static_cast<double>(n + 1) * period), 1.0, tolerance) << "speed " << speed;
  }
}

/// All schemes.
class Impacts : public testing::TestWithParam<Candidate> {};
/// All whose steps are equal.
class ImpactTables : public testing::TestWithParam<Candidate> {};

} // namespace

TEST_P(ImpactTables, OfAnElasticStopHaveThePeaksAndImpulsesOfTheClosedForm) {
  ElasticStop::check(GetParam().options(1e-5), GetParam().tolerance());
}

TEST_P(ImpactTables, OfABallOnAStopAreThoseOfTheClosedForm) {
  check_ball_on_stop(GetParam().options(1e-5), GetParam().tolerance());
}

TEST_P(ImpactTables, OfAFreeMassHaveTheDurationAndPeakOfTheClosedForm) {
  for (const FreeMass& mass : free_masses)
    mass.check_impact(GetParam().options(1e-6), GetParam().tolerance());
}

TEST_P(ImpactTables, TellThePeriodBetweenTwoStops) {
  check_gap_oscillator(GetParam().options(1e-5), GetParam().tolerance());
}

TEST_P(Impacts, LetABallFlyAndReturnAsTheClosedForm) {
  check_ball_in_flight(GetParam().options(1e-5), GetParam().tolerance());
}

// Without a damper 1, with one that of a law that never pulls.
TEST_P(Impacts, GiveTheRestitutionOfTheClosedForm) {
  for (const FreeMass& mass : free_masses)
    mass.check_speed(GetParam().options(1e-6), GetParam().tolerance());
}

TEST_P(Impacts, ThatSlideLoseTangentialSpeedByTheNormalImpulse) {
  check_oblique(0.0, 1.0, 1.4, GetParam().options(1e-7), GetParam().tolerance());
  check_oblique(0.1, 0.74407940, 1.4767762, GetParam().options(1e-7), GetParam().tolerance());
}

INSTANTIATE_TEST_SUITE_P(Schemes, ImpactTables, testing::ValuesIn(with_fixed_steps), name_of_candidate);
INSTANTIATE_TEST_SUITE_P(Schemes, Impacts, testing::ValuesIn(candidates), name_of_candidate);

// Without a gap a mass goes from face to face without a time between: two impacts in a period, whatever the step.
TEST(ImpactCounts, GoFromFaceToFaceWithoutAGap) {
  for (const double gap : {0.0, 1e-8, 1e-6}) {
    Scene s = mass_point(0.3, Vec3(1e4, 1.2e4, 1.4e4), 3.0);
    s.system.damping.setConstant(8.0);
    s.contacts = {contact_of(0.3, {PlanePair{gap, PlaneAxis::y}, {1e5}, {}})};
    s.loads = {force_on(0.3, Vec3(0, 20.0, 0), Harmonic{1.0, 17.0, 0.0})};
    for (const double step : {7e-4, 4e-4, 1e-4}) {
      StepOptions options;
      options.scheme = SchemeKind::splitting;
      options.step = step;
      const History run = simulate(s, options, 1.0);
      EXPECT_NEAR(run.statistics[0].impact_rate, 34.0, 0.51) << gap << " " << step;
      EXPECT_NEAR(run.statistics[0].departure_velocity_mean, run.statistics[0].impact_velocity_mean,
                  0.05 * run.statistics[0].impact_velocity_mean)
          << gap << " " << step;
    }
  }
}

// In a ring without clearance a mass that passes beside the centre stays in contact, however fast the normal turns.
TEST(ImpactCounts, AreNoneBesideTheCentreOfARing) {
  for (const double across : {0.05, 0.5, 5.0}) {
    Scene s = mass_point(0.3, Vec3(1e4, 1.2e4, 1.4e4), 3.0);
    s.system.damping.setConstant(8.0);
    s.contacts = {contact_of(0.3, {contact::Circle{0.0}, {1e5}, {}})};
    s.loads = {force_on(0.3, Vec3(0, 20.0, 0), Harmonic{1.0, 17.0, 0.0}),
               force_on(0.3, Vec3(0, 0, across), Harmonic{1.0, 17.0, 1.2})};
    StepOptions options;
    options.scheme = SchemeKind::splitting;
    options.step = 7e-4;
    const History run = simulate(s, options, 1.0, 0.01); // it starts in the centre, without penetration
    EXPECT_LT(run.statistics[0].impact_rate, 0.5 / 3.0) << across;
    EXPECT_GT(run.statistics[0].contact_time_ratio, 0.9995) << across;
  }
}

// The oracle counts alike, with steps that end where contacts close and open.
TEST(ImpactCounts, OfTheOracleGoFromFaceToFaceWithoutAGap) {
  for (const double gap : {0.0, 1e-8, 1e-6}) {
    Scene s = mass_point(0.3, Vec3(1e4, 1.2e4, 1.4e4), 3.0);
    s.system.damping.setConstant(8.0);
    s.contacts = {contact_of(0.3, {PlanePair{gap, PlaneAxis::y}, {1e5}, {}})};
    s.loads = {force_on(0.3, Vec3(0, 20.0, 0), Harmonic{1.0, 17.0, 0.0})};
    for (const double tolerance : {1e-5, 1e-8}) {
      StepOptions options;
      options.scheme = SchemeKind::runge_kutta_54;
      options.tolerance = tolerance;
      const History run = simulate(s, options, 1.0);
      EXPECT_NEAR(run.statistics[0].impact_rate, 34.0, 0.51) << gap << " " << tolerance;
      EXPECT_NEAR(run.statistics[0].departure_velocity_mean, run.statistics[0].impact_velocity_mean,
                  0.05 * run.statistics[0].impact_velocity_mean)
          << gap;
    }
  }
}

} // namespace impacts_test
