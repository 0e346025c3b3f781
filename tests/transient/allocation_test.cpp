// SPDX-License-Identifier: GPL-3.0-or-later
// The time loop allocates nothing, neither by operator new nor by malloc (Eigen's way): all come here.
#include "post/node_statistics.hpp"
#include "post/recorder.hpp"
#include "scenes.hpp"
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>

namespace {

// volatile: the compiler takes it that malloc changes nothing it can see
volatile bool watching = false;
volatile long allocations = 0;

void* note(void* p) {
  allocations = allocations + watching;
  return p;
}

void* counted(void* p) { return note(p) ? p : throw std::bad_alloc(); }

} // namespace

extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* p, std::size_t size);
void* __wrap_malloc(std::size_t size) { return note(__real_malloc(size)); }
// compilers join malloc and memset into calloc
void* __wrap_calloc(std::size_t count, std::size_t size) { return note(__real_calloc(count, size)); }
void* __wrap_realloc(void* p, std::size_t size) { return note(__real_realloc(p, size)); }
}

void* operator new(std::size_t size) { return counted(__real_malloc(size)); }
void* operator new(std::size_t size, std::align_val_t align) {
  const auto a = static_cast<std::size_t>(align);
  return counted(std::aligned_alloc(a, (size + a - 1) / a * a));
}
// g++ 12 does not see that operator new takes its memory from malloc here
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

/// Watches from the first record to the last but one.
struct Gate final : Observer {
  void visit(core::StateArchive&) override {}
  explicit Gate(std::int64_t steps) : last(steps - 1) {}
  void step(const Record& record) override {
    watching = ++seen < last;
    closed += !record.active.empty();
  }
  std::int64_t seen = 0, last, closed = 0;
};

long allocations_of_a_run(const Scene& scene, const StepOptions& options) {
  const StepChoice choice = choose_step(scene, options);
  const OutputGrid grid = output_grid(scene.duration, 7.7e-4);
  const Eigen::MatrixXd node = Eigen::MatrixXd::Random(3, scene.system.size());
  post::Recorder recorder(scene, {{"node", node}}, grid);
  post::ContactStatistics contacts(scene.contacts, 0.1);
  post::NodeStatistics nodes({node}, 0.1);
  post::ForceStatistics forces(
      {{"section",
        Eigen::MatrixXd::Random(6, scene.system.size()),
        Eigen::MatrixXd::Random(6, 3 * static_cast<Eigen::Index>(scene.contacts.size())),
        {},
        {},
        true,
        post::OuterFibre{true, 1.0, 2.0, 2.0}}},
      0.1);
  Gate gate(choice.steps);
  Observer* const observers[] = {&gate, &contacts, &nodes, &forces};
  allocations = 0;
  (void)run(scene, choice, observers, &recorder, grid);
  watching = false;
  EXPECT_GT(gate.closed, gate.seen / 20); // contacts opened and closed
  EXPECT_LT(gate.closed, gate.seen);
  return allocations;
}

} // namespace

TEST(Allocation, IsSeenByThisTest) {
  const auto seen = [](const auto& work) {
    allocations = 0;
    watching = true;
    work();
    watching = false;
    return static_cast<long>(allocations);
  };
  const Eigen::MatrixXd m = Eigen::MatrixXd::Random(3, 20);
  Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, 3);
  Eigen::VectorXd x;
  std::vector<double> y;
  kernels::Array z;
  EXPECT_EQ(seen([&] { x.setZero(20); }), 1);
  EXPECT_EQ(seen([&] { y.resize(20); }), 1);
  EXPECT_EQ(seen([&] { z.resize(20); }), 1);
  EXPECT_GE(seen([&] { row.row(0) = (m * x).transpose(); }), 1); // a temporary of Eigen
}

