// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "../fem/model_builder.hpp"
#include "fem/rigid_motions.hpp"
#include "modal/dense_modes.hpp"
#include "modal/finish.hpp"
#include "modal/slepc_krylov.hpp"
#include "modal/slepc_modes.hpp"
#include "solve.hpp"
#include <Eigen/Geometry>
#include <random>

namespace slepc_modes_test {

using namespace fretwork;
using namespace fretwork::tests;
using std::numbers::pi;

namespace {

constexpr double orthonormal = 1e-13;
constexpr double same_modes =
    1e-7; // shapes of two solvers: round-off times the ratio of the extreme eigenvalues

/// A tube of given number of elements along a direction, nodes jittered along it; clamped at a, pinned at b,
/// lateral support between.
fem::Model jittered_tube(int elements, const Vec3& direction, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  std::vector<Vec3> points;
  for (int i = 0; i <= elements; ++i)
    points.push_back(direction * (1.5 * (i + (i % elements ? jitter(generator) : 0.0)) / elements));
  ModelBuilder b;
  fem::BeamProperty p{{2e11, 0.3, 8000.0}, fem::rectangle_section(0.02, 0.013)};
  p.orientation = direction.unitOrthogonal();
  b.chain(points, b.property(p));
  b.fix(0, all);
  b.fix(elements, ux | uy | uz);
  return b.model;
}

modal::Basis dense(const fem::Model& model, int count) {
  const auto part = fem::structures(model).at(0);
  const Eigen::MatrixXd rigid = fem::rigid_motions(model, part);
  modal::Cut cut;
  cut.count = count;
  return modal::finish(model, part, rigid, modal::dense_modes(model, part, rigid), cut);
}

double pinned_hz(const fem::BeamProperty& p, double length, int n) {
  return n * n * pi / (2 * length * length) *
         std::sqrt(p.material.young_modulus * p.section.iy / (p.material.density * p.section.area));
}

ModelBuilder pinned_tube(int elements) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, elements, b.property(tube_property()));
  b.fix(nodes.front(), ux | uy | uz | rx);
  b.fix(nodes.back(), uy | uz);
  return b;
}

} // namespace

TEST(Modes, OfKrylovAreThoseOfADenseSolveForAnyOrientationAndMesh) {
  const std::array<Vec3, 4> directions{Vec3::UnitX(), Vec3(1, 2, -3).normalized(),
                                       Vec3(-0.2, 0.1, 1).normalized(), Vec3(0, -1, 1).normalized()};
  unsigned seed = 1;
  for (const Vec3& direction : directions) {
    const fem::Model model = jittered_tube(45, direction, seed++); // 264 dofs: Krylov-Schur
    const auto krylov = solve(model, 20), reference = dense(model, 20);
    for (Eigen::Index i = 0; i < 20; ++i)
      EXPECT_NEAR(krylov.omega[i] / reference.omega[i], 1.0, 1e-10); // strain energies of the same shapes
    EXPECT_LT((krylov.shapes - reference.shapes).cwiseAbs().maxCoeff(),
              same_modes * reference.shapes.cwiseAbs().maxCoeff());
    EXPECT_LT(krylov.orthogonality, orthonormal);
    EXPECT_LT(krylov.residuals.maxCoeff(),
              1e-6); // 1e-16 times the ratio of stiffness to the lowest eigenvalue
  }
}

TEST(Modes, DoNotDependOnTheDirectionOfTheTube) {
  const auto reference = solve(jittered_tube(45, Vec3::UnitX(), 1), 15);
  const auto turned = solve(jittered_tube(45, Vec3(2, -1, 2).normalized(), 1), 15);
  for (Eigen::Index i = 0; i < 15; ++i)
    EXPECT_NEAR(turned.omega[i] / reference.omega[i], 1.0, 1e-10);
}

TEST(Modes, OfAFreeTubeStartWithSixExactRigidMotions) {
  for (const int elements : {12, 120}) { // dense, Krylov-Schur
    ModelBuilder b;
    b.line({0.2, 0.1, 0}, {1.0, -0.3, 0.5}, elements, b.property(tube_property()));
    const auto basis = solve(b.model, 20);
    for (Eigen::Index i = 0; i < 6; ++i) {
      EXPECT_EQ(basis.omega[i], 0.0);
      EXPECT_LT(basis.residuals[i], 1e-10); // round-off of axial forces over the torques of the spin
    }
    const auto& p = b.model.properties[0];
    const double length = (b.model.nodes.back() - b.model.nodes.front()).norm();
    const double beam =
        std::pow(4.730040744862704 / length, 2) *
        std::sqrt(p.material.young_modulus * p.section.iy / (p.material.density * p.section.area));
    const double discretization = 1.1 * std::pow(4.73 / elements, 4) / 1440.0;
    for (const Eigen::Index i : {6, 7})
      EXPECT_NEAR(basis.omega[i] / beam, 1.0, discretization + 1e-10) << elements;
    EXPECT_LT(basis.orthogonality, orthonormal);
  }
}

