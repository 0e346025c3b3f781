// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/canonical_order.hpp"
#include "mesh_files.hpp"
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace fretwork::mesh::test::canonical_order_test {
namespace {

/// A mesh under construction: its node and line numbers mean nothing.
struct Builder {
  RawMesh mesh;

  Index node(double x, double y, double z) {
    mesh.nodes.emplace_back(x, y, z);
    return static_cast<Index>(mesh.nodes.size() - 1);
  }
  Index line(Index a, Index b, Index middle = -1) {
    mesh.lines.push_back({{a, b}, middle});
    return static_cast<Index>(mesh.lines.size() - 1);
  }
};

RawMesh helix(int lines) {
  Builder b;
  for (int i = 0; i <= lines; ++i)
    b.node(std::cos(0.3 * i), std::sin(0.3 * i), 0.01 * i);
  for (int i = 0; i < lines; ++i)
    b.mesh.curves["helix"].push_back(b.line(i, i + 1));
  b.mesh.points["top"] = {static_cast<Index>(lines)};
  return b.mesh;
}

RawMesh ring(int lines) {
  Builder b;
  for (int i = 0; i < lines; ++i)
    b.node(std::cos(2 * std::numbers::pi * i / lines), std::sin(2 * std::numbers::pi * i / lines), 0.0);
  for (int i = 0; i < lines; ++i)
    b.mesh.curves["ring"].push_back(b.line(i, (i + 1) % lines));
  return b.mesh;
}

/// n x n nodes: junctions of three and four lines, and a mass apart from all.
RawMesh grid(int n) {
  Builder b;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      b.node(i, 1.5 * j, 0.0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (i + 1 < n)
        b.mesh.curves["x"].push_back(b.line(i * n + j, (i + 1) * n + j));
      if (j + 1 < n)
        b.mesh.curves["y"].push_back(b.line(i * n + j, i * n + j + 1));
    }
  b.mesh.points["mass"] = {b.node(-1, -1, -1)};
  b.mesh.points["other mass"] = {b.node(0.5, 7, 7)};
  return b.mesh;
}

/// Order 2: a tube, a loop that hangs on it, and two tubes that coincide node for node but have their own
/// names.
RawMesh mixed() {
  Builder b;
  const Index foot = b.node(0, 0, 0), top = b.node(0, 0, 1), middle = b.node(0, 0.02, 0.5);
  b.mesh.curves["tube"] = {b.line(foot, top, middle)};
  Index last = top;
  for (int i = 1; i < 6; ++i) {
    const Index next = b.node(0.2 * i, 0.1 * i * (6 - i), 1 + 0.05 * i * (6 - i));
    b.mesh.curves["loop"].push_back(b.line(last, next));
    last = next;
  }
  b.mesh.curves["loop"].push_back(b.line(last, top));
  for (const char* name : {"first twin", "second twin"}) {
    Index from = b.node(3, 0, 0);
    for (int i = 1; i < 4; ++i) {
      const Index to = b.node(3, 0, i);
      b.mesh.curves[name].push_back(b.line(from, to));
      from = to;
    }
  }
  return b.mesh;
}

/// The same mesh with its nodes and lines in another order and half of its lines turned round.
RawMesh shuffled(const RawMesh& mesh, unsigned seed) {
  std::mt19937 engine(seed);
  const auto permutation = [&](std::size_t count) {
    std::vector<Index> p(count);
    std::iota(p.begin(), p.end(), Index{0});
    std::shuffle(p.begin(), p.end(), engine);
    return p;
  };
  const auto node = permutation(mesh.nodes.size()), line = permutation(mesh.lines.size());
  RawMesh out = mesh;
  for (std::size_t i = 0; i < node.size(); ++i)
    out.nodes[node[i]] = mesh.nodes[i];
  for (std::size_t i = 0; i < line.size(); ++i) {
    const RawLine& old = mesh.lines[i];
    RawLine& moved = out.lines[line[i]];
    moved = {{node[old.nodes[0]], node[old.nodes[1]]}, old.middle < 0 ? -1 : node[old.middle]};
    if (engine() % 2 == 0)
      std::swap(moved.nodes[0], moved.nodes[1]);
  }
  for (auto& [name, members] : out.points)
    for (Index& member : members)
      member = node[member];
  for (auto& [name, members] : out.curves) {
    for (Index& member : members)
      member = line[member];
    std::shuffle(members.begin(), members.end(), engine);
  }
  return out;
}

std::string as_text(const RawMesh& mesh) {
  std::string names, nodes, elements;
  int tag = 0;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    nodes += fmt::format("{} {} {} {}\n", i + 1, mesh.nodes[i].x(), mesh.nodes[i].y(), mesh.nodes[i].z());
  for (const auto& [name, members] : mesh.points) {
    names += fmt::format("0 {} \"{}\"\n", ++tag, name);
    for (const Index member : members)
      elements += fmt::format("15 {} {}\n", tag, member + 1);
  }
  for (const auto& [name, members] : mesh.curves) {
    names += fmt::format("1 {} \"{}\"\n", ++tag, name);
    for (const Index member : members) {
      const auto& [ends, middle] = mesh.lines[member];
      elements += fmt::format("{} {} {} {}", middle < 0 ? 1 : 8, tag, ends[0] + 1, ends[1] + 1);
      elements += middle < 0 ? "\n" : fmt::format(" {}\n", middle + 1);
    }
  }
  return msh22(names, nodes, elements);
}

class AnyOrder : public MeshFiles {
protected:
  void expect_same(const RawMesh& mesh) const {
    const LineMesh reference = read_text(as_text(mesh));
    ASSERT_EQ(reference.lines.size(), mesh.lines.size());
    for (unsigned seed = 1; seed <= 20; ++seed)
      EXPECT_TRUE(same_mesh(read_text(as_text(shuffled(mesh, seed))), reference)) << "seed " << seed;
  }
};

TEST_F(AnyOrder, GivesTheSameChain) { expect_same(helix(60)); }
TEST_F(AnyOrder, GivesTheSameRing) { expect_same(ring(24)); }
TEST_F(AnyOrder, GivesTheSameGrid) { expect_same(grid(5)); }
TEST_F(AnyOrder, GivesTheSameLoopsMiddleNodesAndNamedTwins) { expect_same(mixed()); }

CanonicalOrder order_of(const RawMesh& mesh) {
  return canonical_order(mesh.nodes, mesh.lines, group_labels(mesh));
}

TEST(CanonicalOrder, NumbersAChainFromItsSmallerEnd) {
  Builder b;
  b.node(2, 0, 0), b.node(0, 0, 0), b.node(1, 0, 0);
  b.line(0, 2), b.line(1, 2);
  const CanonicalOrder order = order_of(b.mesh);
  EXPECT_EQ(order.nodes, (std::vector<Index>{1, 2, 0}));
  EXPECT_EQ(order.lines, (std::vector<Index>{1, 0}));
  EXPECT_EQ(order.reversed, (std::vector<char>{0, 1}));
}

TEST(CanonicalOrder, StartsARingAtItsSmallestNodeTowardsTheSmallerNeighbour) {
  Builder b;
  b.node(1, 0, 0), b.node(0, 0, 0), b.node(0, 1, 0), b.node(1, 1, 0);
  b.line(0, 1), b.line(1, 2), b.line(2, 3), b.line(3, 0);
  EXPECT_EQ(order_of(b.mesh).nodes, (std::vector<Index>{1, 2, 3, 0}));
}

TEST(CanonicalOrder, IgnoresAMeshersNoise) {
  Builder b;
  b.node(1e-16, 0, 1), b.node(0, 0, 2), b.node(2e-16, 0, 0);
  b.line(1, 0), b.line(0, 2);
  EXPECT_EQ(order_of(b.mesh).nodes, (std::vector<Index>{2, 0, 1}))
      << "from z = 0 up, although x there is the largest";
}

TEST(CanonicalOrder, PutsStructuresBySmallestNodeAndFreeNodesLast) {
  Builder b;
  b.node(-9, 0, 0); // free
  b.node(5, 0, 0), b.node(1, 0, 0), b.node(0, 1, 0), b.node(7, 1, 0);
  b.line(1, 2), b.line(4, 3);
  EXPECT_EQ(order_of(b.mesh).nodes, (std::vector<Index>{3, 4, 2, 1, 0}));
}

TEST(CanonicalOrder, KeepsTheGivenOrderOfWhatCannotBeTold) {
  Builder b;
  b.node(0, 0, 0), b.node(1, 0, 0), b.node(0, 0, 0), b.node(1, 0, 0);
  b.line(2, 3), b.line(0, 1);
  EXPECT_EQ(order_of(b.mesh).nodes, (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(order_of(b.mesh).lines, (std::vector<Index>{1, 0}));
}

TEST(CanonicalOrder, KeepsTwoLinesOverTheSameNodes) {
  Builder b;
  b.node(0, 0, 0), b.node(1, 0, 0);
  b.line(0, 1), b.line(1, 0);
  const CanonicalOrder order = order_of(b.mesh);
  EXPECT_EQ(order.lines.size(), 2u);
  EXPECT_EQ(order.nodes, (std::vector<Index>{0, 1}));
}

TEST(CanonicalOrder, GivesNeighboursOfAChainNeighbouringNumbers) {
  const RawMesh mesh = shuffled(helix(500), 3);
  const CanonicalOrder order = order_of(mesh);
  std::vector<Index> number(order.nodes.size());
  for (std::size_t i = 0; i < order.nodes.size(); ++i)
    number[order.nodes[i]] = static_cast<Index>(i);
  for (const RawLine& line : mesh.lines)
    EXPECT_EQ(std::abs(number[line.nodes[0]] - number[line.nodes[1]]), 1);
}

} // namespace
} // namespace fretwork::mesh::test::canonical_order_test
