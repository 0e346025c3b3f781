// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mpi.hpp"
#include "core/petsc.hpp"
#include "expect_error.hpp"
#include "fem/fields.hpp"
#include "fem/petsc_assembly.hpp"
#include "fem/petsc_static.hpp"
#include "fem/rigid_motions.hpp"
#include "model_builder.hpp"
#include <Eigen/Geometry>

namespace petsc_assembly_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

/// A portal with a bracing and a spring, restrained here and there.
ModelBuilder portal() {
  ModelBuilder b;
  const Index p = b.property(tube_property());
  const auto left = b.line({0, 0, 0}, {0, 0, 2}, 7, p);
  const auto beam = b.line_from(left.back(), {1.5, 0.2, 2}, 5, p);
  const auto right = b.line_from(beam.back(), {1.5, 0, 0}, 7, p);
  b.model.beams.push_back({left[3], right[3], p});
  b.model.masses.push_back({beam[2], 4.0, Vec3(0.1, 0.1, 0.1), Vec3(0, 0, -0.2)});
  b.model.springs.push_back({left[2], right[5], {1e4, 0, 0, 0, 1e2, 0}, {}});
  b.fix(left.front(), all);
  b.fix(right.back(), ux | uy | uz);
  b.fix(beam[1], uy);
  return b;
}

/// The portal with its bracing cut in two: the halves, of two beams each, hang on ties.
ModelBuilder portal_with_ties() {
  ModelBuilder b = portal();
  const auto first = b.line({0, 0, 1}, {0.7, 0.1, 1}, 2, 0),
             second = b.line({0.7, 0.1, 1}, {1.5, 0, 1}, 2, 0);
  b.model.ties = {{first.front(), 2, ux | uy | uz},
                  {second.front(), first.back(), all & ~static_cast<unsigned>(ry)},
                  {second.back(), 16, ux | rz},
                  {second.back(), 15, uy},
                  {second.front(), first.front(), uz}};
  return b;
}

/// A x with x_i = sin(i + 1), on every rank.
Eigen::VectorXd product(Mat matrix) {
  Vec x = nullptr, y = nullptr, whole = nullptr;
  VecScatter scatter = nullptr;
  FW_PETSC(MatCreateVecs(matrix, &x, &y));
  PetscInt begin = 0, end = 0, size = 0;
  FW_PETSC(VecGetOwnershipRange(x, &begin, &end));
  FW_PETSC(VecGetSize(x, &size));
  for (PetscInt i = begin; i < end; ++i)
    FW_PETSC(VecSetValue(x, i, std::sin(i + 1.0), INSERT_VALUES));
  FW_PETSC(VecAssemblyBegin(x));
  FW_PETSC(VecAssemblyEnd(x));
  FW_PETSC(MatMult(matrix, x, y));
  FW_PETSC(VecScatterCreateToAll(y, &scatter, &whole));
  FW_PETSC(VecScatterBegin(scatter, y, whole, INSERT_VALUES, SCATTER_FORWARD));
  FW_PETSC(VecScatterEnd(scatter, y, whole, INSERT_VALUES, SCATTER_FORWARD));
  const PetscScalar* values = nullptr;
  FW_PETSC(VecGetArrayRead(whole, &values));
  Eigen::VectorXd result = Eigen::Map<const Eigen::VectorXd>(values, size);
  FW_PETSC(VecRestoreArrayRead(whole, &values));
  FW_PETSC(VecScatterDestroy(&scatter));
  FW_PETSC(VecDestroy(&whole));
  FW_PETSC(VecDestroy(&x));
  FW_PETSC(VecDestroy(&y));
  return result;
}

/// The same from fields, restrained dofs 0.
Eigen::VectorXd expected(const fem::Model& model, const fem::Structure& part, bool stiffness) {
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(part.equation.size()), 1);
  for (std::size_t i = 0; i < part.equation.size(); ++i)
    if (part.equation[i] >= 0)
      u(static_cast<Eigen::Index>(i), 0) = std::sin(part.equation[i] + 1.0);
  const Eigen::MatrixXd f =
      stiffness ? fem::stiffness_times(model, part, u) : fem::mass_times(model, part, u);
  return fem::forces_on_equations(part, f);
}

} // namespace

TEST(Assembly, IsTheSameForAnyNumberOfRanks) {
  constexpr double round_off = 1e-13; // sums in another order
  const auto b = portal();
  const auto part = fem::structures(b.model).at(0);
  const auto system = fem::assemble(MPI_COMM_WORLD, b.model, part);
  const Eigen::VectorXd k = expected(b.model, part, true), m = expected(b.model, part, false);
  EXPECT_LT((product(system.stiffness.get()) - k).norm(), round_off * k.norm());
  EXPECT_LT((product(system.mass.get()) - m).norm(), round_off * m.norm());
}

