// SPDX-License-Identifier: GPL-3.0-or-later
// The scheme that keeps the energy: at any step, with every obstacle and law.
#include "core/symmetric.hpp"
#include "scenes.hpp"
#include "transient/conserving/energy_conserving.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace energy_conserving_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using namespace fretwork::vibration;
using contact::FrictionLaw;
using contact::FrictionMemoryKind;
using contact::PlaneAxis;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double kept = 1e-8; // of the energy: asked at any step
constexpr double round_off =
    1e-10; // of the energy: that of thousands of steps, 1e-16 times stiffness times position each

/// What a run did to its energy, and whether its forces obeyed.
struct Seen final : Observer {
  void visit(core::StateArchive&) override {}
  explicit Seen(const Scene& s) : scene(s) {}
  void step(const Record& r) override {
    const Energy& e = r.energy;
    drift = std::max(drift, std::abs(e.stored / e.initial - 1.0));
    lowest = std::min(lowest, e.stored - e.load_work);
    gain = std::max(gain, (e.stored - e.load_work - lowest) / e.initial);
    for (const int c : r.active) {
      const ContactState& s = r.states[static_cast<std::size_t>(c)];
      const FrictionLaw& law = scene.contacts[static_cast<std::size_t>(c)].support.friction;
      excess = std::max(
          excess,
          contact::norm(s.friction) / (s.slides ? law.mu_dynamic : law.mu_static) / s.normal_force - 1.0);
      ++closed;
      slid += s.slides;
    }
    opened += static_cast<int>(r.opened.size());
    missing = std::max(missing, std::abs(r.time - 0.5 * r.step - end));
    end = r.time + 0.5 * r.step;
    last = e;
  }
  const Scene& scene;
  Energy last;
  double drift = 0.0, lowest = std::numeric_limits<double>::infinity(), gain = 0.0;
  double excess = -1.0; ///< of friction over its bound, relative
  double end = 0.0,
         missing =
             0.0; ///< s: end of the last step, largest distance between one's end and the next one's start
  int closed = 0, slid = 0, opened = 0;
};

struct Watched {
  Seen seen;
  Report report;
};

Watched watch(const Scene& scene, double step) {
  Watched out{Seen(scene), {}};
  Observer* const observers[] = {&out.seen};
  out.report = run(scene, choose_step(scene, energy_conserving(step)), observers, nullptr, {});
  return out;
}

/// With the step given as w_c h.
Watched watch_angle(const Scene& scene, double angle) {
  return watch(scene, angle / choose_step(scene, energy_conserving(1e-3)).contact_frequency);
}

/// A simply supported tube of 3 m in 40 modes of two planes, EI = 496 N m2, 1 kg/m, between three holes, moving freely.
Scene tube(const FrictionLaw& friction = {}, double damping = 0.0, double dissipation = 0.0) {
  constexpr int modes = 40;
  constexpr double length = 3.0, first = 24.4; // rad/s
  Scene s;
  s.system.stiffness.resize(modes);
  s.system.damping = s.q0 = s.v0 = Eigen::VectorXd::Zero(modes);
  for (int i = 0; i < modes; ++i) {
    s.system.stiffness(i) = std::pow(first * std::pow(1 + i / 2, 2), 2);
    s.v0(i) = 0.05 * std::cos(1.7 * i) / (1.0 + 0.2 * i);
  }
  const double places[] = {0.71, 1.37, 2.23}, gaps[] = {1.4e-4, 2.6e-4, 1.9e-4};
  for (int c = 0; c < 3; ++c) {
    ContactPoint point{std::to_string(c),
                       {contact::Circle{gaps[c]}, {1e6, damping, dissipation}, friction},
                       Vec3::Zero(),
                       Eigen::MatrixXd::Zero(3, modes)};
    for (int i = 0; i < modes; ++i)
      point.b(1 + i % 2, i) = std::sqrt(2.0 / length) * std::sin((1 + i / 2) * pi * places[c] / length);
    s.contacts.push_back(point);
  }
  s.duration = 2.0;
  return s;
}

/// Lobes and protruding lands: normals that turn at corners and jump between lands.
contact::Profile quatrefoil() {
  std::vector<contact::PolarPoint> points;
  for (int i = 0; i < 24; ++i) {
    const double angle = 0.01 + i * 2.0 * pi / 24;
    points.push_back({angle, 2e-4 * (1.0 + 0.25 * std::cos(4.0 * angle))});
  }
  return contact::Profile(points);
}

} // namespace

TEST(EnergyConserving, KeepsTheEnergyOfATubeInThreeHolesAtAnyStep) {
  const Scene scene = tube();
  for (const double angle : {0.03, 0.26, 1.0, 2.6, 7.0, 20.0, 50.0}) {
    const auto [seen, report] = watch_angle(scene, angle);
    EXPECT_EQ(report.outcome, Outcome::done);
    EXPECT_LT(seen.drift, kept) << "w_c h = " << angle;
    EXPECT_LT(report.residual_relative, round_off) << "w_c h = " << angle;
    EXPECT_GT(seen.closed, 200) << "w_c h = " << angle;
  }
}