TEST(Modes, OfAPinnedTubeStartWithItsSpin) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, 60, b.property(tube_property()));
  b.fix(nodes.front(), ux | uy | uz);
  b.fix(nodes.back(), uy | uz);
  const auto basis = solve(b.model, 7);
  EXPECT_EQ(basis.omega[0], 0.0);
  EXPECT_GT(basis.shapes(3, 0), 0.0);
  EXPECT_NEAR(basis.omega[1] / (2 * pi * pinned_hz(b.model.properties[0], 1.0, 1)), 1.0,
              1e-8); // (pi/60)^4/1440
}

// At 1000 elements the eigensolver has lost six digits to the round-off of K; the strain energy has not.
TEST(Modes, OfAFineMeshKeepTheirDigits) {
  const auto b = pinned_tube(1000);
  const auto basis = solve(b.model, 6);
  for (int n = 1; n <= 3; ++n)
    for (const int plane : {0, 1})
      EXPECT_NEAR(basis.omega[2 * (n - 1) + plane] / (2 * pi * pinned_hz(b.model.properties[0], 1.0, n)), 1.0,
                  1e-9);
}

TEST(Modes, AreTheSameWhenManyAreWanted) {
  for (const bool free : {false, true}) {
    ModelBuilder b;
    b.line({0, 0, 0}, {2, 0.5, 0}, 200, b.property(tube_property()));
    b.fix(0, free ? 0u : unsigned{all});
    const auto few = solve(b.model, 60),
               many = solve(b.model, 170); // one Krylov space, and intervals of the spectrum
    ASSERT_EQ(many.size(), 170);
    EXPECT_LT((many.omega.head(60) - few.omega).cwiseAbs().maxCoeff(), 1e-10 * few.omega[59]);
    EXPECT_LT((many.shapes.leftCols(60) - few.shapes).cwiseAbs().maxCoeff(),
              1e-7 * few.shapes.cwiseAbs().maxCoeff());
    EXPECT_LT(many.orthogonality, orthonormal);
    EXPECT_EQ((many.omega.array() == 0.0).count(), free ? 6 : 0);
  }
}

TEST(Modes, OfATooFineMeshAreRefused) {
  EXPECT_THROW((void)solve(pinned_tube(30000).model, 4), core::ComputationError);
}

TEST(Modes, UpToAFrequencyAreAllBelowIt) {
  const auto b = pinned_tube(50);
  const double third = pinned_hz(b.model.properties[0], 1.0, 3);
  EXPECT_EQ(solve_up_to(b.model, 1.01 * third).size(), 6);
  EXPECT_EQ(solve_up_to(b.model, 0.99 * third).size(), 4);
  EXPECT_EQ(solve_up_to(b.model, 1.0).size(), 0);
  const auto few = pinned_tube(10); // dense
  EXPECT_EQ(solve_up_to(few.model, 1.01 * third).size(), 6);
  const auto all_of_them = solve_up_to(few.model, 1e9);
  EXPECT_EQ(all_of_them.size(), fem::structures(few.model)[0].equations);
}

TEST(Modes, AreFewerWhereTheStructureHasFewer) {
  ModelBuilder b;
  for (int i = 0; i < 3; ++i) {
    b.model.masses.push_back({b.node({1.0 * i, 0, 0}), 2.0});
    b.fix(i, uy | uz | rx | ry | rz);
    b.model.springs.push_back({i, i - 1, {8.0}, {}});
  }
  EXPECT_EQ(solve(b.model, 40).size(), 3);
}

