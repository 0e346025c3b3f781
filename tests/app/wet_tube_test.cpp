// SPDX-License-Identifier: GPL-3.0-or-later
// A tube in and full of fluid, damped by frequency: from the study file to frequencies, mass and ratios.
#include "mesh_text.hpp"
#include "program.hpp"
#include <cmath>
#include <numbers>

namespace fretwork::app::test::wet_tube_test {
namespace {

/// Case E2: clamped at both ends, motion across the tube.
const std::string tube = R"([mesh]
file = "mesh.msh"
[materials.steel]
young_modulus = 2.1e11
poisson_ratio = 0.3
density = 7800.0
[sections.tube]
shape = "pipe"
outer_diameter = 0.04
thickness = 0.005
[[beams]]
group = "tube"
material = "steel"
section = "tube"
fluid_inside = 1000.0
fluid_outside = { density = 1000.0, confinement = 0.6366197723675814 }
[[restraints]]
group = "tube_begin"
fixed = "all"
[[restraints]]
group = "tube_end"
fixed = "all"
[[restraints]]
group = "tube"
fixed = ["ux", "uz", "rx", "ry"]
[modes]
count = 3
)";

nlohmann::json modes_of(const Workshop& folder, const std::string& study) {
  folder.write("mesh.msh", straight_line("tube", {0, 0, 0}, {1, 0, 0}, 40).text());
  folder.write("study.toml", study);
  const Outcome outcome =
      folder.fretwork({"modes", folder.path("study.toml").string(), "-o", folder.path("out").string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(bytes_of(folder.path("out") / "summary.json"));
}

TEST(WetTube, HasTheMassOfItsFluids) {
  constexpr double printed = 2e-5; // of 5.7952 kg/m
  constexpr double elements = 40.0;
  const Workshop folder;
  const auto summary = modes_of(folder, tube);
  EXPECT_TRUE(close_to(summary["model"]["mass_kg"], 5.7952, printed));
  const double inertia = std::numbers::pi / 64.0 * (std::pow(0.04, 4) - std::pow(0.03, 4));
  const std::array<double, 3> roots{4.7300407449, 7.8532046241, 10.9956078380};
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const double of_mesh = std::pow(roots[i] / elements, 4) / 1440.0; // doc/theory.md
    EXPECT_TRUE(close_to(summary["modes"]["frequencies_hz"][i],
                         roots[i] * roots[i] / (2.0 * std::numbers::pi) *
                             std::sqrt(2.1e11 * inertia / summary["model"]["mass_kg"].get<double>()),
                         1.05 * of_mesh));
  }
}

TEST(WetTube, TakesItsDampingFromATableByFrequency) {
  constexpr double round_off = 1e-12; // of frequencies with all their digits
  const Workshop folder;
  const auto summary =
      modes_of(folder, tube + "damping = { table = [[0, 0.03], [500, 0.01], [600, 0.02]] }\n");
  const auto& modes = summary["modes"];
  for (std::size_t i = 0; i < 3; ++i) {
    const double hertz = modes["frequencies_hz"][i];
    const double ratio = hertz < 500.0   ? 0.03 - 4e-5 * hertz
                         : hertz < 600.0 ? 0.01 + 1e-4 * (hertz - 500.0)
                                         : 0.02;
    EXPECT_TRUE(close_to(modes["damping"][i], ratio, round_off)) << hertz;
  }
  // one mode in each part of the table
  EXPECT_LT(modes["frequencies_hz"][0], 500.0);
  EXPECT_GT(modes["frequencies_hz"][1], 500.0);
  EXPECT_LT(modes["frequencies_hz"][1], 600.0);
  EXPECT_GT(modes["frequencies_hz"][2], 600.0);
}

} // namespace
} // namespace fretwork::app::test::wet_tube_test
