// SPDX-License-Identifier: GPL-3.0-or-later
// Ties of the study file: from hinges and slides between groups to frequencies, equilibrium and messages.
#include "mesh_text.hpp"
#include "program.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app::test::ties_test {
namespace {

const std::string rods = R"([mesh]
file = "mesh.msh"
[materials.steel]
young_modulus = 2.0e11
poisson_ratio = 0.3
density = 7800.0
[sections.bar]
shape = "general"
area = 2.872e-3
iy = 1.943e-5
iz = 1.943e-5
torsion_constant = 5.165e-8
)";

std::string beams(const std::string& group) {
  return fmt::format("[[beams]]\ngroup = \"{}\"\nmaterial = \"steel\"\nsection = \"bar\"\n", group);
}

std::string restraint(const std::string& group, const std::string& fixed) {
  return fmt::format("[[restraints]]\ngroup = \"{}\"\nfixed = {}\n", group, fixed);
}

/// Case D3: two bars and a cross bar, whose two ends are tied to the two middles by one entry.
void write_h_grid(const Workshop& folder) {
  MeshText mesh = together(together(straight_line("left", {-2.5, -2.5, 0.0}, {-2.5, 2.5, 0.0}, 10),
                                    straight_line("right", {2.5, -2.5, 0.0}, {2.5, 2.5, 0.0}, 10)),
                           straight_line("cross", {-2.5, 0.0, 0.0}, {2.5, 0.0, 0.0}, 10));
  for (const int node : {0, 10, 11, 21})
    mesh.points.emplace_back("corners", node);
  for (const int node : {16, 5}) // not in the order of the ends
    mesh.points.emplace_back("middles", node);
  for (const int node : {22, 32})
    mesh.points.emplace_back("ends", node);
  folder.write("mesh.msh", mesh.text());
}

const std::string h_grid =
    rods + beams("left") + beams("right") + beams("cross") + restraint("corners", "[\"uz\"]") +
    restraint("left", R"(["ux", "uy", "ry", "rz"])") + restraint("right", R"(["ux", "uy", "ry", "rz"])") +
    restraint("cross", R"(["ux", "uy", "rx", "rz"])") + "[modes]\ncount = 3\n";

std::string tie(const std::string& group, const std::string& other, const std::string& tied) {
  return fmt::format("[[ties]]\ngroup = \"{}\"\nother = \"{}\"\ntied = {}\n", group, other, tied);
}

/// Gerber's beam: clamped, hinged, on a roller; 100 N at the hinge.
const std::string gerber = rods + beams("a") + beams("b") + restraint("a_begin", "\"all\"") +
                           restraint("b_end", R"(["uy", "uz", "rx"])") +
                           tie("a_end", "b_begin", R"(["ux", "uy", "uz"])") + R"([modes]
count = 1000
damping = 0.02
[[loads]]
group = "b_begin"
direction = [0.0, 1.0, 0.0]
constant = 100.0
[transient]
duration = 1.0e-3
start = "static"
[output]
nodes = ["a_end", "b_begin"]
)";

