// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/fields.hpp"
#include "fem/node_blocks.hpp"
#include "model_builder.hpp"
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

namespace fields_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

constexpr double round_off = 1e-13; // relative, of sums over a few elements

/// A frame with everything a model can have.
fem::Model frame() {
  ModelBuilder b;
  const Index round = b.property(tube_property());
  fem::BeamProperty flat{{1e11, 0.25, 5000.0}, fem::rectangle_section(0.02, 0.05)};
  flat.orientation = Vec3(0.2, 0.1, 1.0);
  flat.added_mass = 1.5;
  const auto leg = b.line({0, 0, 0}, {0.1, 0.3, 1.0}, 3, round);
  b.line_from(leg.back(), {1.0, 0.5, 0.8}, 3, b.property(flat));
  b.model.masses.push_back({2, 1.0, Vec3(0.1, 0.2, 0.3), Vec3(0.0, 0.1, 0.2)});
  b.model.springs.push_back({6, -1, {1e4, 2e4, 3e4, 4e2, 5e2, 6e2}, {}});
  b.model.springs.push_back({1, 5, {1e4, 2e4, 3e4, 4e2, 5e2, 6e2}, {}});
  b.fix(0, all);
  return b.model;
}

Eigen::MatrixXd random_fields(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return value(generator); });
}

/// K and M with all dofs, from blocks.
struct Dense {
  Eigen::MatrixXd k, m;
};

Dense dense(const fem::Model& model) {
  const auto part = fem::structures(model).at(0);
  const auto nodes = static_cast<Index>(part.nodes.size());
  const auto blocks = fem::node_blocks(model, part, 0, nodes);
  Dense d{Eigen::MatrixXd::Zero(6 * nodes, 6 * nodes), Eigen::MatrixXd::Zero(6 * nodes, 6 * nodes)};
  for (Index i = 0; i < nodes; ++i)
    for (auto k = blocks.start[static_cast<std::size_t>(i)];
         k < blocks.start[static_cast<std::size_t>(i) + 1]; ++k) {
      d.k.block<6, 6>(6 * i, 6 * blocks.column[k]) = blocks.stiffness[k];
      d.m.block<6, 6>(6 * i, 6 * blocks.column[k]) = blocks.mass[k];
    }
  return d;
}

} // namespace

