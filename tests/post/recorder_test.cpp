// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/recorder.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace recorder_test {

using namespace fretwork;
using namespace fretwork::signals;
using namespace fretwork::transient;
using post::Recorder;
using post::TimeSeries;

namespace {

/// A node on three springs with dampers that is pressed on a hole's wall by a load and slides along it; a
/// second contact far away.
Scene pressed_node() {
  Scene scene;
  scene.system.stiffness = Eigen::Vector3d(40.0, 90.0, 10.0);
  scene.system.damping = Eigen::Vector3d(0.5, 1.0, 0.2);
  ContactPoint wall{"wall",
                    {contact::Circle{1.0}, {1e4, 5.0}, {2e3, 20.0, 0.2, 0.2}},
                    {0.0, 0.0, 1.002},
                    Eigen::Matrix3d::Identity()};
  ContactPoint far{"far", {contact::Circle{100.0}, {1e4}, {}}, {0.0, 3.0, 0.0}, Eigen::Matrix3d::Identity()};
  scene.contacts = {wall, far};
  scene.loads = {{Constant{20.0}, Eigen::Vector3d(0, 0, 1)},
                 {Harmonic{30.0, 2.0}, Eigen::Vector3d(1, 0.5, 0)}};
  scene.q0 = Eigen::Vector3d::Zero();
  scene.v0 = Eigen::Vector3d(0.3, 0.2, 0.0);
  scene.duration = 0.5;
  return scene;
}

Eigen::MatrixXd node_rows() {
  Eigen::MatrixXd rows(3, 3);
  rows << 1, 2, 0, 0, 1, -1, 3, 0, 1;
  return rows;
}

TimeSeries record(const Scene& scene, const StepOptions& options, double every) {
  const StepChoice choice = choose_step(scene, options);
  const OutputGrid grid = output_grid(scene.duration, every);
  Recorder recorder(scene, {{"probe", node_rows()}}, grid);
  (void)run(scene, choice, {}, &recorder, grid);
  return std::move(recorder).series();
}

} // namespace

TEST(Recorder, GivesEverySeriesTheLengthOfTheGrid) {
  const Scene scene = pressed_node();
  const TimeSeries s = record(scene, {SchemeKind::splitting, 1e-4}, 1e-2);
  const Eigen::Index nt = 51;
  EXPECT_EQ(s.time.size(), nt);
  for (Eigen::Index j = 0; j < nt; ++j)
    EXPECT_DOUBLE_EQ(s.time(j), static_cast<double>(j) * 1e-2);
  EXPECT_EQ(s.modal_displacement.cols(), nt);
  EXPECT_EQ(s.modal_velocity.cols(), nt);
  ASSERT_EQ(s.contacts.size(), 2u);
  ASSERT_EQ(s.nodes.size(), 1u);
  EXPECT_EQ(s.contacts[0].name, "wall");
  EXPECT_EQ(s.nodes[0].name, "probe");
  for (const auto& c : s.contacts) {
    EXPECT_EQ(c.displacement.rows(), nt);
    EXPECT_EQ(c.velocity.rows(), nt);
    EXPECT_EQ(c.gap.size(), nt);
    EXPECT_EQ(c.normal_force.size(), nt);
    EXPECT_EQ(c.tangential_force.rows(), nt);
    EXPECT_EQ(c.normal.rows(), nt);
  }
  EXPECT_EQ(s.nodes[0].displacement.rows(), nt);
  EXPECT_EQ(s.nodes[0].velocity.rows(), nt);
  EXPECT_EQ(s.nodes[0].acceleration.rows(), nt);
}

