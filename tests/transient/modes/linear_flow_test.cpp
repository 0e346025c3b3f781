// SPDX-License-Identifier: GPL-3.0-or-later
// Runs in the coordinates of blocks that forces of motion couple: what they show of the modes, of the energies, and of loads and contacts.
#include "post/node_statistics.hpp"
#include "post/power_balance.hpp"
#include "scenes.hpp"
#include "signals/sampled_forces.hpp"
#include "transient/contacts/contact_motion.hpp"
#include "transient/modes/linear_flow.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace linear_flow_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

constexpr double h = 1e-4; // s
constexpr Eigen::Index modes = 11;

/// Of modes 0 to 4, of 6 and 9 with lags of complex rates, and of 8 alone, which is one of another stiffness and damping.
core::MotionForces law() {
  constexpr Eigen::Index states = 7;
  core::MotionForces f;
  f.stiffness = f.damping = Eigen::MatrixXd::Zero(modes, modes);
  f.input = Eigen::MatrixXd::Zero(modes, states);
  f.output = Eigen::MatrixXd::Zero(states, modes);
  f.rates = Eigen::MatrixXd::Zero(states, states);
  f.stiffness.topLeftCorner(5, 5) << -900, 300, 50, 0, 0, -300, -900, 0, 20, 0, 50, 10, -400, 0, 100, 0, -60,
      0, -500, 0, 0, 0, 90, 0, -100;
  f.damping.topLeftCorner(5, 5).setConstant(0.4);
  f.damping(0, 0) = 9.0;
  for (Eigen::Index k = 0; k < 5; ++k) {
    f.input(k, k) = 700.0;
    f.input((k + 1) % 5, k) = -80.0;
    f.output(k, k) = 1.0;
    f.rates(k, k) = -40.0 - 9.0 * static_cast<double>(k);
  }
  f.stiffness(6, 9) = 200.0;
  f.input.block(6, 5, 1, 2) << 500.0, -100.0;
  f.input(9, 5) = 60.0;
  f.output(5, 6) = f.output(6, 9) = 1.0;
  f.rates.bottomRightCorner(2, 2) << -30.0, 25.0, -25.0, -30.0;
  f.stiffness(8, 8) = -1500.0;
  f.damping(8, 8) = -2.0;
  return f;
}

/// Forces of motion that couple the modes of the same blocks and are nothing beside the others.
core::MotionForces law_of_nothing() {
  core::MotionForces f = law();
  for (Eigen::MatrixXd* x : {&f.stiffness, &f.damping, &f.input})
    *x *= 1e-30;
  return f;
}

Scene rattling_tube(double duration) {
  Scene scene = rattling(5, modes, duration);
  scene.v0.setConstant(0.02);
  return scene;
}

TEST(LinearFlow, IsThatOfTheAdaptiveSchemeThroughContacts) {
  Scene scene = rattling_tube(0.02);
  scene.system.motion = law();
  ASSERT_TRUE(LinearFlow(scene, h, {1}).has_blocks());
  StepOptions adaptive;
  adaptive.scheme = SchemeKind::runge_kutta_54;
  adaptive.tolerance = 1e-9;
  const History ours = simulate(scene, splitting(5e-6), 1e-3), reference = simulate(scene, adaptive, 1e-3);
  const Energy &a = ours.report.energy, &b = reference.report.energy;
  EXPECT_GT(reference.statistics[0].impacts + reference.statistics[1].impacts, 0);
  constexpr double of_step = 2e-3; // of steps with w_c h = 0.02, through impacts
  EXPECT_LT((ours.q - reference.q).norm(), of_step * reference.q.norm());
  EXPECT_GT(std::abs(b.fluid_work), 1e-3 * b.stored);
  EXPECT_NEAR(a.fluid_work, b.fluid_work, 10.0 * of_step * std::abs(b.fluid_work));
  EXPECT_NEAR(a.modal_damping, b.modal_damping, 10.0 * of_step * b.modal_damping);
}

