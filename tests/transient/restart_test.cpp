// SPDX-License-Identifier: GPL-3.0-or-later
// A run that is left and gone on with, in objects made anew, gives the same bytes; so does one in vectors of 4 instead of 8 doubles.
#include "kernels/kernels.hpp"
#include "post/impact_table.hpp"
#include "post/largest_impact.hpp"
#include "post/node_statistics.hpp"
#include "post/recorder.hpp"
#include "scenes.hpp"
#include "transient/splitting/splitting.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace restart_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

constexpr double every = 7.7e-4; // s, between outputs: not a multiple of the steps
constexpr double from = 0.01;    // s, start of the statistics

/// A run with all that watches it.
class Watched {
public:
  Watched(const Scene& scene, const StepChoice& choice)
      : node_(Eigen::MatrixXd::Constant(3, scene.system.size(), 0.3)), contacts_(scene.contacts, from),
        impacts_(scene.contacts.size(), from, 2e-3, 1000), nodes_({node_}, from),
        forces_(forces_of(node_, scene.contacts.size()), from), grid_(output_grid(scene.duration, every)),
        recorder_(scene, {{"node", node_}}, grid_), largest_(scene.contacts.size(), from),
        run_(scene, choice, observers_, &recorder_, grid_) {}

  Run& run() { return run_; }

  /// Everything a user can see at the end.
  [[nodiscard]] std::string results() {
    Report report = run_.finish();
    core::StateArchive out;
    out(report.outcome, report.end_time, report.records, report.failure, report.residual_relative);
    out(report.counts, report.energy);
    auto contacts = contacts_.summaries();
    auto impacts = std::move(impacts_).impacts();
    auto nodes = nodes_.summaries();
    auto forces = forces_.summaries();
    out(contacts, impacts, nodes, forces);
    for (auto& history : largest_.histories())
      out(history);
    post::TimeSeries series = std::move(recorder_).series();
    const auto add = [&](auto& m) { out.block(m.data(), static_cast<std::size_t>(m.size())); };
    add(series.time);
    add(series.modal_displacement);
    add(series.modal_velocity);
    for (auto& c : series.contacts) {
      add(c.displacement);
      add(c.velocity);
      add(c.gap);
      add(c.normal_force);
      add(c.tangential_force);
      out(c.state);
    }
    for (auto& n : series.nodes) {
      add(n.displacement);
      add(n.acceleration);
    }
    return std::move(out).bytes();
  }

private:
  static std::vector<post::FollowedForce> forces_of(const Eigen::MatrixXd& node, std::size_t contacts) {
    Eigen::MatrixXd rows(6, node.cols());
    rows << node, -2.0 * node;
    const Eigen::MatrixXd by_contacts = Eigen::MatrixXd::Ones(6, 3 * static_cast<Eigen::Index>(contacts));
    return {{"section", rows, by_contacts, {}, {}, true, post::OuterFibre{true, 1.0, 2.0, 2.0}}};
  }

  Eigen::MatrixXd node_;
  post::ContactStatistics contacts_;
  post::ImpactTable impacts_;
  post::NodeStatistics nodes_;
  post::ForceStatistics forces_;
  OutputGrid grid_;
  post::Recorder recorder_;
  post::LargestImpact largest_;
  Observer* observers_[5] = {&contacts_, &impacts_, &nodes_, &forces_, &largest_};
  Run run_;
};

std::string saved(Run& run) {
  core::StateArchive state;
  state(run);
  return std::move(state).bytes();
}

void restore(Run& run, std::string bytes) {
  core::StateArchive state(std::move(bytes));
  state(run);
  state.end();
}

std::string in_one_go(const Scene& scene, const StepChoice& choice) {
  Watched whole(scene, choice);
  while (whole.run().advance(1000)) {
  }
  return whole.results();
}

