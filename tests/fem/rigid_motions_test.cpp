// SPDX-License-Identifier: GPL-3.0-or-later
#include "expect_error.hpp"
#include "fem/fields.hpp"
#include "fem/rigid_motions.hpp"
#include "model_builder.hpp"

namespace rigid_motions_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

constexpr double no_strain =
    1e-20; // energy of a unit motion over that of one element: round-off squared is 1e-30
constexpr double orthonormal = 1e-13;

Eigen::MatrixXd motions(const fem::Model& model) {
  const auto part = fem::structures(model).at(0);
  const Eigen::MatrixXd fields = fem::rigid_motions(model, part);
  if (fields.cols() > 0) {
    const Eigen::MatrixXd gram = fields.transpose() * fem::mass_times(model, part, fields);
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff(),
              orthonormal);
    const Eigen::VectorXd scale = fields.cwiseAbs2().transpose() * fem::stiffness_diagonal(model, part);
    EXPECT_LT((fem::twice_strain_energy(model, part, fields) - no_strain * scale).maxCoeff(), 1e-300);
    for (Eigen::Index i = 0; i < fields.rows(); ++i)
      if (part.equation[static_cast<std::size_t>(i)] < 0) {
        EXPECT_EQ(fields.row(i).cwiseAbs().maxCoeff(), 0.0);
      }
  }
  return fields;
}

ModelBuilder oblique_tube(int elements) {
  ModelBuilder b;
  b.line({0.1, 0.2, 0.3}, {1.2, -0.4, 2.0}, elements, b.property(tube_property()));
  return b;
}

} // namespace

TEST(RigidMotions, AreSixForAFreeTube) { EXPECT_EQ(motions(oblique_tube(20).model).cols(), 6); }

TEST(RigidMotions, AreNoneForAClampedTube) {
  auto b = oblique_tube(5);
  b.fix(0, all);
  EXPECT_EQ(motions(b.model).cols(), 0);
}

TEST(RigidMotions, KnowThatAPinnedTubeSpins) {
  auto b = oblique_tube(8);
  b.fix(0, ux | uy | uz);
  b.fix(8, ux | uy | uz);
  const Eigen::MatrixXd spin = motions(b.model);
  ASSERT_EQ(spin.cols(), 1);
  const Vec3 axis = (b.model.nodes[8] - b.model.nodes[0]).normalized();
  const Vec3 rotation = spin.block<3, 1>(3, 0).normalized();
  EXPECT_NEAR(std::abs(axis.dot(rotation)), 1.0, 1e-14);
}

TEST(RigidMotions, KnowAHinge) {
  ModelBuilder b;
  b.line({0, 0, 0}, {1, 0, 0}, 4, b.property(tube_property()));
  b.fix(0, all & ~static_cast<unsigned>(rz));
  EXPECT_EQ(motions(b.model).cols(), 1);
}

TEST(RigidMotions, KnowMechanismsOfPartsJoinedBySprings) {
  ModelBuilder b;
  const Index p = b.property(tube_property());
  b.fix(b.line({0, 0, 0}, {1, 0, 0}, 4, p).front(), all);
  const auto arm = b.line({1, 0, 0}, {2, 0, 0}, 4, p);
  b.model.springs.push_back({4, arm.front(), {1e6, 1e6, 1e6}, {}}); // a ball joint: three rotations remain
  EXPECT_EQ(motions(b.model).cols(), 3);
  b.model.springs.push_back({arm.back(), -1, {0.0, 1e-6}, {}}); // however soft, it is no longer free
  EXPECT_EQ(motions(b.model).cols(), 2);
}

TEST(RigidMotions, KnowAFreeChainOfMasses) {
  ModelBuilder b;
  for (int i = 0; i < 5; ++i) {
    b.model.masses.push_back({b.node({1.0 * i, 0, 0}), 1.0 + i});
    b.fix(i, uz | rx | ry | rz); // x is sprung, y is free for each mass
    if (i > 0)
      b.model.springs.push_back({i - 1, i, {1e3}, {}});
  }
  EXPECT_EQ(motions(b.model).cols(), 6);
}

TEST(RigidMotions, RefuseAMotionWithoutMass) {
  auto b = oblique_tube(3);
  b.model.properties[0].section.polar_inertia = 0.0;
  expect_error([&] { (void)fem::rigid_motions(b.model, fem::structures(b.model)[0]); },
               {"node (0.1, 0.2, 0.3)", "neither stiffness nor mass", "restrain it"});
}

TEST(RigidMotions, DoNotTurnWhatAnAxialForceHolds) {
  auto b = oblique_tube(5);
  b.model.properties[0].axial_force = -10.0;
  EXPECT_EQ(motions(b.model).cols(), 4); // three translations and the spin
}

// A square with its diagonals: tension in the sides that compression in the diagonals balances.
TEST(RigidMotions, StayWhereAxialForcesBalance) {
  const auto square = [](double diagonal) {
    ModelBuilder b;
    auto side = tube_property(), cross = tube_property();
    side.axial_force = 100.0;
    cross.axial_force = diagonal;
    const Index sides = b.property(side), diagonals = b.property(cross);
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)})
      b.node(corner);
    b.model.beams = {{0, 1, sides}, {1, 2, sides},     {2, 3, sides},
                     {3, 0, sides}, {0, 2, diagonals}, {1, 3, diagonals}};
    return motions(b.model).cols();
  };
  EXPECT_EQ(square(-100.0 * std::sqrt(2.0)), 6);
  EXPECT_EQ(square(-10.0), 3); // translations
}

} // namespace rigid_motions_test