TEST(Recorder, MakesMotionsAndGapsFromTheModes) {
  const Scene scene = pressed_node();
  const TimeSeries s = record(scene, {SchemeKind::splitting, 1e-4}, 1e-2);
  constexpr double round_off = 1e-14;
  EXPECT_LT((s.nodes[0].displacement.transpose() - node_rows() * s.modal_displacement).norm(), round_off);
  EXPECT_LT((s.nodes[0].velocity.transpose() - node_rows() * s.modal_velocity).norm(), round_off);
  EXPECT_LT((s.contacts[0].displacement.transpose() - s.modal_displacement).norm(), round_off);
  for (Eigen::Index j = 0; j < s.time.size(); ++j)
    EXPECT_NEAR(s.contacts[0].gap(j),
                1.0 - std::hypot(s.modal_displacement(1, j), 1.002 + s.modal_displacement(2, j)), round_off);
}

TEST(Recorder, GivesAnAccelerationThatIsTheRateOfTheVelocity) {
  const Scene scene = pressed_node();
  for (const auto scheme : {SchemeKind::splitting, SchemeKind::euler}) {
    constexpr double every = 1e-3;
    const TimeSeries s = record(scene, {scheme, 1e-5}, every);
    const auto& node = s.nodes[0];
    ASSERT_GT(s.contacts[0].normal_force.minCoeff(), 0.0); // pressed all the time: no kinks
    const double largest = node.acceleration.cwiseAbs().maxCoeff();
    constexpr double differences =
        1e-2; // central differences over 2 ms of motions of 10 ms; and where slip starts, a kink
    for (Eigen::Index j = 20; j + 1 < s.time.size(); ++j) {
      const Eigen::RowVector3d rate = (node.velocity.row(j + 1) - node.velocity.row(j - 1)) / (2.0 * every);
      EXPECT_LT((rate - node.acceleration.row(j)).norm(), differences * largest) << s.time(j);
    }
  }
}

TEST(Recorder, AgreesWithFiniteDifferencesAtAStepAsCoarseAsTheOutputs) {
  // outputs between the steps: the velocity carries no jumps of the actions
  const Scene scene = pressed_node();
  constexpr double every = 0.7e-3;
  const TimeSeries s = record(scene, {SchemeKind::splitting, 1e-3}, every);
  const auto& node = s.nodes[0];
  const double largest = node.acceleration.cwiseAbs().maxCoeff();
  constexpr double of_the_step = 0.1;
  for (Eigen::Index j = 20; j + 1 < s.time.size(); ++j) {
    const Eigen::RowVector3d rate = (node.velocity.row(j + 1) - node.velocity.row(j - 1)) / (2.0 * every);
    EXPECT_LT((rate - node.acceleration.row(j)).norm(), of_the_step * largest) << s.time(j);
  }
}

TEST(Recorder, ShowsNoForceWhereTheContactIsOpen) {
  Scene scene = pressed_node();
  scene.loads = {};
  scene.v0 = Eigen::Vector3d(0.0, 0.0, -1.0); // leaves the wall
  const TimeSeries s = record(scene, {SchemeKind::splitting, 1e-3}, 1e-4);
  int open = 0;
  for (Eigen::Index j = 0; j < s.time.size(); ++j)
    for (const auto& c : s.contacts)
      if (c.gap(j) > 0.0) {
        ++open;
        EXPECT_EQ(c.normal_force(j), 0.0);
        EXPECT_EQ(c.tangential_force.row(j).norm(), 0.0);
      }
  EXPECT_GT(open, 5000);
  EXPECT_GT(s.contacts[0].normal_force.maxCoeff(), 0.0);
}

