// SPDX-License-Identifier: GPL-3.0-or-later
// Steps made at once where no contact can meet its obstacle.
#include "post/impact_table.hpp"
#include "post/node_statistics.hpp"
#include "scenes.hpp"
#include "transient/splitting/splitting.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace macro_steps_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

constexpr double mass = 0.5, stiffness = 1e7, gap = 2e-4;
const double frequency = std::sqrt(stiffness / mass), h = 0.2 / frequency;

StepChoice with_macro_steps(const Scene& scene, int macro_steps) {
  StepChoice choice = choose_step(scene, splitting(h));
  choice.macro_steps = macro_steps;
  return choice;
}

/// A mass on a soft spring that swings between the walls of a hole, one impact with friction after the other.
Scene swinging(double duration, const contact::FrictionLaw& friction = {5e6, 500.0, 0.3, 0.3}) {
  Scene scene = mass_point(mass, Vec3(0.0, 500.0, 800.0), duration);
  scene.contacts = {contact_of(mass, {contact::Circle{gap}, {stiffness}, friction})};
  start(scene, mass, {0.0, 0.0, 0.4 * gap}, {0.0, 0.12, 0.05});
  return scene;
}

/// Of a structure that damps nothing, at any record.
struct MostModalDamping final : Observer {
  double energy = 0.0; ///< J
  void step(const Record& record) override {
    energy = std::max(energy, std::abs(record.energy.modal_damping));
  }
  void visit(core::StateArchive& state) override { state(energy); }
};

struct Result {
  Report report;
  double modal_damping; ///< J
  post::ContactSummary contact;
  post::NodeSummary node;
  std::vector<post::Impact> impacts;
};

Result simulate_with(const Scene& scene, int macro_steps, double from = 0.0) {
  post::ContactStatistics contacts(scene.contacts, from);
  post::NodeStatistics nodes({scene.contacts[0].b}, from);
  post::ImpactTable impacts(1, from, 0.0, 1000);
  MostModalDamping damping;
  Observer* const observers[] = {&contacts, &nodes, &impacts, &damping};
  Result out;
  out.report = run(scene, with_macro_steps(scene, macro_steps), observers, nullptr, {});
  out.modal_damping = damping.energy;
  out.contact = contacts.summaries()[0];
  out.node = nodes.summaries()[0];
  out.impacts = std::move(impacts).impacts()[0].rows;
  return out;
}

} // namespace

TEST(MacroSteps, LeadToTheSameImpacts) {
  const Scene scene = swinging(0.1);
  const Result single = simulate_with(scene, 1), by_macro_steps = simulate_with(scene, 12);
  EXPECT_EQ(single.report.counts.steps, by_macro_steps.report.counts.steps);
  EXPECT_LT(single.report.counts.evaluations, 6 * single.report.counts.steps / 10);
  ASSERT_EQ(single.impacts.size(), by_macro_steps.impacts.size());
  EXPECT_GT(single.impacts.size(), 20U);
  for (std::size_t i = 0; i < single.impacts.size(); ++i) { // exact flows: only round-off differs
    EXPECT_NEAR(single.impacts[i].start, by_macro_steps.impacts[i].start, 1e-9);
    EXPECT_NEAR(single.impacts[i].impulse / by_macro_steps.impacts[i].impulse, 1.0, 1e-6);
  }
  EXPECT_NEAR(by_macro_steps.report.energy.friction / single.report.energy.friction, 1.0, 1e-6);
  EXPECT_NEAR(by_macro_steps.report.energy.contact_damping / single.report.energy.contact_damping, 1.0, 1e-6);
  EXPECT_NEAR(by_macro_steps.report.residual_relative, single.report.residual_relative, 1e-6);
  EXPECT_LT(by_macro_steps.modal_damping, 1e-12 * by_macro_steps.report.energy.scale);
}

