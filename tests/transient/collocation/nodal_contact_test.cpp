// SPDX-License-Identifier: GPL-3.0-or-later
// The derivatives of the laws at the nodes of a step of collocation, in every branch, against finite differences.
#include "transient/collocation/nodal_contact.hpp"
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace nodal_contact_test {

using namespace fretwork;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::FrictionMemoryKind;

namespace {

using enum NormalBranch;
using enum TangentBranch;

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
      n.axes.ny = 1.0;
      n.penetration = 1e-4 * any(generator) + 0.5e-4;
      n.rate = 0.05 * any(generator);
      n.across = 0.1 * any(generator);
      n.curvature = curvature;
      n.slip = {D == 3 ? support.friction.along.x * 0.1 * any(generator) : 0.0,
                support.friction.along.t * n.across};
    }
    ContactNode& start = nodes[0];
    start.face.ny = any(generator) < -0.8 ? -1.0 : 1.0;
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

constexpr int contacts = 3000;
/// Keys of branches.
int normal_at(int node, int branch) { return 100 * node + branch; }
int tangent_at(int node, int branch) { return 100 * node + 50 + branch; }

/// Compares at many contacts. Returns of how many nodes in each branch.
template <int D>
std::map<int, int> compare(const contact::Support& support, double curvature, const JumpScales& scales) {
  std::mt19937 generator(7);
  const SpringTable table = spring_table(support.friction, h);
  std::map<int, int> nodes_in;
  int compared = 0;
  for (int k = 0; k < contacts; ++k) {
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
    if (!same) // at the edge of a branch
      continue;
    ++compared;
    for (int j = 0; j < 2; ++j) {
      ++nodes_in[normal_at(j, static_cast<int>(laws.normal(j)))];
      ++nodes_in[tangent_at(j, static_cast<int>(laws.tangent(j)))];
    }
    const double size = jacobian.cwiseAbs().maxCoeff();
    EXPECT_LT((jacobian - differences).cwiseAbs().maxCoeff(), 1e-6 * size)
        << "branches " << laws.branches() << "\n"
        << jacobian << "\n\n"
        << differences;
  }
  EXPECT_GT(compared, contacts - contacts / 100);
  return nodes_in;
}

/// Compares, and expects just these branches at both nodes.
template <int D>
void compare_in(const contact::Support& support, std::initializer_list<NormalBranch> normals,
                std::initializer_list<TangentBranch> tangents, double curvature = 0.0,
                const JumpScales& scales = {{1e6, 1e6}, 500.0}) {
  auto nodes_in = compare<D>(support, curvature, scales);
  for (int j = 0; j < 2; ++j) {
    for (const auto normal : normals)
      EXPECT_GT(nodes_in.extract(normal_at(j, static_cast<int>(normal))).mapped(), 5) << j;
    for (const auto tangent : tangents)
      EXPECT_GT(nodes_in.extract(tangent_at(j, static_cast<int>(tangent))).mapped(), 5) << j;
  }
  EXPECT_TRUE(nodes_in.empty()) << nodes_in.begin()->first;
}

template <int D>
void compare_laws(double damping, double dissipation, double tangential, contact::Vec2 along) {
  contact::Support support{contact::Circle{1e-3}, {1e6, damping, dissipation}, {3e5, tangential, 0.4, 0.3}};
  support.friction.along = along;
  const auto in = [&](std::initializer_list<TangentBranch> tangents) {
    if (damping > 0.0)
      compare_in<D>(support, {open, closed, limited}, tangents);
    else
      compare_in<D>(support, {open, closed}, tangents);
  };
  if (D == 2)
    in({none, stick, line});
  else if (tangential > 0.0)
    in({none, stick, trial, relaxed});
  else
    in({none, stick, trial});
  support.friction.kind = FrictionMemoryKind::reference;
  in({none, stick, opposed, rest});
}

} // namespace

TEST(NodalContact, HasTheDerivativesOfItsLawsInEveryBranch) {
  for (const double damping : {0.0, 200.0})
    for (const double dissipation : {0.0, 2.0})
      for (const double tangential : {0.0, 150.0}) {
        compare_laws<2>(damping, dissipation, tangential, {1.0, 1.0});
        for (const contact::Vec2 along : {contact::Vec2{1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}})
          compare_laws<3>(damping, dissipation, tangential, along);
      }
  compare_in<2>({contact::Circle{1e-3}, {1e6}, {}}, {open, closed}, {none});
}

// Where the laws do not feel the forces tried, which turn with the normal too.
TEST(NodalContact, HasThemWhereTheNormalTurns) {
  for (const double curvature : {-1000.0, 300.0}) {
    compare_in<2>({contact::Circle{1e-3}, {1e6}, {}}, {open, closed}, {none}, curvature);
    compare_in<2>({contact::Circle{1e-3}, {1e6, 0.0, 2.0}, {3e5, 0.0, 0.4, 0.3}}, {open, closed},
                  {none, stick, line}, curvature, {{0.0, 0.0}, 500.0});
  }
}

} // namespace nodal_contact_test