TEST(Assembly, AddsUpWhatIsTied) {
  constexpr double round_off = 1e-13; // sums in another order
  const auto b = portal_with_ties();
  const auto part = fem::structures(b.model).at(0);
  ASSERT_EQ(fem::structures(b.model).size(), 1u);
  const auto system = fem::assemble(MPI_COMM_WORLD, b.model, part);
  const Eigen::VectorXd k = expected(b.model, part, true), m = expected(b.model, part, false);
  EXPECT_LT((product(system.stiffness.get()) - k).norm(), round_off * k.norm());
  EXPECT_LT((product(system.mass.get()) - m).norm(), round_off * m.norm());
}

TEST(Assembly, IsSymmetricAndAllocatedExactly) {
  const auto b = portal_with_ties();
  const auto part = fem::structures(b.model).at(0);
  const auto system = fem::assemble(MPI_COMM_WORLD, b.model, part);
  PetscBool symmetric = PETSC_FALSE;
  FW_PETSC(MatIsTranspose(system.stiffness.get(), system.stiffness.get(), 1e-6, &symmetric)); // of 1e8 N/m
  EXPECT_TRUE(symmetric);
  MatInfo info;
  FW_PETSC(MatGetInfo(system.stiffness.get(), MAT_GLOBAL_SUM, &info));
  EXPECT_EQ(info.nz_unneeded, 0.0);
  EXPECT_EQ(info.mallocs, 0.0);
}

TEST(Assembly, LeavesOutWhatIsZeroOnOneRank) {
  const auto entries = [](const Vec3& end) { // of a cantilever of four beams of equal length
    ModelBuilder b;
    b.fix(b.line({0, 0, 0}, end, 4, b.property(tube_property())).front(), all);
    const auto system = fem::assemble(MPI_COMM_SELF, b.model, fem::structures(b.model).at(0));
    MatInfo stiffness, mass;
    FW_PETSC(MatGetInfo(system.stiffness.get(), MAT_LOCAL, &stiffness));
    FW_PETSC(MatGetInfo(system.mass.get(), MAT_LOCAL, &mass));
    EXPECT_EQ(stiffness.nz_used, mass.nz_used); // one pattern
    return static_cast<int>(stiffness.nz_used);
  };
  // Along an axis two planes of bending have 2 x 2 entries each, traction and torsion one: 10 in each of the six
  // blocks between nodes and in that of the tip; in those of the three nodes between, deflection and rotation of
  // two equal beams do not meet, which leaves 6.
  constexpr int along_an_axis = 7 * 10 + 3 * 6;
  EXPECT_EQ(entries({0, 0, 4}), along_an_axis);
  EXPECT_GT(entries({1, 2, -2}), 3 * along_an_axis);
}

TEST(Assembly, LeavesRanksWithoutRowsWhereThereAreFewDofs) {
  ModelBuilder b;
  b.model.masses.push_back({b.node({0, 0, 0}), 2.0});
  b.fix(0, all & ~static_cast<unsigned>(ux));
  b.model.springs.push_back({0, -1, {5.0}, {}});
  const auto system = fem::assemble(MPI_COMM_WORLD, b.model, fem::structures(b.model).at(0));
  EXPECT_NEAR(product(system.stiffness.get())[0], 5.0 * std::sin(1.0), 1e-15);
  EXPECT_NEAR(product(system.mass.get())[0], 2.0 * std::sin(1.0), 1e-15);
}

// Gerber's beam: clamped at 0, hinged at a, on a roller at a + b. A force at the hinge bends the cantilever alone,
// P a^3/(3 EI); one in the middle of the hung span loads it with the half, and bends the span by P b^3/(48 EI).
TEST(StaticSolution, IsTheClosedFormOfAHingedBeam) {
  constexpr double a = 1.2, span = 0.8, force = 50.0;
  constexpr double round_off = 1e-10; // eight beams: the condition of K is 1e5
  ModelBuilder b;
  const fem::BeamProperty p = tube_property();
  const auto left = b.line({0, 0, 0}, {a, 0, 0}, 4, b.property(p));
  const auto right = b.line({a, 0, 0}, {a + span, 0, 0}, 4, 0);
  b.fix(left.front(), all);
  b.fix(right.back(), uy | uz | rx);
  b.model.ties.push_back({left.back(), right.front(), ux | uy | uz});
  const auto part = fem::structures(b.model).at(0);
  const double ei = p.material.young_modulus * p.section.iz;
  const auto deflection = [&](Index loaded, Index seen) {
    const Eigen::VectorXd f = fem::point_forces(b.model, std::vector<Index>{loaded}, {0, force, 0}, false);
    return fem::static_solution(b.model, part, f)[seen * 6 + 1];
  };
  const double tip = force * a * a * a / (3.0 * ei);
  for (const Index loaded : {left.back(), right.front()}) // the same load, on either of the nodes
    for (const Index seen : {left.back(), right.front()})
      EXPECT_NEAR(deflection(loaded, seen), tip, round_off * tip);
  const double middle = 0.25 * tip + force * span * span * span / (48.0 * ei);
  EXPECT_NEAR(deflection(right[2], right[2]), middle, round_off * middle);
  EXPECT_NEAR(deflection(right[2], right.front()), 0.5 * tip, round_off * tip);
}

