// SPDX-License-Identifier: GPL-3.0-or-later
// Beams that shear, turn, are pulled or change along their group: from the study file to frequencies and statics.
#include "mesh_text.hpp"
#include "program.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::sections_test {
namespace {

using std::numbers::pi;

constexpr double young = 2.0e11, density = 8000.0, length = 2.0;

const std::string head = R"([mesh]
file = "mesh.msh"
[materials.steel]
young_modulus = 2.0e11
poisson_ratio = 0.3
density = 8000.0
)";

std::string pipe(const std::string& name, double diameter, double thickness, const std::string& more = "") {
  return fmt::format("[sections.{}]\nshape = \"pipe\"\nouter_diameter = {}\nthickness = {}\n{}", name,
                     diameter, thickness, more);
}

std::string beams(const std::string& keys) {
  return "[[beams]]\ngroup = \"tube\"\nmaterial = \"steel\"\n" + keys;
}

std::string held(const std::string& left, const std::string& right) {
  return fmt::format("[[restraints]]\ngroup = \"tube_begin\"\nfixed = {}\n", left) +
         (right.empty() ? "" : fmt::format("[[restraints]]\ngroup = \"tube_end\"\nfixed = {}\n", right)) +
         "[[restraints]]\ngroup = \"tube\"\nfixed = [\"ux\", \"uz\", \"rx\", \"ry\"]\n";
}

const std::string pins = held("[\"uy\"]", "[\"uy\"]");

void write_mesh(const Workshop& folder) {
  MeshText mesh = straight_line("tube", {0, 0, 0}, {length, 0, 0}, 40);
  mesh.points.emplace_back("middle", 20);
  folder.write("mesh.msh", mesh.text());
}

nlohmann::json summary_of(const Workshop& folder, const std::string& study) {
  write_mesh(folder);
  folder.write("study.toml", study);
  const Outcome outcome =
      folder.fretwork({"modes", folder.path("study.toml").string(), "-o", folder.path("out").string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(bytes_of(folder.path("out") / "summary.json"));
}

std::string refusal(const Workshop& folder, const std::string& study) {
  write_mesh(folder);
  folder.write("study.toml", study);
  const Outcome outcome =
      folder.fretwork({"modes", folder.path("study.toml").string(), "-o", folder.path("out").string()});
  EXPECT_EQ(outcome.status, 1) << study;
  return outcome.err;
}

struct Tube {
  double area, inertia;
};
Tube tube_of(double diameter, double thickness) {
  const double inner = diameter - 2.0 * thickness;
  return {pi / 4.0 * (diameter * diameter - inner * inner),
          pi / 64.0 * (std::pow(diameter, 4) - std::pow(inner, 4))};
}

} // namespace

// Lower root of (k G A q^2 - rho A x)(E I q^2 + k G A - rho I x) = (k G A q)^2, x = omega^2.
TEST(Sections, ThatShearAndTurnGiveTimoshenkosFrequency) {
  constexpr double at_40_elements = 1e-4;
  const Workshop folder;
  const auto summary =
      summary_of(folder, head + pipe("tube", 0.2, 0.02, "shear = true\nrotary_inertia = true\n") +
                             beams("section = \"tube\"\n") + pins + "[modes]\ncount = 2\n");
  const auto [area, inertia] = tube_of(0.2, 0.02);
  const double m2 = 0.64, sum = (1.0 + m2) * (1.0 + m2); // inner to outer diameter 0.8
  const double k = 7.8 * sum / (8.8 * sum + 23.6 * m2), ga = k * young / 2.6 * area, q = pi / length;
  const double a = density * area * density * inertia,
               b = density * area * (young * inertia * q * q + ga) + density * inertia * ga * q * q,
               c = ga * young * inertia * std::pow(q, 4);
  const double omega = std::sqrt(2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c)));
  EXPECT_TRUE(close_to(summary["modes"]["frequencies_hz"][0], omega / (2.0 * pi), at_40_elements));
}

