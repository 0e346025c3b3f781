// SPDX-License-Identifier: GPL-3.0-or-later
// The derivatives of the laws at the nodes of a step of collocation, in every branch, against finite differences.
#include "transient/nodal_contact.hpp"
#include <gtest/gtest.h>
#include <map>
#include <random>

using namespace fretwork;
using namespace fretwork::transient;
using contact::FrictionMemoryKind;

namespace {

constexpr double h = 1e-3;

template <int D> using Row = typename NodalContact<D>::Row;

/// A contact at random: how it moves at the nodes without the forces tried, and how it answers these.
template <int D> struct Random {
  ContactNode nodes[3];
  Answer<D> answer;
  Row<D> forces;
  explicit Random(std::mt19937& generator, const contact::Support& support, double curvature) {
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int j = 0; j < 3; ++j) {
      ContactNode& n = nodes[j];
      n.ny = 1.0;
      n.penetration = 1e-4 * any(generator) + 0.5e-4;
      n.rate = 0.05 * any(generator);
      n.across = 0.1 * any(generator);
      n.curvature = curvature;
      n.slip = {D == 3 ? support.friction.along.x * 0.1 * any(generator) : 0.0,
                support.friction.along.t * n.across};
    }
    ContactNode& start = nodes[0];
    start.face_y = any(generator) < -0.8 ? -1.0 : 1.0;
    start.slides = any(generator) > 0.0;
    start.spring = {D == 3 ? 20.0 * any(generator) : 0.0, 20.0 * any(generator)};
    start.friction = start.spring;
    for (Eigen::Index i = 0; i < 2 * D; ++i)
      forces[i] = 60.0 * any(generator);
    for (int j = 0; j < 2; ++j)
      for (int a = 0; a < D; ++a)
        for (Eigen::Index i = 0; i < 2 * D; ++i) {
          answer.u[j][a][i] = 1e-6 * any(generator);
          answer.v[j][a][i] = 2e-3 * any(generator);
        }
  }
  /// The laws where the forces have changed and the contact has moved with them.
  NodalContact<D> at(const contact::Support& support, const SpringTable& table, const JumpScales& scales,
                     const Row<D>& change, ContactNode* moved) const {
    std::copy_n(nodes, 3, moved);
    for (int j = 0; j < 2; ++j) {
      ContactNode& n = moved[j + 1];
      const double along = (answer.u[j][1] * change).sum(), turn = n.curvature * along, rate = n.rate;
      n.penetration -= (answer.u[j][0] * change).sum();
      n.rate += -(answer.v[j][0] * change).sum() - turn * n.across;
      n.across += (answer.v[j][1] * change).sum() + turn * rate;
      n.slip.t = support.friction.along.t * n.across;
      if constexpr (D == 3)
        n.slip.x += support.friction.along.x * (answer.v[j][2] * change).sum();
    }
    return {support, table, moved, forces + change, scales};
  }
};

/// Forces - laws, along the directions of the nodes before they turned.
template <int D>
Row<D> residual(const NodalContact<D>& laws, const Random<D>& random, const Row<D>& change,
                const ContactNode* moved) {
  Row<D> out = laws.forces();
  for (int j = 0; j < 2; ++j) {
    const ContactNode& n = moved[j + 1];
    const double turn = n.curvature * (random.answer.u[j][1] * change).sum();
    out[j * D] -= n.normal - turn * n.friction.t;
    out[j * D + 1] -= n.friction.t + turn * n.normal;
    if constexpr (D == 3)
      out[j * D + 2] -= n.friction.x;
  }
  return out;
}

/// Compares at many contacts. Returns how many there were in each branch.
template <int D>
std::map<int, int> compare(const contact::Support& support, double curvature, const JumpScales& scales) {
  std::mt19937 generator(7);
  const SpringTable table = spring_table(support.friction, h);
  std::map<int, int> branches;
  for (int k = 0; k < 3000; ++k) {
    const Random<D> random(generator, support, curvature);
    ContactNode nodes[3], moved[3];
    const NodalContact<D> laws = random.at(support, table, scales, Row<D>::Zero(), nodes);
    const auto jacobian = laws.jacobian(random.answer);
    bool same = true;
    Eigen::Matrix<double, 2 * D, 2 * D> differences;
    const double e = 1e-4; // N
    for (Eigen::Index i = 0; i < 2 * D; ++i) {
      Row<D> change = Row<D>::Zero(), ends[2];
      for (int side = 0; side < 2; ++side) {
        change[i] = side == 0 ? -e : e;
        const NodalContact<D> there = random.at(support, table, scales, change, moved);
        same = same && there.branches() == laws.branches();
        ends[side] = residual(there, random, change, moved);
      }
      differences.col(i) = (ends[1] - ends[0]).matrix() / (2.0 * e);
    }
    if (!same)
      continue;
    ++branches[laws.branches()];
    const double size = jacobian.cwiseAbs().maxCoeff();
    EXPECT_LT((jacobian - differences).cwiseAbs().maxCoeff(), 1e-6 * size)
        << "branches " << laws.branches() << "\n"
        << jacobian << "\n\n"
        << differences;
  }
  return branches;
}

constexpr JumpScales scales{{1e6, 1e6}, 500.0};

} // namespace

TEST(NodalContact, HasTheDerivativesOfItsLawsInEveryBranch) {
  for (const double damping : {0.0, 200.0})
    for (const double dissipation : {0.0, 2.0})
      for (const auto kind : {FrictionMemoryKind::return_map, FrictionMemoryKind::reference})
        for (const double tangential : {0.0, 150.0})
          for (const contact::Vec2 along : {contact::Vec2{1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}) {
            const contact::Support support{
                contact::Circle{1e-3}, {1e6, damping, dissipation}, {3e5, tangential, 0.4, 0.3, kind, along}};
            // open, closed and limited at each of the nodes, with every kind of friction that the law has
            const bool held = along.t == 1.0;
            EXPECT_GE(compare<3>(support, 0.0, scales).size(), 9u);
            if (held) {
              EXPECT_GE(compare<2>(support, 0.0, scales).size(), 9u);
            }
          }
  const contact::Support smooth{contact::Circle{1e-3}, {1e6}, {}};
  EXPECT_EQ(compare<2>(smooth, 0.0, scales).size(), 4u);
}

// Where the laws do not feel the forces tried, which turn with the normal too.
TEST(NodalContact, HasThemWhereTheNormalTurns) {
  for (const double curvature : {-1000.0, 300.0}) {
    EXPECT_EQ(compare<2>({contact::Circle{1e-3}, {1e6}, {}}, curvature, scales).size(), 4u);
    EXPECT_GE(compare<2>({contact::Circle{1e-3}, {1e6, 0.0, 2.0}, {3e5, 0.0, 0.4, 0.3}}, curvature,
                         {{0.0, 0.0}, 500.0})
                  .size(),
              6u);
  }
}
