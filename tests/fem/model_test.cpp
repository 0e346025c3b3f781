// SPDX-License-Identifier: GPL-3.0-or-later
#include "expect_error.hpp"
#include "fem/lumped.hpp"
#include "fem/model.hpp"
#include "fem/node_blocks.hpp"
#include "model_builder.hpp"
#include <Eigen/Geometry>

namespace model_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

/// Two tubes that a spring may join, and an oscillator of its own.
ModelBuilder two_tubes() {
  ModelBuilder b;
  const Index p = b.property(tube_property());
  b.fix(b.line({0, 0, 0}, {1, 0, 0}, 2, p).front(), all);
  b.fix(b.line({0, 1, 0}, {1, 1, 0}, 2, p).front(), all);
  const Index mass = b.node({0, 0, 5});
  b.model.masses.push_back({mass, 2.0});
  b.fix(mass, rx | ry | rz);
  return b;
}

} // namespace

TEST(Structures, AreTheConnectedPartsByFirstNode) {
  const auto parts = fem::structures(two_tubes().model);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].nodes, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(parts[1].nodes, (std::vector<Index>{3, 4, 5}));
  EXPECT_EQ(parts[2].nodes, (std::vector<Index>{6}));
  EXPECT_EQ(parts[0].beams, (std::vector<Index>{0, 1}));
  EXPECT_EQ(parts[1].beams, (std::vector<Index>{2, 3}));
  EXPECT_EQ(parts[2].masses, (std::vector<Index>{0}));
  EXPECT_EQ(parts[0].equations, 12);
  EXPECT_EQ(parts[2].equations, 3);
}

TEST(Structures, AreJoinedBySpringsBetweenNodesAndNotByTheGround) {
  auto b = two_tubes();
  b.model.springs.push_back({5, 2, {0, 1e3}, {}});
  b.model.springs.push_back({6, -1, {1e3}, {}});
  const auto parts = fem::structures(b.model);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].nodes, (std::vector<Index>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(parts[0].springs, (std::vector<Index>{0}));
  EXPECT_EQ(parts[1].springs, (std::vector<Index>{1}));
}

TEST(Structures, NumberFreeDofsByAscendingNodes) {
  auto b = two_tubes();
  b.fix(1, uy | rz);
  const auto part = fem::structures(b.model)[0];
  EXPECT_EQ(part.equation,
            (std::vector<Index>{-1, -1, -1, -1, -1, -1, 0, -1, 1, 2, 3, -1, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(part.equations, 10);
  EXPECT_EQ(fem::position_of(part, 2), 2);
  EXPECT_EQ(fem::position_of(part, 3), -1);
}

TEST(Structures, KeepAnIsolatedRestrainedNodeWithoutEquations) {
  ModelBuilder b;
  b.fix(b.node({0, 0, 0}), all);
  const auto parts = fem::structures(b.model);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].equations, 0);
}

TEST(Structures, AllowAStiffDofWithoutMass) {
  ModelBuilder b;
  auto p = tube_property();
  p.section.polar_inertia = 0.0;
  b.fix(b.line({0, 0, 0}, {1, 0, 0}, 2, b.property(p)).front(), all);
  EXPECT_EQ(fem::structures(b.model)[0].equations, 12);
}

TEST(Structures, NameADofWithoutMass) {
  auto b = two_tubes();
  b.model.fixed[6] = rx | ry;
  expect_error([&] { (void)fem::structures(b.model); },
               {"node 6 at (0, 0, 5)", "rz is free", "fixed = [\"rz\"]", "inertia"});
  b.model.masses[0].mass = 0.0;
  expect_error([&] { (void)fem::structures(b.model); }, {"ux is free", "give the node a mass"});
}

TEST(Structures, NameANodeOfSpringsWithoutMass) {
  auto b = two_tubes();
  const Index lone = b.node({2, 0, 0});
  b.fix(lone, uy | uz | rx | ry | rz);
  b.model.springs.push_back({lone, 2, {1e3}, {}});
  expect_error([&] { (void)fem::structures(b.model); }, {"node 7 at (2, 0, 0)", "ux"});
}

TEST(Structures, RefusePropertiesWithoutSense) {
  const auto refused = [](auto change, const std::vector<std::string>& parts) {
    ModelBuilder b = two_tubes();
    change(b.model);
    expect_error([&] { (void)fem::structures(b.model); }, parts);
  };
  refused([](auto& m) { m.properties[0].material.young_modulus = 0.0; },
          {"beam property 0", "young_modulus = 0"});
  refused([](auto& m) { m.properties[0].material.poisson_ratio = 0.5; }, {"poisson_ratio = 0.5"});
  refused([](auto& m) { m.properties[0].material.density = -1.0; }, {"density = -1"});
  refused([](auto& m) { m.properties[0].section.area = 0.0; }, {"area = 0"});
  refused([](auto& m) { m.properties[0].section.iy = 0.0; }, {"iy = 0"});
  refused([](auto& m) { m.properties[0].section.iz = 0.0; }, {"iz = 0"});
  refused([](auto& m) { m.properties[0].section.torsion_constant = 0.0; }, {"torsion_constant = 0"});
  refused([](auto& m) { m.properties[0].section.polar_inertia = -1.0; }, {"polar_inertia = -1"});
  refused([](auto& m) { m.properties[0].added_mass = -0.1; }, {"added_mass = -0.1"});
  refused([](auto& m) { m.masses[0].mass = -2.0; }, {"mass at (0, 0, 5)", "mass = -2"});
  refused([](auto& m) { m.masses[0].inertia.y() = -3.0; }, {"mass at (0, 0, 5)", "inertia = -3"});
  refused(
      [](auto& m) {
        m.springs.push_back({1, -1, {0, -5.0}, {}});
      },
      {"spring at (0.5, 0, 0)", "stiffness = -5"});
  refused(
      [](auto& m) {
        m.springs.push_back({1, -1, {}, {0, -6.0}});
      },
      {"spring at (0.5, 0, 0)", "damping = -6"});
}

TEST(TotalMass, CountsBeamsAddedMassAndLumpedMasses) {
  auto b = two_tubes();
  b.model.properties[0].added_mass = 0.25;
  const auto& p = b.model.properties[0];
  EXPECT_DOUBLE_EQ(fem::total_mass(b.model), 2.0 * (p.material.density * p.section.area + 0.25) + 2.0);
}

TEST(LumpedMass, HasTheEnergyOfItsRigidBody) {
  const fem::LumpedMass body{0, 3.0, Vec3(0.1, 0.2, 0.3), Vec3(0.5, -0.4, 0.7)};
  const fem::Matrix6 m = fem::lumped_mass_matrix(body);
  EXPECT_LT((m - m.transpose()).cwiseAbs().maxCoeff(), 1e-15); // products in another order
  const Vec3 v(1.0, -2.0, 0.5), spin(0.3, 0.7, -1.1);
  Eigen::Matrix<double, 6, 1> velocity;
  velocity << v, spin;
  const double energy =
      3.0 * (v + spin.cross(body.arm)).squaredNorm() + spin.dot(body.inertia.cwiseProduct(spin));
  EXPECT_NEAR(velocity.dot(m * velocity) / energy, 1.0, 1e-14); // a few products
}

TEST(IsChain, CountsNeighbours) {
  auto b = two_tubes();
  EXPECT_TRUE(fem::is_chain(b.model, fem::structures(b.model)[0]));
  b.line_from(1, {0.5, 1, 1}, 1, 0);
  EXPECT_FALSE(fem::is_chain(b.model, fem::structures(b.model)[0]));
}

} // namespace model_test
