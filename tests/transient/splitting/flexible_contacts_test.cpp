// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that give way beside the modes (Scene::residual): springs in series, alone, shared between contacts, in stick, at any stiffness.
// With all laws along a smooth path: flexible_paths_test.cpp. Moved by loads: flexible_loads_test.cpp.
#include "contact/series.hpp"
#include "core/error.hpp"
#include "scenes.hpp"
#include "transient/scheme_scope.hpp"
#include "transient/statics/static_start.hpp"
#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace flexible_contacts_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;
using contact::PlaneAxis;

namespace {

constexpr double round_off = 1e-12;

Eigen::MatrixXd diagonal(double x, double y, double z) { return Eigen::Vector3d(x, y, z).asDiagonal(); }

/// A mass that flies into a stop after 1 mm.
Scene impact(double stiffness, double duration) {
  Scene s = mass_point(2.0, Vec3::Zero(), duration);
  s.contacts = {contact_of(2.0, {contact::Stop{1e-3, PlaneAxis::y}, {stiffness}, {}})};
  start(s, 2.0, Vec3::Zero(), Vec3(0.0, 0.5, 0.0));
  return s;
}

double in_series(double stiffness, double flexibility) { return stiffness / (1.0 + stiffness * flexibility); }

/// Largest normal force and the time of it.
struct Peak {
  double force = 0.0, time = 0.0;
};
Peak peak(const Scene& scene, const StepOptions& options) {
  Peak out;
  for (const auto& e : trace(scene, options))
    if (e.normal > out.force)
      out = {e.normal, e.time};
  return out;
}

} // namespace

TEST(SeriesForce, SolvesTheLawOfItsPlace) {
  const contact::NormalLaw laws[] = {{1e5}, {1e5, 40.0}, {1e5, 0.0, 2.0}, {1e5, 40.0, 2.0}};
  for (const auto& law : laws)
    for (const double rate : {-0.8, -0.1, 0.0, 0.1, 0.8})
      for (const double flexibility : {0.0, 1e-7, 1e-5, 1e-2}) {
        constexpr double mean = 1e-3, mobility = 3e-4;
        const double f = contact::series_force(law, mean, rate, mobility, flexibility);
        const double p = mean - flexibility * f, speed = rate - mobility * f;
        EXPECT_NEAR(f, std::max(0.0, law.stiffness * p + law.damping_at(p) * speed), round_off * 1e3);
      }
}

TEST(FlexibleContacts, AreSpringsInSeries) {
  constexpr double stiffness = 1e6;
  for (const double flexibility : {1e-9, 1e-6, 1e-3}) {
    Scene flexible = impact(stiffness, 0.2), softer = impact(in_series(stiffness, flexibility), 0.2);
    flexible.residual = diagonal(0.0, flexibility, 0.0);
    const double w = std::sqrt(in_series(stiffness, flexibility) / 2.0);
    const History a = simulate(flexible, splitting(0.2 / w), 1e-3),
                  b = simulate(softer, splitting(0.2 / w), 1e-3);
    EXPECT_GT(b.normal.maxCoeff(), 0.0);
    constexpr double other_scheme = 5e-3; // forces at instants and over intervals: order 2 at w_c h = 0.2
    EXPECT_LT((a.q - b.q).cwiseAbs().maxCoeff(), other_scheme * b.q.cwiseAbs().maxCoeff());
    EXPECT_NEAR(a.statistics[0].normal_rms, b.statistics[0].normal_rms,
                other_scheme * b.statistics[0].normal_rms);
    EXPECT_NEAR(a.choice.contact_frequency, w, 1e-9 * w);
  }
}

TEST(FlexibleContacts, GiveTheClosedFormOfAnImpactInOrderTwo) {
  constexpr double stiffness = 1e6, flexibility = 3e-6;
  Scene s = impact(stiffness, 0.02);
  s.residual = diagonal(0.0, flexibility, 0.0);
  const double w = std::sqrt(in_series(stiffness, flexibility) / 2.0);
  const double force = 0.5 * 2.0 * w, time = 1e-3 / 0.5 + 0.5 * std::numbers::pi / w;
  const double coarse = std::abs(peak(s, splitting(0.2 / w)).force / force - 1.0);
  const Peak fine = peak(s, splitting(0.0125 / w));
  constexpr double bound = 1e-2; // an instant off the peak by half a step sees (w h)^2/8 less, 5e-3
  EXPECT_LT(coarse, bound);
  EXPECT_LT(std::abs(fine.force / force - 1.0), bound / 1000.0); // of 256 in the worst phase
  EXPECT_NEAR(fine.time, time, 0.0125 / w);
}

