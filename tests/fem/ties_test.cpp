// SPDX-License-Identifier: GPL-3.0-or-later
#include "expect_error.hpp"
#include "fem/fields.hpp"
#include "fem/node_blocks.hpp"
#include "fem/rigid_motions.hpp"
#include "fem/ties.hpp"
#include "model_builder.hpp"

namespace ties_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

/// Two tubes along x, from 0 to 1 and from 1 to 2; nodes 4 and 5 at x = 1.
ModelBuilder two_tubes(unsigned tied) {
  ModelBuilder b;
  const Index p = b.property(tube_property());
  b.line({0, 0, 0}, {1, 0, 0}, 4, p);
  b.line({1, 0, 0}, {2, 0, 0}, 4, p);
  b.model.ties.push_back({5, 4, static_cast<std::uint8_t>(tied)});
  return b;
}

Index equation(const fem::Structure& part, Index node, int d) {
  return part.equation[static_cast<std::size_t>(fem::position_of(part, node) * 6 + d)];
}

} // namespace

TEST(Ties, ShareOneEquation) {
  const auto b = two_tubes(ux | uz | rx);
  const auto parts = fem::structures(b.model);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].equations, 10 * 6 - 3);
  for (const int d : {0, 2, 3})
    EXPECT_EQ(equation(parts[0], 4, d), equation(parts[0], 5, d));
  for (const int d : {1, 4, 5})
    EXPECT_NE(equation(parts[0], 4, d), equation(parts[0], 5, d));
  EXPECT_TRUE(fem::is_chain(b.model, parts[0]));
}

TEST(Ties, SaidTwiceOrInARingChangeNothing) {
  auto b = two_tubes(uy);
  b.line({1, 0, 0}, {1, 1, 0}, 2, 0); // nodes 10 to 12
  b.model.ties.push_back({10, 5, uy});
  const Index equations = fem::structures(b.model).at(0).equations;
  EXPECT_EQ(equations, 13 * 6 - 2);
  b.model.ties.push_back({4, 10, uy});
  b.model.ties.push_back({4, 5, uy});
  EXPECT_EQ(fem::structures(b.model).at(0).equations, equations);
  EXPECT_FALSE(fem::is_chain(b.model, fem::structures(b.model).at(0)));
}

TEST(Ties, OfRestrainedDofsConnectNothing) {
  auto b = two_tubes(uz);
  b.fix(4, uz);
  b.fix(5, uz);
  const auto parts = fem::structures(b.model);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_TRUE(parts[0].ties.empty() && parts[1].ties.empty());
}

TEST(Ties, RestrainWhatIsTiedToARestrainedDof) {
  auto b = two_tubes(uy | uz);
  b.line({1, 0, 0}, {1, 1, 0}, 2, 0);
  b.model.ties.push_back({10, 5, uz});
  b.fix(10, uz | rx);
  expect_error([&] { (void)fem::structures(b.model); },
               {"tie of the nodes at (1, 0, 0) and (1, 0, 0)", "uz", "restrain it at both"});
  fem::restrain_tied(b.model);
  EXPECT_EQ(b.model.fixed[4], uz);
  EXPECT_EQ(b.model.fixed[5], uz);
  EXPECT_EQ(b.model.fixed[10], uz | rx);
  EXPECT_EQ(fem::structures(b.model).size(), 2u);
}

TEST(Ties, GiveAPointItsMass) {
  auto b = two_tubes(ux | uy | uz);
  const Index point = b.node({1, 0, 0});
  b.fix(point, rx | ry | rz);
  expect_error([&] { (void)fem::structures(b.model); }, {"ux is free but nothing there has mass"});
  b.model.ties.push_back({point, 4, ux | uy | uz});
  EXPECT_EQ(fem::structures(b.model).at(0).equations, 10 * 6 - 3);
}

TEST(Ties, AddUpForces) {
  const auto b = two_tubes(uy);
  const auto part = fem::structures(b.model).at(0);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(60, 1);
  force(4 * 6 + 1) = 2.0;
  force(5 * 6 + 1) = 3.0;
  force(5 * 6 + 2) = 7.0;
  const Eigen::MatrixXd sums = fem::forces_on_equations(part, force);
  EXPECT_EQ(sums.rows(), 59);
  EXPECT_EQ(sums(equation(part, 4, 1)), 5.0);
  EXPECT_EQ(sums(equation(part, 5, 2)), 7.0);
  EXPECT_EQ(sums.sum(), 12.0);
}

TEST(Ties, CarryAFieldFromOneNodeToTheOther) {
  auto b = two_tubes(uy | rz);
  b.line({1, 0, 0}, {1, 1, 0}, 2, 0);
  b.model.ties.push_back({10, 5, uy});
  for (const Index given : {4, 5, 10}) {
    Eigen::VectorXd field = Eigen::VectorXd::Zero(13 * 6);
    field.segment<3>(given * 6) = Vec3(1, 2, 3);
    field[7] = 0.5;
    std::vector<bool> given_at(13 * 6, false);
    std::fill_n(given_at.begin() + given * 6, 3, true);
    fem::follow_ties(b.model, given_at, field);
    for (const Index node : {4, 5, 10})
      EXPECT_EQ(field[node * 6 + 1], 2.0);
    EXPECT_EQ(field.sum(), 0.5 + 1 + 3 * 2 + 3);
  }
}

TEST(Ties, GivenZerosAreFollowedAndWhatDiffersIsRefused) {
  const auto b = two_tubes(uy);
  Eigen::VectorXd field = Eigen::VectorXd::Zero(10 * 6);
  std::vector<bool> given(10 * 6, false);
  field(5 * 6 + 1) = 2.0; // not given: of no account
  given[4 * 6 + 1] = true;
  fem::follow_ties(b.model, given, field);
  EXPECT_EQ(field(5 * 6 + 1), 0.0);
  given[5 * 6 + 1] = true;
  field(4 * 6 + 1) = field(5 * 6 + 1) = 3.0;
  fem::follow_ties(b.model, given, field);
  EXPECT_EQ(field(4 * 6 + 1), 3.0);
  field(5 * 6 + 1) = 4.0;
  expect_error(
      [&] { fem::follow_ties(b.model, given, field); },
      {"uy is tied between the nodes at (1, 0, 0) and (1, 0, 0), but given as 3 and 4", "the same value"});
}

// Motions without strain of a clamped tube and one tied to it: those that the tie leaves.
TEST(RigidMotions, KnowBallHingeSlideAndRigidJoint) {
  const auto left = [](unsigned tied) {
    auto b = two_tubes(tied);
    b.fix(0, all);
    return fem::rigid_motions(b.model, fem::structures(b.model).at(0)).cols();
  };
  EXPECT_EQ(left(ux | uy | uz), 3);
  EXPECT_EQ(left(all & ~static_cast<unsigned>(rz)), 1);
  EXPECT_EQ(left(all & ~static_cast<unsigned>(uy)), 1);
  EXPECT_EQ(left(uz), 5);
  EXPECT_EQ(left(all), 0);
  const auto free = two_tubes(ux | uy | uz);
  const auto part = fem::structures(free.model).at(0);
  const Eigen::MatrixXd fields = fem::rigid_motions(free.model, part);
  EXPECT_EQ(fields.cols(), 9);
  constexpr double round_off = 1e-13; // of fields of order 1
  EXPECT_LT((fields.middleRows(24, 3) - fields.middleRows(30, 3)).cwiseAbs().maxCoeff(), round_off);
}

} // namespace ties_test
