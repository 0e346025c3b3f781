// SPDX-License-Identifier: GPL-3.0-or-later
// Orders of convergence on a smooth path: a node that stays pressed on a round obstacle, with the modes
// coupled by the contact, the obstacle at rest or moving. The oracle integrates the law's own differential equations by Runge and Kutta's
// method.
#include "contact/friction_law.hpp"
#include "scenes.hpp"
#include "signals/prescribed_motion.hpp"
#include <gtest/gtest.h>
#include <numbers>

namespace orders_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::Vec2;

namespace {

constexpr double duration = 0.3;
constexpr int outputs =
    37; // no multiple of a step lies on an output but the last: the continuous extension is measured too
constexpr int oracle_steps = 400 * outputs; // errors of 1e-10: step^4
constexpr double steps_first = 64.0;
constexpr int halvings = 5;

struct Solution {
  Eigen::MatrixXd q, v, force; ///< columns: outputs; force: normal, along x_loc, along t
};

/// State of the oracle: modes, their velocities, the friction spring's force.
struct Oracle {
  const Scene& scene;
  Signal harmonic;
  std::vector<MotionSignal> motions;
  int slips = 0, sticks = 0, opens = 0;

  explicit Oracle(const Scene& s) : scene(s), harmonic(s.loads[1].function, s.duration) {
    for (const PrescribedMotion& motion : s.motions)
      motions.emplace_back(motion, s.duration);
  }

  Eigen::VectorXd rate(double time, const Eigen::VectorXd& y, Vec3* force = nullptr) {
    const Eigen::Index n = scene.system.size();
    const auto q = y.head(n), v = y.segment(n, n);
    const ContactPoint& point = scene.contacts[0];
    Vec3 u = point.rest + point.b * q, w = point.b * v;
    for (std::size_t k = 0; k < motions.size(); ++k) {
      const MotionState s = motions[k](time);
      u += s.displacement * point.imposed.col(static_cast<Eigen::Index>(k));
      w += s.velocity * point.imposed.col(static_cast<Eigen::Index>(k));
    }
    const auto at = contact::locate(point.support.obstacle, u.y(), u.z());
    opens += at.gap >= 0.0;
    const double normal =
        contact::normal_force(point.support.normal, -at.gap, -(at.ny * w.y() + at.nz * w.z()));
    const Vec2 spring{y(2 * n), y(2 * n + 1)}, slip{w.x(), at.nz * w.y() - at.ny * w.z()};
    const auto& law = point.support.friction;
    const auto friction =
        law.active() ? contact::evaluate(law, {spring, false}, normal, {}, slip) : contact::Friction{};
    ++(friction.slides ? slips : sticks);
    const Vec2 f = friction.force;
    const Vec2 spring_rate =
        friction.slides ? (-law.stiffness / law.damping) * (spring - f) : -law.stiffness * slip;
    Eigen::VectorXd out(y.size());
    out.head(n) = v;
    out.segment(n, n) =
        scene.loads[0].modal_force + harmonic(time) * scene.loads[1].modal_force +
        point.b.transpose() * Vec3(f.x, normal * at.ny + f.t * at.nz, normal * at.nz - f.t * at.ny) -
        Eigen::VectorXd(scene.system.stiffness.cwiseProduct(q) + scene.system.damping.cwiseProduct(v));
    out.tail(2) << spring_rate.x, spring_rate.t;
    if (force)
      *force = {normal, f.x, f.t};
    return out;
  }

