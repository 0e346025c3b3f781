// SPDX-License-Identifier: GPL-3.0-or-later
// What check says of the directions in which flat obstacles hold a tube.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::contact_directions_test {
namespace {

constexpr int elements = 20, crown = 10, quarter = 5;

/// A half circle of 1 m in the plane x-z.
MeshText half_circle() {
  MeshText mesh = straight_line("tube", {0, 0, 0}, {1, 0, 0}, elements);
  for (int k = 0; k <= elements; ++k) {
    const double angle = std::numbers::pi * (1.0 - static_cast<double>(k) / elements);
    mesh.nodes[static_cast<std::size_t>(k)] = {std::cos(angle), 0.0, std::sin(angle)};
  }
  return mesh;
}

std::string plane(const std::string& name, const std::string& keys) {
  return fmt::format(
      "[[contacts]]\nname = \"{0}\"\ngroup = \"{0}\"\nnormal_stiffness = 1e6\ngap = 1e-3\n{1}\n", name, keys);
}

std::string checked(MeshText mesh, const std::vector<std::pair<std::string, int>>& points,
                    const std::string& contacts) {
  const Workshop folder;
  mesh.points.insert(mesh.points.end(), points.begin(), points.end());
  folder.write("mesh.msh", mesh.text());
  const Outcome outcome = folder.fretwork(
      {"check", folder
                    .write("study.toml", steel_pipe("mesh.msh") + tube_between("tube") + contacts +
                                             "[modes]\ncount = 8\n[transient]\nduration = 0.01\n")
                    .string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.out;
}

TEST(ContactDirections, AreSaidBesideThePlaneOfTheBend) {
  const std::string across = "y_axis = [0.0, 1.0, 0.0]\nobstacle = ";
  const std::string out =
      checked(half_circle(),
              {{"bars", quarter},
               {"bars", crown},
               {"more", elements - quarter},
               {"stops", quarter},
               {"stops", crown},
               {"tilted", crown}},
              plane("bars", across + "\"plane_y\"") + plane("more", across + "\"plane_y\"") +
                  plane("stops", across + "\"plane_z\"") +
                  plane("tilted", "angle = 45\naxis = [1, 0, 0]\nobstacle = \"stop_y\""));
  EXPECT_TRUE(says(out, "note: flat obstacles limit the motion along (0, 1, 0), out of the plane of the bend "
                        "(\"bars\", \"more\"); "
                        "directions that turn with the tube, in the plane of the bend (\"stops\"); "
                        "towards (0, 0.707, 0.707), oblique to the plane of the bend (\"tilted\")"));
}

TEST(ContactDirections, OfAStraightTubeAreAcrossItOrAlongIt) {
  const MeshText line = straight_line("tube", {0, 0, 0}, {1, 0, 0}, elements);
  const std::string out =
      checked(line, {{"a", crown}, {"b", quarter}, {"c", quarter}},
              plane("a", "axis = [1, 0, 0]\nobstacle = \"stop_z\"") +
                  plane("b", "axis = [0, 0, 1]\nobstacle = \"plane_z\"\ny_axis = [1, 0, 0]") +
                  plane("c", "axis = [0, 0, 1]\nobstacle = \"plane_y\"\ny_axis = [1, 0, 0]"));
  EXPECT_TRUE(says(out,
                   "towards (0, 0, 1), across the tube (\"a\"); along (0, 1, 0), across the tube (\"b\"); "
                   "along (1, 0, 0), along the tube (\"c\")"));
  EXPECT_FALSE(says(checked(line, {{"hole", crown}}, plane("hole", "")), "flat obstacles"));
}

} // namespace
} // namespace fretwork::app::test::contact_directions_test