TEST(Modes, OfAMassOnAMasslessBeamAreThoseWithMass) {
  ModelBuilder b;
  auto p = tube_property();
  p.material.density = 0.0;
  const auto nodes = b.line({0, 0, 0}, {0, 1, 0}, 50, b.property(p)); // 300 dofs, three with mass
  b.fix(nodes.front(), all);
  b.model.masses.push_back({nodes.back(), 4.0});
  const auto basis = solve(b.model, 10);
  ASSERT_EQ(basis.size(), 3);
  const double ei = p.material.young_modulus * p.section.iy, ea = p.material.young_modulus * p.section.area;
  EXPECT_NEAR(basis.omega[0] / std::sqrt(3 * ei / 4.0), 1.0, 1e-9);
  EXPECT_NEAR(basis.omega[1] / std::sqrt(3 * ei / 4.0), 1.0, 1e-9);
  EXPECT_NEAR(basis.omega[2] / std::sqrt(ea / 4.0), 1.0, 1e-9);
}

TEST(Modes, AllowMasslessTorsion) {
  auto b = pinned_tube(50);
  const auto reference = solve(b.model, 6);
  b.model.properties[0].section.polar_inertia = 0.0;
  const auto basis = solve(b.model, 6);
  for (Eigen::Index i = 0; i < 6; ++i)
    EXPECT_NEAR(basis.omega[i] / reference.omega[i], 1.0, 1e-10); // these six are all bending
}

TEST(Modes, OfAFreeMassAreRigid) {
  ModelBuilder b;
  b.model.masses.push_back({b.node({1, 2, 3}), 4.0, Vec3(1, 2, 3)});
  const auto basis = solve(b.model, 10);
  ASSERT_EQ(basis.size(), 6);
  EXPECT_EQ(basis.omega, Eigen::VectorXd::Zero(6));
  EXPECT_DOUBLE_EQ(basis.shapes(0, 0), 0.5);
}

TEST(Modes, OfARestrainedNodeAreNone) {
  ModelBuilder b;
  b.fix(b.node({0, 0, 0}), all);
  const auto basis = solve(b.model, 10);
  EXPECT_EQ(basis.size(), 0);
  EXPECT_EQ(basis.shapes.rows(), 6);
}

TEST(Modes, ProjectDampers) {
  auto b = pinned_tube(50);
  EXPECT_EQ(solve(b.model, 4).damping_matrix.size(), 0);
  b.model.springs.push_back({25, -1, {}, {0, 3.0}});
  const auto basis = solve(b.model, 4);
  const Eigen::VectorXd row = basis.shapes.row(basis.row_of(25) + 1).transpose();
  EXPECT_LT((basis.damping_matrix - 3.0 * row * row.transpose()).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(basis.damping, Eigen::VectorXd::Zero(4));
}

// solve_modes looks for compressed beams that buckle before; the search for the lowest mode must end whatever slips through.
TEST(Modes, AreNotSearchedForEverWhereAnEigenvalueIsNegative) {
  ModelBuilder b;
  fem::BeamProperty compressed = tube_property();
  compressed.axial_force = -1e5;
  const auto nodes = b.line({0, 0, 0}, {1.5, 0, 0}, 60, b.property(compressed));
  b.fix(nodes.front(), unsigned{all});
  const fem::Structure part = fem::structures(b.model).at(0);
  const Eigen::MatrixXd rigid = fem::rigid_motions(b.model, part);
  ASSERT_EQ(rigid.cols(), 0);
  ASSERT_FALSE(modal::is_stable(MPI_COMM_SELF, b.model, part, rigid));
  const modal::KrylovModes krylov(MPI_COMM_SELF, b.model, part, rigid);
  try {
    (void)krylov.lowest(125); // so many are searched interval by interval
    ADD_FAILURE() << "no error";
  } catch (const core::ComputationError& error) {
    EXPECT_NE(std::string(error.what()).find("more motions than its 0 rigid ones have no frequency above 0"),
              std::string::npos)
        << error.what();
  }
}

TEST(Modes, RefuseARequestWithoutSense) {
  const auto b = pinned_tube(4);
  const auto part = fem::structures(b.model).at(0);
  const auto refused = [&](modal::Wanted wanted, const std::vector<std::string>& parts) {
    expect_error([&] { (void)modal::solve_modes(MPI_COMM_SELF, b.model, part, wanted); }, parts);
  };
  refused({std::nullopt, std::nullopt}, {"exactly one of count and up_to_hz"});
  refused({3, 100.0}, {"exactly one"});
  refused({0, std::nullopt}, {"count = 0", "> 0"});
  refused({std::nullopt, -5.0}, {"up_to_hz = -5", "> 0"});
}

} // namespace slepc_modes_test