/// Left after every `records` records.
std::string in_portions(const Scene& scene, const StepChoice& choice, std::int64_t records) {
  auto now = std::make_unique<Watched>(scene, choice);
  restore(now->run(), saved(now->run())); // before the first record
  while (now->run().advance(records)) {
    const std::string state = saved(now->run());
    now = std::make_unique<Watched>(scene, choice);
    restore(now->run(), state);
  }
  const std::string end = saved(now->run());
  now = std::make_unique<Watched>(scene, choice);
  restore(now->run(), end); // after the last
  EXPECT_FALSE(now->run().advance(records));
  return now->results();
}

/// In vectors of 4 doubles, where the processor has those of 8.
void expect_same_in_half_vectors(const Scene& scene, const StepChoice& choice, const std::string& whole) {
  using kernels::VectorSize;
  if (kernels::limit_vectors(VectorSize::pack) != VectorSize::pack)
    return;
  kernels::limit_vectors(VectorSize::half);
  EXPECT_TRUE(in_one_go(scene, choice) == whole) << name_of(choice.scheme);
  kernels::limit_vectors(VectorSize::pack);
}

void expect_restarts(const Scene& scene, const std::vector<StepOptions>& schemes) {
  for (const StepOptions& options : schemes) {
    const StepChoice choice = choose_step(scene, options);
    const std::string whole = in_one_go(scene, choice);
    std::int64_t impacts = 0;
    for (const auto& contact : simulate(scene, options, every, from).statistics)
      impacts += contact.impacts;
    EXPECT_TRUE(impacts > 2 || scene.contacts.empty());
    expect_same_in_half_vectors(scene, choice, whole);
    for (const std::int64_t records : {3, 101})
      EXPECT_TRUE(in_portions(scene, choice, records) == whole)
          << name_of(choice.scheme) << ", left after every " << records << " records";
  }
}

void expect_restarts_of_cut_steps(const Scene& scene, const StepOptions& options) {
  const StepChoice choice = choose_step(scene, options);
  EXPECT_GT(run(scene, choice, {}, nullptr, {}).counts.rejected, 0);
  for (const std::int64_t records : {1, 5})
    EXPECT_TRUE(in_portions(scene, choice, records) == in_one_go(scene, choice)) << records;
}

StepOptions scheme(SchemeKind kind, std::optional<double> step) {
  StepOptions options{kind, step};
  options.tolerance = 1e-4;
  return options;
}

/// A hole of four lands.
contact::Profile lobed_hole() {
  std::vector<contact::PolarPoint> points;
  for (int i = 0; i < 24; ++i) {
    const double angle = 0.01 + i * std::numbers::pi / 12.0;
    points.push_back({angle, 2e-4 * (1.0 + 0.25 * std::cos(4.0 * angle))});
  }
  return contact::Profile(points);
}

constexpr double duration = 0.06;

std::vector<StepOptions> all_schemes() {
  return {splitting(1e-4),
          euler(4e-5),
          collocation(1e-4),
          energy_conserving(1e-4),
          scheme(SchemeKind::devogelaere, 4e-5),
          scheme(SchemeKind::runge_kutta_54, {})};
}

Scene pushed(int contacts, int modes) {
  Scene scene = rattling(contacts, modes, duration);
  scene.v0.setConstant(0.02);
  return scene;
}

/// The state between two actions needs the forces of the first, of contacts that act alone and together.
TEST(Restart, KeepsTheStateBetweenActions) {
  for (const int contacts : {1, 2, 3, 9}) {
    const Scene scene = rattling(contacts, 12, 1.0);
    constexpr double h = 1e-4;
    const auto scheme = make_splitting(scene, h);
    const auto size = scene.system.size();
    Eigen::VectorXd q(size), v(size), q_again(size), v_again(size);
    int closed = 0;
    for (int k = 0; k < 1500; ++k) {
      const Record& record = scheme->advance();
      closed += !record.active.empty();
      const double time = record.time + 0.3 * h;
      scheme->state_at(time, q.data(), v.data());
      core::StateArchive saved;
      saved(*scheme);
      const auto anew = make_splitting(scene, h);
      core::StateArchive restored(std::move(saved).bytes());
      restored(*anew);
      restored.end();
      for (const auto& of : {scheme.get(), anew.get()}) { // saving changes nothing either
        of->state_at(time, q_again.data(), v_again.data());
        ASSERT_EQ(q, q_again) << contacts << " contacts, step " << k;
        ASSERT_EQ(v, v_again) << contacts << " contacts, step " << k;
      }
    }
    EXPECT_GT(closed, 100) << contacts;
  }
}

} // namespace

