// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/read.hpp"
#include "mesh_files.hpp"
#include <limits>
#include <numbers>

namespace fretwork::mesh::test::read_test {
namespace {

/// A mesher places nodes to 2e-12 of the length of a curve.
constexpr double mesher_tolerance = 1e-11;

using Read = MeshFiles;

const std::string two_lines =
    msh22("1 1 \"tube\"\n0 2 \"free\"\n", "4 0 0 0\n7 1 0 0\n9 2 0 0\n1 3 3 3\n2 5 5 5\n",
          "1 1 7 4\n1 1 7 9\n15 2 1\n");

TEST_F(Read, DropsNodesThatNothingUsesAndKeepsFreeNamedPoints) {
  const LineMesh mesh = read_text(two_lines);
  EXPECT_EQ(mesh.nodes, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 3, 3}}));
  EXPECT_EQ(mesh.dropped_nodes, 1u);
  EXPECT_EQ(group_nodes(mesh, "free", "test"), (std::vector<Index>{3}));
  EXPECT_EQ(mesh.lines[0].nodes, (std::array<Index, 2>{0, 1})) << "directed along the chain";
}

TEST_F(Read, ScalesToMetres) {
  const LineMesh mesh = read({.file = write("a.msh", two_lines), .scale = 1e-3});
  EXPECT_EQ(mesh.nodes[2], Vec3(2 * 1e-3, 0, 0));
}

TEST_F(Read, CountsSurfacesAndPassesOverThem) {
  const LineMesh mesh = read_text(msh22("", "1 0 0 0\n2 1 0 0\n3 0 1 0\n", "2 5 1 2 3\n1 1 1 2\n"));
  EXPECT_EQ(mesh.ignored_elements, 1u);
  EXPECT_EQ(mesh.lines.size(), 1u);
  EXPECT_EQ(mesh.nodes.size(), 2u);
}

TEST_F(Read, AcceptsNamedPointsAlone) {
  EXPECT_EQ(read_text(msh22("0 1 \"mass\"\n", "1 0 0 0\n", "15 1 1\n")).nodes.size(), 1u);
}