// A portal with clamped feet, height h, width w, horizontal force F at each top corner; beam and posts alike:
// sway by the slope-deflection method: corner rotation and displacement in closed form.
TEST(StaticSolution, IsTheClosedFormOfAPortalFrame) {
  constexpr double h = 2.0, w = 3.0, force = 100.0;
  ModelBuilder b;
  auto p = tube_property();
  p.section.area = 0.05; // hardly any axial strain, as in the formula: its share is iy / (area h^2) = 1e-8
  const Index number = b.property(p);
  const auto left = b.line({0, 0, 0}, {0, 0, h}, 6, number);
  const auto beam = b.line_from(left.back(), {w, 0, h}, 6, number);
  const auto right = b.line_from(beam.back(), {w, 0, 0}, 6, number);
  b.fix_everywhere(uy | rx | rz);
  b.fix(left.front(), all);
  b.fix(right.back(), all);
  const std::vector<Index> corners{left.back(), beam.back()};
  const auto part = fem::structures(b.model).at(0);
  const Eigen::VectorXd u =
      fem::static_solution(b.model, part, fem::point_forces(b.model, corners, {force, 0, 0}, false));
  const double ei = p.material.young_modulus * p.section.iy;
  // moments at a corner: EI (4 t/h - 6 d/h^2 + 6 t/w) = 0; shear of a post: EI (12 d/h^3 - 6 t/h^2) = F
  const double rotation_per_sway = (6 / (h * h)) / (4 / h + 6 / w);
  const double sway = force / ei / (12 / (h * h * h) - 6 / (h * h) * rotation_per_sway);
  constexpr double tolerance = 5e-7; // axial strain, and round-off of so different stiffnesses
  for (const Index corner : corners) {
    EXPECT_NEAR(u[6 * corner] / sway, 1.0, tolerance);
    EXPECT_NEAR(u[6 * corner + 4] / (rotation_per_sway * sway), 1.0, tolerance);
  }
  EXPECT_EQ(u.head(6), Eigen::VectorXd::Zero(6));
}

TEST(StaticSolution, OfAUniformLoadIsExactAtTheNodes) {
  constexpr double length = 2.0, q = 50.0;
  ModelBuilder b;
  const auto p = tube_property();
  const auto nodes = b.line({0, 0, 0}, {0, length, 0}, 10, b.property(p));
  b.fix(nodes.front(), all);
  std::vector<Index> beams(10);
  for (Index i = 0; i < 10; ++i)
    beams[static_cast<std::size_t>(i)] = i;
  const Eigen::VectorXd u = fem::static_solution(b.model, fem::structures(b.model).at(0),
                                                 fem::line_forces(b.model, beams, {0, 0, -q}));
  const double ei = p.material.young_modulus * p.section.iy;
  for (const Index n : nodes) {
    const double x = b.model.nodes[static_cast<std::size_t>(n)].y();
    const double deflection = -q * x * x * (6 * length * length - 4 * length * x + x * x) / (24 * ei);
    EXPECT_NEAR(u[6 * n + 2], deflection,
                1e-10 * q * std::pow(length, 4) / (8 * ei)); // round-off of ten elements
  }
}

TEST(StaticSolution, RefusesAStructureThatIsNotHeld) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, 4, b.property(tube_property()));
  b.fix(nodes.front(), ux | uy | uz);
  b.fix(nodes.back(), uy | uz);
  const auto part = fem::structures(b.model).at(0);
  const Eigen::VectorXd torque = fem::point_forces(b.model, nodes, {1, 0, 0}, true);
  expect_error([&] { (void)fem::static_solution(b.model, part, torque); },
               {"static solution", "(0, 0, 0)", "1 motion(s)", "restrain"});
}

