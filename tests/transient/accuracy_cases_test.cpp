// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that the automatic step of splitting was not made on, at an accuracy of 0.01, against converged values of independent integrators.
#include "contact/support_shapes.hpp"
#include "scenes.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace accuracy_cases_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using namespace fretwork::vibration;
using contact::PlaneAxis;

namespace {

post::ContactSummary statistics(const Scene& scene) {
  return simulate(scene, splitting(), scene.duration).statistics[0];
}

/// With every event located.
post::ContactSummary located(const Scene& scene) {
  StepOptions options;
  options.scheme = SchemeKind::runge_kutta_54;
  options.tolerance = 1e-7;
  return simulate(scene, options, scene.duration).statistics[0];
}

Load random_on(double mass, const Vec3& direction, double rms, double low, double high, std::uint64_t seed) {
  return force_on(mass, direction, Random{rms, low, high, seed});
}

} // namespace

TEST(AccuracyCases, DirectionOfSlipWithoutTangentialDamper) {
  constexpr double mass = 1.0;
  Scene s = mass_point(mass, Vec3(400.0, 700.0, 1100.0), 2.0);
  for (Eigen::Index i = 0; i < 3; ++i)
    s.system.damping(i) = 2.0 * 0.02 * std::sqrt(s.system.stiffness(i));
  s.contacts = {contact_of(mass, {contact::Stop{0.0, PlaneAxis::z}, {1e5}, {2e4, 0.0, 0.3, 0.3}})};
  s.contacts[0].rest.z() = 1e-3;
  s.loads = {force_on(mass, {45.0, 0.0, 0.0}, Harmonic{1.0, 4.0}),
             force_on(mass, {0.0, 45.0, 0.0}, Harmonic{1.0, 8.0, 0.7}),
             force_on(mass, {0.0, 0.0, 20.0}, Harmonic{1.0, 9.0})};
  EXPECT_NEAR(statistics(s).work_rate / 116.771, 1.0, 1e-3);
}

TEST(AccuracyCases, PartialStickWithANormalDamper) {
  constexpr double mass = 0.24555352424019936, low = 6.440028968449738, high = 172.22316326606094;
  Scene s = mass_point(mass, Vec3(16842.32283174656, 10051.284337983529, 10630.461646610309), 200.0);
  for (Eigen::Index i = 0; i < 3; ++i)
    s.system.damping(i) = 2.0 * 0.005 * std::sqrt(s.system.stiffness(i));
  s.contacts = {contact_of(mass, {contact::Stop{0.0004341313813140947, PlaneAxis::y},
                                  {18252072.36199965, 583.4620460804588},
                                  {427678.355392553, 453.6905748629477, 1.0, 1.0}})};
  s.loads = {random_on(mass, {1, 0, 0}, 5.139079492616109, low, high, 70),
             random_on(mass, {0, 1, 0}, 5.780567594016632, low, high, 71),
             random_on(mass, {0, 0, 1}, 4.624454075213306, low, high, 72)};
  const post::ContactSummary c = statistics(s);
  // two standard errors of 200 s and 2 %; with one impulse a step: +34, +60 and +14 %
  EXPECT_NEAR(c.work_rate / 0.0502, 1.0, 0.02 + 2.0 * c.error.work_rate / c.work_rate);
  EXPECT_NEAR(c.friction_power / 0.0185, 1.0, 0.02 + 2.0 * c.error.friction_power / c.friction_power);
  EXPECT_NEAR(c.contact_time_ratio / 0.0135, 1.0, 0.03);
}

TEST(AccuracyCases, AFreeMassCrossesItsGapWithinAStep) {
  // between two planes of a soft contact: a period of 4 gap/v + 2 pi/w_c, whatever the step
  constexpr double mass = 1.0, stiffness = 1e4, gap = 1e-4, speed = 1.0, duration = 5.0;
  Scene s = mass_point(mass, Vec3::Zero(), duration);
  start(s, mass, Vec3::Zero(), Vec3(0, speed, 0));
  s.contacts = {contact_of(mass, {contact::PlanePair{gap, PlaneAxis::y}, {stiffness}, {}})};
  const double w = std::sqrt(stiffness / mass), half_period = 2.0 * gap / speed + std::numbers::pi / w;
  for (const double step : {0.1 / w, 0.8 / w}) { // the crossing takes 0.02/w
    const auto c = simulate(s, splitting(step), duration).statistics[0];
    EXPECT_NEAR(static_cast<double>(c.impacts), duration / half_period, 2.0) << step;
    EXPECT_NEAR(c.contact_duration_mean * w / std::numbers::pi, 1.0, 0.01) << step;
    EXPECT_NEAR(c.departure_velocity_mean, speed, 0.01) << step;
  }
}

