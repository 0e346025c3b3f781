// SPDX-License-Identifier: GPL-3.0-or-later
/// Impacts and statistics of runs of the real schemes against closed forms.
#include "contact/support.hpp"
#include "post/contact_statistics.hpp"
#include "post/impact_table.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace impacts_of_a_run_test {

using namespace fretwork;
using namespace fretwork::signals;
using namespace fretwork::transient;
using post::ContactStatistics;
using post::ContactSummary;
using post::Impact;
using post::ImpactTable;
using std::numbers::pi;

namespace {

constexpr double m = 2.0, k = 5e5; // kg, N/m: R5.06.03's normal law on a free mass
const double w = std::sqrt(k / m); // 500 rad/s

/// A mass that moves along y_loc and meets a stop there.
Scene thrown(double speed, double gap, double damping, double weight, double duration) {
  Scene scene;
  scene.system.stiffness = Eigen::VectorXd::Zero(1);
  scene.system.damping = Eigen::VectorXd::Zero(1);
  ContactPoint stop{"stop",
                    {contact::Stop{gap, contact::PlaneAxis::y}, {k, damping}, {}},
                    core::Vec3::Zero(),
                    Eigen::MatrixXd::Zero(3, 1)};
  stop.b(1, 0) = 1.0 / std::sqrt(m);
  scene.contacts = {stop};
  if (weight != 0.0)
    scene.loads = {{Constant{weight}, Eigen::VectorXd::Constant(1, 1.0 / std::sqrt(m))}};
  scene.q0 = Eigen::VectorXd::Zero(1);
  scene.v0 = Eigen::VectorXd::Constant(1, speed * std::sqrt(m));
  scene.duration = duration;
  return scene;
}

/// A block of mass m pressed with a constant force on a plane (a stop that overlaps it), sliding along x_loc.
Scene launched(double speed, double pressing, const contact::FrictionLaw& friction, double duration) {
  Scene scene = thrown(0.0, 0.0, 0.0, 0.0, duration);
  ContactPoint& plane = scene.contacts[0];
  plane.rest = {0.0, pressing / k, 0.0};
  plane.b.setZero();
  plane.b(0, 0) = 1.0 / std::sqrt(m);
  plane.support.friction = friction;
  scene.v0(0) = speed * std::sqrt(m);
  return scene;
}

struct Seen {
  std::vector<Impact> impacts;
  ContactSummary summary;
};

Seen watch(const Scene& scene, SchemeKind scheme, double step, double rest_time = 0.0) {
  ImpactTable table(1, 0.0, rest_time, 1000);
  ContactStatistics statistics(scene.contacts, 0.0);
  Observer* const observers[] = {&table, &statistics};
  const Report report = run(scene, choose_step(scene, {scheme, step}), observers, nullptr, {});
  EXPECT_EQ(report.outcome, Outcome::done);
  return {std::move(table).impacts()[0].rows, statistics.summaries()[0]};
}

class OfBothSchemes : public testing::TestWithParam<SchemeKind> {};

} // namespace

TEST_P(OfBothSchemes, AnImpactWithoutLossIsAHalfSine) {
  constexpr double v = 1.5, gap = 0.003, h = 2e-6;
  const Seen seen = watch(thrown(v, gap, 0.0, 0.0, 0.02), GetParam(), h);
  ASSERT_EQ(seen.impacts.size(), 1u);
  const Impact& i = seen.impacts[0];
  constexpr double schemes = 2e-3; // Euler at w h = 1e-3, order 1; splitting is far better
  EXPECT_NEAR(i.start, gap / v, h);
  EXPECT_NEAR(i.duration, pi / w, 2.0 * h); // both edges
  EXPECT_NEAR(i.peak / (v * std::sqrt(k * m)), 1.0, schemes);
  EXPECT_NEAR(i.impulse / (2.0 * m * v), 1.0, schemes);
  EXPECT_NEAR(i.velocity_before / v, 1.0, schemes);
  EXPECT_NEAR(i.velocity_after / v, 1.0, schemes);
  EXPECT_NEAR(i.energy_lost, 0.0, 1e-12); // round-off of some J
  EXPECT_NEAR(seen.summary.impulse, i.impulse, 1e-12 * i.impulse);
}