TEST_F(Read, ReportsCoincidentNodesAndMergesThemOnDemand) {
  const std::string text =
      msh22("1 1 \"a\"\n", "1 0 0 0\n2 1 0 0\n3 1 0 1e-9\n4 2 0 0\n", "1 1 1 2\n1 1 3 4\n");
  const LineMesh apart = read_text(text);
  ASSERT_EQ(apart.coincident.size(), 1u);
  EXPECT_EQ(apart.nodes[apart.coincident[0].first].x(), 1.0);
  EXPECT_EQ(apart.nodes[apart.coincident[0].second].x(), 1.0);
  const LineMesh merged = read_text(text, 1e-6);
  EXPECT_EQ(merged.nodes, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  EXPECT_EQ(merged.merged_nodes, 1u);
  EXPECT_EQ(merged.dropped_nodes, 0u);
  EXPECT_TRUE(merged.coincident.empty());
}

TEST_F(Read, KeepsTheTwoLegsOfAFoldedBeam) {
  const LineMesh mesh =
      read_text(msh22("0 1 \"clamp\"\n1 2 \"beam\"\n", "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 1 0 0\n5 0 0 0\n",
                      "15 1 1\n1 2 1 2\n1 2 2 3\n1 2 3 4\n1 2 4 5\n"));
  EXPECT_EQ(mesh.lines.size(), 4u);
  EXPECT_EQ(mesh.coincident.size(), 2u);
}

TEST_F(Read, KnowsGeometriesByTheirEnding) {
  for (const char* name : {"a.geo", "a.step", "a.STP", "a.brep"})
    EXPECT_TRUE(is_geometry(name)) << name;
  for (const char* name : {"a.msh", "geo", "a.vtu", "step.inp"})
    EXPECT_FALSE(is_geometry(name)) << name;
}

TEST_F(Read, KnowsMeshesByTheirEnding) {
  EXPECT_TRUE(is_msh("a.msh"));
  EXPECT_TRUE(is_msh("a.MSH"));
  EXPECT_FALSE(is_msh("a.vtu"));
  const std::string text = msh22("0 1 \"clamp\"\n1 2 \"beam\"\n", "1 0 0 0\n2 1 0 0\n", "15 1 1\n1 2 1 2\n");
  EXPECT_EQ(read({.file = write("a.MSH", text)}).points.size(), 1u);
}

/// An arc 1-2 through 3 and a line 2-4.
const std::string arc_and_line = msh22("1 1 \"tube\"\n0 2 \"end\"\n", "1 0 0 0\n2 2 0 0\n3 1 1 0\n4 3 0 0\n",
                                       "8 1 1 2 3\n1 1 2 4\n15 2 4\n");

TEST_F(Read, KeepsTheMiddleOfAnArcAsAPlace) {
  const LineMesh mesh = read_text(arc_and_line);
  EXPECT_EQ(mesh.nodes, (std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
  ASSERT_EQ(mesh.lines.size(), 2u);
  EXPECT_EQ(mesh.lines[0].middle, Vec3(1, 1, 0));
  EXPECT_FALSE(mesh.lines[1].middle);
  EXPECT_EQ(mesh.points.at("end"), std::vector<Index>{2});
  EXPECT_EQ(mesh.dropped_nodes, 0u);
}

TEST_F(Read, MakesTwoLinesOfAnArcWhereOrderOneIsWanted) {
  const LineMesh mesh = read({.file = write("a.msh", arc_and_line), .order = 1});
  EXPECT_EQ(mesh.nodes, (std::vector<Vec3>{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, 0, 0}}));
  ASSERT_EQ(mesh.lines.size(), 3u);
  EXPECT_EQ(mesh.curves.at("tube"), (std::vector<Index>{0, 1, 2}));
  for (const Line& line : mesh.lines)
    EXPECT_FALSE(line.middle);
}

class ReadErrors : public MeshFiles {
protected:
  [[nodiscard]] static std::string message(const Source& source) {
    return message_of([&] { static_cast<void>(read(source)); });
  }
  [[nodiscard]] std::string message_for(const std::string& text, double merge_tolerance = 0.0) const {
    return message_of([&] { static_cast<void>(read_text(text, merge_tolerance)); });
  }
};

TEST_F(ReadErrors, NameAFileThatDoesNotExistOrIsADirectory) {
  EXPECT_TRUE(says(message({.file = path("none.geo")}), "none.geo does not exist"));
  fs::create_directory(path("dir.msh"));
  EXPECT_TRUE(says(message({.file = path("dir.msh")}), "dir.msh is a directory"));
}

TEST_F(ReadErrors, RefuseImpossibleValues) {
  const fs::path file = write("a.msh", two_lines);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(says(message({.file = file, .scale = 0.0}), "scale = 0 must be a number > 0"));
  EXPECT_TRUE(says(message({.file = file, .scale = nan}), "scale = nan must be"));
  EXPECT_TRUE(
      says(message({.file = file, .merge_tolerance = -1.0}), "merge_tolerance = -1 m must be a length >= 0"));
  EXPECT_TRUE(says(message({.file = file, .element_size = 0.0}), "element_size = 0 m must be a length > 0"));
  EXPECT_TRUE(says(message({.file = file, .element_size = 0.1}), "element_size is for geometries"));
}

TEST_F(ReadErrors, RefuseAMiddleThatIsMoreThanAPlace) {
  const std::string nodes = "1 0 0 0\n2 2 0 0\n3 1 1 0\n4 3 0 0\n";
  EXPECT_TRUE(says(message_for(msh22("0 2 \"end\"\n", nodes, "8 1 1 2 3\n15 2 3\n")),
                   "the point \"end\" at (1, 1, 0) is the middle of a line of order 2"));
  EXPECT_TRUE(says(message_for(msh22("", nodes, "8 1 1 2 3\n1 1 3 4\n")), "set [mesh] order = 1"));
}

TEST_F(ReadErrors, RefuseAnOrderThatTheFileDoesNotHave) {
  const fs::path file = write("a.msh", two_lines);
  EXPECT_TRUE(says(message({.file = file, .order = 2}), "order = 2, but the file has lines of order 1 only"));
  EXPECT_TRUE(says(message({.file = file, .order = 3}), "order = 3 must be 1 or 2"));
}

TEST_F(ReadErrors, TellWhatAMeshLacks) {
  EXPECT_TRUE(says(message_for(msh22("", "", "")), "mesh.msh: the mesh has neither lines nor named points"));
  EXPECT_TRUE(says(message_for(msh22("0 1 \"a\"\n", "1 0 0 0\n", "")), "neither lines nor named points"));
  EXPECT_TRUE(says(message_for(msh22("", "1 0 0 0\n2 1 0 0\n3 0 1 0\n", "2 5 1 2 3\n")),
                   "1 surface or volume elements but no lines"));
}

TEST_F(ReadErrors, RefuseCoordinatesThatAreNotFinite) {
  EXPECT_TRUE(says(message_for(msh22("", "1 0 0 0\n2 1 nan 0\n", "1 1 1 2\n")),
                   "node number 2 of the file is at (1, nan, 0) m"));
  EXPECT_TRUE(says(message_for(msh22("", "1 0 inf 0\n2 1 0 0\n", "1 1 1 2\n")),
                   "node number 1 of the file is at (0, inf, 0) m"));
}

TEST_F(ReadErrors, NameALineWithoutLength) {
  const std::string nodes = "1 0 0 0\n2 1 0 0\n3 1 0 0\n";
  EXPECT_TRUE(says(message_for(msh22("1 1 \"tube\"\n", nodes, "1 1 1 2\n1 1 2 3\n")),
                   "line (1, 0, 0)-(1, 0, 0) of \"tube\" has no length"));
  EXPECT_TRUE(says(message_for(msh22("1 1 \"tube\"\n", nodes, "1 1 1 2\n1 1 2 2\n")), "has no length"));
}

TEST_F(ReadErrors, NameTheLineThatMergingWouldCollapse) {
  EXPECT_TRUE(
      says(message_for(two_lines, 1.5), "merge_tolerance = 1.5 m is more than the length 1 m of line"));
}

using Geometry = ReadErrors;

constexpr const char* quarter_circle = R"(
Point(1) = {0, 0, 0, 0.2}; Point(2) = {1000, 0, 0}; Point(3) = {0, 1000, 0}; Point(4) = {0, 2000, 0};
Circle(1) = {2, 1, 3}; Line(2) = {3, 4};
Physical Curve("tube") = {1, -2}; Physical Point("end") = {4}; Physical Curve("void") = {};
)";

TEST_F(Geometry, IsMeshedWithTheElementSizeInMetres) {
  const LineMesh mesh = read({.file = write("a.geo", quarter_circle), .element_size = 0.1, .scale = 1e-3});
  const double length = 1.0 + std::numbers::pi / 2;
  EXPECT_NEAR(static_cast<double>(mesh.lines.size()), length / 0.1,
              2.0); // a curve rounds its number of lines up
  EXPECT_EQ(mesh.nodes.size(), mesh.lines.size() + 1) << "without the centre of the circle";
  EXPECT_EQ(group_lines(mesh, "tube", "test").size(), mesh.lines.size());
  const Vec3 end = mesh.nodes[group_nodes(mesh, "end", "test").at(0)];
  EXPECT_LT((end - Vec3(0, 2, 0)).norm(), mesher_tolerance);
}

TEST_F(Geometry, LosesTheCentreOfACircleThatIsSavedWithAll) {
  const LineMesh mesh = read(
      {.file = write("a.geo", std::string(quarter_circle) + "Mesh.SaveAll = 1;\n"), .element_size = 100.0});
  EXPECT_EQ(mesh.nodes.size(), mesh.lines.size() + 1);
  EXPECT_EQ(mesh.dropped_nodes, 1u);
}

TEST_F(Geometry, KeepsOrderTwo) {
  const LineMesh mesh =
      read({.file = write("a.geo", std::string(quarter_circle) + "Mesh.ElementOrder = 2;\n"),
            .element_size = 100.0});
  int on_circle = 0;
  for (const Line& line : mesh.lines) {
    ASSERT_TRUE(line.middle);
    if (mesh.nodes[line.nodes[0]].y() < 999 && mesh.nodes[line.nodes[1]].y() < 1000.5) {
      EXPECT_NEAR(line.middle->norm(), 1000.0, 1000.0 * mesher_tolerance);
      ++on_circle;
    }
  }
  EXPECT_GE(on_circle, 15);
  EXPECT_EQ(mesh.nodes.size(), mesh.lines.size() + 1) << "middles are no nodes";
}

TEST_F(Geometry, IsMeshedWithTheOrderAskedFor) {
  const fs::path file = write("a.geo", quarter_circle);
  const LineMesh arcs = read({.file = file, .element_size = 100.0, .order = 2});
  const LineMesh lines = read({.file = file, .element_size = 100.0, .order = 1});
  ASSERT_EQ(arcs.lines.size(), lines.lines.size());
  EXPECT_EQ(arcs.nodes.size(), lines.nodes.size());
  for (std::size_t i = 0; i < arcs.lines.size(); ++i) {
    EXPECT_TRUE(arcs.lines[i].middle);
    EXPECT_FALSE(lines.lines[i].middle);
  }
}

TEST_F(Geometry, UsesItsOwnSizesWithoutElementSize) {
  const LineMesh mesh =
      read({.file = write("a.geo", "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Line(1) = {1, 2};\n"
                                   "Transfinite Curve{1} = 8; Physical Curve(\"a\") = {1};\n")});
  EXPECT_EQ(mesh.lines.size(), 7u);
}

TEST_F(Geometry, ShowsTheMessageOfGmsh) {
  EXPECT_TRUE(says(message({.file = write("a.geo", "\nPoint(1) = {0, 0\n")}),
                   "a.geo: gmsh cannot mesh the geometry: "));
  EXPECT_TRUE(says(message({.file = write("a.geo", "\nPoint(1) = {0, 0\n")}), "line 2: syntax error"));
  EXPECT_TRUE(says(message({.file = write("a.geo", "Point(1) = {0,0,0}; Line(1) = {1, 7};\n")}),
                   "Unknown control point 7"));
  EXPECT_TRUE(says(message({.file = write("a.step", "nonsense")}), "Could not read file"));
  EXPECT_TRUE(says(message({.file = write("a.brep", "nonsense")}), "gmsh cannot mesh the geometry"));
}

TEST_F(Geometry, OfAGeoWhoseLastLineHasNoEndIsReadWholeOrRefused) {
  const std::string points = "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0};\n", line = "Line(1) = {1, 2};",
                    name = "Physical Curve(\"a\") = {1};";
  const char* refused = "a.geo: gmsh cannot mesh the geometry: its last line has no end";
  EXPECT_TRUE(says(message({.file = write("a.geo", points + line + name)}), refused))
      << "gmsh loses the name";
  EXPECT_TRUE(says(message({.file = write("a.geo", "Point(1) = {0, 0, 0}; " + name)}), refused));
  EXPECT_TRUE(
      says(message({.file = write("a.geo", points + "For i In {1:1} " + line + " EndFor")}), refused));
  for (const std::string last : {"", " ", "; ", " // the tube; of 1 m"}) {
    const LineMesh mesh = read({.file = write("a.geo", points + line + "\n" + name + last)});
    EXPECT_EQ(group_lines(mesh, "a", "test").size(), mesh.lines.size()) << last;
  }
  EXPECT_FALSE(read({.file = write("a.geo", points + line + name + "\n// x; y; z")}).lines.empty());
}

TEST_F(Geometry, NamesTheProgramThatIsMissingOrCrashes) {
  const fs::path file = write("a.geo", quarter_circle);
  const char* given = std::getenv("FRETWORK_GEOMETRY");
  const std::string before = given ? given : "";
  setenv("FRETWORK_GEOMETRY", "/nowhere/fretwork-geometry", 1);
  EXPECT_TRUE(
      says(message({.file = file}), "FRETWORK_GEOMETRY = \"/nowhere/fretwork-geometry\" does not exist"));
  setenv("FRETWORK_GEOMETRY", write("plain.txt", "no program").c_str(), 1);
  EXPECT_TRUE(says(message({.file = file}), "plain.txt cannot be started: "));
  const fs::path crashing = write("crash.sh", "#!/bin/sh\nkill -SEGV $$\n");
  fs::permissions(crashing, fs::perms::owner_all);
  setenv("FRETWORK_GEOMETRY", crashing.c_str(), 1);
  EXPECT_TRUE(says(message({.file = file, .trusted = true}),
                   "a.geo: gmsh cannot mesh the geometry: it crashed (signal 11)"));
  unsetenv("FRETWORK_GEOMETRY");
  EXPECT_FALSE(read({.file = file, .element_size = 100.0}).lines.empty())
      << "found beside the running executable";
  if (given)
    setenv("FRETWORK_GEOMETRY", before.c_str(), 1);
}

} // namespace
} // namespace fretwork::mesh::test::read_test