// Records that stand for macro-steps weigh as much time as these take, and show displacements whose sums are integrals.
TEST(MacroSteps, LeaveStatisticsOfTheMotionWhatTheyAre) {
  const Scene scene = swinging(0.5, {});
  const Result single = simulate_with(scene, 1), by_macro_steps = simulate_with(scene, 12);
  EXPECT_NEAR(by_macro_steps.contact.normal_mean / single.contact.normal_mean, 1.0, 1e-3);
  EXPECT_NEAR(by_macro_steps.contact.y.std / single.contact.y.std, 1.0,
              1e-3); // 3e-3 by the displacements at the ends
  EXPECT_NEAR(by_macro_steps.contact.z.std / single.contact.z.std, 1.0, 1e-3);
  EXPECT_NEAR(by_macro_steps.contact.radial_rms / single.contact.radial_rms, 1.0, 1e-3);
  for (int k = 1; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    EXPECT_NEAR(by_macro_steps.node.displacement[axis].std / single.node.displacement[axis].std, 1.0, 1e-3);
  }
}

// Lines over macro-steps would take 0.4 % of a load of thirty macro-steps a period, which makes far more of a motion that only just meets its obstacle.
TEST(MacroSteps, TakeNothingOffHarmonicLoads) {
  constexpr double force = 2.0;
  const double f = 1.0 / (30.0 * 12.0 * h), w = 2.0 * std::numbers::pi * f,
               amplitude = force / (stiffness / 100.0 - mass * w * w);
  Scene scene = mass_point(mass, Vec3(0.0, stiffness / 100.0, stiffness / 100.0), 100.0 / f);
  scene.contacts = {contact_of(mass, {contact::Circle{1.0}, {stiffness}, {}})};
  start(scene, mass, Vec3::Zero(), {0.0, amplitude * w, 0.0}); // the steady motion
  scene.loads = {force_on(mass, Vec3(0.0, force, 0.0), Harmonic{1.0, f})};
  for (const int macro_steps : {1, 12}) {
    const Result result = simulate_with(scene, macro_steps);
    EXPECT_LE(result.report.counts.evaluations, 1); // the first step
    EXPECT_NEAR(result.node.displacement[1].std / std::abs(amplitude / std::numbers::sqrt2), 1.0, 1e-4)
        << macro_steps;
  }
}

// A band that ends at 30 macro-steps a period, below the frequency of the mass.
TEST(MacroSteps, TakeNothingOffRandomLoads) {
  constexpr double force = 2.0;
  const double f = 1.0 / (30.0 * 12.0 * h);
  Scene scene = mass_point(mass, Vec3(0.0, stiffness / 100.0, stiffness / 100.0), 200.0 / f);
  scene.contacts = {contact_of(mass, {contact::Circle{1.0}, {stiffness}, {}})};
  scene.loads = {force_on(mass, Vec3(0.0, force, 0.0), Random{1.0, 0.7 * f, f, 3})};
  const Result single = simulate_with(scene, 1), by_macro_steps = simulate_with(scene, 12);
  EXPECT_LE(by_macro_steps.report.counts.evaluations, 1); // the first step
  EXPECT_NEAR(by_macro_steps.node.displacement[1].std / single.node.displacement[1].std, 1.0, 1e-4);
}

// Steps of one length meet those of another with the loads that these have there.
TEST(MacroSteps, EndWhereTheNextStepStarts) {
  Scene scene = swinging(0.1);
  scene.loads = {force_on(mass, Vec3(0.0, 1.0, 0.5), Harmonic{1.0, 60.0})};
  const auto scheme = make_splitting(scene, h, {.longest = 12});
  const double instant = 1e-9 * h;
  int changes = 0;
  for (double before = h, end = 0.0; end < 0.09;) {
    const Record& record = scheme->advance();
    end = record.time + 0.5 * record.step;
    changes += record.step > 1.5 * before || record.step < before / 1.5;
    before = record.step;
    std::array<double, 3> q{}, v{}, next_q{}, next_v{};
    scheme->state_at(end - instant, q.data(), v.data());
    scheme->state_at(end + instant, next_q.data(), next_v.data());
    for (std::size_t i = 0; i < q.size(); ++i) {
      EXPECT_NEAR(next_q[i], q[i], 1e-9 * gap) << end;
      EXPECT_NEAR(next_v[i], v[i], 1e-9) << end; // m/s
    }
  }
  EXPECT_GT(changes, 20);
}