TEST_P(OfBothSchemes, AnImpactOnADamperLosesWhatItsRestitutionSays) {
  constexpr double v = 1.5, h = 2e-6, xi = 0.1;
  const Seen seen = watch(thrown(v, 0.003, 2.0 * xi * std::sqrt(k * m), 0.0, 0.02), GetParam(), h);
  ASSERT_EQ(seen.impacts.size(), 1u);
  const Impact& i = seen.impacts[0];
  constexpr double e = 0.74407940, duration = 5.912151e-3, peak = 1320.216; // of the damped law, xi = 0.1
  constexpr double schemes = 2e-3; // as above; and the first step's force, cut by where in the step it starts
  EXPECT_NEAR(i.velocity_after / v, e, schemes);
  EXPECT_NEAR(i.duration, duration, 2.0 * h);
  EXPECT_NEAR(i.peak / peak, 1.0, schemes);
  EXPECT_NEAR(i.impulse / (m * v * (1.0 + e)), 1.0, schemes);
  // the force ends where K p = -C p', the spring still pressed by C e v/K: that part is lost later, without force
  const double left = 2.0 * xi * xi * m * e * e * v * v;
  const double lost = 0.5 * m * v * v * (1.0 - e * e) - left;
  EXPECT_NEAR(i.energy_lost / lost, 1.0, schemes);
  EXPECT_NEAR(seen.summary.damping_work / lost, 1.0, schemes);
  EXPECT_NEAR(seen.summary.departure_velocity_mean / v, e, schemes);
}

INSTANTIATE_TEST_SUITE_P(Schemes, OfBothSchemes, testing::Values(SchemeKind::splitting, SchemeKind::euler),
                         [](const auto& scheme) { return name_of(scheme.param); });

TEST(ImpactsOfARun, EachBounceOfABallIsSlowerByItsRestitution) {
  // weight 2 N on 2 kg: flights of 2 v/g >> contacts of pi/w, so that the weight does not show in an impact
  constexpr double v = 1.0, xi = 0.1, e = 0.74407940, h = 5e-6, weight = 2.0;
  const Scene scene = thrown(v, 0.0, 2.0 * xi * std::sqrt(k * m), weight, 6.0);
  const Seen seen = watch(scene, SchemeKind::splitting, h);
  ASSERT_GE(seen.impacts.size(), 4u);
  // the weight changes the speed by g pi/w, 1.5e-2 of the fourth impact's, while the contact lasts; most of it
  // cancels between the two halves of the impact, what the damper takes of it does not
  constexpr double weighed = 1e-2;
  for (std::size_t i = 0; i < 4; ++i) {
    const double before = v * std::pow(e, static_cast<double>(i));
    EXPECT_NEAR(seen.impacts[i].velocity_before / before, 1.0, weighed) << i;
    EXPECT_NEAR(seen.impacts[i].velocity_after / (e * before), 1.0, weighed) << i;
  }
  EXPECT_EQ(seen.impacts.size(), static_cast<std::size_t>(seen.summary.impacts));
  // flights shorter than a rest of 2.5 s: the first is 1.5 s, the next shorter: all one impact
  const Seen joined = watch(scene, SchemeKind::splitting, h, 2.5);
  ASSERT_EQ(joined.impacts.size(), 1u);
  EXPECT_EQ(joined.impacts[0].rebounds, static_cast<std::int64_t>(seen.impacts.size()) - 1);
}

TEST(ImpactsOfARun, FrictionTakesItsForceTimesThePath) {
  constexpr double v = 1.0, pressing = 20.0, mu = 0.3, stiffness = 1e6, duration = 0.4, h = 1e-5;
  const Seen seen =
      watch(launched(v, pressing, {stiffness, 200.0, mu, mu}, duration), SchemeKind::splitting, h);
  const ContactSummary& s = seen.summary;
  const double path = 0.5 * m * v * v / (mu * pressing), stops = m * v / (mu * pressing);
  constexpr double spring =
      1e-4; // the bound's stretch of the spring, 6 um, against a path of 167 mm, and some
  EXPECT_NEAR(s.sliding_distance / path, 1.0, spring);
  EXPECT_NEAR(s.friction_work / (mu * pressing * path), 1.0, spring);
  EXPECT_NEAR(s.friction_work + s.damping_work, 0.5 * m * v * v, 1e-4);
  EXPECT_NEAR(s.impulse, pressing * duration, 2.0 * pressing * h);
  constexpr double ringing = 5e-3; // the slider moves a little while the block comes to rest
  EXPECT_NEAR(s.sticking_ratio, 1.0 - stops / duration, ringing);
  ASSERT_EQ(seen.impacts.size(), 1u);
  EXPECT_TRUE(std::isnan(seen.impacts[0].velocity_after)); // pressed to the end
  EXPECT_EQ(s.departure_velocity_mean, 0.0);
}

} // namespace impacts_of_a_run_test