  Solution solve() {
    const Eigen::Index n = scene.system.size();
    Eigen::VectorXd y(2 * n + 2);
    y << scene.q0, scene.v0, 0.0, 0.0;
    Solution out{Eigen::MatrixXd(n, outputs), Eigen::MatrixXd(n, outputs), Eigen::MatrixXd(3, outputs)};
    const double h = duration / oracle_steps;
    for (int i = 0; i < oracle_steps; ++i) {
      const double t = i * h;
      const Eigen::VectorXd a = rate(t, y), b = rate(t + 0.5 * h, y + 0.5 * h * a),
                            c = rate(t + 0.5 * h, y + 0.5 * h * b), d = rate(t + h, y + h * c);
      y += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
      if ((i + 1) % (oracle_steps / outputs) == 0) {
        const Eigen::Index j = (i + 1) / (oracle_steps / outputs) - 1;
        Vec3 force;
        (void)rate(t + h, y, &force);
        out.q.col(j) = y.head(n);
        out.v.col(j) = y.segment(n, n);
        out.force.col(j) = force;
      }
    }
    return out;
  }
};

Scene on_a_circle(double normal_damping, double modal_damping, const contact::FrictionLaw& friction,
                  const Vec3& velocity, double dissipation = 0.0) {
  return pressed_on_a_circle({1000.0, normal_damping, dissipation}, modal_damping, friction, velocity);
}

/// The obstacle moves too: two motions that leave the contact in its regime.
Scene on_a_moving_circle(const contact::FrictionLaw& friction, const Vec3& velocity) {
  Scene scene = on_a_circle(3.0, 1.0, friction, velocity);
  scene.motions = {{Harmonic{2.0, 2.0, 0.4}, -0.05, 1e-3}, {Harmonic{1.5, 3.0, 1.1}, 0.02, 0.0}};
  scene.contacts[0].imposed.resize(3, 2);
  scene.contacts[0].imposed << 0.3, -0.8, //
      0.9, 0.2,                           //
      -0.3, 0.5;
  return scene;
}

/// Errors of displacement, velocity and force, relative to their largest values.
using Errors = std::array<double, 3>;

Errors errors(const Scene& scene, const StepOptions& options, const Solution& exact) {
  const History run = simulate(scene, options, duration / outputs);
  Eigen::MatrixXd force(3, outputs);
  force << run.normal.rightCols(outputs), run.along_x.rightCols(outputs), run.along_t.rightCols(outputs);
  const auto relative = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
  };
  return {relative(run.q.rightCols(outputs), exact.q), relative(run.v.rightCols(outputs), exact.v),
          relative(force, exact.force)};
}

constexpr const char* names[] = {"displacement", "velocity", "force"};

/// Bounds of the orders of displacement, velocity and force.
struct OrderBounds {
  std::array<double, 3> lower, upper;
};

void expect_orders(const Scene& scene, SchemeKind scheme, const OrderBounds& bounds, double final_error) {
  const Solution exact = Oracle(scene).solve();
  Errors first{}, last{};
  for (int k = 0; k <= halvings; ++k) {
    last = errors(scene, {scheme, duration / (steps_first * (1 << k))}, exact);
    if (k == 0)
      first = last;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double order = std::log2(first[i] / last[i]) / halvings;
    EXPECT_GT(order, bounds.lower[i]) << names[i];
    EXPECT_LT(order, bounds.upper[i]) << names[i];
    EXPECT_LT(last[i], final_error) << names[i];
  }
}
void expect_order(const Scene& scene, SchemeKind scheme, double lower, double upper, double final_error) {
  expect_orders(scene, scheme, {{lower, lower, lower}, {upper, upper, upper}}, final_error);
}

const contact::FrictionLaw none{};
const contact::FrictionLaw sticking{800.0, 5.0, 20.0, 20.0};
const contact::FrictionLaw slipping{800.0, 20.0, 0.1, 0.1};
constexpr auto reference = contact::FrictionMemoryKind::reference;
const contact::FrictionLaw reference_sticking{800.0, 5.0, 20.0, 20.0, reference};
const contact::FrictionLaw reference_slipping{800.0, 20.0, 0.1, 0.1, reference};
constexpr double dissipation = 0.3; ///< s/m: the spring's force changes by up to 15 % at 0.5 m/s
const Vec3 slow(0.05, 0.1, 0.05), fast(1.5, 2.0, 0.0);

// bounds of the measured order: the mean over five halvings, the coarsest step being w_c h = 0.2
constexpr double second_low = 1.85, second_high = 2.2, second_final = 5e-5;
constexpr double splitting_final = 5e-7;
// of displacement and velocity of splitting little is left of order two without friction, less without dampers: last errors 4e-9, 2e-10
constexpr OrderBounds undamped{{2.8, 2.8, second_low}, {3.2, 3.2, second_high}},
    damped{{2.0, 2.0, second_low}, {2.35, 2.35, second_high}};
constexpr double first_low = 0.9, first_high = 1.2, first_final = 1e-2;

// of order four and five: few steps, so that the error stays far above the oracle's 1e-10
constexpr double fourth_low = 3.7, fourth_high = 4.5, fifth_low = 4.6, fifth_high = 6.5;

