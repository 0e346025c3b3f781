// SPDX-License-Identifier: GPL-3.0-or-later
// What modes lack of a static flexibility: nothing where all are kept, what the others give where some are left out.
#include "../fem/model_builder.hpp"
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include "fem/inner_motion.hpp"
#include "fem/petsc_static.hpp"
#include "modal/static_flexibility.hpp"
#include "solve.hpp"
#include <gtest/gtest.h>

namespace static_flexibility_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

constexpr double all_modes = 1e9;  // Hz
constexpr double round_off = 1e-9; ///< of the shapes of a dense solve

/// A beam held as given, loaded at three of its nodes along y.
struct Loaded {
  ModelBuilder b;
  fem::Structure part;
  Eigen::MatrixXd forces, exact;

  explicit Loaded(unsigned restraints) {
    const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, 12, b.property(tube_property()));
    b.fix(nodes.front(), restraints);
    part = fem::structures(b.model).at(0);
    forces = Eigen::MatrixXd::Zero(6 * 13, 3);
    for (Eigen::Index k = 0; k < 3; ++k)
      forces(6 * (4 * (k + 1)) + 1, k) = 1.0;
    exact = forces.transpose() * fem::StaticSolver(b.model, part).solve(forces);
  }
};

Eigen::MatrixXd nothing(const Eigen::MatrixXd& like) {
  return Eigen::MatrixXd::Zero(like.rows(), like.cols());
}

} // namespace

TEST(StaticFlexibility, OfAllModesIsExactForHeldAndFreeStructures) {
  for (const unsigned restraints : {unsigned{all}, 0u, unsigned{ux | uy | uz | rx | ry}}) {
    const Loaded beam(restraints);
    const auto basis = solve_up_to(beam.b.model, all_modes);
    const Eigen::MatrixXd share = modal::flexibility_of(basis, beam.forces);
    EXPECT_LT((share - beam.exact).cwiseAbs().maxCoeff(), round_off * beam.exact.maxCoeff()) << restraints;
    EXPECT_EQ(modal::missing_flexibility(beam.exact, share, nothing(share)).cwiseAbs().maxCoeff(), 0.0)
        << "all of it is round-off";
  }
}

TEST(StaticFlexibility, MissingIsTheShareOfTheModesLeftOut) {
  for (const unsigned restraints : {unsigned{all}, 0u}) {
    const Loaded beam(restraints);
    const auto whole = solve_up_to(beam.b.model, all_modes);
    auto some = whole;
    const Eigen::Index kept = 14, left = whole.size() - kept;
    some.shapes = whole.shapes.leftCols(kept);
    some.omega = whole.omega.head(kept);
    auto rest = whole;
    rest.shapes = whole.shapes.rightCols(left);
    rest.omega = whole.omega.tail(left);
    const Eigen::MatrixXd missing =
        modal::missing_flexibility(beam.exact, modal::flexibility_of(some, beam.forces), nothing(beam.exact));
    EXPECT_LT((missing - modal::flexibility_of(rest, beam.forces)).cwiseAbs().maxCoeff(),
              round_off * beam.exact.maxCoeff());
    EXPECT_GT(missing.maxCoeff(), 1e3 * round_off * beam.exact.maxCoeff()) << "something is missing";
  }
}

TEST(StaticFlexibility, MissingIsSymmetricAndNeverNegative) {
  Eigen::Matrix3d exact, basis;
  exact << 4.0, 1.0, 0.0, 1.0, 2.0, 0.0, 0.0, 0.0, 0.0; // the third direction is restrained
  basis << 3.0, 1.0 + 1e-12, 0.0, 1.0, 2.0 + 1e-10, 0.0, 0.0, 0.0, 0.0;
  const Eigen::MatrixXd missing = modal::missing_flexibility(exact, basis, nothing(exact));
  EXPECT_EQ(missing, missing.transpose());
  EXPECT_GE(core::symmetric_eigenvalues(missing).minCoeff(), -1e-15);
  EXPECT_NEAR(missing(0, 0), 1.0, round_off);
  EXPECT_EQ(missing.row(2).norm(), 0.0);
}

/// A soft and a stiff direction are judged each by its own flexibility.
TEST(StaticFlexibility, KeepsWhatIsMissingInAStiffDirection) {
  const Eigen::MatrixXd exact = Eigen::Vector2d(1.0, 1e-12).asDiagonal(),
                        basis = Eigen::Vector2d(1.0 + 1e-10, 0.5e-12).asDiagonal();
  const Eigen::MatrixXd missing = modal::missing_flexibility(exact, basis, nothing(exact));
  EXPECT_EQ(missing(0, 0), 0.0);
  EXPECT_NEAR(missing(1, 1), 0.5e-12, 1e-20);
}

TEST(StaticFlexibility, RefusesModesSofterThanTheStructure) {
  const Eigen::MatrixXd exact = Eigen::MatrixXd::Constant(1, 1, 1.0), basis = 1.01 * exact;
  try {
    (void)modal::missing_flexibility(exact, basis, nothing(exact));
    ADD_FAILURE() << "no error";
  } catch (const core::ComputationError& error) {
    EXPECT_NE(std::string(error.what()).find("the modes are softer than the structure by 0.01 of it"),
              std::string::npos)
        << error.what();
  }
}

/// A rod of few elements on a spring, pressed along its axis there: all of its modes are softer than statics, by what the motion
/// inside the beams takes from their frequencies. That is not round-off, and nothing is missing.
TEST(StaticFlexibility, TakesMotionInsideBeamsForNoRoundOff) {
  constexpr int elements = 3;
  ModelBuilder b;
  const auto p = tube_property();
  const auto nodes = b.line({0, 0, 0}, {1, 0, 0}, elements, b.property(p));
  b.fix_everywhere(uy | uz | rx | ry | rz);
  b.fix(nodes.front(), all);
  b.model.springs.push_back({nodes.back(), -1, {3.0 * p.material.young_modulus * p.section.area}});
  const auto part = fem::structures(b.model).at(0);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(6 * (elements + 1), 1);
  force(6 * elements, 0) = 1.0;
  const Eigen::MatrixXd exact = force.transpose() * fem::StaticSolver(b.model, part).solve(force);
  const auto basis = solve_up_to(b.model, all_modes);
  const Eigen::MatrixXd share = modal::flexibility_of(basis, force);
  EXPECT_GT(share(0, 0), 1.001 * exact(0, 0));
  EXPECT_LT(share(0, 0), 1.05 * exact(0, 0)); // of a mode by 5 % at most
  EXPECT_THROW((void)modal::missing_flexibility(exact, share, nothing(share)), core::ComputationError);
  const auto inner =
      modal::inner_flexibility(basis, force, fem::largest_inner_changes(b.model, part, basis.omega));
  EXPECT_EQ(modal::missing_flexibility(exact, share, inner)(0, 0), 0.0);
}

} // namespace static_flexibility_test
