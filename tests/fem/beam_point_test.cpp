// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include "fem/beam_element.hpp"
#include "fem/beam_point.hpp"
#include <gtest/gtest.h>

namespace fretwork::fem::beam_point_test {
namespace {

constexpr double rounding = 1e-13; ///< of sums of a dozen terms of order 1
constexpr double solved = 1e-10;   ///< relative: a 6 x 6 system of stiffnesses that differ by 1e3
const Vec3 axis = Vec3(2.0, -1.0, 3.0).normalized();

/// A chain along an oblique axis, elements of different lengths, some given from the far end.
Model chain() {
  Model model;
  for (const double x : {0.0, 0.4, 0.7, 1.5, 1.9})
    model.nodes.push_back(Vec3(0.1, 0.2, 0.3) + x * axis);
  model.properties = {{{2e11, 0.3, 7800.0}, {1e-3, 2e-7, 2e-7, 4e-7, 4e-7}}};
  model.beams = {{0, 1, 0}, {2, 1, 0}, {2, 3, 0}, {4, 3, 0}};
  model.fixed.assign(model.nodes.size(), 0);
  return model;
}

/// Motion of a point, where `dofs` gives the six dofs of a node.
template <class Dofs> Vec3 moved(const BeamPoint& point, Dofs dofs) {
  Vec3 sum = Vec3::Zero();
  for (const NodeShare& share : point.motion)
    sum += share.weights * dofs(share.node);
  return sum;
}

using Six = Eigen::Matrix<double, 6, 1>;

TEST(BeamPoint, OfANodeIsTheNode) {
  const Model model = chain();
  const BeamPoint point = point_at(model, 2);
  EXPECT_EQ(point.place, model.nodes[2]);
  const Six dofs = (Six() << 1, 2, 3, 4, 5, 6).finished();
  EXPECT_EQ(moved(point, [&](Index) { return dofs; }), Vec3(1, 2, 3));
}

TEST(BeamPoint, FollowsRigidMotions) {
  const Model model = chain();
  const Vec3 u(0.3, -0.2, 0.5), turn(0.7, 0.1, -0.4);
  const auto rigid = [&](Index node) {
    Six dofs;
    dofs << u + turn.cross(model.nodes[static_cast<std::size_t>(node)]), turn;
    return dofs;
  };
  for (const double s : {0.0, 0.2, 0.5, 0.9, 1.0})
    for (const Beam& beam : model.beams) {
      const BeamPoint point = point_on(model, beam, s);
      EXPECT_LT((moved(point, rigid) - (u + turn.cross(point.place))).norm(), rounding) << s;
    }
}

TEST(BeamPoint, MovesAsANodeThereWithoutLoad) {
  // two elements in place of one: the middle node without force goes where the point goes
  const Material steel{2e11, 0.3, 7800.0};
  const BeamProperty property{
      steel, {1e-3, 2e-7, 5e-7, 1e-7, 7e-7}, 0.0, AddedMass::transverse, Vec3(0.0, 0.3, 1.0)};
  const Vec3 a(0.1, 0.2, 0.3), b = a + 1.7 * axis;
  Model model;
  model.nodes = {a, b};
  model.properties = {property};
  const Vector12 ends = (Vector12() << 1, 2, -1, 0.3, 0.2, -0.5, -2, 0.5, 1, 0.7, -0.1, 0.4).finished();
  for (const double s : {0.2, 0.5, 0.8}) {
    const Vec3 middle = a + s * (b - a);
    const Matrix12 left = BeamElement(a, middle, property).stiffness();
    const Matrix12 right = BeamElement(middle, b, property).stiffness();
    const Eigen::Matrix<double, 6, 6> own = left.bottomRightCorner<6, 6>() + right.topLeftCorner<6, 6>();
    const Six force =
        left.bottomLeftCorner<6, 6>() * ends.head<6>() + right.topRightCorner<6, 6>() * ends.tail<6>();
    const Six free = -core::Cholesky(own).solve(force);
    const BeamPoint point = point_on(model, {0, 1, 0}, s);
    const Vec3 found =
        moved(point, [&](Index node) { return node == 0 ? Six(ends.head<6>()) : Six(ends.tail<6>()); });
    EXPECT_LT((found - free.head<3>()).norm(), solved * free.head<3>().norm()) << s;
    EXPECT_LT((point.place - middle).norm(), rounding);
  }
}

TEST(BeamPoint, IsFoundAlongAChain) {
  const Model model = chain();
  for (const double distance : {0.0, 0.1, 0.3, 0.5, 0.8, 1.0, 1.2}) {
    const BeamPoint point = point_along(model, 2, axis, distance, "x");
    EXPECT_LT((point.place - (model.nodes[2] + distance * axis)).norm(), rounding) << distance;
    // the weights belong to that place: a rigid turn moves it as such
    const Vec3 turn(0.2, 0.5, -0.3);
    const auto rigid = [&](Index node) {
      Six dofs;
      dofs << turn.cross(model.nodes[static_cast<std::size_t>(node)]), turn;
      return dofs;
    };
    EXPECT_LT((moved(point, rigid) - turn.cross(point.place)).norm(), rounding) << distance;
  }
  EXPECT_LT((point_along(model, 2, -axis, 0.6, "x").place - (model.nodes[2] - 0.6 * axis)).norm(), rounding);
}

TEST(BeamPoint, AtANodeIsTheNodeDespiteRounding) {
  const Model model = chain();
  EXPECT_EQ(point_along(model, 2, -axis, 0.7 * (1.0 + 1e-15), "x").motion.size(), 1u);
  EXPECT_EQ(point_along(model, 2, axis, 1.2 * (1.0 - 1e-15), "x").motion.size(), 1u);
  EXPECT_EQ(point_along(model, 2, axis, 1.2 * (1.0 - 1e-6), "x").motion.size(), 2u);
}

std::string message(const Model& model, Index node, const Vec3& direction, double distance) {
  try {
    (void)point_along(model, node, direction, distance, "contact \"tsp\"");
  } catch (const core::Error& error) {
    return error.what();
  }
  return {};
}

TEST(BeamPoint, SaysWhereTheBeamEndsOrBranches) {
  Model model = chain();
  EXPECT_NE(message(model, 2, axis, 1.3).find("contact \"tsp\": the beam ends at "), std::string::npos);
  EXPECT_NE(message(model, 2, axis, 1.3).find("1.2 m from its node, before the edge of the support at 1.3 m"),
            std::string::npos)
      << message(model, 2, axis, 1.3);
  EXPECT_NE(message(model, 0, -axis, 0.1).find("contact \"tsp\": no beam leaves its node at (0.1, 0.2, 0.3)"),
            std::string::npos)
      << message(model, 0, -axis, 0.1);
  model.nodes.push_back(model.nodes[3] + Vec3(0.0, 1.0, 0.0));
  model.beams.push_back({3, 5, 0});
  EXPECT_NE(message(model, 2, axis, 0.9).find("the beam branches at "), std::string::npos);
  EXPECT_EQ(message(model, 2, axis, 0.8), "") << "the branch itself is still on the beam";
}

} // namespace
} // namespace fretwork::fem::beam_point_test