/// With modes of a block and outside of it at each contact, macro-steps, sampled and other loads, nodes that are watched.
TEST(LinearFlow, LeavesARunWithoutForcesOfMotionAsItIs) {
  Scene scene = rattling_tube(0.05);
  for (auto& c : scene.contacts)
    c.support.normal.damping = 0.0; // macro-steps
  scene.loads.push_back({Constant{1.0}, Eigen::VectorXd::Constant(modes, 0.3)});
  scene.sampled_loads = {sampled_sines(std::vector<double>(modes, 2.0), 7e-4)};
  Scene coupled = scene;
  coupled.system.motion = law_of_nothing();
  ASSERT_TRUE(LinearFlow(coupled, h, {1}).has_blocks());
  StepChoice choice = choose_step(scene, splitting(2e-5));
  choice.macro_steps = 8;
  choice.replay = 1e-3;
  Eigen::MatrixXd node(3, modes);
  for (Eigen::Index i = 0; i < modes; ++i)
    node.col(i) << 1.0, std::cos(static_cast<double>(i)), std::sin(2.0 * static_cast<double>(i));
  const auto observed = [&](const Scene& of, Report& report) {
    post::NodeStatistics nodes({node}, 0.01);
    post::ContactStatistics contacts(of.contacts, 0.01);
    Observer* const observers[] = {&nodes, &contacts};
    report = run(of, choice, observers, nullptr, {});
    Eigen::VectorXd out(5);
    const auto moments = nodes.summaries()[0].displacement;
    out << moments[0].std, moments[1].std, moments[2].mean, contacts.summaries()[0].normal_rms,
        contacts.summaries()[1].normal_rms;
    return out;
  };
  Report a, b;
  const Eigen::VectorXd plain = observed(scene, a);
  const Eigen::VectorXd in_blocks = observed(coupled, b);
  EXPECT_LT(a.counts.evaluations, a.counts.steps);
  EXPECT_EQ(a.counts.evaluations, b.counts.evaluations);
  constexpr double same = 1e-6; // round-off that impacts have amplified
  for (Eigen::Index i = 0; i < plain.size(); ++i)
    EXPECT_NEAR(in_blocks(i) / plain(i), 1.0, same) << i;
  EXPECT_GT(plain(3), 0.0);
  EXPECT_NEAR(b.energy.load_work, a.energy.load_work, same * a.energy.scale);
  EXPECT_NEAR(b.energy.stored, a.energy.stored, same * a.energy.scale);
  EXPECT_NEAR(b.energy.modal_damping, a.energy.modal_damping, same * a.energy.scale);
  EXPECT_NEAR(b.energy.friction, a.energy.friction, same * a.energy.scale);
  EXPECT_NEAR(b.energy.fluid_work, 0.0, same * a.energy.scale);
}

/// Without contacts the energies alone tell that a motion overflows.
TEST(LinearFlow, EndsARunThatOverflows) {
  Scene scene = rattling_tube(40.0);
  scene.contacts.clear();
  scene.system.motion = law();
  scene.system.motion.damping.topLeftCorner(5, 5) += 100.0 * Eigen::MatrixXd::Identity(5, 5);
  ASSERT_TRUE(LinearFlow(scene, h, {1}).has_blocks());
  StepOptions options = splitting(2e-3);
  const Report report = run(scene, choose_step(scene, options), {}, nullptr, {});
  EXPECT_EQ(report.outcome, Outcome::diverged);
}

/// Asks for all of every record.
struct Curious final : Observer {
  void step(const Record& record) override {
    EXPECT_NE(record.q, nullptr);
    const Energy& e = record.energy;
    worst = std::max(worst, std::abs(e.residual()));
    least_damping = std::min(least_damping, e.modal_damping - last_damping);
    last_damping = e.modal_damping;
    EXPECT_GE(e.stored, 0.0);
  }
  void visit(core::StateArchive&) override {}
  double worst = 0.0, last_damping = 0.0, least_damping = 0.0;
};