/// Mean order over some halvings, forces taken where records stand on the outputs: between them they are linear.
void expect_order_four(const Scene& scene, SchemeKind scheme = SchemeKind::devogelaere,
                       int steps = 2 * outputs, int halved = 3) {
  const Solution exact = Oracle(scene).solve();
  const Errors first = errors(scene, {scheme, duration / steps}, exact),
               last = errors(scene, {scheme, duration / (steps << halved)}, exact);
  for (std::size_t i = 0; i < 3; ++i) {
    const double order = std::log2(first[i] / last[i]) / halved;
    EXPECT_GT(order, fourth_low) << names[i];
    EXPECT_LT(order, fourth_high) << names[i];
  }
  // and between the records
  const double coarse = errors(scene, {scheme, duration / 64}, exact)[1],
               fine = errors(scene, {scheme, duration / 512}, exact)[1];
  EXPECT_GT(std::log2(coarse / fine) / 3, fourth_low);
}

void expect_order_five(const Scene& scene) {
  const Solution exact = Oracle(scene).solve();
  const auto with = [&](double longest) {
    StepOptions options{SchemeKind::runge_kutta_54, longest};
    options.tolerance = 1e3; // never rules: every step is the longest
    return errors(scene, options, exact);
  };
  const Errors first = with(duration / 20), last = with(duration / 80);
  for (std::size_t i = 0; i < 2; ++i) {
    const double order = std::log2(first[i] / last[i]) / 2;
    EXPECT_GT(order, fifth_low) << names[i];
    EXPECT_LT(order, fifth_high) << names[i];
  }
}

} // namespace

TEST(OrderFixture, StaysClosedInOneRegime) {
  for (const auto& [law, velocity, slides] :
       {std::tuple(sticking, slow, false), std::tuple(slipping, fast, true)})
    for (const Scene& scene : {on_a_circle(3.0, 1.0, law, velocity), on_a_moving_circle(law, velocity)}) {
      Oracle oracle(scene);
      (void)oracle.solve();
      EXPECT_EQ(oracle.opens, 0);
      EXPECT_EQ(slides ? oracle.sticks : oracle.slips, 0);
    }
}

TEST(OrderFixture, IsMovedByItsObstacle) {
  const Solution moved = Oracle(on_a_moving_circle(sticking, slow)).solve(),
                 still = Oracle(on_a_circle(3.0, 1.0, sticking, slow)).solve();
  constexpr double seen = 0.02; // of the forces: far above the errors that are measured
  for (Eigen::Index row = 0; row < 3; ++row)
    EXPECT_GT((moved.force - still.force).row(row).norm(), seen * still.force.row(row).norm()) << row;
}

TEST(MovingObstacle, IsFollowedInTheOrderOfEachScheme) {
  for (const auto& [law, velocity] : {std::pair(sticking, slow), std::pair(slipping, fast)}) {
    const Scene scene = on_a_moving_circle(law, velocity);
    expect_order(scene, SchemeKind::euler, first_low, first_high, first_final);
    expect_order(scene, SchemeKind::splitting, second_low, second_high, second_final);
    expect_order(scene, SchemeKind::energy_conserving, second_low, second_high, second_final);
    expect_order_four(scene, SchemeKind::collocation, outputs, 4);
    expect_order_four(scene, SchemeKind::devogelaere);
    expect_order_five(scene);
  }
}

TEST(Splitting, IsOfOrderTwoWithoutDampingAndFriction) {
  expect_orders(on_a_circle(0.0, 0.0, none, slow), SchemeKind::splitting, undamped, splitting_final);
}

TEST(Splitting, IsOfOrderTwoWithNormalAndModalDamping) {
  expect_orders(on_a_circle(3.0, 1.0, none, slow), SchemeKind::splitting, damped, splitting_final);
}

TEST(Splitting, IsOfOrderTwoInStick) {
  expect_order(on_a_circle(3.0, 1.0, sticking, slow), SchemeKind::splitting, second_low, second_high,
               splitting_final);
}

TEST(Splitting, IsOfOrderTwoInSlip) {
  expect_order(on_a_circle(3.0, 1.0, slipping, fast), SchemeKind::splitting, second_low, second_high,
               splitting_final);
}

TEST(Splitting, IsOfOrderTwoWithHuntAndCrossleysDamper) {
  expect_order(on_a_circle(0.0, 1.0, none, slow, dissipation), SchemeKind::splitting, second_low, second_high,
               splitting_final);
  expect_order(on_a_circle(0.0, 1.0, slipping, fast, dissipation), SchemeKind::splitting, second_low,
               second_high, splitting_final);
}

TEST(Euler, IsOfOrderOneWithHuntAndCrossleysDamper) {
  expect_order(on_a_circle(0.0, 1.0, none, slow, dissipation), SchemeKind::euler, first_low, first_high,
               first_final);
}