TEST(EnergyConserving, KeepsTheEnergyOfHundredsOfImpactsOnAStiffStop) {
  Scene s = mass_point(1.0, Vec3(0, 314.0 * 314.0, 0), 4.0);
  start(s, 1.0, Vec3::Zero(), Vec3(0, 0.5, 0));
  s.contacts = {contact_of(1.0, {contact::Stop{1e-4, PlaneAxis::y}, {1e9}, {}})};
  for (const double angle : {0.05, 0.5, 2.0, 10.0, 50.0}) {
    const auto [seen, report] = watch_angle(s, angle);
    EXPECT_LT(seen.drift, kept) << "w_c h = " << angle;
    EXPECT_GT(seen.opened, 300) << "w_c h = " << angle;
  }
}

TEST(EnergyConserving, KeepsTheEnergyBetweenObstaclesOfEveryKind) {
  constexpr double far = 0.01, gap = 1e-4;
  const std::pair<contact::Obstacle, Vec3> cases[] = {
      {contact::Circle{0.0}, Vec3::Zero()},
      {contact::PlanePair{gap, PlaneAxis::y}, Vec3::Zero()},
      {contact::PlanePair{gap, PlaneAxis::z}, Vec3::Zero()},
      {contact::Stop{gap, PlaneAxis::z}, Vec3::Zero()},
      {contact::RoundPair{far}, Vec3(0, far + gap, 0)},
      {contact::FacingPlanes{far, PlaneAxis::y, -1.0}, Vec3(0, -far - gap, 0)},
      {quatrefoil(), Vec3::Zero()}};
  for (const auto& [obstacle, rest] : cases) {
    Scene s = tube();
    for (ContactPoint& c : s.contacts) {
      c.support.obstacle = obstacle;
      c.rest = rest;
    }
    for (const double angle : {0.3, 3.0, 30.0}) {
      const auto [seen, report] = watch_angle(s, angle);
      EXPECT_EQ(report.outcome, Outcome::done);
      EXPECT_LT(seen.drift, kept) << obstacle.index() << ", w_c h = " << angle;
      EXPECT_GT(seen.closed, 50) << obstacle.index() << ", w_c h = " << angle;
    }
  }
}

TEST(EnergyConserving, NeverGainsEnergyWithDampersAndFriction) {
  for (const auto& [mu_static, dissipation] : {std::pair(0.3, 0.0), std::pair(0.4, 2.0)}) {
    const Scene scene = tube({5e5, 40.0, mu_static, 0.3}, 20.0, dissipation);
    for (const double angle : {0.05, 0.3, 1.0, 3.0, 10.0, 50.0}) {
      const auto [seen, report] = watch_angle(scene, angle);
      EXPECT_EQ(report.outcome, Outcome::done);
      EXPECT_LT(seen.gain, round_off) << "w_c h = " << angle;
      EXPECT_LT(report.residual_relative, round_off) << "w_c h = " << angle;
      EXPECT_LT(seen.last.stored, 0.6 * seen.last.initial);
      EXPECT_GT(seen.slid, 40); // the fewest at w_c h = 50
      EXPECT_GT(seen.closed, seen.slid);
    }
  }
}

TEST(EnergyConserving, AccountsForAllEnergyWithEitherMemory) {
  for (const auto memory : {FrictionMemoryKind::return_map, FrictionMemoryKind::reference})
    for (const bool profiles : {false, true})
      for (const double h : {1e-5, 1e-4, 1e-3}) {
        Scene scene = rattling(9, 12, 0.3);
        for (ContactPoint& c : scene.contacts) {
          if (c.support.friction.active())
            c.support.friction.kind = memory;
          if (profiles)
            c.support.obstacle = quatrefoil();
        }
        const auto [seen, report] = watch(scene, h);
        EXPECT_EQ(report.outcome, Outcome::done);
        EXPECT_LT(report.residual_relative, round_off) << "h = " << h;
        constexpr double rounding =
            1e-9; // of the bound: forces are solved to the rounding of stiffness times position
        EXPECT_LT(seen.excess, rounding) << "h = " << h;
        EXPECT_GT(seen.slid, 0);
      }
}

TEST(EnergyConserving, CutsStepsWhoseForcesItDoesNotFindAndCoversTheRunAllTheSame) {
  Scene scene = rattling(9, 24, 1.0);
  for (ContactPoint& c : scene.contacts) {
    c.support.obstacle = quatrefoil();
    c.support.normal.stiffness = 1e7;
  }
  constexpr double h = 1e-2; // w_c h of nearly 100: lands are leapt over
  const auto [seen, report] = watch(scene, h);
  EXPECT_EQ(report.outcome, Outcome::done);
  EXPECT_GT(report.counts.rejected, 0);
  EXPECT_LT(report.counts.step_min, 0.6 * h);
  EXPECT_EQ(report.counts.step_max, h);
  EXPECT_EQ(report.records, report.counts.steps);
  constexpr double rounding = 1e-12;
  EXPECT_LT(seen.missing, rounding);
  EXPECT_NEAR(seen.end, 1.0, rounding);
  EXPECT_LT(report.residual_relative, round_off);
}