/// Energies are found where they are asked for, and are the same whoever asks.
TEST(LinearFlow, EnergiesAreThoseOfTheRecordThatIsAskedFor) {
  Scene scene = rattling_tube(0.3);
  scene.system.motion = law();
  const StepChoice choice = choose_step(scene, splitting(h));
  const auto powers = [&](Observer* other, Report& report) {
    post::PowerStatistics power(0.1);
    std::vector<Observer*> observers{&power};
    if (other)
      observers.push_back(other);
    report = run(scene, choice, observers, nullptr, {});
    return power.balance();
  };
  Curious curious;
  Report alone_report, watched_report;
  const post::PowerBalance alone = powers(nullptr, alone_report), watched = powers(&curious, watched_report);
  EXPECT_NE(alone.fluid.mean, 0.0);
  EXPECT_EQ(alone.fluid.mean, watched.fluid.mean);
  EXPECT_EQ(alone.fluid.error, watched.fluid.error);
  EXPECT_EQ(alone.modal_damping.mean, watched.modal_damping.mean);
  EXPECT_EQ(alone.stored.mean, watched.stored.mean);
  EXPECT_EQ(alone_report.energy.fluid_work, watched_report.energy.fluid_work);
  EXPECT_EQ(alone_report.energy.stored, watched_report.energy.stored);
  EXPECT_GE(curious.least_damping,
            -1e-12 * curious.last_damping); // structural damping takes energy in every step
  EXPECT_LT(curious.worst, 1e-2 * watched_report.energy.scale);
}

/// The fluid gives a mode what its damping takes: no end of y^T P y. The block moves by its matrix exponential.
TEST(LinearFlow, AMotionThatIsKeptUpHasItsWorksToo) {
  constexpr double k = 1e4, c = 4.0, speed = 0.1;
  Scene scene = mass_point(1.0, Vec3(k, k, k), 0.5);
  scene.system.damping.setConstant(c);
  start(scene, 1.0, Vec3::Zero(), Vec3(0.0, speed, 0.0));
  core::MotionForces& f = scene.system.motion;
  f.stiffness = f.damping = Eigen::Matrix3d::Zero();
  f.damping(1, 1) = c;
  f.input = Eigen::MatrixXd::Zero(3, 1);
  f.output = Eigen::MatrixXd::Zero(1, 3);
  f.output(0, 1) = 1.0;
  f.rates = Eigen::MatrixXd::Constant(1, 1, -20.0);
  EXPECT_FALSE(LinearFlow(scene, 1e-3, {1}).has_blocks());
  const Report report = simulate(scene, splitting(1e-3), 0.1).report;
  const double t = 0.5, w = std::sqrt(k),
               work = 0.5 * c * speed * speed * (t + std::sin(2.0 * w * t) / (2.0 * w)); // int c v^2 dt
  constexpr double to_order_4 = 1e-6;                                                    // (w h)^4/720
  EXPECT_NEAR(report.energy.fluid_work, work, to_order_4 * work);
  EXPECT_NEAR(report.energy.modal_damping, work, to_order_4 * work);
}

} // namespace