void write_gerber(const Workshop& folder) {
  folder.write("mesh.msh", together(straight_line("a", {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 4),
                                    straight_line("b", {1.0, 0.0, 0.0}, {1.5, 0.0, 0.0}, 2))
                               .text());
}

TEST(Ties, GiveTheFrequenciesOfTheHGrid) {
  constexpr double printed = 2.5e-7; // seven digits
  const Workshop folder;
  write_h_grid(folder);
  folder.write("study.toml", h_grid + tie("ends", "middles", "[\"uz\"]"));
  const Outcome outcome =
      folder.fretwork({"modes", folder.path("study.toml").string(), "-o", folder.path("out").string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto frequencies =
      nlohmann::json::parse(bytes_of(folder.path("out") / "summary.json"))["modes"]["frequencies_hz"];
  const std::array<double, 3> reference{16.419020, 22.56758, 38.046795};
  for (std::size_t i = 0; i < reference.size(); ++i)
    EXPECT_TRUE(close_to(frequencies[i], reference[i], printed)) << frequencies[i];
}

TEST(Ties, CarryALoadThroughAHinge) {
  constexpr double series = 1e-6; // of all modes, and the round-off of the start
  const Workshop folder;
  write_gerber(folder);
  const Results run = folder.run_text(gerber);
  const double deflection = 100.0 / (3.0 * 2.0e11 * 1.943e-5);
  for (const char* node : {"a_end", "b_begin"})
    EXPECT_TRUE(close_to(run.node(node).displacement(0, 1), deflection, series)) << node;
  EXPECT_EQ(run.archive.bases.size(), 1u);
}

TEST(Ties, RestrainWhatIsTiedToARestraint) {
  const Workshop folder;
  write_gerber(folder);
  const auto ties = tie("a_end", "b_begin", R"(["ux", "uy", "uz"])");
  std::string study = gerber;
  study.replace(study.find(ties), ties.size(), ties + restraint("a_end", "[\"uy\"]"));
  const Results run = folder.run_text(study);
  EXPECT_EQ(run.node("b_begin").displacement.col(1).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Ties, ThatCannotBeMadeAreRefused) {
  const Workshop folder;
  write_h_grid(folder);
  const auto said = [&](const std::string& entry) {
    folder.write("study.toml", h_grid + entry);
    const Outcome outcome = folder.fretwork({"check", folder.path("study.toml").string()});
    EXPECT_EQ(outcome.status, 1);
    return outcome.err;
  };
  EXPECT_TRUE(
      says(said(tie("ends", "corners", "[\"uz\"]")),
           "[[ties]] entry 1: group \"ends\" has 2 nodes and other \"corners\" has 4; pairs need as many "
           "nodes in each"));
  EXPECT_TRUE(says(said(tie("left_begin", "corners", "[\"uz\"]")), "has 1 nodes and other"));
  EXPECT_TRUE(says(said(tie("ends", "cross_tips", "[\"uz\"]")), "cross_tips"));
  EXPECT_TRUE(says(said(tie("cross_begin", "ends", "[\"uz\"]")), "has 1 nodes and other"));
  EXPECT_TRUE(says(said(tie("left", "cross", "[\"uz\"]")), "the same nearest node in \"cross\""));
  EXPECT_TRUE(says(said(tie("ends", "middles", "[\"dz\"]")), "ties.ends.tied = \"dz\": unknown"));
}

} // namespace
TEST(Ties, CarryAnInitialStateAndRefuseOneThatContradictsThem) {
  const Workshop folder;
  write_gerber(folder);
  std::string at_rest = gerber;
  const std::string start = "start = \"static\"\n";
  at_rest.erase(at_rest.find(start), start.size());
  const auto initial = [](const std::string& group, const std::string& displacement) {
    return fmt::format("[[initial]]\ngroup = \"{}\"\ndisplacement = {}\n", group, displacement);
  };
  const Results run = folder.run_text(at_rest + initial("a_end", "[0.0, 1.0e-3, 0.0]"), {"--force"});
  constexpr double all_modes = 1e-9; // no mode is left out
  for (const char* node : {"a_end", "b_begin"})
    EXPECT_TRUE(close_to(run.node(node).displacement(0, 1), 1e-3, all_modes)) << node;
  const std::string both = initial("a_end", "[0.0, 1.0e-3, 0.0]") + initial("b_begin", "[0.0, 2.0e-3, 0.0]");
  const Outcome refused = folder.fretwork({"check", folder.write("study.toml", at_rest + both).string()});
  EXPECT_EQ(refused.status, 1);
  EXPECT_TRUE(says(refused.err,
                   "[[initial]] displacement: uy is tied between the nodes at (1, 0, 0) and (1, 0, 0), but "
                   "given as 0.001 and 0.002; give it the same value, or at one of the nodes only"));
}

} // namespace fretwork::app::test::ties_test