TEST(AxialForce, TunesATubeAndBucklesIt) {
  constexpr double at_40_elements = 2e-6;
  const Workshop folder;
  const auto [area, inertia] = tube_of(0.02, 0.001);
  const double euler = pi * pi * young * inertia / (length * length);
  const auto study = [&](double force) {
    return head + pipe("tube", 0.02, 0.001) +
           beams(fmt::format("section = \"tube\"\naxial_force = {}\n", force)) + pins +
           "[modes]\ncount = 2\n";
  };
  const double free = pi / 2.0 / (length * length) * std::sqrt(young * inertia / (density * area));
  EXPECT_TRUE(close_to(summary_of(folder, study(3.0 * euler))["modes"]["frequencies_hz"][0], 2.0 * free,
                       at_40_elements));
  EXPECT_TRUE(close_to(summary_of(folder, study(-0.75 * euler))["modes"]["frequencies_hz"][0], 0.5 * free,
                       at_40_elements));
  EXPECT_TRUE(says(refusal(folder, study(-1.01 * euler)), "buckles under the compression of its beams"));
}

// y(L/2) = P L / (4 N) (1 - tanh(u) / u), u = L/2 sqrt(N / E I); and of the run that starts there nothing moves.
TEST(AxialForce, IsThereInStaticStartsAndInTheLedger) {
  constexpr double series = 1e-6; // of 40 elements and of all modes
  const Workshop folder;
  write_mesh(folder);
  const double inertia = tube_of(0.02, 0.001).inertia, force = 2000.0, load = 50.0;
  const Results run =
      folder.run_text(head + pipe("tube", 0.02, 0.001) +
                      beams(fmt::format("section = \"tube\"\naxial_force = {}\n", force)) + pins +
                      R"([modes]
count = 1000
damping = 0.02
[[loads]]
group = "middle"
direction = [0.0, 1.0, 0.0]
constant = 50.0
[transient]
duration = 2.0e-3
start = "static"
[output]
nodes = ["middle"]
)");
  const double u = 0.5 * length * std::sqrt(force / (young * inertia));
  const double exact = load * length / (4.0 * force) * (1.0 - std::tanh(u) / u);
  const auto& series_y = run.node("middle").displacement.col(1);
  EXPECT_TRUE(close_to(series_y[0], exact, series));
  EXPECT_TRUE(close_to(series_y[series_y.size() - 1], exact, series));
  EXPECT_LT(run.summary["energy"]["residual_relative"].get<double>(), 1e-9);
  EXPECT_TRUE(close_to(run.summary["energy"]["stored_J"], 0.5 * load * exact, 2.0 * series));
}

// A support 40 mm thick meets the tube at two points between its nodes, each with half of its stiffness. A unit force
// at a moves the pinned beam under N at x <= a by
//   G = (x (L - a)/L - sinh(kx) sinh(k(L - a)) / (k sinh(kL))) / N,  k^2 = N/(E I).
TEST(AxialForce, IsThereAtContactsAlongAnElement) {
  constexpr double between_nodes = 5e-6; // the shapes of elements do not know N: 40 of them leave 3.2e-6
  const Workshop folder;
  write_mesh(folder);
  const double inertia = tube_of(0.02, 0.001).inertia, force = 2000.0, load = 50.0, half_stiffness = 0.5e4;
  const Results run =
      folder.run_text(head + pipe("tube", 0.02, 0.001) +
                      beams(fmt::format("section = \"tube\"\naxial_force = {}\n", force)) + pins +
                      R"([modes]
count = 1000
damping = 0.02
[[loads]]
group = "middle"
direction = [0.0, 1.0, 0.0]
constant = 50.0
[[contacts]]
name = "stop"
group = "middle"
obstacle = "plane_y"
gap = 0.0
thickness = 0.04
axis = [1.0, 0.0, 0.0]
angle = 0.0
normal_stiffness = 1.0e4
[transient]
duration = 2.0e-3
start = "static"
[output]
nodes = ["middle"]
)");
  const double k = std::sqrt(force / (young * inertia));
  const auto influence = [&](double x, double a) {
    return (x * (length - a) / length -
            std::sinh(k * x) * std::sinh(k * (length - a)) / (k * std::sinh(k * length))) /
           force;
  };
  const double middle = 0.5 * length, edge = middle - 0.02, other = middle + 0.02;
  const double at_edge = load * influence(edge, middle) /
                         (1.0 + half_stiffness * (influence(edge, edge) + influence(edge, other)));
  const double at_middle =
      load * influence(middle, middle) - 2.0 * half_stiffness * at_edge * influence(edge, middle);
  EXPECT_TRUE(close_to(run.node("middle").displacement(0, 1), at_middle, between_nodes));
}

