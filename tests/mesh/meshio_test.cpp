// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/child_process.hpp"
#include "mesh_files.hpp"

namespace fretwork::mesh::test::meshio_test {
namespace {

/// Debian's interpreter, for which Debian's meshio is installed.
constexpr const char* debian_python = "/usr/bin/python3";

/// Four nodes, three lines; `write_mesh` puts meshio's view of them into a file.
constexpr const char* preamble = R"(
import sys, meshio, numpy as np
x = np.array([[0, 0, 0], [0.1, 0, 0], [0.3, 0.1, 0], [0.7, 0, 1 / 3.0]])
lines = [("line", np.array([[0, 1], [2, 1], [2, 3]]))]
)";

class Meshio : public MeshFiles {
protected:
  /// Run the preamble and `script` (which writes sys.argv[1]), then read the file.
  [[nodiscard]] LineMesh written_by(const std::string& name, const std::string& script) const {
    const auto child = core::run_child({debian_python, "-c", preamble + script, path(name).string()});
    EXPECT_EQ(child.status, 0) << child.output;
    return read({.file = path(name)});
  }
  static void expect_nodes(const LineMesh& mesh) {
    EXPECT_EQ(mesh.nodes, (std::vector<Vec3>{{0, 0, 0}, {0.1, 0, 0}, {0.3, 0.1, 0}, {0.7, 0, 1 / 3.0}}));
  }
  [[nodiscard]] std::string message(const fs::path& file) const {
    return message_of([&] { static_cast<void>(read({.file = file})); });
  }
};

TEST_F(Meshio, ReadsVtuWithMarkedGroups) {
  const LineMesh mesh = written_by("a.vtu", R"(
meshio.Mesh(x, lines, cell_data={"tube": [np.array([1, 1, 0])], "thickness": [np.array([.1, .2, .3])]},
            point_data={"tip": np.array([0, 0, 0, 1])}).write(sys.argv[1])
)");
  expect_nodes(mesh);
  EXPECT_EQ(mesh.curves, (std::map<std::string, std::vector<Index>>{{"tube", {0, 1}}}));
  EXPECT_EQ(mesh.points, (std::map<std::string, std::vector<Index>>{{"tip", {3}}}));
}

TEST_F(Meshio, ReadsTheSetsThatMeshioWritesToVtu) {
  const LineMesh mesh = written_by("a.vtu", R"(
meshio.Mesh(x, lines, cell_sets={"tube": [np.array([0, 1])], "arm": [np.array([2])]},
            point_sets={"tip": np.array([3])}).write(sys.argv[1])
)");
  EXPECT_EQ(mesh.curves, (std::map<std::string, std::vector<Index>>{{"arm", {2}}, {"tube", {0, 1}}}));
  EXPECT_EQ(mesh.points, (std::map<std::string, std::vector<Index>>{{"tip", {3}}}));
}

TEST_F(Meshio, ReadsXdmf) {
  const LineMesh mesh = written_by("a.xdmf", R"(
meshio.Mesh(x, lines, cell_data={"tube": [np.array([0, 1, 1])]}).write(sys.argv[1])
)");
  expect_nodes(mesh);
  EXPECT_EQ(mesh.curves, (std::map<std::string, std::vector<Index>>{{"tube", {1, 2}}}));
}

TEST_F(Meshio, ReadsTheFamiliesOfMed) {
  const LineMesh mesh = written_by("a.med", R"(
m = meshio.Mesh(x, lines, cell_data={"cell_tags": [np.array([-1, -2, -2])]}, point_data={"point_tags": np.array([2, 0, 0, 3])})
m.cell_tags = {-1: ["tube"], -2: ["tube", "upper"]}
m.point_tags = {2: ["foot"], 3: ["tip"]}
m.write(sys.argv[1])
)");
  expect_nodes(mesh);
  EXPECT_EQ(mesh.curves, (std::map<std::string, std::vector<Index>>{{"tube", {0, 1, 2}}, {"upper", {1, 2}}}));
  EXPECT_EQ(mesh.points, (std::map<std::string, std::vector<Index>>{{"foot", {0}}, {"tip", {3}}}));
}

TEST_F(Meshio, ReadsTheSetsOfAbaqus) {
  const LineMesh mesh = written_by("a.inp", R"(
meshio.Mesh(x, lines, cell_sets={"tube": [np.array([0, 1])], "all": [np.array([0, 1, 2])]},
            point_sets={"tip": np.array([3])}).write(sys.argv[1])
)");
  expect_nodes(mesh);
  EXPECT_EQ(mesh.curves, (std::map<std::string, std::vector<Index>>{{"all", {0, 1, 2}}, {"tube", {0, 1}}}));
  EXPECT_EQ(mesh.points, (std::map<std::string, std::vector<Index>>{{"tip", {3}}}));
}

TEST_F(Meshio, ReadsPhysicalNumbersOrderTwoAndTwoCoordinates) {
  const LineMesh mesh = written_by("a.vtu", R"(
meshio.Mesh(x[:, :2], [("line3", np.array([[0, 2, 1]])), ("triangle", np.array([[0, 1, 3]]))],
            cell_data={"gmsh:physical": [np.array([12]), np.array([3])]}).write(sys.argv[1])
)");
  ASSERT_EQ(mesh.lines.size(), 1u);
  EXPECT_EQ(mesh.lines[0].middle, Vec3(0.1, 0, 0));
  EXPECT_TRUE(mesh.curves.contains("12"));
  EXPECT_EQ(mesh.ignored_elements, 1u);
}

TEST_F(Meshio, ShowsItsMessageForAFileItCannotRead) {
  EXPECT_TRUE(says(message(write("a.vtu", "nonsense")), "a.vtu: meshio cannot read the mesh: "));
  EXPECT_TRUE(says(message(write("a.med", "nonsense")), "a.med: meshio cannot read the mesh: "));
  EXPECT_TRUE(says(message(write("a.unknown", "nonsense")), "a.unknown: meshio cannot read the mesh: "));
}

TEST_F(Meshio, SaysWhichFormatsToSaveInPlaceOfUniversalFiles) {
  EXPECT_TRUE(says(message(write("a.unv", "    -1\n  2411\n")),
                   "a.unv: universal files (.unv) cannot be read; save the mesh with its groups as .med"));
}

TEST_F(Meshio, NamesThePackageWhereNoPythonHasIt) {
  setenv("FRETWORK_PYTHON", "/nowhere/python", 1);
  const std::string text = message(write("a.vtu", "nonsense"));
  EXPECT_TRUE(says(text, "install the package python3-meshio (and python3-h5py for .med and .xdmf)"));
  EXPECT_TRUE(says(text, "/nowhere/python: No such file or directory"));
  unsetenv("FRETWORK_PYTHON");
}

} // namespace
} // namespace fretwork::mesh::test::meshio_test