TEST(Restart, OfALinearScene) { expect_restarts(pushed(0, 5), all_schemes()); }

TEST(Restart, WithFrictionInThePlane) { expect_restarts(pushed(5, 9), all_schemes()); }

TEST(Restart, WithFrictionAlongOneTangent) {
  Scene scene = pushed(5, 9);
  for (auto& c : scene.contacts)
    c.b.row(0).setZero();
  expect_restarts(scene, all_schemes());
}

TEST(
    Restart,
    WhereOnlyNearContactsAreLookedAt) { // no normal damper: velocities of the others are those of earlier steps, or none
  for (const int contacts : {2, 4, 19})
    for (const bool in_lanes : {true, false}) {
      Scene scene = pushed(contacts, 21);
      for (auto& c : scene.contacts) {
        c.support.normal.damping = 0.0;
        if (in_lanes)
          c.b.row(0).setZero();
      }
      expect_restarts(scene, {splitting(1e-4)});
    }
}

TEST(Restart, InsideFlights) {
  for (const bool in_lanes : {true, false}) {
    Scene scene = pushed(3, 9);
    for (auto& c : scene.contacts) {
      c.support.normal.damping = 0.0;
      if (in_lanes)
        c.b.row(0).setZero();
    }
    StepChoice choice = choose_step(scene, splitting(2e-5));
    choice.macro_steps = 8;
    const auto counts = run(scene, choice, {}, nullptr, {}).counts;
    EXPECT_LT(counts.evaluations, 9 * counts.steps / 10);
    const std::string whole = in_one_go(scene, choice);
    for (const std::int64_t records : {1, 3, 101})
      EXPECT_TRUE(in_portions(scene, choice, records) == whole) << records;
  }
}

TEST(Restart, WithContactsThatTheStartPresses) {
  Scene scene = pushed(3, 9);
  scene.q0.setConstant(7e-5);
  scene.duration = 0.3;
  expect_restarts(scene, {splitting(1e-4)});
}

TEST(Restart, WhereContactsPushOthersIn) {
  const Scene bar = turning_bar(1.0);
  constexpr double step = 7e-3; // w_c h = 0.57
  EXPECT_TRUE(closes_at_both_ends_at_once(bar, step));
  expect_restarts(bar, {splitting(step)});
}

TEST(Restart, UnderTablesAndNoise) {
  Scene scene = pushed(2, 6);
  scene.loads[0].function = Random{4.0, 5.0, 60.0, 1};
  scene.loads[1].function = Table{{0.0, 0.03, 0.03, 0.05}, {3.0, -3.0, 4.0, 1.0}};
  scene.loads.push_back({Constant{2.0}, Eigen::VectorXd::Ones(6)});
  expect_restarts(scene, all_schemes());
}

TEST(Restart, UnderAConstantLoad) {
  Scene scene = pushed(2, 6);
  scene.loads = {{Constant{2.0}, Eigen::VectorXd::Ones(6)}};
  expect_restarts(scene, all_schemes());
}

TEST(Restart, WithAnyObstacleAndLaw) {
  Scene scene = pushed(8, 9);
  const auto set = [&](std::size_t c, const contact::Obstacle& obstacle, const Vec3& rest) {
    scene.contacts[c].support.obstacle = obstacle;
    scene.contacts[c].rest = rest;
  };
  constexpr double far = 0.01, gap = 1e-4;
  const contact::PolarPoint square[] = {{0.0, 2e-4}, {1.6, 2e-4}, {3.1, 2e-4}, {4.7, 2e-4}};
  set(1, contact::RoundPair{far}, Vec3(0, far + gap, 0));
  set(2, contact::FacingPlanes{far, contact::PlaneAxis::z, 1.0}, Vec3(0, 0, far + gap));
  set(3, contact::Profile(square), Vec3::Zero());
  scene.contacts[0].support.normal.dissipation = scene.contacts[3].support.normal.dissipation = 1.0;
  scene.contacts[5].support.friction.along = {0.0, 1.0};
  scene.contacts[6].support.friction.along = {1.0, 0.0};
  scene.contacts[7].support.friction.kind = contact::FrictionMemoryKind::reference;
  expect_restarts(scene, all_schemes());
}

