// SPDX-License-Identifier: GPL-3.0-or-later
// Collocation where its step is not smooth: several contacts that open and close, steps made in halves, failure.
#include "scenes.hpp"
#include "transient/collocation/collocation.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace collocation_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;
using contact::PlaneAxis;
using contact::PlanePair;

namespace {

constexpr double duration = 0.5;

Scene rattling_scene(contact::FrictionMemoryKind kind = contact::FrictionMemoryKind::return_map,
                     double dissipation = 0.0) {
  Scene scene = rattling(5, 12, duration);
  for (ContactPoint& c : scene.contacts) {
    c.support.friction.kind = kind;
    c.support.normal.dissipation = dissipation;
  }
  return scene;
}

} // namespace

TEST(Collocation, StandsForTheWholeTimeAndGivesTheMotionOfItsRecords) {
  const Scene scene = rattling_scene();
  constexpr double h = 1e-3, round_off = 1e-12;
  const auto scheme = make_collocation(scene, h);
  std::vector<double> q(12), v(12);
  double covered = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double expected = scheme->next_time();
    const Record& record = scheme->advance();
    EXPECT_EQ(record.time, expected);
    EXPECT_NEAR(record.time, 0.5 * h * i, round_off);
    covered += record.step;
    scheme->state_at(record.time, q.data(), v.data());
    for (std::size_t m = 0; m < q.size(); ++m)
      EXPECT_NEAR(q[m], record.q[m], round_off);
    const ContactPoint& point = scene.contacts[2];
    EXPECT_NEAR((point.b * Eigen::Map<const Eigen::VectorXd>(q.data(), 12)).z(), record.uz[2], round_off);
  }
  // up to the last record, a node 1/2, with the sixth of the step behind it still to come
  EXPECT_NEAR(covered, 200.0 * h - h / 6.0, round_off);
}

TEST(Collocation, HasTheDepartureOfEveryImpact) {
  // a mass on a spring against a stop, with nothing that a contact keeps when it opens: the step's end may be the first to be open
  constexpr double mass = 100.0, stiffness = 1e4, gap = 1e-3;
  Scene scene = mass_point(mass, Vec3(0, stiffness, 0), 3.0);
  start(scene, mass, Vec3::Zero(), Vec3(0, 1.0, 0));
  scene.contacts = {contact_of(mass, {contact::Stop{gap, PlaneAxis::y}, {1e6}, {}})};
  const auto c = simulate(scene, collocation(), 0.1).statistics[0];
  const double speed = std::sqrt(1.0 - stiffness / mass * gap * gap); // m/s, at the stop
  constexpr double allowed = 1e-2; // the node that is the first to be open has left by up to half a step
  EXPECT_GT(c.impacts, 5);
  EXPECT_NEAR(c.departure_velocity_mean, speed, allowed);
  EXPECT_NEAR(c.departure_velocity_max, speed, allowed);
}

TEST(Collocation, SolvesTheLawsAtItsNodes) {
  // the record's force is the law's at the record's state
  const Scene scene = rattling_scene();
  const auto scheme = make_collocation(scene, 5e-4);
  constexpr double sweeps = 1e-7; // of the force: sweeps stop at 1e-9 of the contact's largest
  std::vector<double> q(12), v(12);
  int closed = 0, slides = 0;
  for (int i = 0; i < 2000; ++i) {
    const Record& record = scheme->advance();
    scheme->state_at(record.time, q.data(), v.data());
    for (const int c : record.active) {
      const ContactPoint& point = scene.contacts[static_cast<std::size_t>(c)];
      const Vec3 u = point.rest + point.b * Eigen::Map<const Eigen::VectorXd>(q.data(), 12),
                 w = point.b * Eigen::Map<const Eigen::VectorXd>(v.data(), 12);
      const auto at = contact::locate(point.support.obstacle, u.y(), u.z());
      const ContactState& state = record.states[static_cast<std::size_t>(c)];
      const double law =
          contact::normal_force(point.support.normal, -at.gap, -(at.ny * w.y() + at.nz * w.z()));
      const double damper = point.support.normal.damping * w.norm(); // fills the jump at first touch
      EXPECT_LE(state.normal_force, law + sweeps * (1.0 + law) + (std::abs(at.gap) < 1e-12 ? damper : 0.0));
      if (std::abs(at.gap) > 1e-12) {
        EXPECT_NEAR(state.normal_force, law, sweeps * (1.0 + law));
      }
      const auto& friction = point.support.friction;
      EXPECT_LE(contact::norm(state.friction), friction.mu_static * state.normal_force * (1.0 + sweeps));
      if (state.slides) {
        EXPECT_NEAR(contact::norm(state.friction), friction.mu_dynamic * state.normal_force, sweeps);
      }
      ++closed;
      slides += state.slides;
    }
  }
  EXPECT_GT(closed, 500);
  EXPECT_GT(slides, 100);
}

