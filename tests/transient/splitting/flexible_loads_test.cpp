// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that loads move beside the modes (ContactPoint::under_loads), as modes far above the motion would.
#include "scenes.hpp"
#include "transient/statics/static_start.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace flexible_loads_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;
using contact::PlaneAxis;

namespace {

/// A node that two modes move, the second far above what happens, on a stop; a force acts where the second moves ten times as much.
Scene with_a_high_mode(const TimeFunction& force, double duration) {
  constexpr double high = 1e5, share = 30.0; // rad/s, 1/sqrt(kg)
  Scene s;
  s.duration = duration;
  s.system.stiffness = Eigen::Vector2d(2e4, high * high);
  s.system.damping = Eigen::Vector2d(5.0, 0.2 * high);
  s.q0 = s.v0 = Eigen::Vector2d::Zero();
  s.contacts = {contact_of(1.0, {contact::Stop{1e-3, PlaneAxis::y}, {1e6}, {}})};
  s.contacts[0].b = Eigen::MatrixXd::Zero(3, 2);
  s.contacts[0].b.row(1) << 1.0, share;
  s.loads = {{force, Eigen::Vector2d(1.0, 10.0 * share)}};
  return s;
}

double peak_force(const Scene& scene, const StepOptions& options) {
  double largest = 0.0;
  for (const auto& e : trace(scene, options))
    largest = std::max(largest, e.normal);
  return largest;
}

/// The same with the flexibility of the high mode in its place.
Scene without_it(Scene s, bool under_loads = true) {
  const double gain = s.contacts[0].b(1, 1) / s.system.stiffness(1),
               flexibility = gain * s.contacts[0].b(1, 1), under_load = gain * s.loads[0].modal_force(1);
  const double at_start = Signal(s.loads[0].function, s.duration)(0.0);
  for (Eigen::VectorXd* x : {&s.system.stiffness, &s.system.damping, &s.q0, &s.v0, &s.loads[0].modal_force})
    x->conservativeResize(1);
  s.contacts[0].b = s.contacts[0].b.leftCols(1).eval();
  s.residual = Eigen::Matrix3d(Vec3(0.0, flexibility, 0.0).asDiagonal());
  if (under_loads) {
    s.contacts[0].under_loads = Vec3(0.0, under_load, 0.0);
    s.contacts[0].loaded_at_start = at_start * s.contacts[0].under_loads;
  }
  return s;
}

} // namespace

TEST(FlexibleContacts, AreMovedByLoadsAsTheModesLeftOutWould) {
  constexpr double force = 400.0, h = 1e-5;
  const Table jump{{0.0, 0.008, 0.008, 0.02}, {0.0, force, 0.4 * force, force}};
  for (const TimeFunction& function :
       {TimeFunction{Constant{force}}, TimeFunction{Harmonic{force, 30.0, 0.3}}, TimeFunction{jump},
        TimeFunction{Random{force, 5.0, 60.0, 3}}}) {
    const Scene whole = with_a_high_mode(function, 0.06);
    const double reference = peak_force(whole, splitting(h));
    ASSERT_GT(reference, 0.0) << function.index();
    constexpr double without_inertia =
        3.9e-3; // nor damping of the mode left out, which rings by w_c/1e5 of its share
    EXPECT_NEAR(peak_force(without_it(whole), splitting(h)) / reference, 1.0, without_inertia)
        << function.index();
    EXPECT_GT(std::abs(peak_force(without_it(whole, false), splitting(h)) / reference - 1.0),
              3.0 * without_inertia)
        << function.index();
  }
}

TEST(FlexibleContacts, AreMovedByTheMeanOfATableThatIsFinerThanSteps) {
  // quarters of a step, up and down in turn: at every instant of an action the table is up, its mean over the step is not
  constexpr double force = 400.0, h = 4e-5, duration = 0.02;
  const auto with = [&](double zigzag) {
    Table table;
    for (int i = 0; 0.25 * h * i <= 1.01 * duration; ++i) {
      table.time.push_back(0.25 * h * i);
      const double by = i < 17 ? 0.0 : i == 17 ? -0.5 : i % 2 == 0 ? 1.0 : -1.0; // from the start no impulse
      table.value.push_back(force * table.time.back() / duration + by * zigzag);
    }
    return trace(without_it(with_a_high_mode(table, duration)), splitting(h));
  };
  const auto smooth = with(0.0), fine = with(force);
  double difference = 0.0, closed = 0.0;
  for (std::size_t i = 1; i < smooth.size(); ++i) {
    difference = std::max(difference, std::abs(fine[i].normal - smooth[i].normal));
    closed = std::max(closed, smooth[i].normal);
  }
  constexpr double round_off = 1e-9; // of times, in the means
  EXPECT_GT(closed, 0.5 * force);
  EXPECT_LT(difference, round_off * closed);
}

TEST(FlexibleContacts, RestInEquilibriumWithWhatLoadsMove) {
  constexpr double force = 400.0, h = 1e-5;
  const Scene whole = with_a_high_mode(Constant{force}, 0.002);
  Scene s = without_it(whole), placed = s;
  placed.contacts[0].rest = s.place_at_start(s.contacts[0]);
  const Equilibrium e = static_equilibrium(placed);
  EXPECT_NEAR(e.normal_force(0) / static_equilibrium(whole).normal_force(0), 1.0, 1e-9);
  s.q0 = e.q;
  for (const auto& step : trace(s, splitting(h)))
    ASSERT_NEAR(step.normal, e.normal_force(0), 1e-4 * e.normal_force(0)); // (w h)^2/8
}

TEST(FlexibleContacts, BalanceTheirEnergyUnderLoads) {
  constexpr double of_the_splitting = 2e-3;
  const Scene s = without_it(with_a_high_mode(Harmonic{400.0, 30.0, 0.3}, 0.3));
  EXPECT_LT(simulate(s, splitting(2e-5), 1e-3).report.residual_relative, of_the_splitting);
}

} // namespace flexible_loads_test