TEST(Allocation, NeverHappensInTheLoop) {
  Scene scene = rattling(3, 12, 1.0);
  scene.contacts[0].b.row(0).setZero(); // two and three components
  EXPECT_EQ(allocations_of_a_run(scene, splitting(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, energy_conserving(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, collocation(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, euler(2e-5)), 0);
  for (auto& c : scene.contacts)
    c.b.row(0).setZero();
  EXPECT_EQ(allocations_of_a_run(scene, splitting(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, energy_conserving(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, collocation(1e-4)), 0);
  scene.system.damping_matrix = Eigen::MatrixXd(scene.system.damping.asDiagonal());
  EXPECT_EQ(allocations_of_a_run(scene, euler(2e-5)), 0);
  scene.system.damping_matrix(0, 5) = scene.system.damping_matrix(5, 0) = 0.3;
  EXPECT_EQ(allocations_of_a_run(scene, splitting(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, energy_conserving(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, collocation(1e-4)), 0);
}

TEST(Allocation, NeverHappensWhereOnlyNearContactsAreLookedAt) {
  Scene scene = rattling(19, 12, 0.5);
  for (auto& c : scene.contacts) {
    c.support.normal.damping = 0.0;
    c.b.row(0).setZero();
  }
  EXPECT_EQ(allocations_of_a_run(scene, splitting(1e-4)), 0);
}

TEST(Allocation, NeverHappensWhereContactsPushOthersIn) {
  const Scene bar = turning_bar(1.0);
  constexpr double step = 7e-3; // w_c h = 0.57
  EXPECT_TRUE(closes_at_both_ends_at_once(bar, step));
  EXPECT_EQ(allocations_of_a_run(bar, splitting(step)), 0);
}

TEST(Allocation, NeverHappensUnderTablesAndNoise) {
  Scene scene = rattling(3, 12, 1.0);
  scene.loads[0].function = Random{4.0, 5.0, 60.0, 1};
  scene.loads[1].function = Table{{0.0, 0.3, 0.3, 0.9}, {3.0, -3.0, 4.0, 1.0}};
  EXPECT_EQ(allocations_of_a_run(scene, splitting(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, energy_conserving(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, collocation(1e-4)), 0);
}

TEST(Allocation, NeverHappensWithForcesThatDependOnTheMotion) {
  constexpr int modes = 12, coupled = 9;
  Scene scene = rattling(3, modes, 1.0);
  core::MotionForces& f = scene.system.motion;
  f.stiffness = f.damping = Eigen::MatrixXd::Zero(modes, modes);
  f.stiffness.topLeftCorner(coupled, coupled).setConstant(-20.0);
  f.damping(10, 10) = -0.3;
  f.input = Eigen::MatrixXd::Zero(modes, 2);
  f.input.topRows(coupled).setConstant(40.0);
  f.output = 0.01 * f.input.transpose();
  f.rates = -50.0 * Eigen::Matrix2d::Identity();
  EXPECT_EQ(allocations_of_a_run(scene, splitting(1e-4)), 0);
}

TEST(Allocation, NeverHappensWithObstaclesThatMove) {
  Scene scene = rattling(3, 12, 1.0);
  scene.motions = {{Harmonic{1.0, 20.0, 0.0}, -1.0 / 125.66, 0.0},
                   {Random{0.5, 5.0, 60.0, 1}, 0.0, 0.0},
                   {Table{{0.0, 0.5, 0.5, 1.0}, {0.0, 1e-3, -1e-3, 0.0}}}};
  for (auto& c : scene.contacts)
    c.imposed = 0.1 * Eigen::Matrix3d::Identity();
  EXPECT_EQ(allocations_of_a_run(scene, splitting(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, energy_conserving(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, collocation(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, {SchemeKind::devogelaere, 2e-5}), 0);
  EXPECT_EQ(allocations_of_a_run(scene, euler(2e-5)), 0);
}

TEST(Allocation, NeverHappensWithAnyObstacleAndLaw) {
  Scene scene = rattling(8, 12, 0.5);
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
  EXPECT_EQ(allocations_of_a_run(scene, splitting(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, energy_conserving(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, collocation(1e-4)), 0);
  EXPECT_EQ(allocations_of_a_run(scene, euler(2e-5)), 0);
}
