// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/near_nodes.hpp"
#include "mesh_files.hpp"
#include <random>

namespace fretwork::mesh::test::near_nodes_test {
namespace {

using Pairs = std::vector<std::pair<Index, Index>>;

std::vector<Vec3> random_nodes(int count) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  std::vector<Vec3> nodes;
  for (int i = 0; i < count; ++i)
    nodes.emplace_back(coordinate(engine), coordinate(engine), coordinate(engine));
  return nodes;
}

TEST(NearPairs, AreThoseOfTheDirectSearch) {
  const auto nodes = random_nodes(400);
  for (const double distance : {0.02, 0.1, 0.5, 3.0}) {
    Pairs direct;
    for (Index i = 0; i < 400; ++i)
      for (Index j = i + 1; j < 400; ++j)
        if ((nodes[i] - nodes[j]).norm() <= distance)
          direct.emplace_back(i, j);
    EXPECT_EQ(near_pairs(nodes, distance), direct) << distance;
  }
}

TEST(NearPairs, FindExactlyCoincidentNodesAtDistanceZero) {
  const std::vector<Vec3> nodes{{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {5, 5, 5}};
  EXPECT_EQ(near_pairs(nodes, 0.0), (Pairs{{0, 2}}));
  EXPECT_EQ(near_pairs(std::vector<Vec3>(3, Vec3(1, 1, 1)), 0.0), (Pairs{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_TRUE(near_pairs(std::vector<Vec3>{{1, 1, 1}}, 1.0).empty());
}

TEST(NearPairs, StandADistanceFarBelowTheExtent) {
  const std::vector<Vec3> nodes{{0, 0, 0}, {1e6, 0, 0}, {1e6, 0, 0}};
  EXPECT_EQ(near_pairs(nodes, 1e-300), (Pairs{{1, 2}}));
}

RawMesh two_lines(double gap) {
  RawMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1 + gap, 0, 0}, {2, 0, 0}};
  mesh.lines = {{{0, 1}, -1}, {{2, 3}, -1}};
  mesh.curves = {{"tube", {0, 1}}};
  mesh.points = {{"joint", {2}}};
  return mesh;
}

TEST(MergeNodes, TakesTheSmallestPosition) {
  RawMesh mesh = two_lines(1e-4);
  EXPECT_EQ(merge_nodes(mesh, 1e-3), 1u);
  EXPECT_EQ(mesh.lines[1].nodes, (std::array<Index, 2>{1, 3}));
  EXPECT_EQ(mesh.points["joint"], (std::vector<Index>{1}));
}

TEST(MergeNodes, LeavesNodesFartherApartThanTheTolerance) {
  RawMesh mesh = two_lines(2e-3);
  EXPECT_EQ(merge_nodes(mesh, 1e-3), 0u);
}

TEST(MergeNodes, RefusesAToleranceLongerThanALine) {
  RawMesh mesh = two_lines(1e-4);
  const auto message = message_of([&] { merge_nodes(mesh, 1.5); });
  EXPECT_TRUE(
      says(message,
           "merge_tolerance = 1.5 m is more than the length 1 m of line (0, 0, 0)-(1, 0, 0) of \"tube\""));
}

TEST(MergeNodes, RefusesToCollapseALineThroughAChainOfNodes) {
  RawMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}};
  mesh.lines = {{{0, 1}, -1}};
  mesh.points = {{"between", {2}}};
  const auto message = message_of([&] { merge_nodes(mesh, 0.6); });
  EXPECT_TRUE(
      says(message, "merge_tolerance = 0.6 m makes one node of both ends of line (0, 0, 0)-(1, 0, 0)"));
}

} // namespace
} // namespace fretwork::mesh::test::near_nodes_test
