// SPDX-License-Identifier: GPL-3.0-or-later
// The weight of a horizontal tube: in air, and full of water in water, where what it displaces carries a part of it.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::sag_test {
namespace {

constexpr double pi = std::numbers::pi, outer = 0.01905, bore = outer - 2.0 * 0.00109, gravity = 9.81;
constexpr double span = 1.0;
const double bore_area = pi / 4.0 * bore * bore, displaced = pi / 4.0 * outer * outer,
             stiffness = 2.0e11 * pi / 64.0 * (std::pow(outer, 4) - std::pow(bore, 4));

/// m, at the middle of a pinned span. @param fluid  keys of the beams
double sag(const Workshop& folder, const std::string& fluid) {
  MeshText mesh = straight_line("tube", {0, 0, 0}, {span, 0, 0}, 40);
  mesh.points.emplace_back("middle", 20);
  folder.write("mesh.msh", mesh.text());
  const std::string study = steel_pipe("mesh.msh") +
                            "[[beams]]\ngroup = \"tube\"\nmaterial = \"steel\"\nsection = \"tube\"\n" +
                            fluid +
                            R"([[restraints]]
group = "tube"
fixed = ["ux", "uy", "rx", "rz"]
[[restraints]]
group = "tube_begin"
fixed = ["uz"]
[[restraints]]
group = "tube_end"
fixed = ["uz"]
[modes]
count = 40
[gravity]
acceleration = [0, 0, -9.81]
[transient]
duration = 0.01
start = "static"
[output]
nodes = ["middle"]
)";
  const Results results = folder.run_text(study, {"--force"});
  return -results.node("middle").displacement(0, 2);
}

/// kg/m -> m.
double closed_form(double mass) { return 5.0 * mass * gravity * std::pow(span, 4) / (384.0 * stiffness); }

TEST(Sag, OfATubeFullOfWaterInWaterIsThatOfItsWeightLessBuoyancy) {
  constexpr double asked =
      1e-6; // of modes that are left out: (1/41)^5 of the first; the mesh gives none at nodes
  const double metal = 8000.0 * (displaced - bore_area);
  const Workshop folder;
  const std::string filled = "fluid_inside = 1000.0\n";
  for (const char* confinement : {"1.0", "2.5"})
    EXPECT_TRUE(close_to(
        sag(folder,
            filled + fmt::format("fluid_outside = {{ density = 1000.0, confinement = {} }}\n", confinement)),
        closed_form(metal + 1000.0 * (bore_area - displaced)), asked))
        << "hydrodynamic mass does not weigh: " << confinement;
}

TEST(Sag, InAirIsThatOfTheTubeAndWhatIsInIt) {
  constexpr double asked = 1e-6; // as above
  const double metal = 8000.0 * (displaced - bore_area);
  const Workshop folder;
  EXPECT_TRUE(close_to(sag(folder, ""), closed_form(metal), asked));
  EXPECT_TRUE(close_to(sag(folder, "fluid_inside = 800.0\nadded_mass = 0.2\n"),
                       closed_form(metal + 800.0 * bore_area + 0.2), asked))
      << "added mass that is given by itself weighs";
}

/// A tube that hangs from its upper end, or one that stands on it, in a grid with a gap at its free end.
std::string hanging(const Workshop& folder, double length, double gravity_z, const std::string& beam_keys,
                    bool grid) {
  MeshText mesh = straight_line("tube", {0, 0, 0}, {0, 0, -length}, 40);
  folder.write("mesh.msh", mesh.text());
  return steel_pipe("mesh.msh") + "[[beams]]\ngroup = \"tube\"\nmaterial = \"steel\"\nsection = \"tube\"\n" +
         beam_keys + "[[restraints]]\ngroup = \"tube_begin\"\nfixed = \"all\"\n" +
         (grid ? "[[contacts]]\ngroup = \"tube_end\"\ngap = 1.0e-4\nnormal_stiffness = 1.0e5\n" : "") +
         fmt::format(
             "[modes]\ncount = 10\n[gravity]\nacceleration = [0, 0, {}]\n[transient]\nduration = 0.01\n",
             gravity_z);
}

double first_hz(const Results& run) { return run.summary["modes"]["frequencies_hz"][0]; }