TEST(EnergyConserving, StopsWhereNoStepHelps) {
  Scene s = mass_point(1.0, Vec3(0, 1.0, 0), 1.0);
  start(s, 1.0, Vec3::Zero(), Vec3(0, 1e150, 0));
  // a force that is no number
  s.contacts = {contact_of(1.0, {contact::Stop{0.0, PlaneAxis::y}, {1e200}, {}})};
  const auto scheme = make_energy_conserving(s, 0.1);
  EXPECT_EQ(scheme->failure(), StepFailure::contacts);
  EXPECT_EQ(scheme->next_time(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(scheme->counts().rejected, 9); // whole, and cut in two eight times
  EXPECT_EQ(scheme->advance().time, 0.0);
  EXPECT_EQ(scheme->counts().steps, 0);
}

TEST(EnergyConserving, GivesTheStateOfItsRecordsAndAContinuousOneBetween) {
  const Scene scene = rattling(5, 12, 0.3);
  const auto scheme = make_energy_conserving(scene, 1e-3);
  Eigen::VectorXd q(12), v(12), before_q = scene.q0, before_v = scene.v0;
  for (int k = 0; k < 200; ++k) {
    const double at = scheme->next_time();
    scheme->state_at(at, before_q.data(), before_v.data());
    const Record& record = scheme->advance();
    ASSERT_EQ(record.time, at);
    scheme->state_at(at, q.data(), v.data());
    const double largest = 1e-3, fastest = 1e-1; // m, m/s of this scene
    constexpr double rounding = 1e-12;
    ASSERT_LT((q - Eigen::Map<const Eigen::VectorXd>(record.q, 12)).norm(), rounding * largest);
    ASSERT_LT((q - before_q).norm(), rounding * largest);
    ASSERT_LT((v - before_v).norm(), rounding * fastest);
  }
}

TEST(EnergyConserving, IsExactWithoutContacts) {
  Scene scene = mass_point(1.0, Vec3(100.0, 400.0, 0.0), 2.0);
  scene.system.damping = Vec3(0.5, 50.0, 1.0);
  scene.loads = {force_on(1.0, Vec3(1, 2, 3), Constant{1.0})};
  start(scene, 1.0, Vec3(0.1, 0.0, -0.2), Vec3(1.0, 0.0, 0.0));
  const History coarse = simulate(scene, energy_conserving(0.5), 0.1),
                fine = simulate(scene, splitting(1e-3), 0.1);
  constexpr double rounding = 1e-12;
  EXPECT_LT((coarse.q - fine.q).norm(), rounding * fine.q.norm());
  EXPECT_LT((coarse.v - fine.v).norm(), rounding * fine.v.norm());
  EXPECT_LT(coarse.report.residual_relative, rounding);
}

TEST(EnergyConserving, TakesDampersThatCoupleTheModes) {
  // the same structure in other coordinates: rows of B and the damping matrix turn, the motion does not
  Scene plain = rattling(5, 12, 0.2), turned = plain;
  plain.system.stiffness.setConstant(1e4);
  plain.system.damping = Eigen::VectorXd::LinSpaced(12, 1.0, 40.0);
  const Eigen::MatrixXd turn =
      core::symmetric_eigenpairs(Eigen::MatrixXd::NullaryExpr(12, 12, [](Eigen::Index i, Eigen::Index j) {
        return std::sin(1.0 + 3.7 * double(i + j) + 1.3 * double(i * j));
      })).vectors;
  turned.system.stiffness.setConstant(1e4);
  turned.system.damping_matrix = turn.transpose() * plain.system.damping.asDiagonal() * turn;
  for (ContactPoint& c : turned.contacts)
    c.b = c.b * turn;
  for (Load& load : turned.loads)
    load.modal_force = turn.transpose() * load.modal_force;
  for (const double h : {1e-4, 1e-3}) {
    const History a = simulate(plain, energy_conserving(h), 0.01),
                  b = simulate(turned, energy_conserving(h), 0.01);
    EXPECT_GT(a.normal.maxCoeff(), 0.0);
    constexpr double rounding = 1e-7; // that of two ways to the same flow, spread by impacts
    EXPECT_LT((a.q - turn * b.q).norm(), rounding * a.q.norm());
    EXPECT_LT((a.v - turn * b.v).norm(), rounding * a.v.norm());
    EXPECT_LT(b.report.residual_relative, round_off);
  }
}

} // namespace energy_conserving_test