/// The largest residual of the energy in steps h, mean of the logarithms over several starts: single runs scatter by as much as a factor 3.
double mean_residual(Scene scene, double h) {
  constexpr int starts = 24;
  double sum = 0.0;
  for (int i = 0; i < starts; ++i) {
    scene.v0 = Eigen::VectorXd::NullaryExpr(scene.v0.size(), [&](Eigen::Index mode) {
      return 0.05 * std::sin(1.0 + 7.3 * i + double(mode) * (1.1 + 0.37 * i));
    });
    sum += std::log(simulate(scene, collocation(h), duration).report.residual_relative);
  }
  return std::exp(sum / starts);
}

// Contacts close, slip and stick inside steps. The order is between 1 and 2, as the force of a damper jumps where its contact closes; means over
// its starts are 7e-4 at 8e-4 s (by the quadratic alone of a step 3e-3) and 5e-5 at 1e-4 s (5e-5 to 1.3e-4).
TEST(Collocation, BalancesItsEnergyThroughImpacts) {
  for (const double dissipation : {0.0, 1.0}) {
    const Scene scene = rattling_scene(contact::FrictionMemoryKind::return_map, dissipation);
    EXPECT_LT(mean_residual(scene, 8e-4), 1e-3);
    EXPECT_LT(simulate(scene, collocation(2e-4), duration).report.residual_relative, 5e-5);
    EXPECT_LT(mean_residual(scene, 2e-4 / 8.0), 5.2e-6); // 4.8e-6 and 3.4e-6
  }
}

// What contacts lose by their friction is in their records, all of it, and none of it is negative.
TEST(Collocation, ShowsTheLossesOfItsLedger) {
  struct Losses final : Observer {
    double friction = 0.0, least = 0.0;
    void step(const Record& record) override {
      for (const int c : record.active) {
        friction += record.states[static_cast<std::size_t>(c)].friction_work;
        least = std::min(least, record.states[static_cast<std::size_t>(c)].friction_work);
      }
    }
    void visit(core::StateArchive&) override {}
  };
  Scene scene = rattling(10, 24, 0.3);
  scene.v0.setConstant(0.03);
  for (const double mu_static : {0.3, 0.6}) {
    for (ContactPoint& c : scene.contacts) {
      c.support.normal.stiffness = 1e6;
      if (c.support.friction.active())
        c.support.friction.mu_static = std::max(c.support.friction.mu_dynamic, mu_static);
    }
    Losses seen;
    Observer* const observers[] = {&seen};
    const Report report = run(scene, choose_step(scene, collocation(2e-4)), observers, nullptr, {});
    EXPECT_NEAR(seen.friction / report.energy.friction, 1.0, 3e-3); // the last node is in no record
    EXPECT_GE(seen.least, 0.0);
  }
}

// A strong damper, whose force jumps where contacts close: w_c h = 1.
TEST(Collocation, KeepsItsEnergyInHandWithStrongDampers) {
  Scene scene = rattling(10, 24, 0.15);
  for (ContactPoint& c : scene.contacts) {
    c.support.normal.stiffness = 1e7;
    c.support.normal.damping = 500.0;
  }
  EXPECT_LT(mean_residual(scene, 1.05e-4), 1e-2);
}