TEST(FlexibleContacts, RestInEquilibrium) {
  // pressed on a stop by its own spring: f = K_eff (q - gap), k q = F - f; the node stands at q - R f
  constexpr double stiffness = 1e6, flexibility = 4e-6, spring = 2e4, load = 100.0, gap = 1e-3;
  Scene s = mass_point(1.0, Vec3::Constant(spring), 0.5);
  s.contacts = {contact_of(1.0, {contact::Stop{gap, PlaneAxis::y}, {stiffness, 5.0}, {1e5, 2.0, 0.3, 0.3}})};
  s.residual = diagonal(1e-6, flexibility, 1e-6);
  s.loads = {force_on(1.0, Vec3(0.0, load, 0.0), Constant{1.0})};
  const double k = in_series(stiffness, flexibility), q = (load + k * gap) / (spring + k), f = k * (q - gap);
  const Equilibrium e = static_equilibrium(s);
  EXPECT_EQ(e.q.size(), 3);
  EXPECT_NEAR(e.q(1), q, round_off * q);
  EXPECT_NEAR(e.normal_force(0), f, 1e-10 * f);
  s.q0 = e.q;
  s.duration = 0.02;
  constexpr double h = 1e-5;
  const double of_the_splitting =
      0.125 * (spring + k) * h * h; // relative: a constant force as kicks, (w h)^2/8
  for (const auto& step : trace(s, splitting(h))) {
    ASSERT_NEAR(step.normal, f, 2.0 * of_the_splitting * f);
    ASSERT_NEAR(step.uy, q - flexibility * f, 2.0 * of_the_splitting * q);
    ASSERT_NEAR(step.energy.residual(), 0.0, 2.0 * of_the_splitting * step.energy.initial);
  }
}

TEST(FlexibleContacts, ShareTheirFlexibility) {
  // two nodes on two stops: f = (1/K + R)^-1 (q - gap) where both are closed
  constexpr double gap = 1e-3;
  const double stiffness[2] = {1e6, 4e5};
  const auto scene = [&](double coupling) {
    Scene s;
    s.system.stiffness = Eigen::Vector2d(1e4, 2e4);
    s.system.damping = s.q0 = s.v0 = Eigen::Vector2d::Zero();
    s.duration = 0.2;
    s.residual = Eigen::MatrixXd::Zero(6, 6);
    for (int c = 0; c < 2; ++c) {
      ContactPoint p{std::to_string(c),
                     {contact::Stop{gap, PlaneAxis::y}, {stiffness[c]}, {}},
                     Vec3::Zero(),
                     Eigen::MatrixXd::Zero(3, 2)};
      p.b(1, c) = 1.0;
      s.contacts.push_back(p);
      s.residual(3 * c + 1, 3 * c + 1) = 3e-6;
    }
    s.residual(1, 4) = s.residual(4, 1) = coupling;
    return s;
  };
  const auto forces = [&](const Scene& s, const Eigen::Vector2d& q) {
    const Eigen::Matrix2d r =
        (Eigen::Matrix2d() << s.residual(1, 1), s.residual(1, 4), s.residual(1, 4), s.residual(4, 4))
            .finished();
    return Eigen::Vector2d(
        (r + Eigen::Matrix2d(Eigen::Vector2d(1.0 / stiffness[0], 1.0 / stiffness[1]).asDiagonal()))
            .inverse() *
        (q.array() - gap).matrix());
  };
  struct Case {
    double coupling;
    Eigen::Vector2d q;
    const char* what;
  };
  const Case cases[] = {{2.9e-6, {2e-3, 2e-3}, "close together"},
                        {-2e-6, {2e-3, 0.9e-3}, "closed by the other's force"},
                        {2.9e-6, {2e-3, 1.1e-3}, "opened by the other's force"}};
  for (const Case& c : cases) {
    Scene s = scene(c.coupling);
    s.q0 = c.q;
    Eigen::Vector2d f = forces(s, c.q);
    if (c.coupling > 0.0 && c.q(1) < 1.5e-3) {
      EXPECT_LT(f(1), 0.0); // closed it would pull
      f = Eigen::Vector2d(in_series(stiffness[0], 3e-6) * (c.q(0) - gap), 0.0);
    }
    s.loads = {{Constant{1.0}, s.system.stiffness.cwiseProduct(c.q) + f}}; // at rest
    s.duration = 0.02;
    const History run = simulate(s, splitting(1e-5), 0.001);
    constexpr double of_the_splitting = 1e-5; // (w h)^2/8, w^2 = 3e5
    for (Eigen::Index i = 1; i < run.time.size(); ++i) {
      ASSERT_LT((run.normal.col(i) - f).norm(), of_the_splitting * f.norm()) << c.what;
      ASSERT_LT((run.q.col(i) - c.q).norm(), of_the_splitting * c.q.norm()) << c.what;
    }
    EXPECT_EQ(run.report.counts.unconverged, 0);
  }
}

