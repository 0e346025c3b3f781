// SPDX-License-Identifier: GPL-3.0-or-later
// What a run tells of inputs that are legal, and mostly not what was meant.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"

namespace fretwork::app::test::notes_test {
namespace {

/// Notes and warnings of a run.
std::string told(const std::string& more, const std::vector<std::string>& set = {}) {
  const Workshop folder;
  folder.write("mesh.msh", lone_points({"mass"}).text());
  const Results run = folder.run_text(lone_mass() + more, set);
  return run.summary["notes"].dump() + run.summary["warnings"].dump();
}

std::string shaken(const std::string& table) {
  return "[[base_motion]]\ndirection = [1, 0, 0]\ntable = " + table + "\n";
}

const std::string initial = "[[initial]]\ngroup = \"mass\"\n";
const std::string stop = "[[contacts]]\nname = \"stop\"\ngroup = \"mass\"\nobstacle = \"stop_y\"\n"
                         "axis = [0, 0, 1]\ny_axis = [1, 0, 0]\ngap = 0.1\nnormal_stiffness = 1e3\n"
                         "tangential_stiffness = 1e3\n";

} // namespace

TEST(Notes, OfDampingGivenAsPerCent) {
  EXPECT_TRUE(says(told("", {"--set", "modes.damping=2.0"}), "does not oscillate"));
  EXPECT_FALSE(says(told("", {"--set", "modes.damping=0.02"}), "does not oscillate"));
}

TEST(Notes, OfAnAccelerationThatGoesOnAfterItsTable) {
  EXPECT_TRUE(says(told(shaken("[[0, 0], [0.2, 3], [0.4, 1]]")), "its last acceleration, 1 m/s2, goes on"));
  EXPECT_FALSE(says(told(shaken("[[0, 0], [0.2, 3], [0.4, 0]]")), "goes on"));
  EXPECT_FALSE(says(told(shaken("[[0, 0], [0.2, 3], [1.0, 1]]")), "goes on"));
}

TEST(Notes, OfAnInitialStateThatMovesNothing) {
  EXPECT_TRUE(
      says(told(initial + "velocity = [0, 1, 0]\n"), "[[initial]] entry 1 on \\\"mass\\\" moves nothing"));
  EXPECT_FALSE(says(told(initial + "velocity = [0.1, 1, 0]\n"), "moves nothing"));
  EXPECT_FALSE(says(told(initial + "velocity = [0, 0, 0]\n"), "moves nothing")); // at rest, as it says
}

TEST(Notes, OfTangentialStiffnessWithoutFriction) {
  EXPECT_TRUE(says(told(stop), "tangential_stiffness without friction"));
  EXPECT_FALSE(says(told(stop + "friction = 0.1\ntangential_damping = 10.0\n"), "without friction"));
}

TEST(Notes, OfASweepThatARunDoesNotCompute) {
  const std::string sweep = "[sweep]\ndesign = \"grid\"\n[[sweep.variables]]\nkey = "
                            "\"springs.mass.stiffness.0\"\nvalues = [50, 100]\n";
  EXPECT_TRUE(says(told(sweep), "fretwork sweep computes its cases"));
  EXPECT_FALSE(says(told(""), "fretwork sweep"));
}

} // namespace fretwork::app::test::notes_test