// The weight is 0.492 kg/m: 19.3 N at the top of 4 m. By Rayleigh's quotient w_1^2 grows by 1.571 g/L, 3.9 % of the frequency.
TEST(Weight, AlongATubeIsNotedWithWhatItWouldChange) {
  const Workshop folder;
  const Results plain = folder.run_text(hanging(folder, 4.0, -9.81, "", false), {"--force"});
  const std::string notes = plain.summary["notes"].dump();
  EXPECT_TRUE(
      says(notes, "[gravity]: the weight makes axial forces of 0 to 19.1 N in the beams (tension > 0)"));
  EXPECT_TRUE(says(notes, "which the modes leave out: they change the frequency of 1.112 Hz by +3.9 %; give "
                          "them by axial_force = [a, b]"));
  const double top = 8000.0 * (displaced - bore_area) * gravity * 4.0;
  const Results given =
      folder.run_text(hanging(folder, 4.0, -9.81,
                              fmt::format("axial_force = [{}, 0.0]\nfrom = \"tube_begin\"\n", top), false),
                      {"--force"});
  EXPECT_NEAR(first_hz(given) / first_hz(plain), 1.0387, 1e-3);
  EXPECT_EQ(given.summary["notes"].dump().find("[gravity]"), std::string::npos);
}

// Modes, stability and response of a tube are as wrong without it as a run is.
TEST(Weight, AlongATubeIsNotedWithItsModesToo) {
  const Workshop folder;
  const fs::path study = folder.write("study.toml", hanging(folder, 4.0, -9.81, "", false));
  const Outcome modes = folder.fretwork({"modes", study.string(), "-o", folder.path("modes").string()});
  ASSERT_EQ(modes.status, 0) << modes.err;
  const std::string change = "they change the frequency of 1.112 Hz by +3.9 %";
  EXPECT_TRUE(says(modes.out, change));
  EXPECT_TRUE(
      says(nlohmann::json::parse(bytes_of(folder.path("modes") / "summary.json"))["notes"].dump(), change));
}

// Greenhill, Proc. Camb. Phil. Soc. 4 (1881) 65: a column buckles under its own weight from w L^3/EI = 7.837 on.
TEST(Weight, GivenAsAxialForceBucklesAColumnAtGreenhillsLength) {
  constexpr double by_steps = 1e-3; // of the length: 40 elements, each with the force of its middle
  const Workshop folder;
  const double weight = 8000.0 * (displaced - bore_area) * gravity,
               critical = std::cbrt(7.837347 * stiffness / weight);
  const auto modes = [&](double length) {
    const std::string keys =
        fmt::format("axial_force = [{}, 0.0]\nfrom = \"tube_begin\"\n", -weight * length);
    const fs::path study = folder.write("study.toml", hanging(folder, length, gravity, keys, false));
    return folder.fretwork({"modes", study.string(), "-o", folder.path("modes").string(), "--force"});
  };
  EXPECT_EQ(modes((1.0 - by_steps) * critical).status, 0);
  const Outcome longer = modes((1.0 + by_steps) * critical);
  EXPECT_EQ(longer.status, 1);
  EXPECT_TRUE(says(longer.err, "buckles under the compression of its beams"));
}

TEST(Weight, ThatWouldBuckleATubeIsAWarning) {
  const Workshop folder;
  const auto said = [&](double length, bool grid) {
    const nlohmann::json summary =
        folder.run_text(hanging(folder, length, 9.81, "", grid), {"--force"}).summary;
    return summary["warnings"].dump();
  };
  EXPECT_TRUE(says(said(12.0, false), "with them the mode at 0.1236 Hz buckles"));
  EXPECT_EQ(said(4.0, true).find("[gravity]"), std::string::npos); // a grid holds its end
}

/// Arcs of a circle of radius R in the plane y = 0, and what follows of the study.
std::string arcs(const Workshop& folder, const std::string& curves, const std::string& restraints,
                 double gravity_z) {
  folder.write("bend.geo", curves);
  return "[mesh]\nfile = \"bend.geo\"\norder = 2\n" +
         steel_pipe("bend.geo").substr(steel_pipe("bend.geo").find("[materials")) +
         "[[beams]]\ngroup = \"tube\"\nmaterial = \"steel\"\nsection = \"tube\"\n" + restraints +
         fmt::format(
             "[modes]\ncount = 6\n[gravity]\nacceleration = [0, 0, {}]\n[transient]\nduration = 0.01\n",
             gravity_z);
}

