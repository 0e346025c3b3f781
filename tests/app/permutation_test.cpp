// SPDX-License-Identifier: GPL-3.0-or-later
// Node numbers, directions and order of elements, and the choice of axes do not matter.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <random>

namespace fretwork::app::test::permutation_test {
namespace {

constexpr double no_difference =
    1e-6; ///< relative, up to the third impact: round-off of another order of sums, amplified by the impacts
/// Ten pairs of bending modes and the first torsion: a count that cuts a pair keeps the one that the axes
/// prefer.
constexpr int modes = 21;
constexpr int elements = 30;
constexpr double length = 3.0;

MeshText tube(const core::Vec3& along) {
  MeshText mesh = straight_line("tube", core::Vec3::Zero(), length * along, elements);
  mesh.points.emplace_back("support", 10);
  mesh.points.emplace_back("drive", 17);
  return mesh;
}

/// The same tube, numbered, directed and ordered at random.
MeshText shuffled(MeshText mesh) {
  std::mt19937 draw(7);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    mesh.numbers.push_back(static_cast<int>(3 * i + 5));
  std::shuffle(mesh.numbers.begin(), mesh.numbers.end(), draw);
  std::shuffle(mesh.points.begin(), mesh.points.end(), draw);
  std::shuffle(mesh.lines.begin(), mesh.lines.end(), draw);
  for (std::size_t i = 0; i < mesh.lines.size(); i += 2)
    std::swap(mesh.lines[i].nodes[0], mesh.lines[i].nodes[1]);
  // nodes in another order in the file too
  std::vector<int> order(mesh.nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = static_cast<int>(i);
  std::shuffle(order.begin(), order.end(), draw);
  MeshText out = mesh;
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    out.nodes[i] = mesh.nodes[static_cast<std::size_t>(order[i])];
    out.numbers[i] = mesh.numbers[static_cast<std::size_t>(order[i])];
  }
  for (auto& point : out.points)
    point.second = place[static_cast<std::size_t>(point.second)];
  for (auto& line : out.lines)
    for (int& node : line.nodes)
      node = place[static_cast<std::size_t>(node)];
  return out;
}

std::string text(const core::Vec3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}

/// A tube along `x` driven along `y` and `z`, round and round, against a circle with friction. The axes may
/// be any right-handed set.
std::string study(const core::Vec3& x, const core::Vec3& y, const core::Vec3& z) {
  return steel_pipe("tube.msh", 12000.0) + tube_between("tube") +
         fmt::format(R"([modes]
count = {}
damping = 0.01
[[contacts]]
name = "support"
group = "support"
gap = 1.0e-4
axis = {}
y_axis = {}
normal_stiffness = 1.0e6
normal_damping = 20.0
friction = 0.3
tangential_stiffness = 1.0e6
tangential_damping = 100.0
[[loads]]
group = "drive"
direction = {}
harmonic = {{ amplitude = 20.0, frequency = 17.0 }}
[[loads]]
group = "drive"
direction = {}
harmonic = {{ amplitude = 15.0, frequency = 31.0 }}
[transient]
duration = 0.5
[output]
every = 1.0e-4
nodes = ["drive"]
)",
                     modes, text(x), text(y), text(y), text(z));
}

const core::Vec3 ex{1, 0, 0}, ey{0, 1, 0}, ez{0, 0, 1};

Results run(const Workshop& folder, const MeshText& mesh, const std::string& study_text) {
  folder.write("tube.msh", mesh.text());
  return folder.run_text(study_text, {"--force"});
}

/// Outputs up to the end of the third impact.
Eigen::Index third_impact(const Results& results) {
  const auto& force = results.contact("support").normal_force;
  int impacts = 0;
  for (Eigen::Index i = 1; i < force.size(); ++i)
    if (force(i) == 0.0 && force(i - 1) > 0.0 && ++impacts == 3)
      return i;
  ADD_FAILURE() << "only " << impacts << " impacts";
  return 0;
}

/// Largest difference over the rows, relative to the largest value.
double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::Index rows) {
  return (a.topRows(rows) - b.topRows(rows)).cwiseAbs().maxCoeff() / a.topRows(rows).cwiseAbs().maxCoeff();
}

TEST(Permutation, OfNumbersAndOrderGivesTheSameBytes) {
  const Workshop folder;
  const Results straight = run(folder, tube(ex), study(ex, ey, ez));
  const Results mixed = run(folder, shuffled(tube(ex)), study(ex, ey, ez));
  EXPECT_TRUE(same_numbers(straight.archive, mixed.archive));
  for (const char* part : {"contacts", "nodes", "modes", "energy", "transient", "model"})
    EXPECT_EQ(straight.summary[part], mixed.summary[part]) << part;
}

/// A tube along x, its contact and load turned with it: modes of a turned tube are turned, whichever of two
/// equal ones comes first.
void expect_turned(const core::Vec3& x, const core::Vec3& y, const core::Vec3& z) {
  const Workshop folder;
  const Results straight = run(folder, tube(ex), study(ex, ey, ez)),
                turned = run(folder, tube(x), study(x, y, z));
  for (std::size_t i = 0; i < modes; ++i)
    EXPECT_TRUE(close_to(turned.summary["modes"]["frequencies_hz"][i],
                         straight.summary["modes"]["frequencies_hz"][i], no_difference));
  const Eigen::Index rows = third_impact(straight);
  const auto &a = straight.contact("support"), &b = turned.contact("support");
  EXPECT_LT(difference(a.displacement, b.displacement, rows), no_difference);
  EXPECT_LT(difference(a.velocity, b.velocity, rows), no_difference);
  EXPECT_LT(difference(a.normal_force, b.normal_force, rows), no_difference);
  EXPECT_LT(difference(a.tangential_force, b.tangential_force, rows), no_difference);
  Eigen::Matrix3d axes;
  axes << x, y, z;
  EXPECT_LT(difference(straight.node("drive").displacement, turned.node("drive").displacement * axes, rows),
            no_difference);
}

TEST(Permutation, OfThePlanesGivesTheTurnedRun) { expect_turned(ex, ez, -ey); }

TEST(Permutation, OfAllAxesGivesTheTurnedRun) { expect_turned(ez, ex, ey); }

TEST(Permutation, ToAnObliqueTubeGivesTheTurnedRun) {
  const core::Vec3 x = core::Vec3(2.0, -1.0, 2.0) / 3.0, y = core::Vec3(2.0, 2.0, -1.0) / 3.0,
                   z = core::Vec3(-1.0, 2.0, 2.0) / 3.0;
  expect_turned(x, y, z);
}

TEST(Permutation, OfTheTubesEndsMirrorsTheModes) {
  const Workshop folder;
  MeshText backwards = tube(ex);
  for (auto& node : backwards.nodes)
    node.x() = length - node.x();
  backwards.points = {{"tube_begin", 0}, {"tube_end", elements}, {"support", 10}, {"drive", 17}};
  const Results straight = run(folder, tube(ex), study(ex, ey, ez)),
                mirrored = run(folder, backwards, study(ex, ey, ez));
  const Eigen::Index rows = third_impact(straight);
  EXPECT_LT(
      difference(straight.contact("support").displacement, mirrored.contact("support").displacement, rows),
      no_difference);
  EXPECT_LT(
      difference(straight.contact("support").normal_force, mirrored.contact("support").normal_force, rows),
      no_difference);
}

} // namespace
} // namespace fretwork::app::test::permutation_test