// The record at its end is the first of the window, and weighs half of it too much or too little.
TEST(MacroSteps, AreNoMatterToWindowsThatBeginInsideThem) {
  const Scene scene = swinging(0.5, {});
  for (const double from : {0.1, 0.1001, 0.1002, 0.1003}) {
    const Result single = simulate_with(scene, 1, from), by_macro_steps = simulate_with(scene, 12, from);
    EXPECT_EQ(by_macro_steps.contact.impacts, single.contact.impacts);
    EXPECT_NEAR(by_macro_steps.contact.impact_rate / single.contact.impact_rate, 1.0, 6.0 * h / 0.4);
    EXPECT_NEAR(by_macro_steps.contact.z.std / single.contact.z.std, 1.0, 1e-3);
    EXPECT_NEAR(by_macro_steps.node.displacement[1].std / single.node.displacement[1].std, 1.0, 1e-3);
  }
}

// An arc that touches its obstacle between the ends of a macro-step, from any phase.
TEST(MacroSteps, MissNoImpact) {
  constexpr int phases = 200;
  std::int64_t by_macro_steps = 0;
  const double swing = 0.5 / (12.0 * h); // rad/s: beyond the stop for half the time of a macro-step
  for (int i = 0; i < phases; ++i) {
    Scene scene = mass_point(mass, mass * swing * swing * Vec3::Ones(), 200.0 * h);
    scene.contacts = {contact_of(mass, {contact::Stop{gap, contact::PlaneAxis::y}, {stiffness}, {}})};
    start(scene, mass, Vec3(0.0, -1.01 * gap * std::cos(0.01 + 0.031 * i), 0.0),
          Vec3(0.0, 1.01 * gap * swing * std::sin(0.01 + 0.031 * i), 0.0));
    const auto first = [&](int macro_steps) { return simulate_with(scene, macro_steps).impacts.at(0).start; };
    EXPECT_NEAR(first(12), first(1), 1e-9) << i;
    const auto counts = simulate_with(scene, 12).report.counts;
    by_macro_steps += counts.steps - counts.evaluations;
  }
  EXPECT_GT(by_macro_steps, 10000); // of 40 000 steps
}

// A mass that a force holds just off its stop: its swing is a hundredth of the clearance, by which speeds are judged slow, and only just reaches it.
TEST(MacroSteps, MissNoGrazingImpact) {
  constexpr double w = 100.0, held_off = 1e-2, swing = 1e-4, reach = 0.995; // rad/s, m, m, share of the swing
  Scene scene = mass_point(1.0, w * w * Vec3::Ones(), 10.0);
  scene.contacts = {
      contact_of(1.0, {contact::Stop{held_off + reach * swing, contact::PlaneAxis::y}, {1e4}, {}})};
  start(scene, 1.0, Vec3(0.0, held_off - swing, 0.0), Vec3::Zero());
  scene.loads.push_back({Constant{w * w * held_off}, Vec3(0.0, 1.0, 0.0)});
  const auto simulated = [&](int macro_steps) {
    StepChoice choice = choose_step(scene, splitting(5e-4));
    choice.macro_steps = macro_steps;
    post::ContactStatistics contacts(scene.contacts, 0.0);
    Observer* const observers[] = {&contacts};
    const Report report = run(scene, choice, observers, nullptr, {});
    return std::pair(contacts.summaries()[0], report.counts);
  };
  const auto [single, all] = simulated(1);
  const auto [by_macro_steps, some] = simulated(10);
  EXPECT_GT(single.impacts, 150);
  EXPECT_EQ(by_macro_steps.impacts, single.impacts);
  EXPECT_NEAR(by_macro_steps.normal_mean / single.normal_mean, 1.0, 1e-3); // where a record ends
  EXPECT_LT(some.evaluations, all.steps / 2);                              // steps with contacts near
}