TEST(Collocation, BalancesTheEnergyOfTheReferencesFrictionToWhatItsJumpsLeave) {
  constexpr double accepted = 1e-2; // the force jumps by C_T v at every change, at any step
  for (const double h : {2e-4, 2.5e-5}) {
    const Report report =
        simulate(rattling_scene(contact::FrictionMemoryKind::reference), collocation(h), duration).report;
    EXPECT_EQ(report.outcome, Outcome::done);
    EXPECT_LT(report.residual_relative, accepted);
  }
}

TEST(Collocation, AgreesWithTheSplittingSchemeWhereBothConverge) {
  Scene scene = rattling_scene();
  scene.duration = 0.05; // some impacts
  const History a = simulate(scene, collocation(5e-6), 0.005), b = simulate(scene, splitting(1e-6), 0.005);
  std::int64_t closed = 0;
  for (const auto& s : a.statistics)
    closed += s.impacts;
  EXPECT_GT(closed, 3);
  constexpr double of_splitting = 1e-4;
  EXPECT_LT((a.q - b.q).cwiseAbs().maxCoeff() / b.q.cwiseAbs().maxCoeff(), of_splitting);
}

TEST(Collocation, CountsItsRejectedStepsAndRecoversItsGrid) {
  // a stiff contact with a jump of friction at a step far too long: some steps need halves
  Scene scene = rattling(5, 12, duration);
  for (ContactPoint& c : scene.contacts) {
    c.support.normal.stiffness = 1e8;
    c.support.friction.stiffness = 1e8;
    c.support.friction.mu_static = 0.8;
  }
  constexpr double h = 1e-3;
  const auto scheme = make_collocation(scene, h);
  double last = -1.0, covered = 0.0;
  while (scheme->next_time() < duration) {
    const Record& record = scheme->advance();
    EXPECT_GT(record.time, last);
    last = record.time;
    covered += record.step;
  }
  const StepCounts counts = scheme->counts();
  EXPECT_EQ(scheme->failure(), StepFailure::none);
  EXPECT_GT(counts.rejected, 0);
  EXPECT_LT(counts.step_min, h);
  EXPECT_EQ(counts.step_max, h);
  EXPECT_EQ(counts.unconverged, 0);
  EXPECT_EQ(counts.evaluations, 2 * (counts.steps + counts.rejected));
  EXPECT_NEAR(covered, last, h);
  EXPECT_LT(counts.steps, 10 * 500);
}

TEST(Collocation, TakesAContactThatClosesAtTheVeryEndOfAStep) {
  // onto a stop with a damper at the end of step 32, 64 ...: there the force jumps, and hardly moves the node at that instant
  constexpr double touch = 2e-3, mass = 1.0, stiffness = 1e6, damping = 100.0;
  for (const double k : {0.0, 1e-2, 1.0, 1e2, 1e4}) {
    const double omega = std::sqrt(k / mass), gap = k > 0.0 ? std::sin(omega * touch) / omega : touch;
    Scene scene = mass_point(mass, Vec3(0, k, 0), 4.0 * touch);
    start(scene, mass, Vec3::Zero(), Vec3(0, 1.0, 0));
    scene.contacts = {contact_of(mass, {contact::Stop{gap, PlaneAxis::y}, {stiffness, damping}, {}})};
    const History fine = simulate(scene, collocation(scene.duration / 65536), scene.duration);
    constexpr double of_the_jump = 1e-2; // the step in which the contact closes is of order 1 there
    for (int steps = 128; steps <= 4096; steps *= 2) {
      const History run = simulate(scene, collocation(scene.duration / steps), scene.duration);
      EXPECT_EQ(run.report.outcome, Outcome::done) << k << " " << steps;
      EXPECT_EQ(run.report.counts.rejected, 0) << k << " " << steps;
      EXPECT_NEAR(run.v(1, 1), fine.v(1, 1), of_the_jump * 128 / steps) << k << " " << steps;
    }
    const double xi = damping / (2.0 * std::sqrt(stiffness * mass));
    if (k == 0.0) { // case A6 of doc/validation.md
      EXPECT_NEAR(fine.v(1, 1), -std::exp(-2.0 * xi * std::acos(xi) / std::sqrt(1.0 - xi * xi)), 1e-4);
    }
  }
}

