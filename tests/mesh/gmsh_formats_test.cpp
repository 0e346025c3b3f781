// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_files.hpp"
#include <cmath>
#include <gmsh.h>

namespace fretwork::mesh::test::gmsh_formats_test {
namespace {

/// gmsh writes 16 digits of a number as text, one less than a double may need.
constexpr double text_tolerance = 2e-15;

/// A bent tube with a branch: a curve in two groups (one with a negative sign), a named point on a curve, one
/// apart.
void build_geometry(int order) {
  namespace geo = gmsh::model::geo;
  gmsh::clear();
  geo::addPoint(0, 0, 0, 0.1, 1);
  geo::addPoint(1, 0, 0, 0.1, 2);
  geo::addPoint(1, 1, 0, 0.1, 3);
  geo::addPoint(2, 1, 1.0 / 3, 0.1, 4);
  geo::addPoint(-3, 0, 0, 0.1, 5);
  geo::addPoint(1, 2, 0, 0.1, 6);
  geo::addCircleArc(1, 2, 3, 1);
  geo::addLine(3, 4, 2);
  geo::addLine(3, 6, 3);
  geo::synchronize();
  gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, {1, -2}, 11), "tube");
  gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, {2, 3}, 12), "upper");
  gmsh::model::setPhysicalName(0, gmsh::model::addPhysicalGroup(0, {3, 5}, 13), "named");
  gmsh::model::mesh::generate(1);
  gmsh::model::mesh::setOrder(order);
}

class GmshFormats : public MeshFiles {
protected:
  GmshFormats() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
  }
  ~GmshFormats() override { gmsh::finalize(); }

  [[nodiscard]] LineMesh saved_as(double version, bool binary) const {
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::option::setNumber("Mesh.Binary", binary ? 1 : 0);
    gmsh::write(path("a.msh").string());
    return read({.file = path("a.msh")});
  }
};

TEST_F(GmshFormats, GiveTheSameMesh) {
  for (const int order : {1, 2}) {
    build_geometry(order);
    const LineMesh reference = saved_as(4.1, true);
    EXPECT_EQ(reference.points.at("named").size(), 2u);
    EXPECT_EQ(reference.nodes.size(), reference.lines.size() + 2) << "one tree of lines and a free point";
    EXPECT_GT(reference.curves.at("tube").size(), 10u);
    EXPECT_GT(reference.curves.at("upper").size(), 10u);
    EXPECT_TRUE(same_mesh(saved_as(4.1, false), reference, text_tolerance)) << "4.1 text, order " << order;
    EXPECT_TRUE(same_mesh(saved_as(2.2, true), reference)) << "2.2 binary, order " << order;
    EXPECT_TRUE(same_mesh(saved_as(2.2, false), reference, text_tolerance)) << "2.2 text, order " << order;
  }
}

TEST_F(GmshFormats, ReadParametricNodes) {
  build_geometry(1);
  gmsh::option::setNumber("Mesh.SaveParametric", 1);
  const LineMesh reference = saved_as(4.1, true);
  EXPECT_TRUE(same_mesh(saved_as(4.1, false), reference, text_tolerance));
  gmsh::option::setNumber("Mesh.SaveParametric", 0);
  EXPECT_TRUE(same_mesh(saved_as(4.1, true), reference));
}

TEST_F(GmshFormats, TellATruncatedBinaryFile) {
  build_geometry(1);
  for (const double version : {2.2, 4.1}) {
    static_cast<void>(saved_as(version, true));
    std::ifstream stream(path("a.msh"), std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(stream)), {});
    for (const char* section : {"$Nodes", "$Elements"}) {
      const fs::path cut = write("cut.msh", whole.substr(0, whole.find(section) + 100));
      EXPECT_TRUE(says(message_of([&] { static_cast<void>(read({.file = cut})); }),
                       std::string("the file ends inside ") + section + "; it is truncated"))
          << version;
    }
  }
}

} // namespace
} // namespace fretwork::mesh::test::gmsh_formats_test