TEST(Recorder, TellsWhetherAContactIsOpenSticksOrSlides) {
  Scene scene = pressed_node();
  scene.contacts.push_back(scene.contacts[0]);
  scene.contacts[2].support.friction = {}; // nothing holds it: it slides
  const OutputGrid grid = output_grid(scene.duration, 1e-2);
  Recorder recorder(scene, {}, grid);
  const Eigen::Vector3d shut(0, 0, 0), away(0, 0, -0.5), v(0, 0, 0);
  const ContactForce free{0.0, {}, {0.0, 0.0}, false}, held{2.0, {0.1, 0.0}, {0.0, -1.0}, false},
      moving{2.0, {0.4, 0.0}, {0.0, -1.0}, true};
  const auto serve = [&](int j, const Eigen::Vector3d& q, const ContactForce& f) {
    recorder.state(j, j * grid.every, q.data(), v.data());
    recorder.forces(j, j * grid.every, v.data(), std::vector<ContactForce>{f, free, f});
  };
  serve(0, shut, free); // shut, but held free of force by its damper
  serve(1, shut, held);
  serve(2, shut, moving);
  serve(3, away, moving); // the force of a step around the instant
  const TimeSeries s = std::move(recorder).series();
  using State = std::vector<std::uint8_t>;
  EXPECT_EQ(s.contacts[0].state, (State{post::open, post::sticks, post::slides, post::open}));
  EXPECT_EQ(s.contacts[1].state, (State{post::open, post::open, post::open, post::open}));
  EXPECT_EQ(s.contacts[2].state, (State{post::open, post::slides, post::slides, post::open}));
}

TEST(Recorder, GivesTheNormalOfTheForcesOrOfThePlace) {
  const Scene scene = pressed_node();
  const OutputGrid grid = output_grid(scene.duration, 1e-2);
  Recorder recorder(scene, {}, grid);
  const Eigen::Vector3d v(0, 0, 0), pressed(0, 0, 0),
      inside(0, 0.3, -0.602); // at (0, 1.002) and (0.3, 0.4) of the hole
  const ContactForce free{0.0, {}, {0.0, 0.0}, false}, held{2.0, {0.1, 0.0}, {0.6, -0.8}, false};
  const auto serve = [&](int j, const Eigen::Vector3d& q, const ContactForce& f) {
    recorder.state(j, j * grid.every, q.data(), v.data());
    recorder.forces(j, j * grid.every, v.data(), std::vector<ContactForce>{f, free});
  };
  serve(0, pressed, free);
  serve(1, pressed, held);
  serve(2, inside, held); // the force of a step around the instant
  const TimeSeries s = std::move(recorder).series();
  EXPECT_TRUE(s.contacts[0].normal.row(0).isApprox(Eigen::RowVector2d(0.0, -1.0), 1e-15));
  EXPECT_EQ(s.contacts[0].normal.row(1), Eigen::RowVector2d(0.6, -0.8));
  EXPECT_TRUE(s.contacts[0].normal.row(2).isApprox(Eigen::RowVector2d(-0.6, -0.8), 1e-15));
  EXPECT_EQ(s.contacts[1].normal.row(1), Eigen::RowVector2d(-1.0, 0.0)); // the second node is at (3, 0)
}

TEST(Recorder, SeesTheBlockOfARunComeToRest) {
  Scene scene = pressed_node();
  scene.loads.pop_back(); // at 0.3 m/s under 20 N and mu = 0.2 it stops after 75 ms
  scene.v0 = Eigen::Vector3d(0.3, 0.0, 0.0);
  const TimeSeries s = record(scene, {SchemeKind::splitting, 1e-4}, 1e-3);
  int kinds[3] = {};
  for (std::size_t j = 0; j < s.contacts[0].state.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    const double bound = 0.2 * s.contacts[0].normal_force(i);
    ++kinds[s.contacts[0].state[j]];
    constexpr double between = 1e-5; // the sweeps' tolerance is 1e-6 of the bound, at both steps around
    if (s.contacts[0].state[j] == post::slides && j > 0 && s.contacts[0].state[j - 1] == post::slides) {
      EXPECT_NEAR(s.contacts[0].tangential_force.row(i).norm(), bound, between * bound);
    }
    EXPECT_LE(s.contacts[0].tangential_force.row(i).norm(), bound * (1.0 + between));
  }
  EXPECT_EQ(kinds[post::open], 0);
  EXPECT_GT(kinds[post::sticks], 10);
  EXPECT_GT(kinds[post::slides], 10);
}