TEST(Collocation, StopsWhereNoStepSolvesItsContacts) {
  Scene scene = mass_point(1.0, Vec3(0, 1.0, 0), 1.0);
  start(scene, 1.0, Vec3::Zero(), Vec3(0, 1.0, 0));
  scene.contacts = {
      contact_of(1.0, {PlanePair{0.1, PlaneAxis::y}, {1e6, 0.0, 1e308}, {}})}; // its forces are not finite
  const History run = simulate(scene, collocation(1e-3), 0.1);
  EXPECT_EQ(run.report.outcome, Outcome::step_failed);
  EXPECT_EQ(run.report.failure, StepFailure::contacts);
  EXPECT_NEAR(run.report.end_time, 0.1, 2e-3);
}

/// A mass driven in a plane, pressed on it by a force that swings by `swing` N: it sticks, and slides in directions that turn.
Scene driven_in_plane(double tangential_damping, double swing) {
  constexpr double mass = 1.0;
  Scene scene = mass_point(mass, Vec3(400.0, 700.0, 1100.0), 2.0);
  for (Eigen::Index i = 0; i < 3; ++i)
    scene.system.damping(i) = 0.04 * std::sqrt(scene.system.stiffness(i));
  scene.contacts = {contact_of(
      mass, {contact::Stop{0.0, PlaneAxis::z}, {1e5}, {2e4, tangential_damping, 0.3, 0.3}}, {0, 0, 1e-3})};
  scene.loads = {force_on(mass, Vec3(25.0, 0, 0), signals::Harmonic{1.0, 4.0, 0.0}),
                 force_on(mass, Vec3(0, 25.0, 0), signals::Harmonic{1.0, 8.0, 0.7}),
                 force_on(mass, Vec3(0, 0, swing), signals::Harmonic{1.0, 9.0, 0.0})};
  return scene;
}

// Dampers that relax springs within 1/40 to 1/2000 of a step. Where the direction of slip at the ends of paths was that of the relaxed spring, steps
// failed, friction powers were up to 3.7 times too high, and residuals up to 2.4.
TEST(Collocation, DissipatesAlikeWithShortTangentialDampersAndWithNone) {
  for (const double swing : {20.0, 110.0}) // with the second it opens too
    for (const double h : {2.5e-4, 1e-3}) {
      const double without =
          simulate(driven_in_plane(0.0, swing), collocation(h), 0.5).statistics[0].friction_power;
      for (const double x : {20.0, 60.0, 125.0, 250.0, 500.0, 1000.0}) { // K_T h/(2 C_T)
        const History run = simulate(driven_in_plane(0.5 * 2e4 * h / x, swing), collocation(h), 0.5);
        const double share = 2.0 / x; // of the damper, which takes something
        EXPECT_NEAR(run.statistics[0].friction_power, without, (1e-3 + share) * without) << x << " " << h;
        EXPECT_LT(run.report.residual_relative, 3e-4) << x << " " << h;
        EXPECT_LT(run.report.counts.rejected, 30) << x << " " << h;
      }
    }
}

TEST(Collocation, LosesAtTheOppositeFaceWhatTheLastOneLoaded) {
  // a block pressed against one face and slid, then thrown at the other: no force of the old spring there
  Scene scene = mass_point(1.0, Vec3::Zero(), 0.02);
  start(scene, 1.0, Vec3(0, 1.2e-4, 0), Vec3(0, 0, 0.1));
  scene.contacts = {
      contact_of(1.0, {PlanePair{1e-4, PlaneAxis::y}, {1e6}, {1e6, 1e5, 0.5, 0.5}})}; // relaxes in 0.1 s
  const auto scheme = make_collocation(scene, 5e-5);
  double at_first = 0.0, at_second = -1.0;
  while (scheme->next_time() < scene.duration) {
    const Record& record = scheme->advance();
    if (record.active.empty())
      continue;
    const ContactState& state = record.states[0];
    if (state.axes.ny < 0.0)
      at_first = contact::norm(state.friction);
    else if (at_second < 0.0)
      at_second = contact::norm(state.friction) - 1e5 * 0.1; // less than what its damper alone can give
  }
  EXPECT_GE(at_first, 0.0);
  EXPECT_LT(at_second, 0.0);
}

} // namespace collocation_test