TEST(FlexibleContacts, AreSolvedWhereTheyShareMuchMoreThanTheyGiveWay) {
  // nodes side by side on springs, each between planes with friction; K_N R = 300, of which they share 0.95; w_c h = 0.6 of the stiffest shape
  constexpr int count = 10;
  constexpr double stiffness = 1e10, flexibility = 3e-8, shared = 0.95;
  Scene s;
  s.system.stiffness = Eigen::VectorXd::LinSpaced(count, 1e4, 4e4);
  s.system.damping = Eigen::VectorXd::Constant(count, 2.0);
  s.q0 = s.v0 = Eigen::VectorXd::Zero(count);
  s.duration = 0.2;
  s.residual = Eigen::MatrixXd::Zero(3 * count, 3 * count);
  for (int c = 0; c < count; ++c) {
    ContactPoint p{std::to_string(c),
                   {contact::PlanePair{1e-4, PlaneAxis::y}, {stiffness, 10.0}, {1e7, 10.0, 0.4, 0.3}},
                   Vec3::Zero(),
                   Eigen::MatrixXd::Zero(3, count)};
    p.b(1, c) = 1.0;
    p.b(2, (c + 1) % count) = 0.5;
    s.contacts.push_back(p);
    for (int other = 0; other < count; ++other)
      for (int k = 1; k < 3; ++k)
        s.residual(3 * c + k, 3 * other + k) = flexibility * (c == other ? 1.0 : shared);
    s.loads.push_back({Harmonic{1.0, 20.0 + c, 0.3 * c}, 60.0 * Eigen::VectorXd::Unit(count, c)});
  }
  const History run = simulate(s, splitting(2.5e-5), 0.1);
  EXPECT_EQ(run.report.counts.steps, 8000);
  EXPECT_LT(run.report.residual_relative, 1e-2);
  EXPECT_EQ(run.report.counts.unconverged, 0);
}

TEST(FlexibleContacts, StickWithTheStiffnessesInSeries) {
  // a block held by a sticking spring of K_T and R: x = (v0/w) sin(w t), w^2 = K_T/(1 + K_T R)/m
  constexpr double stiffness = 1e4, speed = 0.1;
  for (const double flexibility : {1e-5, 1e-4, 1e-2})
    for (const auto kind :
         {contact::FrictionMemoryKind::return_map, contact::FrictionMemoryKind::reference}) {
      const double w = std::sqrt(in_series(stiffness, flexibility));
      Scene s = mass_point(1.0, Vec3::Zero(), 10.0 / w);
      s.contacts = {pressed(1.0, 1e4, {stiffness, 0.0, 1e3, 1e3, kind})};
      s.residual = diagonal(flexibility, flexibility, 0.0);
      start(s, 1.0, Vec3::Zero(), Vec3(0.6, 0.8, 0.0) * speed);
      const auto error = [&](double h) {
        const History run = simulate(s, splitting(h), 0.5 / w);
        double largest = 0.0;
        for (Eigen::Index i = 0; i < run.time.size(); ++i)
          largest = std::max(
              largest, (run.q.col(i) - speed / w * std::sin(w * run.time(i)) * Vec3(0.6, 0.8, 0.0)).norm());
        return largest * w / speed;
      };
      const double coarse = error(0.1 / w), fine = error(0.0125 / w);
      EXPECT_LT(coarse, 2e-2) << flexibility;
      EXPECT_LT(fine, coarse / 45.0) << flexibility; // of 64
    }
}