// A pinned tube that is free to spin, somewhere in space: P L^3/(48 EI), and no spin.
TEST(StaticSolution, LeavesOpenWhatNoForcePushes) {
  constexpr double length = 2.0, force = 50.0;
  constexpr double round_off = 1e-9; // ten beams whose axis no coordinate has
  const Vec3 along = Vec3(2.0, -1.0, 0.5).normalized(), across = along.cross(Vec3::UnitX()).normalized();
  ModelBuilder b;
  const fem::BeamProperty p = tube_property();
  const auto nodes = b.line({0, 0, 0}, length * along, 10, b.property(p));
  b.fix(nodes.front(), ux | uy | uz);
  b.fix(nodes.back(), ux | uy | uz);
  const auto part = fem::structures(b.model).at(0);
  ASSERT_EQ(fem::rigid_motions(b.model, part).cols(), 1);
  const Index middle = nodes[5];
  const Eigen::VectorXd u = fem::static_solution(
      b.model, part, fem::point_forces(b.model, std::vector<Index>{middle}, force * across, false));
  const double expected = force * std::pow(length, 3) / (48.0 * p.material.young_modulus * p.section.iy);
  EXPECT_LT((u.segment<3>(6 * middle) - expected * across).norm(), round_off * expected);
  for (const Index node : nodes)
    EXPECT_NEAR(u.segment<3>(6 * node + 3).dot(along), 0.0, round_off * expected);
}

// A free tube that forces F at both ends and -2 F in the middle bend, and a mass that slides on nothing: F (L/2)^3/(3 EI) between them.
TEST(StaticSolution, OfAFreeTubeUnderForcesThatBalance) {
  constexpr double length = 2.0, force = 50.0, round_off = 1e-9;
  ModelBuilder b;
  const fem::BeamProperty p = tube_property();
  const auto nodes = b.line({0, 0, 0}, {length, 0, 0}, 10, b.property(p));
  const Index slider = b.node({0, 1, 0});
  b.model.masses.push_back({slider, 2.0});
  b.fix(slider, all & ~static_cast<unsigned>(ux));
  b.model.springs.push_back({nodes.front(), slider, {0.0, 1e3}, {}}); // across: the slider is free along x
  b.model.springs.push_back({nodes.back(), -1, {0.0, 1e3}, {}});
  const auto part = fem::structures(b.model).at(0);
  ASSERT_EQ(fem::rigid_motions(b.model, part).cols(), 5); // 6 of the tube less uy and rz, and the slider
  Eigen::VectorXd f =
      fem::point_forces(b.model, std::vector<Index>{nodes.front(), nodes.back()}, {0, 0, force}, false);
  f += fem::point_forces(b.model, std::vector<Index>{nodes[5]}, {0, 0, -2.0 * force}, false);
  const Eigen::VectorXd u = fem::static_solution(b.model, part, f);
  const double expected = force * std::pow(0.5 * length, 3) / (3.0 * p.material.young_modulus * p.section.iy);
  EXPECT_NEAR(u[6 * nodes.front() + 2] - u[6 * nodes[5] + 2], expected, round_off * expected);
  const Eigen::VectorXd rigid = fem::rigid_motions(b.model, part).transpose() *
                                fem::mass_times(b.model, part, u.head(6 * (slider + 1)));
  EXPECT_LT(rigid.norm(), round_off * expected);
}

TEST(StaticSolution, RefusesAStiffnessSingularToWorkingPrecision) {
  ModelBuilder b;
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, 4, b.property(tube_property()));
  b.model.springs.push_back({nodes.front(), -1, {1e-12, 1e-12, 1e-12, 1e-12, 1e-12, 1e-12}, {}});
  const auto part = fem::structures(b.model).at(0);
  const Eigen::VectorXd force = fem::point_forces(b.model, nodes, {0, 1, 0}, false);
  EXPECT_THROW((void)fem::static_solution(b.model, part, force), core::ComputationError);
}

TEST(StaticSolution, OfAFineMeshIsNotTakenForSingular) {
  constexpr int elements = 1000;
  ModelBuilder b;
  const auto p = tube_property();
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, elements, b.property(p));
  b.fix(nodes.front(), all);
  const std::vector<Index> tip{nodes.back()};
  const Eigen::VectorXd u = fem::static_solution(b.model, fem::structures(b.model).at(0),
                                                 fem::point_forces(b.model, tip, {0, 1, 0}, false));
  constexpr double conditioned = 1e-3; // round-off times elements^4, with a margin
  EXPECT_NEAR(u[6 * nodes.back() + 1] * 3 * p.material.young_modulus * p.section.iy, 1.0, conditioned);
}

} // namespace petsc_assembly_test
