// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/line_mesh.hpp"
#include "mesh_files.hpp"

namespace fretwork::mesh::test::line_mesh_test {
namespace {

/// Nodes 0-1-2-3 in a row; line 1 (from 1 to 2) is an arc; node 4 is alone.
LineMesh three_lines() {
  LineMesh mesh;
  mesh.nodes.assign(5, Vec3::Zero());
  mesh.lines = {{{0, 1}}, {{1, 2}, Vec3(1, 1, 0)}, {{2, 3}}};
  mesh.points = {{"end", {3}}, {"shared", {0}}, {"nothing", {}}};
  mesh.curves = {{"tube", {0, 1}}, {"shared", {2}}, {"void", {}}};
  return mesh;
}

TEST(GroupNames, AreUniqueAndSortedPointsFirst) {
  EXPECT_EQ(group_names(three_lines()),
            (std::vector<std::string>{"end", "nothing", "shared", "tube", "void"}));
}

TEST(GroupNodes, OfACurveAreTheEndsOfItsLinesOnce) {
  EXPECT_EQ(group_nodes(three_lines(), "tube", "a"), (std::vector<Index>{0, 1, 2}));
}

TEST(GroupNodes, OfANameOfPointAndCurveAreThoseOfBoth) {
  EXPECT_EQ(group_nodes(three_lines(), "shared", "a"), (std::vector<Index>{0, 2, 3}));
}

TEST(GroupNodes, NameTheNearestWhereTheGroupIsMissing) {
  const auto message =
      message_of([] { static_cast<void>(group_nodes(three_lines(), "tubes", "[[masses]] entry 1")); });
  EXPECT_TRUE(says(message, "[[masses]] entry 1: the mesh has no group \"tubes\"; did you mean \"tube\"?"));
  EXPECT_TRUE(says(message, "groups of the mesh: \"end\", \"nothing\", \"shared\", \"tube\", \"void\""));
}

TEST(GroupNodes, SayThatAGroupIsEmpty) {
  for (const char* name : {"nothing", "void"})
    EXPECT_TRUE(says(message_of([&] { static_cast<void>(group_nodes(three_lines(), name, "x")); }),
                     std::string("x: the group \"") + name + "\" is empty"));
}

TEST(GroupLines, AreThoseOfTheCurve) {
  EXPECT_EQ(group_lines(three_lines(), "tube", "a"), (std::vector<Index>{0, 1}));
  EXPECT_EQ(group_lines(three_lines(), "shared", "a"), (std::vector<Index>{2}));
}

TEST(GroupLines, RefusePointsMissingAndEmptyCurves) {
  const auto message = [](const char* name) {
    return message_of([&] { static_cast<void>(group_lines(three_lines(), name, "[[beams]] entry 2")); });
  };
  EXPECT_TRUE(says(message("end"),
                   "[[beams]] entry 2: the group \"end\" is a physical point; a physical curve is needed"));
  EXPECT_TRUE(
      says(message("tub"),
           "the mesh has no curve \"tub\"; did you mean \"tube\"? curves of the mesh: \"shared\", \"tube\""));
  EXPECT_TRUE(says(message("void"), "the group \"void\" is empty"));
}

TEST(GroupLines, OfAMeshWithoutNamedCurvesSayHowToNameThem) {
  LineMesh mesh = three_lines();
  mesh.curves.clear();
  EXPECT_TRUE(says(message_of([&] { static_cast<void>(group_lines(mesh, "tube", "[[beams]] entry 1")); }),
                   "[[beams]] entry 1: the mesh has no curve \"tube\", for it names no curves; in gmsh: "
                   "Physical Curve(\"tube\") = {...};"));
}

} // namespace
} // namespace fretwork::mesh::test::line_mesh_test
