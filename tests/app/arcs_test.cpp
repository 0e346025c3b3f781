// SPDX-License-Identifier: GPL-3.0-or-later
// Bends of arcs: from a geometry meshed with order 2 to frequencies, mass, loads and contacts inside the bend.
#include "program.hpp"
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::arcs_test {
namespace {

constexpr double leg = 0.2504, radius = 0.412947;

/// Case E1: a U-bend between clamped feet, 12 elements a bend.
std::string geometry() {
  return fmt::format(R"(L = {}; R = {};
Point(1) = {{-R, 0, 0}}; Point(2) = {{-R, 0, L}}; Point(3) = {{0, 0, L}}; Point(4) = {{0, 0, L + R}};
Point(5) = {{R, 0, L}}; Point(6) = {{R, 0, 0}};
Line(1) = {{1, 2}}; Circle(2) = {{2, 3, 4}}; Circle(3) = {{4, 3, 5}}; Line(4) = {{5, 6}};
Transfinite Curve {{1, 4}} = 9; Transfinite Curve {{2, 3}} = 7;
Physical Curve("tube") = {{1, 2, 3, 4}}; Physical Point("feet") = {{1, 6}}; Physical Point("apex") = {{4}};
)",
                     leg, radius);
}

const std::string study = R"([mesh]
file = "bend.geo"
order = 2
[materials.alloy]
young_modulus = 2.02e11
poisson_ratio = 0.3
density = 8330.0
[sections.tube]
shape = "pipe"
outer_diameter = 0.02222
thickness = 0.00127
[[beams]]
group = "tube"
material = "alloy"
section = "tube"
[[restraints]]
group = "feet"
fixed = "all"
[modes]
count = 6
)";

const std::string apex_in_a_ring = R"(damping = 0.3
[gravity]
acceleration = [0.0, -9.81, 0.0]
[[contacts]]
name = "bar"
group = "apex"
obstacle = "circle"
gap = 1.0
thickness = 0.05
normal_stiffness = 1.0e5
[transient]
duration = 1.0
[output]
nodes = ["apex"]
statistics_from = 0.9
)";

const std::array<double, 6> frequencies{30.055, 62.795, 82.627, 163.80, 182.53, 315.65};

double worst_error(const Results& run) {
  double worst = 0.0;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const double found = run.summary["modes"]["frequencies_hz"][i];
    worst = std::max(worst, std::abs(found / frequencies[i] - 1.0));
  }
  return worst;
}

TEST(Arcs, OfAGeometryOfOrderTwoGiveTheFrequenciesOfTheBend) {
  const Workshop folder;
  folder.write("bend.geo", geometry());
  const Results run = folder.run_text(study + apex_in_a_ring);
  EXPECT_LT(worst_error(run), 5e-4); // of 12 arcs; chords leave 5e-3
  EXPECT_EQ(run.summary["model"]["elements"], 28);
  EXPECT_EQ(run.summary["model"]["nodes"], 29);
  const double area = std::numbers::pi * 0.00127 * (0.02222 - 0.00127);
  EXPECT_TRUE(
      close_to(run.summary["model"]["mass_kg"], 8330.0 * area * (2 * leg + std::numbers::pi * radius), 1e-9));
}

TEST(Arcs, CarryGravityAndSupportsOfSomeThickness) {
  const Workshop folder;
  folder.write("bend.geo", geometry());
  const Results arcs = folder.run_text(study + apex_in_a_ring);
  const Results chords = folder.run_text(study + apex_in_a_ring, {"--set", "mesh.order=1"});
  // the sag out of the plane at rest: as that of chords, within their errors
  const auto sag = [](const Results& run) {
    return run.summary["nodes"][0]["displacement"]["y"]["mean"].get<double>();
  };
  EXPECT_LT(sag(arcs), -1e-4);
  EXPECT_TRUE(close_to(sag(arcs), sag(chords), 2e-2));
}

TEST(Arcs, BecomeChordsWhereOrderOneIsWanted) {
  const Workshop folder;
  folder.write("bend.geo", geometry());
  const Results run = folder.run_text(study + apex_in_a_ring, {"--set", "mesh.order=1"});
  EXPECT_GT(worst_error(run), 2e-3);
}

} // namespace
} // namespace fretwork::app::test::arcs_test
