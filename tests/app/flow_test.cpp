// SPDX-License-Identifier: GPL-3.0-or-later
// The flow along tubes in the program: added mass and weight, damping, stability, and what is refused.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::flow_test {
namespace {

constexpr double pi = std::numbers::pi, outer = 0.01905, bore = outer - 2.0 * 0.00109;
const double bore_area = pi / 4.0 * bore * bore, displaced = pi / 4.0 * outer * outer,
             bending = 2.0e11 * pi / 64.0 * (std::pow(outer, 4) - std::pow(bore, 4));

const std::string square_bundle = "arrangement = \"square\"\npitch = 0.027432\n"; // P/D = 1.44
/// Liquid of 740 kg/m3 all along the tube, 700 inside. @param zone  further keys
std::string flow_of(const std::string& zone, const std::string& flow = {}) {
  return "[[flow]]\ngroup = \"tube\"\nfrom = \"tube_begin\"\n" + flow +
         "[[flow.zones]]\nname = \"water\"\ndensity = 740.0\nviscosity = 1.23e-7\nfluid_inside = 700.0\n" +
         zone;
}

/// A tube of 1 m along x that moves along z alone, pinned. @param beams  further keys of its beams
std::string pinned_tube(const std::string& beams = {}) {
  return steel_pipe("mesh.msh") + "[[beams]]\ngroup = \"tube\"\nmaterial = \"steel\"\nsection = \"tube\"\n" +
         beams +
         R"([[restraints]]
group = "tube"
fixed = ["ux", "uy", "rx", "rz"]
[[restraints]]
group = "tube_begin"
fixed = ["uz"]
[[restraints]]
group = "tube_end"
fixed = ["uz"]
)";
}

void write_mesh(const Workshop& folder) {
  MeshText mesh = straight_line("tube", {0, 0, 0}, {1, 0, 0}, 40);
  mesh.points.emplace_back("middle", 20);
  mesh.points.emplace_back("third", 14);
  folder.write("mesh.msh", mesh.text());
}