// Loads of one function of time are one: what they add to a reaction is the sum of what each does.
TEST(Recorder, AddsTheLoadsToReactions) {
  Scene scene = pressed_node();
  scene.loads = {{Harmonic{30.0, 2.0}, Eigen::Vector3d(1, 0.5, 0)},
                 {Constant{20.0}, Eigen::Vector3d(0, 0, 1)},
                 {Harmonic{30.0, 2.0}, Eigen::Vector3d(0, 0, 2)},
                 {Harmonic{30.0, 3.0}, Eigen::Vector3d(0, 1, 0)}};
  const Eigen::MatrixXd rows = Eigen::MatrixXd::Constant(6, 3, 0.5);
  Eigen::MatrixXd by_loads(6, 4);
  for (Eigen::Index i = 0; i < by_loads.size(); ++i)
    by_loads.data()[i] = std::cos(static_cast<double>(i));
  const OutputGrid grid = output_grid(scene.duration, 1e-2);
  Recorder recorder(scene, {}, grid);
  const auto reaction = [&](const std::string& name, const Eigen::MatrixXd& of_loads) {
    post::FollowedForce out{name, rows};
    out.by_loads = of_loads;
    out.section = false;
    return out;
  };
  recorder.add_reactions(
      {reaction("one", by_loads), reaction("other", -2.0 * by_loads), reaction("none", {})});
  (void)run(scene, choose_step(scene, {SchemeKind::splitting, 1e-4}), {}, &recorder, grid);
  const TimeSeries s = std::move(recorder).series();
  ASSERT_EQ(s.reactions.size(), 3u);
  constexpr double rounding = 1e-12; // N
  for (Eigen::Index i = 0; i < s.time.size(); ++i) {
    Eigen::Vector4d values;
    for (Eigen::Index l = 0; l < 4; ++l)
      values(l) = Signal(scene.loads[static_cast<std::size_t>(l)].function, scene.duration)(s.time(i));
    const Eigen::VectorXd of_modes = rows * s.modal_displacement.col(i), of_loads = by_loads * values;
    EXPECT_LT((s.reactions[0].force.row(i).transpose() - of_modes - of_loads).norm(), rounding);
    EXPECT_LT((s.reactions[1].force.row(i).transpose() - of_modes + 2.0 * of_loads).norm(), rounding);
    EXPECT_LT((s.reactions[2].force.row(i).transpose() - of_modes).norm(), rounding);
  }
}

TEST(Recorder, CutsTheSeriesOfARunThatEndedEarly) {
  const Scene scene = pressed_node();
  const OutputGrid grid = output_grid(scene.duration, 1e-2);
  Recorder recorder(scene, {{"probe", node_rows()}}, grid);
  const Eigen::Vector3d q(1, 2, 3), v(0, 0, 0);
  const std::vector<ContactForce> forces(2);
  for (int j = 0; j < 4; ++j) {
    recorder.state(j, j * grid.every, q.data(), v.data());
    recorder.forces(j, j * grid.every, v.data(), forces);
  }
  recorder.state(4, 4 * grid.every, q.data(), v.data()); // its forces never came
  const TimeSeries s = std::move(recorder).series();
  EXPECT_EQ(s.time.size(), 4);
  EXPECT_EQ(s.modal_displacement.cols(), 4);
  EXPECT_EQ(s.contacts[1].gap.size(), 4);
  EXPECT_EQ(s.contacts[1].displacement.rows(), 4);
  EXPECT_EQ(s.contacts[1].tangential_force.rows(), 4);
  EXPECT_EQ(s.contacts[1].normal.rows(), 4);
  EXPECT_EQ(s.nodes[0].acceleration.rows(), 4);
  EXPECT_EQ(s.nodes[0].velocity.rows(), 4);
}

} // namespace recorder_test