TEST(Fields, MultiplyAsTheMatricesDo) {
  const fem::Model model = frame();
  const auto part = fem::structures(model).at(0);
  const Dense d = dense(model);
  EXPECT_EQ(d.k, d.k.transpose().eval());
  EXPECT_LT((d.m - d.m.transpose()).cwiseAbs().maxCoeff(), round_off * d.m.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd u = random_fields(d.k.rows(), 3);
  EXPECT_LT((fem::stiffness_times(model, part, u) - d.k * u).norm(), round_off * (d.k * u).norm());
  EXPECT_LT((fem::mass_times(model, part, u) - d.m * u).norm(), round_off * (d.m * u).norm());
  EXPECT_LT((fem::stiffness_times(model, u.col(0)) - d.k * u.col(0)).norm(), round_off * (d.k * u).norm());
  EXPECT_LT((fem::mass_times(model, u.col(0)) - d.m * u.col(0)).norm(), round_off * (d.m * u).norm());
  EXPECT_LT((fem::stiffness_diagonal(model, part) - d.k.diagonal()).norm(),
            round_off * d.k.diagonal().norm());
  const Eigen::VectorXd energy = fem::twice_strain_energy(model, part, u);
  for (Eigen::Index j = 0; j < u.cols(); ++j)
    EXPECT_NEAR(energy[j] / u.col(j).dot(d.k * u.col(j)), 1.0, round_off);
}

TEST(Fields, BlocksOfSomeRowsAreThoseOfAll) {
  const fem::Model model = frame();
  const auto part = fem::structures(model).at(0);
  const auto whole = fem::node_blocks(model, part, 0, 7), some = fem::node_blocks(model, part, 2, 5);
  ASSERT_EQ(some.start.size(), 4u);
  const std::size_t skipped = whole.start[2];
  ASSERT_EQ(some.column.size(), whole.start[5] - skipped);
  for (std::size_t k = 0; k < some.column.size(); ++k) {
    EXPECT_EQ(some.column[k], whole.column[k + skipped]);
    EXPECT_EQ(some.stiffness[k], whole.stiffness[k + skipped]);
    EXPECT_EQ(some.mass[k], whole.mass[k + skipped]);
  }
}

TEST(SpringsBetweenNodes, PullTheTwoTogether) {
  ModelBuilder b;
  for (int i = 0; i < 2; ++i) {
    b.model.masses.push_back({b.node({0.0, 0.0, 0.0}), 1.0});
    b.fix(i, rx | ry | rz);
  }
  b.model.springs.push_back({0, 1, {10.0, 20.0, 30.0}, {}});
  Eigen::VectorXd u = Eigen::VectorXd::Zero(12);
  u.segment<3>(6) = Vec3(1.0, 1.0, 1.0);
  const Eigen::VectorXd force = fem::stiffness_times(b.model, u);
  EXPECT_EQ(force.segment<3>(6), Vec3(10.0, 20.0, 30.0));
  EXPECT_EQ(force.segment<3>(0), Vec3(-10.0, -20.0, -30.0));
}

TEST(TranslationField, MovesTheTotalMass) {
  fem::Model model = frame();
  model.properties[1].added_mass_direction = fem::AddedMass::all;
  const Vec3 direction = Vec3(1, -2, 3).normalized();
  const Eigen::VectorXd u = fem::translation_field(model, direction);
  EXPECT_NEAR(u.dot(fem::mass_times(model, u)) / fem::total_mass(model), 1.0, round_off);
  EXPECT_EQ(u.segment<3>(9), Vec3::Zero());
}

TEST(PointForces, PutTheFullValueAtEachNode) {
  const fem::Model model = frame();
  const std::vector<Index> nodes{1, 4};
  const Eigen::VectorXd force = fem::point_forces(model, nodes, Vec3(1, 2, 3), false);
  EXPECT_EQ(force.segment<3>(6), Vec3(1, 2, 3));
  EXPECT_EQ(force.segment<3>(24), Vec3(1, 2, 3));
  EXPECT_DOUBLE_EQ(force.sum(), 12.0);
  const Eigen::VectorXd moment = fem::point_forces(model, nodes, Vec3(1, 2, 3), true);
  EXPECT_EQ(moment.segment<3>(9), Vec3(1, 2, 3));
  EXPECT_DOUBLE_EQ(moment.sum(), 12.0);
}

// The work of consistent forces in any motion that the element can make is the work of the line force: here
// in rigid ones.
TEST(LineForces, DoTheWorkOfTheLineForceInRigidMotions) {
  const fem::Model model = frame();
  const std::vector<Index> beams{1, 3, 4};
  const Vec3 force(10.0, -20.0, 5.0), spin(0.3, -0.4, 0.5);
  const Eigen::VectorXd field = fem::line_forces(model, beams, force);
  double length = 0.0, work_of_rotation = 0.0;
  for (const Index i : beams) {
    const auto& beam = model.beams[static_cast<std::size_t>(i)];
    const Vec3 a = model.nodes[static_cast<std::size_t>(beam.a)],
               b = model.nodes[static_cast<std::size_t>(beam.b)];
    length += (b - a).norm();
    work_of_rotation += (b - a).norm() * force.dot(spin.cross(0.5 * (a + b)));
  }
  EXPECT_NEAR(field.dot(fem::translation_field(model, force)) / (length * force.squaredNorm()), 1.0,
              round_off);
  double work = 0.0;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(6 * i);
    work += field.segment<3>(row).dot(spin.cross(model.nodes[i])) + field.segment<3>(row + 3).dot(spin);
  }
  EXPECT_NEAR(work / work_of_rotation, 1.0, round_off);
}

} // namespace fields_test