TEST(Restart, WithADampingMatrix) {
  Scene scene = pushed(3, 6);
  scene.system.damping_matrix = Eigen::MatrixXd(scene.system.damping.asDiagonal());
  scene.system.damping_matrix(0, 5) = scene.system.damping_matrix(5, 0) = 0.3;
  expect_restarts(scene, all_schemes());
}

TEST(Restart, WithForcesThatDependOnTheMotion) {
  constexpr int modes = 6, states = 4;
  Scene scene = pushed(3, modes);
  core::MotionForces& f = scene.system.motion;
  f.stiffness = Eigen::MatrixXd::Constant(modes, modes, -20.0);
  f.damping = Eigen::MatrixXd::Constant(modes, modes, 0.3);
  f.input = Eigen::MatrixXd::Constant(modes, states, 40.0);
  f.output = Eigen::MatrixXd::Constant(states, modes, 0.5);
  f.rates = -50.0 * Eigen::MatrixXd::Identity(states, states);
  expect_restarts(scene, {splitting(1e-4), scheme(SchemeKind::runge_kutta_54, {})});
}

TEST(Restart, WithObstaclesThatMove) {
  Scene scene = pushed(3, 6);
  scene.motions = {{Harmonic{1.0, 20.0, 0.0}, -1.0 / 125.66, 0.0}, {Random{0.5, 5.0, 60.0, 1}, 0.0, 0.0}};
  for (auto& c : scene.contacts)
    c.imposed = 0.1 * Eigen::MatrixXd::Identity(3, 2);
  expect_restarts(scene, all_schemes());
}

TEST(Restart, WhereCollocationHasCutSteps) {
  Scene scene = pushed(5, 9);
  for (auto& c : scene.contacts)
    c.support.normal.stiffness = 1e8;
  expect_restarts_of_cut_steps(scene, collocation(4e-4));
}

TEST(Restart, WhereTheEnergyConservingSchemeHasCutSteps) {
  Scene scene = rattling(9, 24, 1.0);
  for (auto& c : scene.contacts) {
    c.support.obstacle = lobed_hole();
    c.support.normal.stiffness = 1e7;
  }
  expect_restarts_of_cut_steps(scene, energy_conserving(1e-2)); // w_c h of nearly 100
}

TEST(Restart, OfADivergedRunStaysDiverged) {
  Scene scene = mass_point(1.0, Vec3(0, 1e6, 0), 1.0);
  start(scene, 1.0, Vec3(0, 1e-3, 0), Vec3::Zero());
  const StepChoice choice = choose_step(scene, euler(2.1e-3)); // w_max h = 2.1, limit 2
  EXPECT_TRUE(in_portions(scene, choice, 10) == in_one_go(scene, choice));
}

TEST(Restart, RefusesTheStateOfAnotherRun) {
  const Scene scene = pushed(3, 6), other = pushed(3, 12);
  const StepChoice choice = choose_step(scene, splitting(1e-4));
  Watched large(other, choice), small(scene, choice);
  large.run().advance(100);
  EXPECT_THROW(restore(small.run(), saved(large.run())), core::StateMismatch);
  Watched again(scene, choice), longer(scene, choice);
  EXPECT_THROW(restore(again.run(), saved(again.run()) + "x"), core::StateMismatch);
  EXPECT_THROW(restore(longer.run(), saved(longer.run()).substr(1)), core::StateMismatch);
}

} // namespace restart_test