// Masses cross a round hole, bounce and slide round, all from other places and in other directions. Without shorter intervals where they cross, those of
// 4 and 8 clearances a step have up to 2.5 % less contact time.
TEST(AccuracyCases, MassesCrossARoundHoleWithinAStep) {
  constexpr double mass = 1.0, stiffness = 1e5, speed = 0.5, mu = 0.3;
  constexpr int starts = 60;
  const double w = std::sqrt(stiffness / mass);
  for (const double step : {0.65 / w, 1.75 / w, 3.0 / w})
    for (const double clearances : {1.0, 4.0, 8.0}) { // of a step
      const double gap = speed * step / clearances,
                   duration = step * std::ceil(5.0 * (2.0 * gap / speed + std::numbers::pi / w) / step);
      double closed = 0.0, closed_of = 0.0, impulse = 0.0, impulse_of = 0.0;
      for (int i = 0; i < starts; ++i) {
        const double r = 0.9 * gap * std::sqrt((i + 0.5) / starts), at = 2.4 * i, to = 1.7 * i * i,
                     v = speed * (0.5 + std::fmod(0.618 * i, 1.0));
        Scene s = mass_point(mass, Vec3::Zero(), duration);
        start(s, mass, Vec3(0.0, r * std::cos(at), r * std::sin(at)),
              Vec3(0.0, v * std::cos(to), v * std::sin(to)));
        s.contacts = {contact_of(mass, {contact::Circle{gap}, {stiffness}, {0.5 * stiffness, 9.0, mu, mu}})};
        const post::ContactSummary c = simulate(s, splitting(step), duration).statistics[0], of = located(s);
        closed += c.contact_time_ratio;
        closed_of += of.contact_time_ratio;
        impulse += c.normal_mean;
        impulse_of += of.normal_mean;
      }
      EXPECT_NEAR(closed / closed_of, 1.0, 0.005) << step * w << ' ' << clearances;
      EXPECT_NEAR(impulse / impulse_of, 1.0, 0.008) << step * w << ' ' << clearances;
    }
}

// A mass slides along a face of an egg crate into its corner, where the normal turns within a small part of a step.
TEST(AccuracyCases, SlidesIntoCornersOfAnEggCrate) {
  constexpr double mass = 1.0, room = 3.9e-5, duration = 60.0;
  Scene s = mass_point(mass, Vec3(4800.0, 4800.0, 6200.0), duration);
  for (Eigen::Index i = 0; i < 3; ++i)
    s.system.damping(i) = 2.0 * 0.0075 * std::sqrt(s.system.stiffness(i));
  s.contacts = {contact_of(
      mass, {contact::egg_crate(1e-2, 1e-2 + room, 1e-2 + room), {1e7, 1771.0}, {5.8e6, 0.0, 0.3, 0.3}})};
  s.loads = {force_on(mass, {0.0, 2.0, 0.0}, Harmonic{1.0, 5.3}),
             force_on(mass, {0.0, 1.5, 0.0}, Harmonic{1.0, 14.1, 1.0}),
             force_on(mass, {0.0, 0.0, 3.0}, Harmonic{1.0, 9.7, 2.0})};
  const post::ContactSummary c = statistics(s), of = located(s);
  EXPECT_NEAR(c.contact_time_ratio / of.contact_time_ratio, 1.0, 0.012); // 0.6, 0.4 and 0.3 %;
  EXPECT_NEAR(c.normal_rms / of.normal_rms, 1.0, 0.01);                  // in two intervals a step 2.3, 2.6
  EXPECT_NEAR(c.work_rate / of.work_rate, 1.0, 0.01);                    // and 1.6 %
}