nlohmann::json summary_of(const Workshop& folder, const std::string& study,
                          const std::string& command = "modes", const std::vector<std::string>& more = {}) {
  write_mesh(folder);
  folder.write("study.toml", study);
  std::vector<std::string> arguments{command, folder.path("study.toml").string(), "-o",
                                     folder.path("out").string(), "--force"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = folder.fretwork(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(bytes_of(folder.path("out") / "summary.json"));
}

std::string message_of(const Workshop& folder, const std::string& study) {
  write_mesh(folder);
  folder.write("study.toml", study);
  const Outcome outcome = folder.fretwork({"check", folder.path("study.toml").string()});
  EXPECT_EQ(outcome.status, 1);
  return outcome.err;
}

/// kg/m, of the tube in the bundle.
double wet_mass() {
  constexpr double ratio = 1.44, q = (1.07 + 0.56 * ratio) * ratio, cm = (q * q + 1.0) / (q * q - 1.0);
  return 8000.0 * (displaced - bore_area) + 700.0 * bore_area + cm * 740.0 * displaced;
}

TEST(Flow, GivesTheTubeItsAddedMass) {
  constexpr double of_mesh = 4e-8; // (pi/40)^4/1440 of the first frequency, and as much for round-off
  const Workshop folder;
  const auto summary = summary_of(folder, pinned_tube() + "[modes]\ncount = 3\n" + flow_of(square_bundle));
  EXPECT_TRUE(close_to(summary["model"]["mass_kg"], wet_mass(), 1e-12));
  EXPECT_TRUE(
      close_to(summary["modes"]["frequencies_hz"][0], pi / 2.0 * std::sqrt(bending / wet_mass()), of_mesh));
}

TEST(Flow, WeighsWithBuoyancy) {
  constexpr double asked = 1e-6; // of the modes that are left out
  const Workshop folder;
  write_mesh(folder);
  const Results results = folder.run_text(pinned_tube() + flow_of(square_bundle) + R"([modes]
count = 40
[gravity]
acceleration = [0, 0, -9.81]
[transient]
duration = 0.01
start = "static"
[output]
nodes = ["middle"]
)");
  const double mass = 8000.0 * (displaced - bore_area) + 700.0 * bore_area - 740.0 * displaced;
  EXPECT_TRUE(
      close_to(-results.node("middle").displacement(0, 2), 5.0 * mass * 9.81 / (384.0 * bending), asked));
}

TEST(Flow, RefusesFluidsThatAreGivenTwice) {
  const Workshop folder;
  EXPECT_TRUE(says(
      message_of(folder, pinned_tube("fluid_inside = 700.0\n") + flow_of("")),
      "flow \"tube\": [[beams]] of group \"tube\" have fluid_inside or fluid_outside, and the flow gives"));
  EXPECT_TRUE(says(message_of(folder, pinned_tube("fluid_outside = { density = 1.0 }\n") + flow_of("")),
                   "leave one of them out"));
}

TEST(Flow, RefusesWhatIsNoTube) {
  const Workshop folder;
  const std::string again =
      "[[flow]]\nname = \"again\"\ngroup = \"tube\"\nfrom = \"tube_begin\"\n[[flow.zones]]\n"
      "density = 740.0\nviscosity = 1.23e-7\n";
  const auto of = [](std::string text, const std::string& old, const std::string& fresh) {
    return text.replace(text.find(old), old.size(), fresh);
  };
  const std::pair<std::string, std::string> cases[] = {
      {flow_of("") + again, "flow \"tube\" and flow \"again\" share a beam"},
      {of(flow_of(""), "tube_begin", "tube"),
       "from = \"tube\" has 2 of the 2 ends of its curves; name a group with one end"},
      {of(flow_of(""), "\"tube\"", "\"tub\""), "flow \"tub\""},
      {of(flow_of(""), "tube_begin", "middle"), "from = \"middle\" has 0 of the 2 ends"},
      {flow_of("from = 0.5\nto = 1.5\n"), "flow \"tube\": zone \"water\""},
      {flow_of("arrangement = \"square\"\npitch = 0.0191\n"), "flow \"tube\": zone \"water\": pitch = "}};
  for (const auto& [flow, expected] : cases)
    EXPECT_TRUE(says(message_of(folder, pinned_tube() + flow), expected));
}

TEST(Flow, NotesZonesOfFewElements) {
  const Workshop folder;
  const auto summary = summary_of(
      folder, pinned_tube() + flow_of("to = 0.1\n" + square_bundle) +
                  "[[flow.zones]]\nname = \"rest\"\nfrom = 0.1\ndensity = 740.0\nviscosity = 1.23e-7\n");
  EXPECT_TRUE(says(summary["notes"].dump(), "zone \\\"water\\\": 4 elements, fewer than 10"));
}

TEST(Flow, WarnsOfPartsOfTheTubeInNoZone) {
  const Workshop folder;
  const auto warnings = [&](const std::string& zone) {
    return summary_of(folder, pinned_tube() + "[modes]\ncount = 3\n" + flow_of(zone))["warnings"].dump();
  };
  EXPECT_TRUE(says(warnings("from = 0.2\nto = 0.7\n"),
                   "no zone has s = 0 to 0.2 m, s = 0.7 to 1 m of its tube, which is 1 m long"));
  EXPECT_TRUE(says(warnings("from = 0.2\n"), "give it a zone, with phase = \\\"none\\\" if it is dry"));
  const std::string dry = "[[flow.zones]]\nphase = \"none\"\n";
  EXPECT_EQ(
      warnings("from = 0.2\nto = 0.7\n" + dry + "to = 0.2\n" + dry + "from = 0.7\n").find("no zone has"),
      std::string::npos);
  EXPECT_TRUE(says(warnings("from = 0.2\nto = 0.7\n" + dry + "from = 0.7\n"),
                   "no zone has s = 0 to 0.2 m of its tube"));
  EXPECT_EQ(warnings("").find("no zone has"), std::string::npos);
  EXPECT_EQ(warnings("to = 0.996\n").find("no zone has"), std::string::npos); // as tables may end early
}

/// A leg of 1 m along x, and a quarter of a circle, 0.5 m long, of chords; contacts at 0.5 m and 0.9 m.
TEST(Flow, NotesVelocitiesAcrossTheTubeThatReachFarIntoALeg) {
  const Workshop folder;
  MeshText mesh = straight_line("tube", {0, 0, 0}, {1.5, 0, 0}, 30);
  const double radius = 1.0 / pi;
  for (int k = 21; k <= 30; ++k) {
    const double angle = 0.05 * (k - 20) / radius;
    mesh.nodes[static_cast<std::size_t>(k)] = {1.0 + radius * std::sin(angle), 0.0,
                                               radius * (1.0 - std::cos(angle))};
  }
  for (const int node : {10, 18})
    mesh.points.emplace_back("plates", node);
  const std::string contacts = "[[contacts]]\ngroup = \"plates\"\ngap = 1e-4\nnormal_stiffness = 1e6\n";
  const auto notes = [&](const std::string& zone) {
    folder.write("mesh.msh", mesh.text());
    folder.write("study.toml", steel_pipe("mesh.msh") + tube_between("tube") + flow_of(zone) + contacts +
                                   "[modes]\ncount = 3\n[transient]\nduration = 0.01\n");
    const Outcome outcome = folder.fretwork({"check", folder.path("study.toml").string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_TRUE(
      says(notes("velocity = 1\n"),
           "note: flow \"tube\", zone \"water\": its velocity is across the tube in the straight leg "
           "too, past the first contact beside the bend: s = 0 to 0.9 m. Where the flow is along the leg, "
           "give velocity as a vector"));
  EXPECT_TRUE(says(notes("velocity = 1\nfrom = 0.8\n"), "the bend: s = 0.8 to 0.9 m"));
  for (const char* to : {"1.2", "1.02"})
    EXPECT_TRUE(says(notes(fmt::format("velocity = 1\nto = {}\n", to)), "the bend: s = 0 to 0.9 m")) << to;
  for (const char* zone : {"velocity = 1\nfrom = 0.92\n", "velocity = 1\nto = 0.9\n",
                           "velocity = 1\nto = 1.000001\n", // the whole leg, by a rounded end
                           "velocity = [0, 0, 1]\n", "velocity = [[0, 0], [0.8, 0.5], [1.5, 1]]\n", ""})
    EXPECT_FALSE(says(notes(zone), "straight leg")) << zone;
}

TEST(Flow, WarnsOfBeamsThatGoOnBeyondItsGroup) {
  const Workshop folder;
  MeshText mesh = straight_line("tube", {0, 0, 0}, {1, 0, 0}, 10);
  mesh.lines[8].group = mesh.lines[9].group = "rest";
  mesh.points.emplace_back("joint", 8);
  folder.write("mesh.msh", mesh.text());
  const std::string study = pinned_tube() + "[[beams]]\ngroup = \"rest\"\nmaterial = \"steel\"\n"
                                            "section = \"tube\"\n[modes]\ncount = 3\n";
  const auto warnings = [&](const std::string& more) {
    const Outcome outcome =
        folder.fretwork({"check", folder.write("study.toml", study + flow_of("") + more).string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_TRUE(says(warnings(""), "flow \"tube\": 2 beams go on beyond its tube, from (0.8, 0, 0) on, without "
                                 "the mass and damping of a fluid"));
  EXPECT_EQ(warnings("[[flow]]\ngroup = \"rest\"\nfrom = \"joint\"\n[[flow.zones]]\ndensity = 740.0\n"
                     "viscosity = 1.23e-7\n")
                .find("go on beyond"),
            std::string::npos);
}

} // namespace
} // namespace fretwork::app::test::flow_test
