// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/msh_reader.hpp"
#include "mesh_files.hpp"

namespace fretwork::mesh::test::msh_reader_test {
namespace {

using MshReader = MeshFiles;

/// Written by hand after the manual: two curves with a shared node, parametric nodes, sparse tags, a surface,
/// negative physical tags, a comment section and one that is not known.
constexpr const char* modern_text = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Comments
anything 1 2 3
$EndComments
$PhysicalNames
4
0 7 "tip node"
1 5 "leg"
1 6 "all"
2 9 "skin"
$EndPhysicalNames
$Entities
2 2 1 0
1 0 0 0 0
3 2 0 0 1 7
1 0 0 0 1 0 0 2 5 6 2 1 -2
2 1 0 0 2 0 0 1 -6 2 2 -3
1 0 0 0 2 0 0 1 9 0
$EndEntities
$Nodes
3 4 1 900000
0 1 0 1
1
0 0 0
1 1 1 2
900000
20
1 0 0 0.5
1e-1 +2.5E-1 -0.5 0.25
0 3 0 1
30
2 0 0
$EndNodes
$Parametrizations
1 2
$EndParametrizations
$Elements
4 4 1 4
0 3 15 1
1 30
1 1 1 1
2 1 900000
1 2 8 1
3 900000 30 20
2 1 2 1
4 1 900000 30
$EndElements
)";

TEST_F(MshReader, ReadsFormat41Text) {
  const RawMesh mesh = read_msh(write("a.msh", modern_text));
  ASSERT_EQ(mesh.nodes.size(), 4u);
  EXPECT_EQ(mesh.nodes[1], Vec3(1, 0, 0));
  EXPECT_EQ(mesh.nodes[2], Vec3(0.1, 0.25, -0.5));
  ASSERT_EQ(mesh.lines.size(), 2u);
  EXPECT_EQ(mesh.lines[0].nodes, (std::array<Index, 2>{0, 1}));
  EXPECT_EQ(mesh.lines[0].middle, -1);
  EXPECT_EQ(mesh.lines[1].nodes, (std::array<Index, 2>{1, 3}));
  EXPECT_EQ(mesh.lines[1].middle, 2);
  EXPECT_EQ(mesh.points, (Groups{{"tip node", {3}}}));
  EXPECT_EQ(mesh.curves, (Groups{{"leg", {0}}, {"all", {0, 1}}}));
  EXPECT_EQ(mesh.ignored_elements, 1u);
}

TEST_F(MshReader, ReadsWindowsLineEnds) {
  std::string text;
  for (const char* c = modern_text; *c; ++c)
    text += *c == '\n' ? std::string("\r\n") : std::string(1, *c);
  EXPECT_EQ(read_msh(write("a.msh", text)).curves, (Groups{{"leg", {0}}, {"all", {0, 1}}}));
}

TEST_F(MshReader, MakesOneLineOfARepetitionInFormat22) {
  const RawMesh mesh = read_msh(write("a.msh", msh22("1 1 \"a\"\n1 2 \"b\"\n", "1 0 0 0\n2 1 0 0\n3 2 0 0\n",
                                                     "1 1 1 2\n1 2 2 1\n1 2 2 3\n")));
  EXPECT_EQ(mesh.lines.size(), 2u);
  EXPECT_EQ(mesh.curves, (Groups{{"a", {0}}, {"b", {0, 1}}}));
}

TEST_F(MshReader, KeepsTwoCurvesOverTheSameNodesInFormat41) {
  const char* text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 2 0 0\n1 0 0 0 1 0 0 1 1 0\n2 0 0 0 1 0 0 1 2 0\n"
      "$EndEntities\n$Nodes\n1 2 1 2\n1 1 0 2\n1\n2\n0 0 0\n1 0 0\n$EndNodes\n$Elements\n2 3 1 3\n1 1 1 2\n1 "
      "1 2\n"
      "3 1 2\n1 2 1 1\n2 1 2\n$EndElements\n";
  const RawMesh mesh = read_msh(write("a.msh", text));
  EXPECT_EQ(mesh.lines.size(), 2u); // the repetition within curve 1 is the same line
  EXPECT_EQ(mesh.curves, (Groups{{"1", {0, 0}}, {"2", {1}}}));
}

TEST_F(MshReader, KeepsGroupsThatAreNamedButEmpty) {
  const RawMesh mesh =
      read_msh(write("a.msh", msh22("0 3 \"nobody\"\n1 2 \"void\"\n", "1 0 0 0\n2 1 0 0\n", "1 1 1 2\n")));
  EXPECT_EQ(mesh.points, (Groups{{"nobody", {}}}));
  EXPECT_EQ(mesh.curves, (Groups{{"1", {0}}, {"void", {}}}));
}

TEST_F(MshReader, GivesNoGroupToPhysicalTagZero) {
  EXPECT_TRUE(read_msh(write("a.msh", msh22("", "1 0 0 0\n2 1 0 0\n", "1 0 1 2\n"))).curves.empty());
}

TEST_F(MshReader, ReadsWithoutEntities) {
  const char* text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 2 1 2\n1 1 0 2\n1\n2\n0 0 0\n1 0 0\n$EndNodes\n"
      "$Elements\n1 1 1 1\n1 1 1 1\n1 1 2\n$EndElements\n";
  EXPECT_EQ(read_msh(write("a.msh", text)).lines.size(), 1u);
}

} // namespace
} // namespace fretwork::mesh::test::msh_reader_test
