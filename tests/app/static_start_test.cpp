// SPDX-License-Identifier: GPL-3.0-or-later
// A run that starts in equilibrium: a preloaded tube stays where it is, a run from rest does not; what cannot be held is told.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app::test::static_start_test {
namespace {

constexpr double length = 1.0, overlap = 2.0e-4, stiffness = 1.0e6;
constexpr int modes = 20;

MeshText tube() {
  MeshText mesh = straight_line("tube", core::Vec3::Zero(), core::Vec3(length, 0, 0), 20);
  mesh.points.emplace_back("support", 9);
  return mesh;
}

/// A clamped tube pressed by a bar that overlaps it through offset; `more` ends the study.
std::string study(const std::string& start, const std::string& more = {}) {
  return steel_pipe("tube.msh") + tube_between("tube") +
         fmt::format(R"([modes]
count = {}
damping = 0.01
[[contacts]]
name = "bar"
group = "support"
obstacle = "stop_y"
gap = 0.0
axis = [1.0, 0.0, 0.0]
offset = [{}, 0.0]
normal_stiffness = {}
friction = 0.3
tangential_stiffness = 1.0e6
[transient]
duration = 0.05
start = "{}"
{})",
                     modes, -overlap, stiffness, start, more);
}

Results run(const Workshop& folder, const std::string& start, const std::string& more = {}) {
  folder.write("tube.msh", tube().text());
  return folder.run_text(study(start, more), {"--force"});
}

/// Force of the bar on the tube from the modes themselves: overlap / (1/K + flexibility of the basis at the bar).
double closed_form(const Results& results) {
  const auto& basis = results.archive.bases.at(0);
  const Eigen::Index row = basis.row_of(9) + 1; // uy
  const double flexibility = (basis.shapes.row(row).transpose().array() / basis.omega.array()).square().sum();
  return overlap / (1.0 / stiffness + flexibility);
}

double spread(const Eigen::VectorXd& values) { return values.maxCoeff() - values.minCoeff(); }

TEST(StaticStart, OfAPreloadedTubeLeavesNoArtefact) {
  const Workshop folder;
  const Results rest = run(folder, "rest"), start = run(folder, "static");
  const double force = closed_form(start);
  constexpr double of_the_splitting =
      1e-4; // of order (w h)^2/12 of the modes that carry the force; w_c h is 0.011 here
  EXPECT_TRUE(close_to(start.statistics("bar")["normal_force"]["mean"], force, of_the_splitting));
  EXPECT_TRUE(close_to(start.statistics("bar")["normal_force"]["max"], force, of_the_splitting));
  EXPECT_EQ(start.statistics("bar")["contact_time_ratio"], 1.0);
  EXPECT_LT(spread(start.contact("bar").normal_force), of_the_splitting * force);
  EXPECT_GT(spread(rest.contact("bar").normal_force), force); // from rest the overlap throws the tube off
  const double from_rest = spread(rest.contact("bar").displacement.col(1));
  EXPECT_LT(spread(start.contact("bar").displacement.col(1)), of_the_splitting * from_rest);
}

TEST(StaticStart, StaysToRoundOffWithEuler) {
  const Workshop folder;
  const Results start = run(folder, "static", "scheme = \"euler\"\n");
  const double force = closed_form(start);
  constexpr double round_off = 1e-9; // of thousands of steps
  EXPECT_TRUE(close_to(start.statistics("bar")["normal_force"]["mean"], force, round_off));
  EXPECT_LT(spread(start.contact("bar").normal_force), round_off * force);
}

TEST(StaticStart, IsToldAndKeepsInitialVelocities) {
  const Workshop folder;
  folder.write("tube.msh", tube().text());
  const auto text = study("static", "[[initial]]\ngroup = \"tube\"\nvelocity = [0.0, 0.0, 0.1]\n");
  const Outcome outcome = folder.fretwork(
      {"run", folder.write("study.toml", text).string(), "--no-report", "-o", folder.path("out").string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out + outcome.err, "static start: 1 of 1 contacts closed, largest force "));
  EXPECT_GT(read_results(folder.path("out")).archive.series.modal_velocity.col(0).norm(), 0.0);
}

TEST(StaticStart, TellsTheForceOfAContactInSeriesWithTheModes) {
  const Workshop folder;
  folder.write("tube.msh", tube().text());
  const Results start =
      folder.run_text(study("static"), {"--set", "modes.static_modes=all", "--set", "modes.count=3"});
  const double force = start.contact("bar").normal_force(0);
  EXPECT_TRUE(says(start.summary["notes"].dump(), fmt::format("it presses with {:.4g} N", force)));
}

