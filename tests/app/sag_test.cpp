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

} // namespace
} // namespace fretwork::app::test::sag_test