// A pipe that gets thinner by half in every size has the frequencies of the cone: I ~ A^2.
TEST(Taper, OfATubeGivesTheFrequencyOfTheCone) {
  constexpr double published = 2e-6, at_40_elements = 1e-6; // 4.62515: Downs, J. Appl. Mech. 44 (1977) 737
  const auto [area, inertia] = tube_of(0.04, 0.004);
  const double exact = 4.62515 / (2.0 * pi * length * length) * std::sqrt(young * inertia / (density * area));
  const std::string sections = pipe("root", 0.04, 0.004) + pipe("tip", 0.02, 0.002);
  const std::string fixed_left = held("\"all\"", ""), modes = "[modes]\ncount = 2\n";
  const Workshop folder;
  const auto summary =
      summary_of(folder, head + sections + beams("section = [\"root\", \"tip\"]\nfrom = \"tube_begin\"\n") +
                             fixed_left + modes);
  EXPECT_TRUE(close_to(summary["modes"]["frequencies_hz"][0], exact, published + at_40_elements));
  EXPECT_TRUE(close_to(summary["model"]["mass_kg"], density * area * length * 7.0 / 12.0, 1e-12));
  // the same written from the other end
  const auto turned =
      summary_of(folder, head + sections + beams("section = [\"tip\", \"root\"]\nfrom = \"tube_end\"\n") +
                             fixed_left + modes);
  EXPECT_TRUE(close_to(turned["modes"]["frequencies_hz"][0], summary["modes"]["frequencies_hz"][0], 1e-11));
}

TEST(Taper, OfMassesAddsTheirMeans) {
  const Workshop folder;
  const auto summary = summary_of(
      folder, head + pipe("tube", 0.04, 0.004) +
                  beams("section = \"tube\"\nadded_mass = [0.1, 0.5]\nfluid_inside = [0, 800]\n"
                        "fluid_outside = { density = 500, confinement = [1, 3] }\nfrom = \"tube_end\"\n") +
                  pins + "[modes]\ncount = 2\n");
  const double bore = pi / 4.0 * 0.032 * 0.032, displaced = pi / 4.0 * 0.04 * 0.04;
  EXPECT_TRUE(close_to(
      summary["model"]["mass_kg"],
      length * (density * tube_of(0.04, 0.004).area + 0.3 + 400.0 * bore + 1000.0 * displaced), 1e-12));
}

TEST(Taper, WithoutAPlaceIsRefused) {
  const Workshop folder;
  const auto said = [&](const std::string& from) {
    return refusal(folder, head + pipe("tube", 0.04, 0.004) +
                               beams("section = \"tube\"\nadded_mass = [0, 1]\nfrom = \"" + from + "\"\n") +
                               pins + "[modes]\ncount = 2\n");
  };
  EXPECT_TRUE(says(said("middle"),
                   "[[beams]] entry 1: what changes along group \"tube\" has no place: the node of "
                   "\"middle\" at (1, 0, 0) is no end of its curve"));
  EXPECT_TRUE(says(said("middl"), "the mesh has no group \"middl\"; did you mean \"middle\"?"));
  MeshText two = together(straight_line("tube", {0, 0, 0}, {length, 0, 0}, 4),
                          straight_line("tube", {0, 1, 0}, {length, 1, 0}, 4));
  two.points.emplace_back("one_end", 0);
  two.points.emplace_back("both_ends", 0);
  two.points.emplace_back("both_ends", 4);
  folder.write("two.msh", two.text());
  const auto of_two = [&](const std::string& from) {
    std::string study = head + pipe("tube", 0.04, 0.004) +
                        beams("section = \"tube\"\nadded_mass = [0, 1]\nfrom = \"" + from + "\"\n") + pins;
    study.replace(study.find("mesh.msh"), 8, "two.msh");
    folder.write("study.toml", study);
    const Outcome outcome = folder.fretwork({"check", folder.path("study.toml").string()});
    EXPECT_EQ(outcome.status, from == "tube_begin" ? 0 : 1) << outcome.err;
    return outcome.err;
  };
  EXPECT_TRUE(says(of_two("one_end"), "4 of its 8 lines are on curves without a node of \"one_end\""));
  EXPECT_TRUE(says(of_two("both_ends"), "has nodes of \"both_ends\" at both ends"));
  (void)of_two("tube_begin"); // each has its own
}

} // namespace fretwork::app::test::sections_test