// By how much the mean over a step exceeds that of the cubic through both its ends: of modes alone, and of those that forces of motion couple.
TEST(LinearFlow, KnowsTheMeanOfTheMotion) {
  constexpr int parts = 2000;
  Scene scene = rattling_tube(1.0);
  scene.loads = {{Harmonic{1.0, 40.0, 0.4}, 30.0 * Eigen::VectorXd::LinSpaced(modes, 1.0, -2.0)}};
  for (const bool coupled : {false, true}) {
    scene.system.motion = coupled ? law() : core::MotionForces{};
    const double step = 1.5 / std::sqrt(scene.system.stiffness.maxCoeff());
    LinearFlow flow(scene, step, {1});
    ASSERT_TRUE(flow.has_bow());
    const Eigen::VectorXd q0 = 1e-3 * Eigen::VectorXd::LinSpaced(modes, 1.0, -0.5),
                          v0 = Eigen::VectorXd::LinSpaced(modes, -0.2, 0.7);
    const LinearFlow::State from = flow.start(q0, v0);
    kernels::Array load0(static_cast<std::size_t>(flow.force_numbers()), 0.0), load1(load0), bend(load0);
    flow.load_in_step(0.0, step, true, load0, load1, bend);
    const vibration::ModalForce force{load1, kernels::Array(load1.size(), 0.0)}; // as good as any
    kernels::Array bow(static_cast<std::size_t>(flow.coordinates()), 0.0);
    flow.bow(from, load0, load1, force.mean, bow);
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(modes), q(modes), v(modes), q1(modes), v1(modes);
    for (int k = 0; k < parts; ++k) {
      flow.inside((k + 0.5) / parts * step, step, from, load0, load1, &force, q.data(), v.data());
      mean += q / parts;
    }
    flow.inside(step, step, from, load0, load1, &force, q1.data(), v1.data());
    const Eigen::VectorXd exact = mean - 0.5 * (q0 + q1) - step / 12.0 * (v0 - v1);
    std::vector<ContactPoint> rows;
    for (Eigen::Index i = 0; i < modes; ++i) {
      ContactPoint point = scene.contacts[0];
      point.modes.clear();
      point.b = Eigen::MatrixXd::Zero(3, modes);
      point.b(1, i) = 1.0;
      rows.push_back(point);
    }
    const PackedContacts contacts(flow.outputs(rows), flow.coordinates(), coupled);
    ContactMotion motion(contacts);
    motion.gather(bow.data(), bow.data());
    for (Eigen::Index i = 0; i < modes; ++i)
      EXPECT_NEAR(motion.u[static_cast<std::size_t>(i)], exact(i), 1e-4 * exact.cwiseAbs().maxCoeff())
          << coupled << i;
  }
}

// Loads that are no lines within a step leave the modes where they do in short steps, those alone and those that forces of motion couple: a table with a corner and a jump inside,
// of which the third and higher moments are left out, and a harmonic of ten steps a period.
TEST(LinearFlow, MovesModesUnderLoadsThatBendWithinTheStep) {
  constexpr int parts = 400;
  for (const bool coupled : {false, true}) {
    Scene scene = rattling_tube(1.0);
    scene.system.motion = coupled ? law() : core::MotionForces{};
    scene.sampled_loads.clear();
    const double step = 2.0 / std::sqrt(scene.system.stiffness.maxCoeff());
    const Eigen::VectorXd shape = 30.0 * Eigen::VectorXd::LinSpaced(modes, 1.0, -2.0);
    const Table parabola = [&] { // that has no other moments
      Table out;
      for (int i = 0; i <= 50; ++i) { // no record
        const double x = i / 25.0 - 1.0;
        out.time.push_back(0.5 * (1.0 + x) * step);
        out.value.push_back(0.3 - 0.5 * x + 2.0 * x * x);
      }
      return out;
    }();
    const Table corner{{0.0, 0.3 * step, 0.6 * step, 0.6 * step, step}, {0.2, 1.0, -0.4, 0.5, 0.1}};
    struct Case {
      TimeFunction load;
      double most; ///< of what the load does
    };
    for (const auto& [load, most] :
         {Case{corner, 2e-2}, {Harmonic{1.0, 0.1 / step, 0.9}, 3e-4}, {parabola, 3e-4}}) {
      scene.loads = {{load, shape}};
      const auto moved = [&](int count, bool loaded) {
        Scene of = scene;
        if (!loaded)
          of.loads.clear();
        LinearFlow flow(of, step / count, {1});
        LinearFlow::State now = flow.start(1e-3 * shape, -0.2 * shape), next = now;
        kernels::Array load0(static_cast<std::size_t>(flow.force_numbers()), 0.0), load1(load0), bend(load0);
        for (int k = 0; k < count; ++k) {
          flow.load_in_step(k * step / count, (k + 1) * step / count, true, load0, load1, bend);
          (void)flow.move(1, now, load0, load1, next);
          std::swap(now, next);
        }
        return now;
      };
      const LinearFlow::State found = moved(1, true), exact = moved(parts, true), free = moved(1, false);
      double by_load = 0.0, rate_by_load = 0.0;
      for (std::size_t i = 0; i < found.q.size(); ++i) {
        by_load = std::max(by_load, std::abs(exact.q[i] - free.q[i]));
        rate_by_load = std::max(rate_by_load, std::abs(exact.v[i] - free.v[i]));
      }
      SCOPED_TRACE(testing::Message() << coupled << " " << most);
      for (std::size_t i = 0; i < found.q.size(); ++i) {
        EXPECT_NEAR(found.q[i], exact.q[i], most * by_load) << i;
        EXPECT_NEAR(found.v[i], exact.v[i], most * rate_by_load) << i;
      }
    }
  }
}