/// Half a circle of radius R below its apex.
std::string half_circle(double radius, int arcs_a_quarter) {
  return fmt::format("R = {}; Point(1) = {{-R, 0, -R}}; Point(2) = {{0, 0, 0}}; Point(3) = {{R, 0, -R}};\n"
                     "Point(4) = {{0, 0, -R}}; Circle(1) = {{1, 4, 2}}; Circle(2) = {{2, 4, 3}};\n"
                     "Transfinite Curve {{1, 2}} = {};\n"
                     "Physical Curve(\"tube\") = {{1, 2}}; Physical Point(\"apex\") = {{2}};\n",
                     radius, arcs_a_quarter + 1);
}

/// Warnings of half a circle that is restrained at its apex.
std::string of_half_circle(double radius, int arcs_a_quarter, const std::string& fixed, double gravity_z) {
  const Workshop folder;
  const Results run =
      folder.run_text(arcs(folder, half_circle(radius, arcs_a_quarter),
                           "[[restraints]]\ngroup = \"apex\"\nfixed = " + fixed + "\n", gravity_z));
  return run.summary["warnings"].dump();
}

// It turns as a ring does: w^2 = g R (1 - 2/pi)/(2 R^2 (1 - 2/pi)) = g/(2 R), 0.352 Hz for 1 m.
// The largest axial force is that of w R (pi/2 - a) sin a, at tan a = pi/2 - a: 0.5611 w R, 2.71 N.
TEST(Weight, OfABendThatHangsFromAHingeMakesItAPendulum) {
  const std::string hinge = R"(["ux", "uy", "uz", "rx", "rz"])",
                    fine = of_half_circle(1.0, 40, hinge, -gravity);
  EXPECT_TRUE(says(fine, "the weight makes axial forces of 0 to 2.71 N in the beams"));
  EXPECT_TRUE(says(fine,
                   "with them a motion without strain is a pendulum of 0.352 Hz; axial_force = [a, b] and "
                   "from of [[beams]] give those of straight beams; arcs cannot have any"));
  EXPECT_TRUE(says(of_half_circle(1.0, 2, hinge, -gravity), "pendulum of 0.353 Hz")) << "two arcs a quarter";
  EXPECT_TRUE(says(of_half_circle(1.0, 40, hinge, gravity), "a motion without strain falls over"));
}

TEST(Weight, OfABendThatFallsMakesNoForces) {
  const std::string falls = R"(["ux", "uy", "rx", "ry", "rz"])", held = R"("all")";
  EXPECT_TRUE(says(of_half_circle(10.0, 2, held, -gravity), "[gravity]"));
  EXPECT_FALSE(says(of_half_circle(10.0, 2, falls, -gravity), "[gravity]"));
}

// An arc of 400 m radius: the figures of the straight tube above; the top of its first chord has 19.3 N.
TEST(Weight, AlongAFlatArcIsThatOfAStraightTube) {
  const Workshop folder;
  const double radius = 400.0, angle = 4.0 / radius;
  const std::string flat =
      fmt::format("Point(1) = {{0, 0, 0}}; Point(2) = {{{:.12g}, 0, {:.12g}}}; Point(3) = {{{}, 0, 0}};\n"
                  "Circle(1) = {{1, 3, 2}}; Transfinite Curve {{1}} = 41;\n"
                  "Physical Curve(\"tube\") = {{1}}; Physical Point(\"top\") = {{1}};\n",
                  radius * (1.0 - std::cos(angle)), -radius * std::sin(angle), radius);
  const std::string notes =
      folder.run_text(arcs(folder, flat, "[[restraints]]\ngroup = \"top\"\nfixed = \"all\"\n", -gravity))
          .summary["notes"]
          .dump();
  EXPECT_TRUE(says(notes, "the weight makes axial forces of 0 to 19.3 N"));
  EXPECT_TRUE(says(notes, "they change the frequency of 1.112 Hz by +3.9 %"));
}

} // namespace
} // namespace fretwork::app::test::sag_test