// It bounces from face to face in a corner until friction has taken what it began with: in two intervals a step it gains as much, on and on.
TEST(AccuracyCases, BouncesInACornerOfAnEggCrate) {
  constexpr double mass = 0.45, room = 2.2e-5, duration = 34.0;
  Scene s = mass_point(mass, mass * Vec3(3910.0, 7860.0, 1340.0), duration);
  for (Eigen::Index i = 0; i < 3; ++i)
    s.system.damping(i) = 2.0 * 0.0051 * std::sqrt(s.system.stiffness(i));
  s.contacts = {contact_of(
      mass, {contact::egg_crate(1e-2, 1e-2 + room, 1e-2 + room), {1.16e6}, {3.67e4, 17.5, 0.18, 0.18}})};
  s.contacts[0].rest = {0.0, 4.53e-5, 4.52e-5};
  s.loads = {force_on(mass, {0.02, 0.0, 0.0}, Harmonic{1.0, 4.9}),
             force_on(mass, {0.0, 0.01, 0.0}, Harmonic{1.0, 13.0}),
             force_on(mass, {0.0, 0.0, 0.002}, Harmonic{1.0, 8.0, 1.0})};
  const post::ContactSummary c = statistics(s), of = located(s);
  EXPECT_NEAR(c.normal_rms / of.normal_rms, 1.0, 0.05);
  EXPECT_NEAR(c.work_rate / of.work_rate, 1.0, 0.1);
}

// Without clearance a mass that slides goes from face to face within an interval.
TEST(AccuracyCases, SlidesBetweenFacesWithoutAGap) {
  constexpr double mass = 0.38, duration = 40.0;
  Scene s = mass_point(mass, Vec3(7000.0, 1000.0, 11000.0), duration);
  for (Eigen::Index i = 0; i < 3; ++i)
    s.system.damping(i) = 2.0 * 0.03 * std::sqrt(s.system.stiffness(i));
  s.contacts = {
      contact_of(mass, {contact::PlanePair{0.0, PlaneAxis::z}, {4.1e4, 1.8}, {3900.0, 2.3, 2.0, 0.8}})};
  s.loads = {force_on(mass, {0.0, 33.0, 0.0}, Harmonic{1.0, 19.7}),
             force_on(mass, {0.0, 33.0, 0.0}, Harmonic{1.0, 36.3, 1.0}),
             force_on(mass, {0.0, 0.0, 34.0}, Harmonic{1.0, 13.5}),
             force_on(mass, {0.0, 0.0, 34.0}, Harmonic{1.0, 18.6, 2.0})};
  const post::ContactSummary c = statistics(s), of = located(s);
  EXPECT_NEAR(c.work_rate / of.work_rate, 1.0, 0.01); // in two intervals a step -5 and -1.7 %
  EXPECT_NEAR(c.friction_power / of.friction_power, 1.0, 0.005);
  EXPECT_GT(c.contact_time_ratio, 0.995);
}

// Impacts of Hunt and Crossley that leave next to nothing of the speed, d v up to 20: the force rises far faster than the spring alone makes it.
TEST(AccuracyCases, NearlyPlasticImpactsThatSlide) {
  constexpr double mass = 0.3, duration = 3.0;
  Scene s = mass_point(mass, Vec3(1e4, 1.2e4, 1.4e4), duration);
  for (Eigen::Index i = 0; i < 3; ++i)
    s.system.damping(i) = 2.0 * 0.02 * std::sqrt(s.system.stiffness(i));
  s.contacts = {
      contact_of(mass, {contact::Stop{1e-4, PlaneAxis::y}, {1e6, 0.0, 40.0}, {3e5, 1.0, 0.3, 0.3}})};
  s.loads = {force_on(mass, {0.0, 20.0, 0.0}, Harmonic{1.0, 17.0}),
             force_on(mass, {0.0, 9.0, 0.0}, Harmonic{1.0, 26.18, 1.0}),
             force_on(mass, {0.0, 0.0, 6.0}, Harmonic{1.0, 29.0, 0.3}),
             force_on(mass, {5.0, 0.0, 0.0}, Harmonic{1.0, 13.0, 0.3})};
  const post::ContactSummary c = statistics(s), of = located(s);
  EXPECT_NEAR(c.work_rate / of.work_rate, 1.0, 0.02); // in two intervals a step +4 and +128 %
  EXPECT_NEAR(c.friction_power / of.friction_power, 1.0, 0.02);
}

} // namespace accuracy_cases_test
