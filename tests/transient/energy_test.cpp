// SPDX-License-Identifier: GPL-3.0-or-later
// The energy balance: its residual measures what the scheme gets wrong.
#include "scenes.hpp"
#include "transient/splitting/splitting.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace energy_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::PlaneAxis;
using contact::PlanePair;

namespace {

constexpr double accepted = 2e-2; // of the automatic step
constexpr double duration = 0.5;

double residual(const StepOptions& options) {
  return simulate(rattling(5, 12, duration), options, duration).report.residual_relative;
}

/// Mean order over four halvings.
double order(SchemeKind scheme, double step) {
  return std::log2(residual({scheme, step}) / residual({scheme, step / 16.0})) / 4.0;
}

/// A mass that bounces between two planes, without any loss.
Scene conservative(double speed = 0.4) {
  Scene s = mass_point(1.0, Vec3(0, 100.0, 0), 10.0);
  start(s, 1.0, Vec3::Zero(), Vec3(0, speed, 0));
  s.contacts = {contact_of(1.0, {PlanePair{0.02, PlaneAxis::y}, {1e6}, {}})};
  return s;
}

/// Largest departure of the stored energy from the initial one outside of impacts, over the number of impacts: the mean of several
/// speeds, because a single motion may lock its impacts to one phase of the step, where it loses five times as much or nothing.
double loss_of_an_impact(const StepOptions& options) {
  constexpr int speeds = 40;
  double sum = 0.0;
  for (int i = 0; i < speeds; ++i) {
    double worst = 0.0;
    int count = 0;
    bool before = false;
    for (const auto& r : trace(conservative(0.4 * (1.0 + 1e-3 * i)), options)) {
      count += r.closed && !before;
      before = r.closed;
      if (!r.closed)
        worst = std::max(worst, std::abs(r.energy.stored / r.energy.initial - 1.0));
    }
    EXPECT_GT(count, 80);
    sum += worst / count;
  }
  return sum / speeds;
}

} // namespace

TEST(EnergyLedger, ResidualOfSplittingFallsWithTheSquareOfTheStep) {
  const double measured = order(SchemeKind::splitting, 2e-4);
  EXPECT_GT(measured, 1.7); // impacts and slips start between steps: the order scatters about 2
  EXPECT_LT(measured, 2.5);
}

TEST(EnergyLedger, ResidualOfEulerFallsWithTheStep) {
  const double measured = order(SchemeKind::euler, 5e-5);
  EXPECT_GT(measured, 0.7);
  EXPECT_LT(measured, 2.5);
}

TEST(EnergyLedger, ResidualIsSmallAtTheAutomaticStep) {
  EXPECT_LT(residual(splitting()), accepted);
  EXPECT_LT(residual(euler()), accepted);
}

TEST(EnergyLedger, HoldsAtEveryStepAndItsLossesNeverFall) {
  for (const StepOptions& options : {splitting(2e-5), euler(5e-6)}) {
    Energy last;
    for (const auto& r : trace(rattling(5, 12, duration), options)) {
      EXPECT_GE(r.energy.modal_damping, last.modal_damping - 1e-12);
      EXPECT_GE(r.energy.friction, last.friction);
      EXPECT_GE(r.energy.scale, last.scale);
      EXPECT_GE(r.energy.stored, 0.0);
      EXPECT_LE(std::abs(r.energy.residual()), accepted * std::max(r.energy.scale, last.scale) + 1e-6);
      last = r.energy;
    }
    EXPECT_GT(last.friction, 0.0);
    EXPECT_GT(last.contact_damping, 0.0);
    EXPECT_GT(last.modal_damping, 0.0);
  }
}

TEST(EnergyLedger, StoresTheEnergyOfTheStateThatTheRecordShows) {
  // which is that at the end of its step
  Scene scene = conservative();
  scene.contacts[0].support.normal.damping = 50.0;
  constexpr double h = 5e-4;
  const auto scheme = make_splitting(scene, h);
  Vec3 q, v;
  int closed = 0;
  for (int i = 0; i < 2000; ++i) {
    const Record& record = scheme->advance();
    scheme->state_at(record.time + 0.5 * record.step, q.data(), v.data());
    const double depth = std::max(0.0, std::abs(q.y()) - 0.02);
    const double energy = 0.5 * v.squaredNorm() + 50.0 * q.y() * q.y() + 0.5e6 * depth * depth;
    constexpr double round_off = 1e-12;
    ASSERT_NEAR(record.energy.stored / energy, 1.0, round_off) << "at " << record.time;
    closed += !record.active.empty();
  }
  EXPECT_GT(closed, 40);
}

TEST(EnergyLedger, OfALinearSceneIsExact) {
  // every term is integrated exactly for a load that is linear over the steps
  Scene scene = mass_point(1.0, Vec3(100.0, 400.0, 0.0), 2.0);
  scene.system.damping = Vec3(0.5, 50.0, 1.0);
  scene.loads = {force_on(1.0, Vec3(1, 2, 3), Constant{1.0})};
  start(scene, 1.0, Vec3(0.1, 0.0, -0.2), Vec3(1.0, 0.0, 0.0));
  constexpr double round_off = 1e-12;
  EXPECT_LT(simulate(scene, splitting(0.01), 2.0).report.residual_relative, round_off);
}

TEST(ConservativeScene, KeepsItsEnergyOverManyImpacts) {
  const double loss = loss_of_an_impact(splitting());
  constexpr double per_impact =
      1.2e-4; // at the automatic step, w_c h = 0.7: far below any structure's damping; the stop alone would keep it to round-off
  EXPECT_LT(loss, per_impact);
  constexpr double finer = 0.2; // a step 4 times smaller: order 2 and some scatter of the impacts' phases
  const double step = choose_step(conservative(), splitting()).step;
  EXPECT_LT(loss_of_an_impact(splitting(step / 4.0)), finer * loss);
}

} // namespace energy_test