// A force that bends within a step leaves the modes where the linear one does that stands for it, with the same work: modes alone, and those that forces of motion
// couple. Against short steps.
TEST(LinearFlow, TakesForcesThatBendWithinTheStep) {
  constexpr int parts = 400;
  Scene scene = rattling_tube(1.0);
  scene.loads = {{Constant{1.0}, 30.0 * Eigen::VectorXd::LinSpaced(modes, 1.0, -2.0)}};
  for (const bool coupled : {false, true}) {
    scene.system.motion = coupled ? law() : core::MotionForces{};
    const double step = 2.0 / std::sqrt(scene.system.stiffness.maxCoeff());
    LinearFlow flow(scene, step, {1}), fine(scene, step / parts, {1});
    const LinearFlow::State from = flow.start(1e-3 * Eigen::VectorXd::LinSpaced(modes, 1.0, -0.5),
                                              Eigen::VectorXd::LinSpaced(modes, -0.2, 0.7));
    kernels::Array pattern(static_cast<std::size_t>(flow.force_numbers()), 0.0);
    const kernels::Array none(pattern);
    kernels::Array same(pattern), bend(pattern);
    flow.load_in_step(0.0, step, true, pattern, same, bend);
    const auto times = [&](double factor) {
      kernels::Array out(pattern);
      for (double& x : out)
        x *= factor;
      return out;
    };
    for (const std::array<double, 2>& bends : {std::array{1.0, 0.0}, {0.0, 1.0}, {1.0, -2.0}}) {
      const auto at = [&](double x) { // of the force, x from -1 to 1
        return 0.2 + bends[0] * 0.5 * (3.0 * x * x - 1.0) + bends[1] * 0.5 * (5.0 * x * x * x - 3.0 * x);
      };
      vibration::ModalForce force{times(0.2), none};
      flow.add_bends({times(bends[0]), times(bends[1])}, force);
      LinearFlow::State to = from, now = from, next = from;
      LinearFlow::BlockWorks works, fine_works;
      const auto moved = [&](LinearFlow& by, const LinearFlow::State& start,
                             const vibration::ModalForce& under, LinearFlow::State& end,
                             LinearFlow::BlockWorks& of) {
        auto sums = by.push(start, none, none, under.mean, under.slope, end);
        by.add_works(1, start, none, none, &under, sums, of);
        return sums.contact_work;
      };
      const double work = moved(flow, from, force, to, works);
      double exact = 0.0;
      for (int k = 0; k < parts; ++k) {
        const double first = at(2.0 * k / parts - 1.0), half = at((2.0 * k + 1.0) / parts - 1.0),
                     last = at(2.0 * (k + 1) / parts - 1.0);
        exact += moved(fine, now, {times((first + 4.0 * half + last) / 6.0), times(0.5 * (last - first))},
                       next, fine_works);
        std::swap(now, next);
      }
      const auto size = [](const kernels::Array& of) {
        double out = 0.0;
        for (const double x : of)
          out = std::max(out, std::abs(x));
        return out;
      };
      SCOPED_TRACE(testing::Message() << coupled << bends[0] << bends[1]);
      for (std::size_t i = 0; i < to.q.size(); ++i) {
        EXPECT_NEAR(to.q[i], now.q[i], 1e-8 * size(now.q));
        EXPECT_NEAR(to.v[i], now.v[i], 1e-8 * size(now.v));
      }
      EXPECT_NEAR(works.fluid, fine_works.fluid, 1e-2 * std::abs(fine_works.fluid));
      EXPECT_NEAR(work, exact, 1e-2 * std::abs(exact)); // modal damping takes another part of it
    }
  }
}

} // namespace linear_flow_test