TEST(StaticStart, WarnsOfAPreloadThatTheLoadsTake) {
  const Workshop folder;
  const std::string pull = "[[loads]]\ngroup = \"support\"\ndirection = [0.0, -1.0, 0.0]\nconstant = 100.0\n";
  const auto warnings = [&](const char* start, const std::string& more) {
    return run(folder, start, more).summary["warnings"].dump();
  };
  EXPECT_TRUE(says(warnings("static", pull),
                   "contact \\\"bar\\\": placed with an overlap of 0.0002 m, it is open by "));
  EXPECT_FALSE(says(warnings("static", ""), "placed with an overlap"));
  EXPECT_FALSE(says(warnings("rest", pull), "placed with an overlap")); // pressed at t = 0
}

TEST(StaticStart, GivesTheSameBytesOnTwoRanks) {
  const Workshop folder;
  folder.write("tube.msh", tube().text());
  EXPECT_TRUE(same_numbers(folder.run_text(study("static"), {"--force"}).archive,
                           folder.run_text(study("static"), {"--force"}, 2).archive));
}

TEST(StaticStart, TellsTheForceOfAnOverlapAtTheStart) {
  const Workshop folder;
  const Results start = run(folder, "static"), rest = run(folder, "rest");
  EXPECT_TRUE(says(start.summary["notes"].dump(), fmt::format("presses with {:.4g} N", closed_form(start))));
  EXPECT_TRUE(says(rest.summary["notes"].dump(), fmt::format("presses with {:.4g} N", stiffness * overlap)));
}

TEST(StaticStart, TakesNoInertiaOfABaseOrSupportThatAccelerates) {
  const Workshop folder;
  folder.write("points.msh", lone_points({"block"}).text());
  const std::string block = R"([mesh]
file = "points.msh"
[[masses]]
group = "block"
mass = 2.0
[[restraints]]
group = "block"
fixed = ["ux", "uz", "rx", "ry", "rz"]
[[springs]]
group = "block"
stiffness = [0.0, 2.0e4, 0.0, 0.0, 0.0, 0.0]
[gravity]
acceleration = [0.0, -9.81, 0.0]
[transient]
duration = 0.1
start = "static"
[output]
every = 0.05
nodes = ["block"]
)";
  constexpr double sag = -9.81 / 1e4; // g/w^2
  for (const std::string moved : {"[[base_motion]]\n", "[[support_motion]]\ngroup = \"block\"\n"}) {
    const Results run = folder.run_text(block + moved + "direction = [0.0, 1.0, 0.0]\nconstant = 30.0\n");
    const auto& displacement = run.node("block").displacement;
    EXPECT_TRUE(close_to(displacement(0, 1), sag, 1e-12)) << moved; // equilibrium in closed form
    EXPECT_GT(std::abs(displacement(1, 1) - sag), 1e-3) << moved;   // the step of 30/w^2 is dynamic
  }
}

// A tube in mm hardly resists its weight: no equilibrium of it is found.
TEST(StaticStart, NamesTheDeepestOverlapWhereItFindsNoEquilibrium) {
  const Workshop folder;
  const Outcome outcome =
      folder.fretwork({"check", example("straight_tube").string(), "--set", "mesh.scale=1000", "--set",
                       "transient.start=static", "--set", "gravity.acceleration=[0,0,-9.81]", "--set",
                       "contacts.support.offset=[0.002, 0]"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(says(outcome.err, "contact \"support[0]\" overlaps its obstacle most, by 0.0"));
}

TEST(StaticStart, NamesTheMotionThatNothingHolds) {
  const Workshop folder;
  folder.write("points.msh", lone_points({"block", "wall"}).text());
  const std::string text = R"([mesh]
file = "points.msh"
[[masses]]
group = "block"
mass = 2.0
[[restraints]]
group = "block"
fixed = ["ux", "rx", "ry", "rz"]
[[restraints]]
group = "wall"
fixed = "all"
[[springs]]
group = "block"
stiffness = [0.0, 100.0, 0.0, 0.0, 0.0, 0.0]
[[loads]]
group = "block"
direction = [0.0, 1.0, -1.0]
constant = 3.0
[transient]
duration = 1.0
start = "static"
)";
  const Outcome outcome = folder.fretwork({"run", folder.write("study.toml", text).string(), "--no-report"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(says(outcome.err, "nothing holds a structure against its loads at t = 0: it would move along "
                                "(0, 0, -1); add a restraint"));
}

} // namespace
} // namespace fretwork::app::test::static_start_test
