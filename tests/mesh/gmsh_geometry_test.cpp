// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_files.hpp"
#include <gmsh.h>

namespace fretwork::mesh::test::gmsh_geometry_test {
namespace {

/// A mesher places nodes to 2e-12 of the length of a curve; STEP files carry 15 digits.
constexpr double mesher_tolerance = 1e-11;

class GmshGeometry : public MeshFiles {
protected:
  GmshGeometry() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
  }
  ~GmshGeometry() override { gmsh::finalize(); }

  /// Three straight curves in a row, 1000 units each (gmsh writes STEP in millimetres), and a quarter circle.
  void write_geometry(const std::string& name) const {
    namespace occ = gmsh::model::occ;
    for (int i = 0; i < 4; ++i)
      occ::addPoint(1000.0 * i, 0, 0, 0, i + 1);
    occ::addPoint(3000, 1000, 0, 0, 5);
    occ::addPoint(4000, 1000, 0, 0, 6);
    for (int i = 1; i < 4; ++i)
      occ::addLine(i, i + 1, i);
    occ::addCircleArc(4, 5, 6, 4);
    occ::synchronize();
    gmsh::model::removeEntities({{0, 5}});
    gmsh::write(path(name).string());
    gmsh::clear();
  }
};

TEST_F(GmshGeometry, OfStepIsConnectedAndInMetres) {
  write_geometry("a.step");
  const LineMesh mesh = read({.file = path("a.step"), .element_size = 0.1});
  EXPECT_EQ(mesh.nodes.size(), mesh.lines.size() + 1) << "one chain";
  EXPECT_TRUE(mesh.coincident.empty());
  EXPECT_LT(mesh.nodes.front().norm(), mesher_tolerance);
  EXPECT_LT((mesh.nodes.back() - Vec3(4, 1, 0)).norm(), 4 * mesher_tolerance);
  EXPECT_NEAR(static_cast<double>(mesh.lines.size()), 30 + 10 * 1.5708,
              2.0); // a curve rounds its number of lines up
}

TEST_F(GmshGeometry, OfStepGetsItsNamesFromAGeoThatMergesIt) {
  write_geometry("a.step");
  const fs::path geo =
      write("a.geo", "SetFactory(\"OpenCASCADE\");\nMerge \"a.step\";\nCoherence;\n"
                     "Physical Curve(\"tube\") = Curve{:};\nPhysical Point(\"ends\") = {1};\n");
  const LineMesh mesh = read({.file = geo, .element_size = 0.1});
  EXPECT_EQ(mesh.nodes.size(), mesh.lines.size() + 1);
  EXPECT_EQ(group_lines(mesh, "tube", "test").size(), mesh.lines.size());
  EXPECT_LT((mesh.nodes.back() - Vec3(4, 1, 0)).norm(), 4 * mesher_tolerance);
  EXPECT_EQ(group_nodes(mesh, "ends", "test").size(), 1u);
}

TEST_F(GmshGeometry, OfBrepKeepsItsUnits) {
  write_geometry("a.brep");
  const LineMesh mesh = read({.file = path("a.brep"), .element_size = 0.1, .scale = 1e-3});
  EXPECT_EQ(mesh.nodes.size(), mesh.lines.size() + 1);
  EXPECT_LT((mesh.nodes.back() - Vec3(4, 1, 0)).norm(), 4 * mesher_tolerance);
}

} // namespace
} // namespace fretwork::mesh::test::gmsh_geometry_test