// Outputs come from the exact flow inside a macro-step, and change none of it.
TEST(MacroSteps, GiveOutputsAtAnyInstantAndDoNotFeelThem) {
  const Scene scene = swinging(0.02);
  struct Positions final : Sampler {
    void state(std::int64_t, double, const double* q, const double*) override { y.push_back(q[1]); }
    void forces(std::int64_t, double, const double*, std::span<const ContactForce>) override {}
    void visit(core::StateArchive&) override {}
    std::vector<double> y;
  };
  const auto watched = [&](int macro_steps, double every) {
    Positions positions;
    post::ContactStatistics statistics(scene.contacts, 0.0);
    Observer* const observers[] = {&statistics};
    (void)run(scene, with_macro_steps(scene, macro_steps), observers, &positions,
              output_grid(scene.duration, every));
    return std::pair(positions.y, statistics.summaries()[0].radial_rms);
  };
  const auto [single, same] = watched(1, 1.7e-5);
  const auto [by_macro_steps, dense] = watched(12, 1.7e-5);
  ASSERT_EQ(single.size(), by_macro_steps.size());
  for (std::size_t i = 0; i < single.size(); ++i)
    EXPECT_NEAR(single[i], by_macro_steps[i], 1e-9 * gap) << i;
  EXPECT_EQ(watched(12, 0.01).second, dense);
}

// Without observers nobody looks at the positions of records: outputs and energies are the same bytes.
TEST(MacroSteps, DoNotFeelWhetherSomebodyLooks) {
  const Scene scene = swinging(0.1);
  struct Forces final : Sampler {
    void state(std::int64_t, double, const double* q, const double* v) override { keep(q, v); }
    void forces(std::int64_t, double, const double* load, std::span<const ContactForce> contacts) override {
      keep(load, &contacts[0].friction.t);
    }
    void keep(const double* three, const double* more) {
      all.insert(all.end(), three, three + 3);
      all.push_back(*more);
    }
    void visit(core::StateArchive&) override {}
    std::vector<double> all;
  };
  for (const double fastest : {0.0, 5.0}) { // heavier modes: positions are in other coordinates
    StepChoice choice = with_macro_steps(scene, 12);
    choice.fastest = fastest;
    Forces unseen, seen;
    MostModalDamping observer;
    Observer* const observers[] = {&observer};
    const OutputGrid grid = output_grid(scene.duration, 1.7e-5);
    const Report a = run(scene, choice, {}, &unseen, grid), b = run(scene, choice, observers, &seen, grid);
    EXPECT_EQ(unseen.all, seen.all);
    EXPECT_EQ(a.energy.stored, b.energy.stored);
    EXPECT_EQ(a.energy.friction, b.energy.friction);
    EXPECT_EQ(a.residual_relative, b.residual_relative);
    EXPECT_LT(a.counts.evaluations, a.counts.steps);
  }
}

TEST(
    MacroSteps,
    AreNotMadeRoundAnObstacle) { // gaps outside a circle bend upwards: a straight path between two free places may cross it
  Scene scene = swinging(0.1);
  scene.duration = 0.3;
  scene.contacts[0].support.obstacle = contact::RoundPair{2e-3};
  scene.contacts[0].rest.y() = 3e-3;
  const Result single = simulate_with(scene, 1), by_macro_steps = simulate_with(scene, 12);
  EXPECT_EQ(single.contact.impacts, by_macro_steps.contact.impacts);
  EXPECT_GT(single.contact.impacts, 0);
}

} // namespace macro_steps_test
