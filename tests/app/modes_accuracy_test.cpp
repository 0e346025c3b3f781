// SPDX-License-Identifier: GPL-3.0-or-later
// modes.accuracy: as many modes as the forces of contacts need.
#include "mesh_text.hpp"
#include "program.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test {
namespace {

constexpr double bending = 496.0, mass = 1.0; // N m2, kg/m of a span of 1 m

/// A pinned span that gravity throws against a stop.
std::string span(const std::string& modes, double stiffness) {
  return R"([mesh]
file = "beam.msh"
[materials.steel]
young_modulus = 2.0e11
poisson_ratio = 0.3
density = 8000.0
[sections.tube]
shape = "general"
area = 1.25e-4
iy = 2.48e-9
iz = 2.48e-9
torsion_constant = 4.96e-9
polar_inertia = 4.96e-9
[[beams]]
group = "beam"
material = "steel"
section = "tube"
[[restraints]]
group = "beam_begin"
fixed = ["uy"]
[[restraints]]
group = "beam_end"
fixed = ["uy"]
[[restraints]]
group = "beam"
fixed = ["ux", "uz", "rx", "ry"]
[gravity]
acceleration = [0.0, 20.0, 0.0]
[transient]
duration = 0.015
step = 1.0e-6
[[contacts]]
name = "stop"
group = "stop"
obstacle = "stop_y"
axis = [1.0, 0.0, 0.0]
gap = 5.0e-4
)" + fmt::format("normal_stiffness = {}\n[modes]\ndamping = 0.001\n{}\n", stiffness, modes);
}

/// The stop at `element` of 100 along the span.
void mesh_span(const Workshop& folder, int element) {
  MeshText mesh = straight_line("beam", core::Vec3::Zero(), {1.0, 0.0, 0.0}, 100);
  mesh.points.emplace_back("stop", element);
  folder.write("beam.msh", mesh.text());
}

double largest_force(const Results& run) { return run.statistics("stop")["normal_force"]["max"]; }

TEST(ModesAccuracy, ImpactsOfASpanAreWithinIt) {
  constexpr double accuracy = 0.01;
  const Workshop folder;
  mesh_span(folder, 21);
  for (const double stiffness : {1e5, 1e6, 1e7}) {
    const double exact =
        largest_force(folder.run_text(span("count = 60\nstatic_modes = \"auto\"", stiffness)));
    for (const char* static_modes : {"none", "auto", "all"}) {
      const Results run = folder.run_text(
          span(fmt::format("accuracy = {}\nstatic_modes = \"{}\"", accuracy, static_modes), stiffness));
      const double error = largest_force(run) / exact - 1.0;
      fmt::print("| K_N {:.0e} | {} | {} modes | error {:.2f} % |\n", stiffness, static_modes,
                 run.summary["modes"]["frequencies_hz"].size(), 100.0 * error);
      EXPECT_LT(std::abs(error), accuracy) << stiffness << " " << static_modes;
      // and not by many modes more than it takes
      EXPECT_LT(run.summary["modes"]["frequencies_hz"].back().get<double>(),
                run.summary["modes"]["limit"]["up_to_hz"].get<double>());
    }
  }
}

TEST(ModesAccuracy, SaysWhatItTakesAndFollowsTheContacts) {
  constexpr double six_digits = 1e-6; // of the root of the clamped span
  const Workshop folder;
  mesh_span(folder, 47);
  std::size_t before = 0;
  for (const double stiffness : {1e5, 1e6}) {
    const Results run = folder.run_text(span("accuracy = 0.01", stiffness));
    const double contact =
        std::sqrt(bending / mass) * std::pow(stiffness / (2.0 * std::numbers::sqrt2 * bending), 2.0 / 3.0);
    const double root = std::sqrt(7.0 * contact) + 4.7300407 * std::pow(bending / mass, 0.25);
    const auto& limit = run.summary["modes"]["limit"];
    EXPECT_EQ(limit["contact"], "stop");
    EXPECT_EQ(limit["accuracy"], 0.01);
    EXPECT_TRUE(close_to(limit["contact_frequency_hz"], contact / (2.0 * std::numbers::pi), six_digits));
    EXPECT_TRUE(close_to(limit["up_to_hz"], root * root / (2.0 * std::numbers::pi), six_digits));
    EXPECT_TRUE(says(run.summary["notes"].dump(), "for contact forces within modes.accuracy = 0.01"));
    const std::size_t modes = run.summary["modes"]["frequencies_hz"].size();
    EXPECT_GT(modes, before) << "the modes of another stiffness are not read again";
    before = modes;
  }
}

TEST(ModesAccuracy, WarnsOfLoadsThatAreFasterThanItsModes) {
  const Workshop folder;
  mesh_span(folder, 47);
  const Results run = folder.run_text(span("accuracy = 0.1", 1e5) + R"([[loads]]
group = "stop"
direction = [0.0, 1.0, 0.0]
harmonic = { amplitude = 1.0, frequency = 5000.0 }
)");
  EXPECT_TRUE(says(run.summary["warnings"].dump(), "shake with up to 5000 Hz, faster than the modes"));
}

TEST(ModesAccuracy, NeedsContacts) {
  const Workshop folder;
  const fs::path study =
      folder.write("study.toml", "[mesh]\nfile = \"beam.msh\"\n[modes]\naccuracy = 0.01\n");
  const Outcome outcome = folder.fretwork({"check", study.string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(says(outcome.err, "modes.accuracy = 0.01: there are no [[contacts]]"));
  EXPECT_TRUE(says(outcome.err, "give count or up_to_hz"));
}

TEST(ModesAccuracy, NeedsAContactAtABeam) {
  const Workshop folder;
  folder.write("mass.msh", lone_points({"mass"}).text());
  const fs::path study = folder.write("study.toml", R"([mesh]
file = "mass.msh"
[[masses]]
group = "mass"
mass = 1.0
[[restraints]]
group = "mass"
fixed = ["uz", "rx", "ry", "rz"]
[modes]
accuracy = 0.01
[[contacts]]
name = "stop"
group = "mass"
obstacle = "circle"
axis = [0.0, 0.0, 1.0]
gap = 1.0e-4
normal_stiffness = 1.0e6
[transient]
duration = 0.01
)");
  for (const char* command : {"run", "check"}) {
    const Outcome outcome = folder.fretwork({command, study.string()});
    EXPECT_EQ(outcome.status, 1) << command;
    EXPECT_TRUE(says(outcome.err, "modes.accuracy = 0.01: no contact is at a beam with mass")) << command;
    EXPECT_TRUE(says(outcome.err, "give modes.count or modes.up_to_hz")) << command;
  }
}

} // namespace
} // namespace fretwork::app::test