TEST(FlexibleContacts, HaveNoStepLimitOfTheirOwn) {
  // K_N R = 1e5: the contacts alone would allow steps 300 times shorter
  constexpr double stiffness = 1e9, give = 1e-4, mass = 2.0;
  Scene s = mass_point(mass, Vec3::Constant(1e3), 5.0);
  s.contacts = {contact_of(mass, {contact::Circle{1e-3}, {stiffness}, {}})};
  s.residual = diagonal(give, give, give);
  start(s, mass, Vec3::Zero(), Vec3(0.0, 0.3, 0.4));
  const double w = std::sqrt(in_series(stiffness, give) / mass);
  const auto records = trace(s, splitting(0.3 / w));
  double lowest = 1e300, highest = 0.0;
  for (const auto& e : records) {
    lowest = std::min(lowest, e.energy.stored);
    highest = std::max(highest, e.energy.stored);
  }
  EXPECT_LT(highest / lowest - 1.0, 0.1); // while it is closed; impacts take nothing
  // with friction and dampers it comes to rest
  s.contacts[0].support = {contact::Circle{1e-3}, {stiffness, 100.0}, {1e8, 1e3, 0.4, 0.3}};
  s.loads = {force_on(mass, Vec3(0.0, 5.0, 0.0), Constant{1.0})};
  s.system.damping.setConstant(3.0);
  const auto damped = trace(s, splitting(0.3 / w));
  const double force = 5.0 - 1e3 * (1e-3 + give * 4.0);
  EXPECT_NEAR(damped.back().normal, force, 0.02 * force); // up to what friction holds
  EXPECT_NEAR(damped.back().normal, damped[damped.size() - 2].normal, 1e-3 * force);
}

TEST(SchemeScope, RefusesReferenceFrictionOnANodeThatIsCarriedAndCannotMove) {
  const auto scene = [](contact::FrictionMemoryKind kind, double moves) {
    Scene s = mass_point(2.0, Vec3::Zero(), 0.1);
    s.contacts = {contact_of(2.0, {contact::Stop{1e-3, PlaneAxis::y}, {1e6}, {1e5, 2.0, 0.3, 0.3, kind}})};
    s.contacts[0].b.row(0) *= moves;
    s.contacts[0].imposed = Vec3(-1.0, 0.0, 0.0);
    s.motions.resize(1);
    return s;
  };
  constexpr auto reference = contact::FrictionMemoryKind::reference;
  constexpr double of_round_off = 1e-14; // of the largest shape
  const Scene held = scene(reference, of_round_off);
  for (const SchemeKind kind :
       {SchemeKind::splitting, SchemeKind::euler, SchemeKind::devogelaere, SchemeKind::runge_kutta_54})
    EXPECT_EQ(out_of_scope(held, kind), "");
  for (const SchemeKind kind : {SchemeKind::collocation, SchemeKind::energy_conserving}) {
    EXPECT_EQ(out_of_scope(scene(reference, 1.0), kind), "");
    EXPECT_EQ(out_of_scope(scene(contact::FrictionMemoryKind::return_map, 0.0), kind), "");
    EXPECT_EQ(out_of_scope(held, kind),
              "does not take friction_memory = \"reference\" of contact \"" + held.contacts[0].name +
                  "\", which an obstacle carries along x_loc where no mode moves its node (it does "
                  "take \"return_map\")");
  }
}

TEST(FlexibleContacts, AreRefusedBySchemesThatDoNotTakeThem) {
  Scene s = impact(1e6, 0.1);
  s.residual = diagonal(0.0, 1e-6, 0.0);
  EXPECT_NO_THROW(check_scope(s, SchemeKind::splitting));
  for (const SchemeKind kind : {SchemeKind::collocation, SchemeKind::euler, SchemeKind::energy_conserving,
                                SchemeKind::devogelaere, SchemeKind::runge_kutta_54}) {
    try {
      check_scope(s, kind);
      ADD_FAILURE() << "no error";
    } catch (const core::Error& error) {
      EXPECT_EQ(error.what(), "scheme = \"" + name_of(kind) +
                                  "\" does not take the residual flexibility of the modes at the contacts "
                                  "(modes.static_modes = \"auto\"); use "
                                  "scheme = \"splitting\"");
    }
  }
}

} // namespace flexible_contacts_test