TEST(Euler, IsOfOrderOne) {
  expect_order(on_a_circle(0.0, 0.0, none, slow), SchemeKind::euler, first_low, first_high, first_final);
  expect_order(on_a_circle(3.0, 1.0, sticking, slow), SchemeKind::euler, first_low, first_high, first_final);
  expect_order(on_a_circle(3.0, 1.0, slipping, fast), SchemeKind::euler, first_low, first_high, first_final);
}

TEST(Devogelaere, IsOfOrderFour) {
  expect_order_four(on_a_circle(0.0, 0.0, none, slow));
  expect_order_four(on_a_circle(3.0, 1.0, none, slow));
  expect_order_four(on_a_circle(3.0, 1.0, sticking, slow));
  expect_order_four(on_a_circle(3.0, 1.0, slipping, fast));
  expect_order_four(on_a_circle(0.0, 1.0, slipping, fast, dissipation));
}

TEST(RungeKutta54, IsOfOrderFive) {
  expect_order_five(on_a_circle(0.0, 0.0, none, slow));
  expect_order_five(on_a_circle(3.0, 1.0, sticking, slow));
  expect_order_five(on_a_circle(3.0, 1.0, slipping, fast));
}

TEST(EnergyConserving, IsOfOrderTwo) {
  for (const Scene& scene : {on_a_circle(0.0, 0.0, none, slow), on_a_circle(3.0, 1.0, none, slow),
                             on_a_circle(3.0, 1.0, sticking, slow), on_a_circle(3.0, 1.0, slipping, fast)})
    expect_order(scene, SchemeKind::energy_conserving, second_low, second_high, second_final);
}

TEST(EnergyConserving, IsOfOrderTwoWithHuntAndCrossleysDamper) {
  for (const Scene& scene :
       {on_a_circle(0.0, 1.0, none, slow, dissipation), on_a_circle(0.0, 1.0, slipping, fast, dissipation)})
    expect_order(scene, SchemeKind::energy_conserving, second_low, second_high, second_final);
}

void expect_order_four_of_collocation(const Scene& scene) {
  expect_order_four(scene, SchemeKind::collocation, outputs, 4);
}

TEST(Collocation, IsOfOrderFourWithoutDampingAndFriction) {
  expect_order_four_of_collocation(on_a_circle(0.0, 0.0, none, slow));
}

TEST(Collocation, IsOfOrderFourWithNormalAndModalDamping) {
  expect_order_four_of_collocation(on_a_circle(3.0, 1.0, none, slow));
}

TEST(Collocation, IsOfOrderFourInStick) {
  expect_order_four_of_collocation(on_a_circle(3.0, 1.0, sticking, slow));
  expect_order_four_of_collocation(on_a_circle(3.0, 1.0, reference_sticking, slow));
}

TEST(Collocation, IsOfOrderFourInSlip) {
  expect_order_four_of_collocation(on_a_circle(3.0, 1.0, slipping, fast));
  expect_order_four_of_collocation(on_a_circle(3.0, 1.0, reference_slipping, fast));
}

TEST(Collocation, IsOfOrderFourWithHuntAndCrossleysDamper) {
  expect_order_four_of_collocation(on_a_circle(0.0, 1.0, none, slow, dissipation));
  expect_order_four_of_collocation(on_a_circle(0.0, 1.0, slipping, fast, dissipation));
}

TEST(Collocation, BalancesItsEnergyToOrderFour) {
  for (const auto& [law, velocity] :
       {std::pair(none, slow), std::pair(sticking, slow), std::pair(slipping, fast)})
    for (const Scene& scene : {on_a_circle(3.0, 1.0, law, velocity), on_a_moving_circle(law, velocity)}) {
      const auto residual = [&](double steps) {
        return simulate(scene, {SchemeKind::collocation, duration / steps}, duration)
            .report.residual_relative;
      };
      const double order = std::log2(residual(steps_first) / residual(8.0 * steps_first)) / 3.0;
      EXPECT_GT(order, fourth_low);
      EXPECT_LT(order, fourth_high);
    }
}

TEST(EnergyConserving, BalancesWhatAMovingObstacleBringsAtAnyStep) {
  constexpr double round_off = 1e-12; // of the energies that pass
  for (const auto& [law, velocity] :
       {std::pair(none, slow), std::pair(sticking, slow), std::pair(slipping, fast)})
    for (const double steps : {8.0, 64.0, 512.0}) {
      const Report report = simulate(on_a_moving_circle(law, velocity),
                                     {SchemeKind::energy_conserving, duration / steps}, duration)
                                .report;
      EXPECT_LT(report.residual_relative, round_off) << steps;
    }
}

} // namespace orders_test
